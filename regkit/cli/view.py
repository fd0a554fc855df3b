"""``regkit view``."""

from __future__ import annotations

import os
import signal
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread
from typing import Annotated

import typer

from regkit.cli.console import errors, output
from regkit.cli.options import options
from regkit.experiment.viewing import site_of
from regkit.viewer.server import HOST, Server


def view(
    what: Annotated[
        Path,
        typer.Argument(
            metavar="WHAT",
            help="Results of a run, RESULTS/METHOD/RECORDING, a folder of `track` or `register`, "
            "the JSON of `align --json`, the folder or file of a recording, or a cloud.",
            show_default=False,
        ),
    ],
    recording: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="Name of the recording, if there are several.", show_default=False
        ),
    ] = None,
    method: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Show only this method of a run. Repeatable."),
    ] = None,
    host: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS", help="Address to listen on; at others than this one, others can see."
        ),
    ] = HOST,
    port: Annotated[
        int,
        typer.Option(min=0, max=65535, metavar="N", help="Port to listen on; 0 for a free one."),
    ] = 0,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in a browser.")
    ] = True,
) -> None:
    """Show tracks, clouds or a recording in a browser, until Ctrl-C."""
    with options(**{"dataset.recordings": "--recording", "port": "--port", "host": "--host"}):
        site = site_of(what, recording, method or ())
        server = Server(site, host, port)
    with server, _interrupted() as interrupt:
        Thread(target=server.serve_forever, daemon=True).start()
        output.print(server.url)
        errors.print("Ctrl-C ends the viewer")
        if browser:
            open_browser(server.url)
        interrupt.wait()
        server.shutdown()


@contextmanager
def _interrupted() -> Iterator[Event]:
    """Context manager: yields an event that Ctrl-C sets, which here is the way to end."""
    pressed = Event()
    former = signal.getsignal(signal.SIGINT)
    if former not in (signal.SIG_IGN, None):
        signal.signal(signal.SIGINT, lambda *_: pressed.set())
    try:
        yield pressed
    finally:
        if former is not None:
            signal.signal(signal.SIGINT, former)


def open_browser(url: str) -> None:
    """Opens a page in a browser, where there is a display."""
    if _has_display():
        webbrowser.open(url)


def _has_display() -> bool:
    """Whether a browser can open a window."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))

"""``regkit doctor``."""

from __future__ import annotations

import importlib
import platform
import sys
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from regkit.cli.console import output, print_warning
from regkit.cli.extras import extras
from regkit.config.former import left_behind
from regkit.config.preset import preset, presets_of
from regkit.interfaces import SLOTS
from regkit.system.cache import cache_folder
from regkit.system.errors import RegkitError
from regkit.system.optional import load_library

LIBRARIES = {name: name for name in ("numpy", "scipy", "numba", "pydantic", "matplotlib")} | {
    "PIL": "pillow",
    "open3d": None,
    "casadi": None,
}
"""Libraries by module name, with the distribution to install where its name differs."""


def doctor(
    warm: Annotated[
        bool,
        typer.Option(
            "--warm",
            help="Compile and keep all numerical loops instead, so that no later run waits for "
            "it: for images, CI and containers. Takes up to a minute, once.",
        ),
    ] = False,
) -> None:
    """Check the installation and name the command that repairs each problem.

    Optional libraries are listed with what they are for; one that is missing is no problem.
    """
    if warm:
        _warm()
        return
    table = Table("component", "state", "repair")
    findings = [_python(), *(_library(*names) for names in LIBRARIES.items())]
    findings += [_plugins(), _cache()]
    for what, state, cure in findings:
        table.add_row(what, escape(state), escape(cure), style="red" if cure else None)
    output.print(table)
    _print_extras()
    if any(cure for _, _, cure in findings):
        raise typer.Exit(1)


def _warm() -> None:
    """Compiles all loops, and prints where they are kept and the time that it took."""
    warmed = importlib.import_module("regkit.api.warming").warm()
    for name, message in warmed.failed.items():
        print_warning(f"{name}: {message}")
    output.print(f"all loops are compiled ({warmed.seconds:.1f} s), and kept in {warmed.folder}")


def _print_extras() -> None:
    """Prints the optional libraries, and below them how to install those that are missing."""
    listed = extras(besides={*LIBRARIES})
    table = Table("optional library", "state", "for")
    for one in listed:
        table.add_row(one.name, one.version or "not installed", escape(", ".join(one.purposes)))
    output.print(table)
    for one in listed:
        if one.version is None:
            output.print(
                f"to install {one.name}: {one.command}",
            )


def _python() -> tuple[str, str, str]:
    enough = sys.version_info >= (3, 11)
    return "Python", platform.python_version(), "" if enough else "install Python 3.11 or newer"


def _library(module: str, distribution: str | None) -> tuple[str, str, str]:
    name = distribution or module
    try:
        library = load_library(module, install=distribution and f"pip install {distribution}")
    except RegkitError as error:
        state, _, cure = str(error).rpartition("run: ")
        return name, state.rstrip("; "), cure
    return name, str(library.__version__), ""


def _cache() -> tuple[str, str, str]:
    """Returns the cache folder and its size; it may be deleted at any time."""
    folder = cache_folder()
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    return "cache", f"{folder} ({size / 1e6:.1f} MB; safe to delete)", ""


def _plugins() -> tuple[str, str, str]:
    broken = []
    total = 0
    for slot in SLOTS:
        for kind in slot.available():
            total += 1
            try:
                slot.load(kind)
            except RegkitError as error:
                broken.append(str(error))
        broken += left_behind(slot)
        for name in presets_of(slot.group):
            try:
                preset(slot.group, name)
            except RegkitError as error:
                broken.append(str(error))
    if broken:
        return "plug-ins", "\n".join(broken), "reinstall or uninstall these distributions"
    return "plug-ins", f"{total} in {len(SLOTS)} groups", ""

"""A headless Chromium, and pages that are watched in it."""

import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = (
    "--no-sandbox",
    "--disable-background-networking",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
WITHOUT_WEBGL = """
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
        return kind === "2d" ? get.call(this, kind, ...more) : null;
    };
"""
"""A script that takes WebGL from the browser, whose pages then open much faster."""

TIMEOUT = 20_000
"""Time that a page has on a busy machine [ms]."""


@contextmanager
def chromium() -> Iterator[Any]:
    """Starts the Chromium of the system; skips the test where there is none."""
    driver = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        pytest.skip(f"none of {', '.join(PROGRAMS)} is installed")
    with driver.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=program, args=list(OPTIONS))
        yield browser
        browser.close()


@dataclass
class Watched:
    """A page, what it wrote to the console, and what it asked for.

    Attributes:
        page: The page of playwright.
        messages: Messages of the console and uncaught errors.
        requests: Addresses that were asked for, besides those that hold their own content.
    """

    page: Any
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def data(self, name: str) -> str | None:
        """A value that the page tells about itself."""
        return self.page.evaluate("name => document.documentElement.dataset[name]", name)

    def wait(self, condition: str) -> None:
        """Waits until an expression is true in the page, in which ``data`` is what it tells."""
        # Playwright's own waiting evaluates text in the page, which the page's policy forbids.
        source = f"(data => {condition})(document.documentElement.dataset)"
        end = time.monotonic() + TIMEOUT / 1000
        while not self.page.evaluate(source):
            assert time.monotonic() < end, f"not true in time: {condition}; {self.messages}"
            time.sleep(0.02)

    def go(self, hash: str) -> None:
        """Sets what follows the page's address."""
        # An address that is there already would change nothing, although the page has moved on.
        self.page.evaluate("history.replaceState(null, '', '#')")
        self.page.evaluate("hash => { location.hash = hash }", hash)

    def wait_frame(self, number: int) -> None:
        """Waits until a frame is drawn."""
        self.wait(f"data.ready === '{number}'")


@contextmanager
def opened(
    browser: Any,
    address: str | Path,
    *,
    hash: str = "",
    width: int = 800,
    height: int = 560,
    script: str = "",
    before: Callable[[Watched], None] = lambda watched: None,
    **options: Any,
) -> Iterator[Watched]:
    """Opens a page or a file in a context of its own.

    Args:
        browser: The browser.
        address: URL or file.
        hash: What follows the address.
        width: Width of the window in pixels.
        height: Its height.
        script: A script that runs before those of the page.
        before: What is done before the page opens.
        options: Other options of the context.
    """
    context = browser.new_context(viewport={"width": width, "height": height}, **options)
    watched = Watched(context.new_page())
    watched.page.set_default_timeout(TIMEOUT)
    watched.page.on("console", lambda message: watched.messages.append(message.text))
    watched.page.on("pageerror", lambda error: watched.messages.append(str(error)))
    watched.page.on(
        "request",
        lambda asked: asked.url.startswith("data:") or watched.requests.append(asked.url),
    )
    if script:
        watched.page.add_init_script(script)
    before(watched)
    url = address.as_uri() if isinstance(address, Path) else address
    watched.page.goto(url + hash)
    yield watched
    context.close()

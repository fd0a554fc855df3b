"""One browser, and one page of a walk in it, for all tests of the viewer."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import Watched, chromium, opened
from viewer_scenes import walk

from regkit.viewer.page import page


# A browser that runs on would disturb tests of other packages, which run loops of their own.
@pytest.fixture(scope="package")
def browser() -> Iterator[Any]:
    with chromium() as started:
        yield started


@pytest.fixture(scope="package")
def walk_page(tmp_path_factory) -> Path:
    file = tmp_path_factory.mktemp("viewer") / "walk.html"
    file.write_text(page("walk", walk()), "utf-8")
    return file


@pytest.fixture(scope="package")
def opened_walk(browser, walk_page) -> Iterator[Watched]:
    with opened(browser, walk_page, reduced_motion="reduce") as watched:
        yield watched


@pytest.fixture
def shown(opened_walk) -> Watched:
    """The page of the walk, at its first frame, as if it had just been opened."""
    opened_walk.page.set_viewport_size({"width": 800, "height": 560})
    opened_walk.page.emulate_media(color_scheme="light")
    opened_walk.go("#recording=walk&frame=0&play=0&speed=1&methods=best,icp")
    opened_walk.wait_frame(0)
    return opened_walk

"""Every code block of the pages runs, every document in them is valid, every link leads somewhere.

``pages.py`` says how a block that is special is marked. What is not run is skipped with its reason.
"""

import warnings

import pytest
from examples import Runner
from pages import Page, pages
from places import ROOT

from regkit.interfaces import SLOTS

PAGES = {page.path.relative_to(ROOT).as_posix(): page for page in pages()}
LEFT_OUT = {block.place: block for page in PAGES.values() for block in page.blocks if block.reason}


LONG = (
    "docs/explanation/spheres.md",
    "docs/how-to/shape-model.md",
    "docs/how-to/compiled.md",
    "docs/how-to/install.md",
    "docs/how-to/keypoints.md",
    "docs/how-to/limits.md",
    "docs/how-to/robot.md",
    "docs/how-to/room.md",
    "docs/how-to/compose.md",
    "docs/tutorials/comparison.md",
    "docs/tutorials/first-experiment.md",
    "docs/tutorials/notebook.md",
    "docs/tutorials/new-shape-model.md",
)
"""Pages whose blocks only a release runs; they take longest, and others use what they use."""


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.long] if name in LONG else [])
        for name, page in PAGES.items()
        if page.blocks
    ],
)
def test_blocks_of_page_run(name, tmp_path, monkeypatch, regkit):
    monkeypatch.chdir(tmp_path)
    runner = Runner(PAGES[name], tmp_path, regkit, monkeypatch.syspath_prepend)
    runner.prepare()
    for block in PAGES[name].blocks:
        if block.reason is None:
            runner.run(block)


@pytest.mark.parametrize("place", LEFT_OUT)
def test_block_that_is_not_run_says_why(place):
    assert len(LEFT_OUT[place].reason.split()) > 2
    pytest.skip(f"{place}: {LEFT_OUT[place].reason}")


@pytest.mark.parametrize("name", PAGES)
def test_links_of_page_lead_somewhere(name):
    page = PAGES[name]
    for target in page.links:
        if target.startswith(("http://", "https://")):
            continue
        file, _, anchor = target.partition("#")
        path = (page.path.parent / file).resolve() if file else page.path
        assert path.exists(), f"{name}: {target}"
        if anchor and path.suffix == ".md":
            assert anchor in Page.read(path).anchors, f"{name}: {target}"


def test_every_group_of_plugins_has_a_page():
    for slot in SLOTS:
        group = slot.group.removeprefix("regkit.")
        text = (ROOT / "docs" / "reference" / "plugins" / f"{group}.md").read_text()
        assert f"```{{plugins}} {slot.group}\n```" in text


def test_pages_build_without_a_warning(tmp_path):
    from sphinx.cmd.build import build_main

    with warnings.catch_warnings():
        # What Sphinx and its extensions use of one another is theirs to mend.
        warnings.simplefilter("ignore")
        # The theme has no part in what is warned of, and takes a quarter of the time.
        options = ["-q", "-W", "--keep-going", "-n", "-D", "html_theme=basic"]
        code = build_main([*options, str(ROOT / "docs"), str(tmp_path)])
    assert code == 0

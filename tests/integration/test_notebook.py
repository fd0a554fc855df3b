"""The tutorial's notebook is its page, with results that anyone may see."""

import json
import re
import runpy
from pathlib import Path

import pytest
from notebook_cells import KEPT, cells, stale
from places import ROOT

NOTEBOOK = ROOT / "docs" / "tutorials" / "notebook.ipynb"
LARGEST = 3_000_000
"""Size of the file that a repository and a download may have."""


def code_cells(notebook: Path) -> list[dict]:
    stored = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in stored if cell["cell_type"] == "code"]


def shown(cell: dict) -> list[str]:
    """What a cell shows: errors, streams and the best form of other outputs."""
    forms = ("image/png", "text/html", "text/plain")
    return [
        next((form for form in forms if form in output.get("data", {})), output["output_type"])
        for output in cell["outputs"]
    ]


@pytest.fixture
def page(tmp_path) -> Path:
    """A page with each kind of part, and its notebook."""
    picture = tmp_path / "one.png"
    picture.write_bytes(b"picture")
    file = tmp_path / "page.md"
    file.write_text(
        "# Page\n\nA [link](other.md#there), [one more](https://x.test), and code:\n\n"
        "Download it [as a notebook](page.ipynb).\n\n"
        "```python\na = 1\n```\n\n![result](one.png)\n\n*A caption.*\n\n"
        "```python\nprint(a)\n```\n\n```text\n1\n```\n\n## Part\n\n- one\n- two\n\n"
        f"```python\nview\n```\n\n{KEPT}\n![scene](one.png)\n"
    )
    return file


def store(page: Path) -> Path:
    notebook = page.with_suffix(".ipynb")
    made = [
        {
            "cell_type": one.kind,
            "source": one.source.splitlines(keepends=True),
            "attachments": {name: {"image/png": text} for name, text in one.pictures.items()},
        }
        for one in cells(page)
    ]
    notebook.write_text(json.dumps({"cells": made}))
    return notebook


def test_cells_are_the_prose_and_the_code_of_the_page(page):
    first, code, caption, printing, part, view, scene = cells(page)
    assert first.source.startswith("# Page\n\nA *link*, [one more](https://x.test), and code:")
    assert [one.source for one in (code, printing, view)] == ["a = 1", "print(a)", "view"]
    assert caption.source == "*A caption.*"
    assert part.source == "## Part\n\n- one\n- two"
    assert scene.source == "![scene](attachment:one.png)"
    assert scene.pictures == {"one.png": "cGljdHVyZQ=="}


@pytest.mark.parametrize(
    ("old", "new"),
    [("a = 1", "a = 2"), ("- two\n", "- three\n"), ("## Part\n", ""), ("view\n", "view\n\n\nb\n")],
)
def test_change_of_the_page_is_noticed(page, old, new):
    notebook = store(page)
    assert stale(notebook) is None
    text = page.read_text()
    page.write_text(text.replace(old, new))
    assert "cell" in stale(notebook)


def test_change_of_a_picture_and_a_new_last_cell_are_noticed(page):
    notebook = store(page)
    (page.parent / "one.png").write_bytes(b"another")
    assert "cell 6" in stale(notebook)
    page.write_text(page.read_text() + "\n## End\n")
    (page.parent / "one.png").write_bytes(b"picture")
    assert stale(notebook) == "it has 7 cells, and its page has 8"


def test_notebook_is_that_of_its_page():
    assert stale(NOTEBOOK) is None, "run: make notebook"


def test_notebook_is_executed_and_small_and_knows_no_machine():
    text = NOTEBOOK.read_text(encoding="utf-8")
    assert len(text.encode()) < LARGEST
    assert not re.search(r"/(home|tmp|Users|root|usr)/|site-packages|per second", text)
    code = code_cells(NOTEBOOK)
    assert [cell["execution_count"] for cell in code] == [*range(1, len(code) + 1)]
    forms = [form for cell in code for form in shown(cell)]
    assert "error" not in forms
    assert forms.count("image/png") > 3
    assert "<iframe srcdoc=" in text
    assert "<progress value='12' max='12'" in text
    assert all(output.get("name") != "stderr" for cell in code for output in cell["outputs"])


@pytest.mark.long
def test_notebook_runs_in_an_empty_folder():
    script = runpy.run_path(str(ROOT / "docs" / "notebook.py"))
    made = script["notebook_of"](NOTEBOOK.with_suffix(".md"))
    script["run"](made)
    ran = [cell for cell in made.cells if cell.cell_type == "code"]
    assert [shown(cell) for cell in ran] == [shown(cell) for cell in code_cells(NOTEBOOK)]

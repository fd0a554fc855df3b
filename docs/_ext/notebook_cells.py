"""Tutorials that are notebooks too: the cells of a page, and whether its notebook has them.

Blocks of Python are cells of code, and what is between them is prose. A notebook shows results
itself: text and pictures right after a block are left out. A comment keeps a picture:

    <!-- notebook: with the picture -->

Links to other pages become their titles in italics, for a notebook is opened anywhere.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.token import Token
from sphinx.application import Sphinx
from sphinx.util import logging

NOTE = (
    "This is a page of regkit's documentation, as a notebook; *titles in italics* are other pages. "
    "It runs in any folder, in an environment with regkit and Jupyter: install regkit's wheel and "
    "`jupyterlab` with pip."
)
"""What a notebook says below its title."""

KEPT = "<!-- notebook: with the picture -->"
_LINK = re.compile(r"(?<!!)\[([^]]+)\]\((?!https?://)[^)]+\)")
_PICTURE = re.compile(r"!\[([^]]*)\]\(([^)]+)\)")


@dataclass
class Cell:
    """A cell of a notebook.

    Attributes:
        kind: ``code`` or ``markdown``.
        source: Its text.
        pictures: The PNG files that the text shows, in base64 by their names.
    """

    kind: str
    source: str
    pictures: dict[str, str] = field(default_factory=dict)

    @classmethod
    def stored(cls, cell: dict[str, Any]) -> Cell:
        """Returns a cell of a notebook's file."""
        pictures = {name: one["image/png"] for name, one in cell.get("attachments", {}).items()}
        return cls(cell["cell_type"], "".join(cell["source"]), pictures)


def cells(page: Path) -> list[Cell]:
    """Returns the cells of a page."""
    found: list[Cell] = []
    for kind, text in _parts(page.read_text(encoding="utf-8"), page.with_suffix(".ipynb").name):
        if kind == "code" or text.startswith("#") or found[-1].kind == "code":
            found.append(Cell(kind, text))
        else:
            found[-1].source += f"\n\n{text}"
    found[0].source += f"\n\n{NOTE}"
    return [cell if cell.kind == "code" else _prose(cell, page.parent) for cell in found]


def stale(notebook: Path) -> str | None:
    """Returns how a notebook differs from its page; None if it does not."""
    stored = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    expected, present = cells(notebook.with_suffix(".md")), [Cell.stored(one) for one in stored]
    for number, (one, other) in enumerate(zip(expected, present, strict=False)):
        if one != other:
            return f"cell {number} differs from the page; there it begins: {one.source[:60]!r}"
    if len(expected) != len(present):
        return f"it has {len(present)} cells, and its page has {len(expected)}"
    return None


def _parts(text: str, itself: str) -> Iterator[tuple[str, str]]:
    """Yields the code and the paragraphs of a page.

    Args:
        text: The page.
        itself: The notebook's own name; a paragraph with a link to it is left out.
    """
    lines = text.splitlines()
    follows_code = keep = False
    for token in MarkdownIt("commonmark").enable("table").parse(text):
        if token.level or token.map is None:
            continue
        part = "\n".join(lines[slice(*token.map)]).strip()
        if token.type == "fence" and token.info == "python":
            yield "code", token.content.rstrip("\n")
        elif token.type == "html_block":
            keep = keep or part == KEPT
            continue
        elif _is_result(token, part) and follows_code and not keep:
            pass
        elif f"]({itself})" not in part:
            yield "markdown", part
        follows_code, keep = token.type == "fence", False


def _is_result(token: Token, part: str) -> bool:
    """Whether it shows what code gave: printed text, or a picture."""
    return token.type == "fence" or _PICTURE.fullmatch(part) is not None


def _prose(cell: Cell, folder: Path) -> Cell:
    """Returns a cell that needs no other file: its pictures are inside."""
    source, pictures = _LINK.sub(r"*\1*", cell.source), {}
    for _, target in _PICTURE.findall(source):
        file = folder / target
        pictures[file.name] = base64.b64encode(file.read_bytes()).decode()
        source = source.replace(f"]({target})", f"](attachment:{file.name})")
    return Cell(cell.kind, source, pictures)


def _checked(app: Sphinx) -> None:
    for notebook in sorted(Path(app.srcdir).glob("tutorials/*.ipynb")):
        if found := stale(notebook):
            logging.getLogger(__name__).warning("%s: %s; run: make notebook", notebook.name, found)


def setup(app: Sphinx) -> dict[str, bool]:
    """Connects the check of notebooks to the beginning of a build."""
    app.connect("builder-inited", _checked)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

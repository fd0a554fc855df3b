"""The Markdown pages of the project: their code blocks, and how these want to be run.

A comment before a block says what is special about it:

    <!-- example: not run: REASON -->          it is not run, and the tests say why
    <!-- example: with --set a.b=VALUE -->     added to each ``regkit run`` of the block
    <!-- example: fails -->                    its commands end with the error that is shown,
                                               where ... stands for anything
    <!-- example: file NAME -->                the block is written there before what follows
    <!-- example: part of hand -->             YAML that is a segment of the hand; or of `bones`
    <!-- example: from FILE -->                an excerpt of a file that is run by itself
    <!-- example: let NAME be FILE -->         stands alone: NAME is a link to a file or folder

YAML needs none of these if it is a template, an experiment, or some fields of an experiment, which
is completed and checked as `regkit validate` does.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token
from places import ROOT

_MARKER = re.compile(r"<!-- example: (.+?) -->", flags=re.DOTALL)
_COMMAND = re.compile(r"(\$ |regkit |make |python )")
_UNWANTED = re.compile(r"[^\w\- ]")


@dataclass(frozen=True)
class Block:
    """A code block.

    Attributes:
        page: Its page, from the project's root.
        line: Where it begins.
        language: What it is written in; ``text`` is not to be run.
        text: Its content.
        markers: What was said before it, by its first word: ``not``, ``with``, ``part``, ...
    """

    page: str
    line: int
    language: str
    text: str
    markers: dict[str, str] = field(default_factory=dict)

    @property
    def place(self) -> str:
        """Where it is, for messages."""
        return f"{self.page}:{self.line}"

    @property
    def reason(self) -> str | None:
        """Why it is not run, if it is not."""
        return self.markers.get("not run:")


@dataclass(frozen=True)
class Page:
    """A page.

    Attributes:
        path: Where it is.
        blocks: Its code blocks.
        stand_ins: Names that stand for files or folders of the project.
        anchors: Of its headings.
        links: Targets of its links and pictures.
    """

    path: Path
    blocks: tuple[Block, ...]
    stand_ins: dict[str, str]
    anchors: frozenset[str]
    links: tuple[str, ...]

    @classmethod
    def read(cls, path: Path) -> Page:
        """The page in a Markdown file."""
        tokens = MarkdownIt("commonmark").enable("table").parse(path.read_text(encoding="utf-8"))
        name = path.relative_to(ROOT).as_posix()
        blocks, stand_ins, pending = [], {}, []
        for token in tokens:
            if token.type == "html_block":
                pending += [" ".join(found.split()) for found in _MARKER.findall(token.content)]
                stand_ins |= dict(_stand_in(one) for one in pending if one.startswith("let "))
                pending = [one for one in pending if not one.startswith("let ")]
            elif token.type in ("fence", "code_block"):
                language = _language(token)
                markers = dict(_split(one) for one in pending)
                line = token.map[0] + 1
                blocks.append(Block(name, line, language, token.content, markers))
                pending = []
        assert not pending, f"{name}: no block follows {pending}"
        return cls(path, tuple(blocks), stand_ins, _anchors(tokens), tuple(_links(tokens)))


def pages() -> list[Page]:
    """The README and every page of the documentation."""
    found = sorted((ROOT / "docs").rglob("*.md"))
    kept = [path for path in found if not {"_build", "examples"} & set(path.parts)]
    return [Page.read(path) for path in (ROOT / "README.md", *kept)]


def _split(marker: str) -> tuple[str, str]:
    for word in ("not run:", "with", "fails", "file", "part of", "from"):
        if marker == word or marker.startswith(f"{word} "):
            return word, marker[len(word) :].strip()
    raise AssertionError(f"no such marker: {marker}")


def _stand_in(marker: str) -> tuple[str, str]:
    _, name, _, target = marker.split()
    return name, target


def _language(token: Token) -> str:
    if token.type == "code_block":
        # Pages that are older than this rule indent commands, and what commands print.
        return "sh" if _COMMAND.match(token.content.lstrip()) else "text"
    return token.info.strip()


def _anchors(tokens: list[Token]) -> frozenset[str]:
    """The anchors of headings, as GitHub and MyST make them."""
    headings = [
        after.content.replace("`", "")
        for token, after in pairwise(tokens)
        if token.type == "heading_open"
    ]
    plain = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading) for heading in headings]
    return frozenset(_UNWANTED.sub("", one.lower()).replace(" ", "-") for one in plain)


def _links(tokens: list[Token]) -> list[str]:
    found = []
    for token in tokens:
        for child in token.children or ():
            target = child.attrGet("href") or child.attrGet("src")
            if isinstance(target, str):
                found.append(target)
    return found

"""Text of others, such as names in files, made safe to print."""

from __future__ import annotations

import re

_UNSAFE = re.compile(
    "[\x00-\x09\x0b-\x1f\x7f-\x9f"  # Controls of a terminal, without the line feed.
    "\u061c\u200b\u200e\u200f\u2028-\u202e\u2060-\u2069\ufeff"  # Hidden, or change the direction.
    "\ud800-\udfff]"  # Bytes of a file's name that are no text.
)
"""Characters that move a cursor, hide or reorder text, or cannot be encoded."""

_LONG_WORD = re.compile(r"\S{300,}")
_LONG_LINE = re.compile(r"(?m)^(.{2000}).+$")

LONGEST = 60
"""Number of characters of a value that messages show."""


def printable(text: str) -> str:
    """Returns a text with its unsafe characters as escapes; lines remain."""
    return _UNSAFE.sub(lambda found: found.group().encode("unicode_escape").decode("ascii"), text)


def plain_name(text: str) -> str:
    """Returns a name with an underscore in place of each unsafe character and line feed."""
    return _UNSAFE.sub("_", text).replace("\n", "_")


def is_name(text: str) -> bool:
    """Returns whether a name can be printed: it is not blank, and its characters are safe."""
    return bool(text.strip()) and plain_name(text) == text


def one_line(text: str) -> str:
    """Returns a text with its unsafe characters and its line feeds as escapes."""
    return printable(text).replace("\n", "\\n")


def shortened(text: str, longest: int = LONGEST) -> str:
    """Returns a text in one line, and a long one by its beginning and its length."""
    safe = one_line(text)
    return safe if len(safe) <= longest else f"{safe[:longest]}... ({len(text)} characters)"


def cut(message: str) -> str:
    """Returns a message with its long words, which are values of others, and long lines cut."""
    words = _LONG_WORD.sub(lambda found: shortened(found.group()), message)
    return _LONG_LINE.sub(r"\1 ...", words)

"""Numbers in text files, as programs write them.

Python also reads ``1_000`` and the digits of every script, which nobody writes into such files:
there they are damage.
"""

from __future__ import annotations


def real(word: str) -> float:
    """Returns the number that a word is.

    Raises:
        ValueError: If it is none.
    """
    return float(_plain(word))


def whole(word: str) -> int:
    """Returns the whole number that a word is.

    Raises:
        ValueError: If it is none.
    """
    return int(_plain(word))


def _plain(word: str) -> str:
    if "_" in word or not word.isascii():
        raise ValueError(f"{word[:60]!r} is not a number")
    return word

"""Damage to text: numbers, lines, words, separators, encodings."""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random

from tests.fuzz.mutations.unsuitable import UnsuitableError

NUMBERS = (
    *(
        "nan",
        "NaN",
        "-nan",
        "inf",
        "-inf",
        "Infinity",
        "1e400",
        "-1e400",
        "-0",
        "0",
        "0.0",
        "1e300",
    ),
    *("1e-300", "-1", "-1e9", "1e19", "1000000", str(2**31), str(2**63), str(10**30), "9" * 400),
    *(
        "1_000",
        "0x10",
        "1,5",
        "1.2.3",
        "1e",
        "--1",
        "+-1",
        "\u0663",
        "\u00bd",
        "1d3",
        "None",
        "#N/A",
    ),
    *("null", "true", '"1"', "'1'", "1 000", "(1)", "1e5000000", "1" * 5000),
)
"""Numbers that are none, or that no measurement has."""

WORDS = (
    "",
    "\0",
    "\u2028",
    "a" * 20_000,
    "../../x",
    "\x1b[2J",
    "=1+1",
    "\u202e",
    "\ud7ff",
    "'",
    '"',
)
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")


def _on_text(change: Callable[[Random, str], str]) -> Callable[[Random, bytes], bytes]:
    def mutation(random: Random, content: bytes) -> bytes:
        # Latin-1 gives every byte a character, and gives it back.
        return change(random, content.decode("latin-1")).encode("utf-8", "surrogatepass")

    return mutation


def _on_lines(change: Callable[[Random, list[str]], list[str]]) -> Callable[[Random, str], str]:
    def on_text(random: Random, text: str) -> str:
        return "".join(change(random, text.splitlines(keepends=True) or [""]))

    return on_text


def _one(random: Random, text: str, pattern: re.Pattern[str]) -> re.Match[str]:
    found = list(pattern.finditer(text))
    if not found:
        raise UnsuitableError
    # The first few are those of a header.
    return random.choice(found[:6] if random.random() < 0.4 else found)


def _replaced(text: str, match: re.Match[str], by: str) -> str:
    return text[: match.start()] + by + text[match.end() :]


def number(random: Random, text: str) -> str:
    return _replaced(text, _one(random, text, NUMBER), random.choice(NUMBERS))


def several_numbers(random: Random, text: str) -> str:
    for _ in range(random.randint(2, 20)):
        text = number(random, text)
    return text


def count(random: Random, text: str) -> str:
    """Change a whole number a little, or a lot."""
    match = _one(random, text, re.compile(r"(?<![\w.+-])\d+(?![\w.])"))
    value = int(match.group()[:18])
    changed = random.choice((value + 1, value - 1, 2 * value, value // 2, -value, 10**9, 10**12, 0))
    return _replaced(text, match, str(changed))


def scale(random: Random, text: str) -> str:
    """Multiply one number by a thousand or more."""
    match = _one(random, text, NUMBER)
    return _replaced(
        text, match, repr(float(match.group()[:30]) * random.choice((1e3, -1.0, 1e12)))
    )


def word(random: Random, text: str) -> str:
    return _replaced(text, _one(random, text, re.compile(r"[^\s,;]+")), random.choice(WORDS))


def exchange_words(random: Random, text: str) -> str:
    pattern = re.compile(r"[^\s,;]+")
    first, second = sorted((_one(random, text, pattern) for _ in range(2)), key=re.Match.start)
    if first.start() == second.start():
        raise UnsuitableError
    changed = _replaced(text, second, first.group())
    return _replaced(changed, first, second.group())


def separator(random: Random, text: str) -> str:
    """Another separator, everywhere or once."""
    old, new = random.choice("\t ,;:"), random.choice(("\t", " ", ",", ";", ", ", "|", "  ", ""))
    if old not in text:
        raise UnsuitableError
    return text.replace(old, new) if random.random() < 0.5 else text.replace(old, new, 1)


def decimal_comma(random: Random, text: str) -> str:
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


def line_ends(random: Random, text: str) -> str:
    return text.replace("\n", random.choice(("\r\n", "\r", "\n\n", " \n", "\x0b", "\x85", "")))


def remove_line(random: Random, lines: list[str]) -> list[str]:
    at = random.randrange(len(lines))
    return lines[:at] + lines[at + random.choice((1, 1, 2, 10)) :]


def repeat_line(random: Random, lines: list[str]) -> list[str]:
    at = random.randrange(len(lines))
    return lines[:at] + lines[at : at + 1] * random.choice((2, 2, 3, 1000)) + lines[at + 1 :]


def exchange_lines(random: Random, lines: list[str]) -> list[str]:
    one, other = random.randrange(len(lines)), random.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]
    return lines


def cut_line(random: Random, lines: list[str]) -> list[str]:
    at = random.randrange(len(lines))
    return [*lines[:at], lines[at][: random.randrange(len(lines[at]) + 1)], *lines[at + 1 :]]


def insert_line(random: Random, lines: list[str]) -> list[str]:
    at = random.randrange(len(lines) + 1)
    kinds = ("\n", "# a comment\n", "// a comment\n", "1 2 3\n", "1 2 3 4 5 6 7 8 9\n", "x,y,z\n")
    return [*lines[:at], random.choice((*kinds, "a b c\n", "\0\0\0\n")), *lines[at:]]


def encoding(random: Random, content: bytes) -> bytes:
    text = content.decode("latin-1")
    name = random.choice(("utf-16", "utf-16-le", "utf-32", "utf-8-sig", "utf-7", "cp500"))
    return text.encode(name, "replace")


def latin_letters(random: Random, content: bytes) -> bytes:
    """Letters of an encoding other than UTF-8, in place of others or added."""
    at = random.randrange(len(content) + 1)
    return content[:at] + random.choice((b"\xe9", b"\xc3", b"\xfc\xdf", b"\x80")) + content[at:]


TEXT = {
    **{
        one.__name__: _on_text(one)
        for one in (
            *(number, several_numbers, count, scale, word, exchange_words),
            *(separator, decimal_comma, line_ends),
        )
    },
    **{
        one.__name__: _on_text(_on_lines(one))
        for one in (remove_line, repeat_line, exchange_lines, cut_line, insert_line)
    },
    "encoding": encoding,
    "latin_letters": latin_letters,
}

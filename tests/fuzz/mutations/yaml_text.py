"""What only the text of YAML can hold: aliases, tags, directives, repeated keys, odd scalars."""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random

from tests.fuzz.mutations.unsuitable import UnsuitableError

TAGS = (
    *("!!python/object/apply:os.system", "!!python/name:os.system", "!!binary", "!!set", "!!omap"),
    *("!!int", "!!float", "!!str", "!!bool", "!!null", "!!timestamp", "!!map", "!!seq", "!custom"),
)
SCALARS = (
    *(
        "2001-01-01",
        "2001-99-99",
        "12:30:45",
        "0o17",
        "0b11",
        "0x1F",
        "1_000",
        ".inf",
        "-.INF",
        ".nan",
    ),
    *(
        "1e5",
        "1e400",
        "9" * 5000,
        "y",
        "off",
        "~",
        "'",
        '"\\ud800"',
        '"\\x00"',
        "*unknown",
        "&a",
        "<<",
    ),
    *(
        "|",
        ">-",
        "? a",
        "- - - a",
        "%TAG",
        "@x",
        "`x`",
        "[",
        "{a: 1",
        "]",
        "{[1, 2]: 3}",
        "? {a: 1}",
    ),
    *('"unclosed', "!!int abc", "!!float abc", "!!bool 7", "!!timestamp x", "=", "1." + "0" * 4000),
)
_VALUE = re.compile(r"(?<=: )[^\n#{\[|>]+")
_LINE = re.compile(r"^( *)([\w]+):.*$", re.MULTILINE)


def _one(random: Random, text: str, pattern: re.Pattern[str]) -> re.Match[str]:
    found = list(pattern.finditer(text))
    if not found:
        raise UnsuitableError
    return random.choice(found)


def _put(text: str, match: re.Match[str], new: str) -> str:
    return text[: match.start()] + new + text[match.end() :]


def scalar(random: Random, text: str) -> str:
    return _put(text, _one(random, text, _VALUE), random.choice(SCALARS))


def tag(random: Random, text: str) -> str:
    match = _one(random, text, _VALUE)
    return _put(text, match, f"{random.choice(TAGS)} {match.group()}")


def repeated_key(random: Random, text: str) -> str:
    match = _one(random, text, _LINE)
    return _put(text, match, f"{match.group()}\n{match.group()}")


def alias(random: Random, text: str) -> str:
    """One value is that of another place."""
    first, second = _one(random, text, _VALUE), _one(random, text, _VALUE)
    if first.start() >= second.start():
        raise UnsuitableError
    changed = _put(text, second, "*a")
    return _put(changed, first, f"&a {first.group()}")


def alias_of_itself(random: Random, text: str) -> str:
    match = _one(random, text, _VALUE)
    return _put(text, match, random.choice(("&a [*a]", "&a {x: *a}", "&a *a", "&a [*a, *a]")))


def laugh(random: Random, text: str) -> str:
    """Aliases of aliases, which grow without bound when they are written out."""
    many = random.choice((2, 9))
    lines = ["l0: &l0 [x, x, x, x, x, x, x, x, x]"]
    lines += [
        f"l{level}: &l{level} [{', '.join([f'*l{level - 1}'] * many)}]"
        for level in range(1, random.choice((3, 8, 12)))
    ]
    return "\n".join([*lines, text])


def merge(random: Random, text: str) -> str:
    match = _one(random, text, _LINE)
    value = random.choice(("*a", "{a: 1}", "[{a: 1}, {kind: human}]", "1", "&b {<<: *b}"))
    return _put(text, match, f"{match.group()}\n{match.group(1)}<<: {value}")


def directive(random: Random, text: str) -> str:
    lines = ("%YAML 1.1\n---\n", "%YAML 3.0\n---\n", "%TAG ! tag:x,2000:\n---\n", "%FOO\n---\n")
    return random.choice((*lines, "--- a\n", "---\n", "...\n")) + text


def documents(random: Random, text: str) -> str:
    return text + random.choice(("\n---\na: 1\n", "\n...\n", "\n--- !!int x\n", text, "\n- a\n"))


def indent(random: Random, text: str) -> str:
    match = _one(random, text, _LINE)
    return text[: match.start()] + random.choice((" ", "   ", "\t", "- ")) + text[match.start() :]


def nest(random: Random, text: str) -> str:
    depth = random.choice((20, 200, 1000, 5000))
    opening, closing = random.choice((("[", "]"), ("{a: ", "}"), ("- ", ""), ("? ", "")))
    return _put(text, _one(random, text, _VALUE), opening * depth + closing * depth)


def long_key(random: Random, text: str) -> str:
    match = _one(random, text, _LINE)
    key = random.choice(
        ("k" * 500, "k" * 5000, "? k", "\u00e9", "null", "1", "1.5", "[1]", '"a\\nb"')
    )
    return _put(text, match, f"{match.group()}\n{match.group(1)}{key}: 1")


def odd_character(random: Random, text: str) -> str:
    at = random.randrange(len(text) + 1)
    odd = ("\0", "\x07", "\x1b", "\ufeff", "\u2028", "\x85", "\ufffe", "\U0001f600", "\t", "\r")
    return text[:at] + random.choice(odd) + text[at:]


def _on_text(change: Callable[[Random, str], str]) -> Callable[[Random, bytes], bytes]:
    def mutation(random: Random, content: bytes) -> bytes:
        text = content.decode("utf-8", "replace")
        return change(random, text).encode("utf-8", "surrogatepass")

    return mutation


YAML_TEXT = {
    f"yaml.{one.__name__}": _on_text(one)
    for one in (
        *(scalar, tag, repeated_key, alias, alias_of_itself, laugh, merge),
        *(directive, documents, indent, nest, long_key, odd_character),
    )
}

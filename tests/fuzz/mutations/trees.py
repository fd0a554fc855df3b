"""Damage to a tree of lists and mappings: types, keys, depths, lengths, numbers."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from tests.fuzz.mutations.unsuitable import UnsuitableError

Path = tuple[Any, ...]

ABSURD = (
    *(0, -1, 1, 2, 0.0, -0.0, -1e-9, 1e-300, 1e300, -1e300, float("nan"), float("inf")),
    *(2**31, 2**63, -(2**63), 10**30, 10**400, 1e6, 1e9, 360, 1e6 * 360, 3.5, True, None),
)
VALUES = (
    *ABSURD,
    *(
        "",
        " ",
        "nan",
        "1",
        "1e5",
        "~",
        "null",
        "/",
        "..",
        "/dev/zero",
        "/dev/null",
        "a\nb",
        "\x1b[1m",
    ),
    *("x" * 5000, "\u00e9", "\u202e", "human", "best", "{}", "${HOME}", "~/x.yaml", "a\0b", "=1"),
    *([], {}, [None], [[]], [{}], {"": 1}, {"kind": "human"}, {"kind": None}, {"preset": "best"}),
    *({"kind": "direct"}, [1, 2, 3], [1.0] * 5000, {"a": {"b": {}}}, [[1, 2], [3]]),
)

MOST, DEEPEST = 20_000, 400
"""Number of places, and of levels, of the largest tree that is changed."""


def places(tree: Any) -> list[tuple[Path, Any]]:
    """Every place of a tree with what is there; aliases may make a tree that has no end."""
    found: list[tuple[Path, Any]] = []
    waiting: list[tuple[Path, Any]] = [((), tree)]
    while waiting:
        path, node = waiting.pop()
        if len(found) == MOST or len(path) > DEEPEST:
            raise UnsuitableError
        found.append((path, node))
        if isinstance(node, (dict, list)):
            inner = node.items() if isinstance(node, dict) else enumerate(node)
            waiting.extend(((*path, key), value) for key, value in inner)
    return found


def _holder(random: Random, tree: Any, kinds: tuple[type, ...] = (dict, list)) -> Any:
    holders = [node for _, node in places(tree) if isinstance(node, kinds) and node]
    if not holders:
        raise UnsuitableError
    return random.choice(holders)


def _keys(holder: Any) -> list[Any]:
    return list(holder) if isinstance(holder, dict) else list(range(len(holder)))


def replace(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    holder[random.choice(_keys(holder))] = random.choice(VALUES)


def absurd_number(random: Random, tree: Any) -> None:
    numbers = [
        (holder, key)
        for _, holder in places(tree)
        if isinstance(holder, (dict, list))
        for key in _keys(holder)
        if isinstance(holder[key], (int, float)) and not isinstance(holder[key], bool)
    ]
    if not numbers:
        raise UnsuitableError
    holder, key = random.choice(numbers)
    value = holder[key]
    scaled = (-value, value * 1000, value + 1) if abs(value) < 1e300 else ()
    holder[key] = random.choice((*ABSURD, *scaled, *scaled, *scaled))


def remove(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    del holder[random.choice(_keys(holder))]


def rename(random: Random, tree: Any) -> None:
    holder = _holder(random, tree, (dict,))
    old = random.choice(list(holder))
    new = random.choice(
        (f"{old}s", f"{old}"[:-1], "", "__class__", "kind", "preset", 1, None, "a.b", "../x")
    )
    items = [(new if key == old else key, value) for key, value in holder.items()]
    holder.clear()
    holder.update(items)


def add(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    if isinstance(holder, list):
        holder.insert(random.randrange(len(holder) + 1), random.choice((*VALUES, *holder)))
    else:
        holder[random.choice(("kind", "extra", "preset", "sweep", "x y", "\u00e9"))] = (
            random.choice(VALUES)
        )


def exchange(random: Random, tree: Any) -> None:
    one, other = _holder(random, tree), _holder(random, tree)
    first, second = random.choice(_keys(one)), random.choice(_keys(other))
    # Copies: a node within itself would have no end.
    one[first], other[second] = json_copy(other[second]), json_copy(one[first])


def wrap(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    key = random.choice(_keys(holder))
    holder[key] = random.choice(([holder[key]], {"value": holder[key]}, [holder[key], holder[key]]))


def deepen(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    key, as_list = random.choice(_keys(holder)), random.random() < 0.5
    node: Any = holder[key]
    for _ in range(random.choice((5, 60, 300))):
        node = [node] if as_list else {"a": node}
    holder[key] = node


def lengthen(random: Random, tree: Any) -> None:
    holder = _holder(random, tree)
    if isinstance(holder, list):
        holder.extend(holder * random.choice((1, 3, 300)))
    else:
        key = random.choice(list(holder))
        holder.update({f"{key}{n}": holder[key] for n in range(random.choice((1, 3, 300)))})


def json_copy(node: Any) -> Any:
    if isinstance(node, dict):
        return {key: json_copy(value) for key, value in node.items()}
    return [json_copy(value) for value in node] if isinstance(node, list) else node


_CHANGES = (replace, replace, absurd_number, absurd_number, absurd_number, remove, rename, add)
CHANGES: tuple[Callable[[Random, Any], None], ...] = (*_CHANGES, exchange, wrap, deepen, lengthen)

"""The tree of a YAML text, built from ruamel's events within bounds."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ruamel.yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)

from regkit.config.yaml_events import Events
from regkit.config.yaml_scalars import scalar
from regkit.system.printable import shortened

DEEPEST = 50
"""Maximum number of mappings and lists within each other."""

MOST = 50_000
"""Maximum number of values, those repeated by aliases included."""

_SURROGATE = re.compile("[\ud800-\udfff]")
"""Characters that an escape can write, but no file can hold."""

_CORE = "tag:yaml.org,2002:"


@dataclass(frozen=True)
class Node:
    """One value.

    Attributes:
        line: Its line, from 1.
        content: A scalar's value, the items of a list, or the keys and values of a mapping.
        size: Number of values in it, itself included.
        depth: Number of mappings and lists within each other in it.
    """

    line: int
    content: Any
    size: int = 1
    depth: int = 0


@dataclass(frozen=True)
class Key:
    """A key of a mapping: its text as written, whatever a plain scalar would mean as a value."""

    text: str
    line: int


def root_of(text: str, place: str | None) -> Node | None:
    """Returns the value of a YAML text; None if the text is empty.

    Args:
        text: The text, in one document without tags.
        place: Its file, for messages.

    Raises:
        ConfigError: If it is not YAML, or exceeds a bound; the line follows ``place``.
    """
    return _Builder(text, place).root()


class _Builder:
    """The events of a text and the anchors that were defined so far."""

    def __init__(self, text: str, place: str | None) -> None:
        self._events = Events(text, place)
        # An anchor without a node is that of a value which is still being read.
        self._anchors: dict[str, Node | None] = {}

    def root(self) -> Node | None:
        self._events.next()
        started = self._events.next()
        if not isinstance(started, DocumentStartEvent):
            return None
        if started.version is not None and tuple(started.version) != (1, 2):
            version = ".".join(map(str, started.version))
            raise self._events.error(f"the file asks for YAML {version}; only YAML 1.2 is read")
        root = self._node(self._events.next(), 1)
        self._events.next()
        if isinstance(self._events.next(), DocumentStartEvent):
            raise self._events.error(
                "a second document begins here (---); one file holds one document"
            )
        return root

    def _node(self, event: Any, depth: int) -> Node:
        line = self._events.line
        if isinstance(event, AliasEvent):
            return self._aliased(event.anchor)
        self._check_tag(event)
        if event.anchor is not None:
            self._anchors[event.anchor] = None
        if isinstance(event, ScalarEvent):
            node = Node(line, self._scalar(event))
        elif depth > DEEPEST:
            raise self._events.error(
                f"more than {DEEPEST} mappings and lists are within each other"
            )
        elif isinstance(event, SequenceStartEvent):
            items = list(self._items(depth))
            node = self._collection(line, items, items)
        else:
            pairs = self._pairs(depth)
            node = self._collection(line, pairs, list(pairs.values()))
        if event.anchor is not None:
            self._anchors[event.anchor] = node
        return node

    def _aliased(self, name: str) -> Node:
        if name not in self._anchors:
            raise self._events.error(f"nothing before this line is called '&{shortened(name)}'")
        node = self._anchors[name]
        if node is None:
            raise self._events.error(f"the value '&{shortened(name)}' contains itself")
        return node

    def _collection(self, line: int, content: Any, parts: list[Node]) -> Node:
        size = 1 + sum(part.size for part in parts)
        depth = 1 + max((part.depth for part in parts), default=0)
        if size > MOST:
            raise self._events.error(
                f"the text has more than {MOST} values, those repeated by aliases (*name) included"
            )
        if depth > DEEPEST:
            raise self._events.error(
                f"the aliases (*name) nest more than {DEEPEST} mappings and lists"
            )
        return Node(line, content, size, depth)

    def _items(self, depth: int) -> Iterator[Node]:
        while not isinstance(event := self._events.next(), SequenceEndEvent):
            yield self._node(event, depth + 1)

    def _pairs(self, depth: int) -> dict[Key, Node]:
        pairs: dict[str, tuple[Key, Node]] = {}
        merged: dict[str, tuple[Key, Node]] = {}
        while not isinstance(event := self._events.next(), MappingEndEvent):
            key, plain = self._key(event)
            if plain and key.text == "<<":
                merged = self._merged(self._node(self._events.next(), depth + 1)) | merged
                continue
            if key.text in pairs:
                raise self._events.error(
                    f"duplicate key '{shortened(key.text)}'; it is in line "
                    f"{pairs[key.text][0].line} already"
                )
            pairs[key.text] = key, self._node(self._events.next(), depth + 1)
        return dict((merged | pairs).values())

    def _key(self, event: Any) -> tuple[Key, bool]:
        """Returns a key, and whether it is a plain scalar."""
        line = self._events.line
        if isinstance(event, AliasEvent):
            raise self._events.error("an alias (*name) cannot be a key; write the name of a field")
        self._check_tag(event)
        if not isinstance(event, ScalarEvent):
            kind = "mapping" if isinstance(event, MappingStartEvent) else "list"
            raise self._events.error(f"a {kind} cannot be a key; write the name of a field")
        if not event.value:
            raise self._events.error("a key is empty; write the name of a field before the colon")
        if event.anchor is not None:
            self._anchors[event.anchor] = Node(line, event.value)
        return Key(event.value, line), not event.style

    def _merged(self, node: Node) -> dict[str, tuple[Key, Node]]:
        """Returns the pairs of the mappings behind ``<<``, of which earlier ones prevail."""
        pairs: dict[str, tuple[Key, Node]] = {}
        for one in node.content if isinstance(node.content, list) else [node]:
            if not isinstance(one.content, dict):
                raise self._events.error(
                    "'<<' merges mappings; give the alias of one, or a list of them"
                )
            pairs = {key.text: (key, value) for key, value in one.content.items()} | pairs
        return pairs

    def _check_tag(self, event: Any) -> None:
        if event.tag is not None:
            tag = str(event.tag)
            shown = f"!!{tag.removeprefix(_CORE)}" if tag.startswith(_CORE) else tag
            raise self._events.error(
                f"the tag '{shortened(shown)}' is not read here; write the value without it"
            )

    def _scalar(self, event: Any) -> Any:
        if _SURROGATE.search(event.value):
            raise self._events.error(
                f"'{shortened(event.value)}' has half of a pair of UTF-16, which is no character"
            )
        if event.style:
            return event.value
        try:
            return scalar(event.value)
        except ValueError as error:
            raise self._events.error(f"{shortened(event.value)} {error}") from None

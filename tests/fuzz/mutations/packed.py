"""Damage to the JSON within a GLB file, whose sizes are then right again."""

from __future__ import annotations

import struct
from collections.abc import Callable
from random import Random

from tests.fuzz.mutations.binary import BINARY
from tests.fuzz.mutations.tree_files import JSON
from tests.fuzz.mutations.unsuitable import UnsuitableError

Mutation = Callable[[Random, bytes], bytes]


def packed(text: bytes, data: bytes) -> bytes:
    """A GLB file of its two chunks."""
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data))
    chunks = ((b"JSON", text), (b"BIN\0", data))
    return head + b"".join(struct.pack("<I4s", len(one), name) + one for name, one in chunks)


def _parts(content: bytes) -> tuple[bytes, bytes]:
    if not content.startswith(b"glTF") or len(content) < 28:
        raise UnsuitableError
    (size,) = struct.unpack("<I", content[12:16])
    return content[20 : 20 + size], content[28 + size :]


def _text(mutation: Mutation) -> Mutation:
    def change(random: Random, content: bytes) -> bytes:
        text, data = _parts(content)
        return packed(mutation(random, text), data)

    return change


def _data(mutation: Mutation) -> Mutation:
    def change(random: Random, content: bytes) -> bytes:
        text, data = _parts(content)
        return packed(text, mutation(random, data))

    return change


PACKED = {
    **{f"glb.{name}": _text(mutation) for name, mutation in JSON.items()},
    **{f"glb.data.{name}": _data(BINARY[name]) for name in ("set_real", "set_integer", "cut_tail")},
}

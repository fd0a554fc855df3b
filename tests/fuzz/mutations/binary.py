"""Damage to any bytes, as disks, transfers and other people's programs do it."""

from __future__ import annotations

import struct
from random import Random

INTEGERS = (0, 1, -1, 2, 255, 65535, 2**31 - 1, -(2**31), 2**30, 10**6)
REALS = (float("nan"), float("inf"), -float("inf"), -0.0, 1e38, -1.0, 1e-45)
TOKENS = (
    b"\0",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"\0" * 64,
    b"\xff" * 16,
    b"\r",
    b"\x1b[31m",
    b"\x1a",
)


def _place(random: Random, content: bytes) -> int:
    # Headers are short and matter most, so half of the damage is done near the beginning.
    end = len(content) if random.random() < 0.5 else min(len(content), 200)
    return random.randrange(end + 1)


def truncate(random: Random, content: bytes) -> bytes:
    return content[: _place(random, content)]


def cut_tail(random: Random, content: bytes) -> bytes:
    return content[: max(0, len(content) - random.choice((1, 2, 3, 4, 8, 12, 16)))]


def flip_bits(random: Random, content: bytes) -> bytes:
    changed = bytearray(content)
    for _ in range(random.choice((1, 1, 2, 5, 20))):
        if changed:
            changed[min(_place(random, content), len(changed) - 1)] ^= 1 << random.randrange(8)
    return bytes(changed)


def set_byte(random: Random, content: bytes) -> bytes:
    at = _place(random, content)
    return content[:at] + bytes([random.choice((0, 1, 127, 128, 255))]) + content[at + 1 :]


def set_integer(random: Random, content: bytes) -> bytes:
    """Replace a 32-bit integer, wherever one may be."""
    at = _place(random, content) // 4 * 4
    order = random.choice("<<<>")
    return content[:at] + struct.pack(f"{order}i", random.choice(INTEGERS)) + content[at + 4 :]


def set_real(random: Random, content: bytes) -> bytes:
    """Replace a number of single or double precision, wherever one may be."""
    kind, size = random.choice((("<f", 4), ("<d", 8), (">f", 4)))
    at = _place(random, content) // 4 * 4
    return content[:at] + struct.pack(kind, random.choice(REALS)) + content[at + size :]


def remove_block(random: Random, content: bytes) -> bytes:
    at = _place(random, content)
    return content[:at] + content[at + random.choice((1, 2, 4, 12, 64, 500)) :]


def repeat_block(random: Random, content: bytes) -> bytes:
    at, size = _place(random, content), random.choice((1, 4, 12, 64, 500))
    times = random.choice((1, 1, 2, 50))
    return content[:at] + content[at : at + size] * times + content[at:]


def move_block(random: Random, content: bytes) -> bytes:
    at, to, size = _place(random, content), _place(random, content), random.choice((4, 16, 200))
    return content[:to] + content[at : at + size] + content[to + size :]


def insert_token(random: Random, content: bytes) -> bytes:
    at = random.choice((0, len(content), _place(random, content)))
    return content[:at] + random.choice(TOKENS) + content[at:]


def insert_noise(random: Random, content: bytes) -> bytes:
    at = _place(random, content)
    return content[:at] + random.randbytes(random.choice((1, 3, 30, 300))) + content[at:]


def zero_block(random: Random, content: bytes) -> bytes:
    """A block of zeros, as a crash of the machine leaves it."""
    at, size = _place(random, content), random.choice((8, 64, 4096))
    return content[:at] + bytes(len(content[at : at + size])) + content[at + size :]


def empty(random: Random, content: bytes) -> bytes:
    return b""


def only_noise(random: Random, content: bytes) -> bytes:
    return random.randbytes(random.choice((1, 10, 1000)))


BINARY = {
    one.__name__: one
    for one in (
        truncate,
        cut_tail,
        flip_bits,
        set_byte,
        set_integer,
        set_real,
        remove_block,
        repeat_block,
        move_block,
        insert_token,
        insert_noise,
        zero_block,
        empty,
        only_noise,
    )
}

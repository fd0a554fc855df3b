"""The sentence by which a file is listed."""

from __future__ import annotations

import re
from itertools import takewhile

from regkit.config.schema_line import MARK


def opening_sentence(text: str) -> str:
    """Returns the first sentence of the comment at the top of a YAML file."""
    lines = [line for line in text.splitlines() if not line.startswith(MARK)]
    comment = takewhile(lambda line: line.startswith("#"), lines)
    return first_sentence(" ".join(line.removeprefix("#") for line in comment))


def first_sentence(text: str) -> str:
    """Returns the first sentence of a text, in one line."""
    return re.split(r"(?<=[.])\s", " ".join(text.split()))[0]

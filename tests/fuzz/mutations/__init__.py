"""Ways to damage a file: any bytes, text, trees (YAML and JSON), archives and images."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from tests.fuzz.mutations.archives import ARCHIVES
from tests.fuzz.mutations.binary import BINARY
from tests.fuzz.mutations.images import IMAGES
from tests.fuzz.mutations.packed import PACKED
from tests.fuzz.mutations.text import TEXT
from tests.fuzz.mutations.tree_files import JSON, YAML
from tests.fuzz.mutations.unsuitable import UnsuitableError
from tests.fuzz.mutations.yaml_text import YAML_TEXT

Mutation = Callable[[Random, bytes], bytes]
"""Damages the content of a file; the same random numbers give the same damage."""

FORMS: dict[str, list[tuple[float, dict[str, Mutation]]]] = {
    "binary": [(1.0, BINARY)],
    "text": [(0.2, BINARY), (0.8, TEXT)],
    "json": [(0.1, BINARY), (0.2, TEXT), (0.7, JSON)],
    "yaml": [(0.05, BINARY), (0.15, TEXT), (0.3, YAML_TEXT), (0.5, YAML)],
    "npz": [(0.2, BINARY), (0.8, ARCHIVES)],
    "png": [(0.3, BINARY), (0.7, IMAGES)],
    "glb": [(0.3, BINARY), (0.7, PACKED)],
}
"""Mutations of each form of file, with the share of each group."""


def mutated(random: Random, form: str, content: bytes) -> tuple[bytes, list[str]]:
    """A damaged content, and the names of the one to three mutations that made it so."""
    names = []
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        shares, groups = zip(*FORMS[form], strict=True)
        (group,) = random.choices(groups, shares)
        name = random.choice(sorted(group))
        try:
            content = group[name](random, content)
        except UnsuitableError:
            # An earlier mutation left nothing that this one can be done to.
            continue
        names.append(name)
    return content, names

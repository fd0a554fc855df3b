"""A case: number N of seed S is always the same damage to the same file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from random import Random

from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.mutations import mutated
from tests.fuzz.seeds import GROUPS, seeds_of


@dataclass(frozen=True)
class Case:
    """A damaged input.

    Attributes:
        group: ``inputs`` or ``yaml``.
        number: Its number.
        kind: What it was before.
        sound: The files before.
        name: Name of the damaged file, before.
        content: Its content now.
        given: Its name now.
        mutations: What was done to it.
    """

    group: str
    number: int
    kind: Kind
    sound: Files
    name: str
    content: bytes
    given: str
    mutations: tuple[str, ...]

    @classmethod
    def of(cls, group: str, seed: int, number: int) -> Case:
        """The case of a number."""
        random, kind = drawn(group, seed, number)
        sound = random.choice(seeds_of(group, kind.name))
        name = random.choice([name for name in kind.forms if name in sound])
        content, mutations = mutated(random, kind.forms[name], sound[name])
        given = name
        if kind.suffixes and random.random() < 0.03:
            given = Path(name).stem + random.choice(kind.suffixes)
            mutations.append(f"suffix {given}")
        return cls(group, number, kind, sound, name, content, given, tuple(mutations))

    @property
    def place(self) -> str:
        """Number and kind, for people."""
        return f"{self.group} {self.number} ({self.kind.name})"

    def written(self, folder: Path) -> Path:
        """Write the files; answer with the path of what is read: the file, or the folder."""
        for name, content in {**self.sound, self.name: self.content}.items():
            path = folder / (self.given if name == self.name else name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return folder if self.kind.whole else folder / self.given

    def damaged(self, *, noted: bool) -> Damaged:
        """What the oracle gets to know."""
        return Damaged(self.sound, self.content, noted)


def drawn(group: str, seed: int, number: int) -> tuple[Random, Kind]:
    """The kind of a case, and the random numbers that its damage is made of."""
    random = Random(f"{seed}/{group}/{number}")
    kinds = GROUPS[group]
    (kind,) = random.choices(kinds, [kind.weight for kind in kinds])
    return random, kind

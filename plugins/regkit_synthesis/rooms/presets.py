"""Rooms by name, and the choice of a room in YAML."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from regkit_synthesis.motion.config import ClipConfig, KeyframesConfig
from regkit_synthesis.rooms.furniture import Box, Chair, Table
from regkit_synthesis.rooms.part import Part
from regkit_synthesis.rooms.person import Person
from regkit_synthesis.rooms.planes import Floor, Wall

RoomName = Literal["none", "floor", "walls", "wall_only", "furnished", "desk", "crowded"]

ROOMS: Mapping[RoomName, Mapping[str, Part]] = {
    "none": {},
    "floor": {"floor": Floor()},
    "walls": {
        "floor": Floor(),
        "back_wall": Wall(side="back", distance=0.8),
        "side_wall": Wall(side="left", distance=1.0),
    },
    "wall_only": {"wall": Wall(side="back", distance=0.5)},
    "furnished": {
        "floor": Floor(),
        "back_wall": Wall(side="back", distance=0.9),
        "side_wall": Wall(side="left", distance=1.2),
        "chair": Chair(side="left", distance=0.1, shift=0.1, heading_deg=40.0),
        "table": Table(side="front", distance=0.15, shift=0.55),
        "cupboard": Box(side="back", distance=0.4, shift=0.75, size=(0.9, 0.45, 1.7)),
    },
    "desk": {
        "floor": Floor(),
        "back_wall": Wall(side="back", distance=1.0),
        "desk": Box(side="front", distance=0.1, size=(1.8, 0.7, 0.75)),
    },
    "crowded": {
        "floor": Floor(),
        "back_wall": Wall(side="back", distance=1.2),
        "neighbour": Person(
            side="right", distance=0.1, shift=0.2, body="small",
            motion=ClipConfig(name="walk", way=0.2), heading_deg=-20.0,
        ),
        "onlooker": Person(
            side="back", distance=0.15, shift=-0.35, body="tall",
            motion=KeyframesConfig(name="arms_crossed"), heading_deg=15.0,
        ),
    },
}  # fmt: skip
"""The parts of each room, by name.

- ``floor``: only the floor.
- ``walls``: a floor, a wall behind the body, and one to its left in the image.
- ``wall_only``: a wall close behind the body.
- ``furnished``: floor and walls; a chair beside the body, a cupboard behind it, and a table in
  front of it, which hides a part of its legs.
- ``desk``: a desk with a closed front hides the lower body.
- ``crowded``: a second person walks beside the body, and a third stands partly hidden behind it.
"""

AnyPart = Annotated[
    Floor | Wall | Box | Chair | Table | Person,
    Field(discriminator="kind"),
]
"""A part of a room, by its ``kind``."""

PartName = Annotated[str, Field(pattern=r"^\w[\w. -]*$")]

Parts = Annotated[dict[PartName, AnyPart], Field(min_length=1, max_length=200)]
"""The parts by their names; as many as there are labels of pixels."""


def _form(value: Any) -> str:
    """Returns the tag of a room's form: name or parts."""
    return "name" if isinstance(value, str) else "parts"


RoomChoice = Annotated[
    Annotated[RoomName, Tag("name")] | Annotated[Parts, Tag("parts")], Discriminator(_form)
]
"""A room by its name, or its parts by their names."""


def room_of(choice: RoomName | Mapping[str, Part]) -> Mapping[str, Part]:
    """Returns the parts of a room by its name, or the given ones."""
    return ROOMS[choice] if isinstance(choice, str) else choice

"""Rooms: what stands around a body, and hides parts of it.

Room axes: x to the right of the image, y away from the camera, z up. They are level and face the
camera, so a view's heading turns the motion in its room, and elevation and roll show the room from
above and rolled. Parts are placed beside the region that the body covers over time, so that each
room suits each motion.
"""

from regkit_synthesis.rooms.furniture import Box, Chair, Table
from regkit_synthesis.rooms.part import Part
from regkit_synthesis.rooms.person import Person
from regkit_synthesis.rooms.planes import Floor, Wall
from regkit_synthesis.rooms.presets import ROOMS, RoomChoice, RoomName, room_of
from regkit_synthesis.rooms.region import Region
from regkit_synthesis.rooms.surface import Surface

__all__ = [
    "ROOMS",
    "Box",
    "Chair",
    "Floor",
    "Part",
    "Person",
    "Region",
    "RoomChoice",
    "RoomName",
    "Surface",
    "Table",
    "Wall",
    "room_of",
]

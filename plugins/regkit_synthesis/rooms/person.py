"""A second person in a room."""

from __future__ import annotations

from math import radians
from typing import Literal

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.bodies.choice import Body, Motion, chosen_body, chosen_motion
from regkit_synthesis.rooms.part import Standing
from regkit_synthesis.rooms.region import Region
from regkit_synthesis.rooms.surface import Surface


class Person(Standing):
    """A second person, who moves beside the first; the regions that both cover are apart."""

    kind: Literal["person"] = "person"

    body: Body = "average"
    """The body: ``average``, ``small`` or ``tall``, or any body by its ``kind``."""
    motion: Motion
    """The motion: the name of a shipped clip, or a motion by its ``kind``."""

    def surface(self, region: Region, times: Array) -> Surface:
        """Returns the moving skin.

        Raises:
            RegkitError: If a file is missing or invalid, or the motion does not fit the body.
        """
        body = chosen_body(self.body).body()
        moved, mesh = body.moved_by(chosen_motion(self.motion)), body.mesh
        turn = vector_to_matrix(np.array([0.0, 0.0, radians(self.heading_deg)]))
        own = Region.around(mesh.posed(moved(time)) @ turn.T for time in times)
        offset = own.offset_beside(region, self.side, self.distance, self.shift)
        T_room_ground = rigid(turn, offset)
        return Surface(
            mesh.faces, lambda time: mesh.posed(T_room_ground @ moved(time)), still=False
        )

"""Starts of bodies whose root is fixed in the world: sought as if it were free."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.geometry.rigid import inverse
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.interfaces import Template
from regkit.skeleton import Pose
from regkit.skeleton.joints import FreeJoint
from regkit.start.finalist import Finalist
from regkit.system.arrays import Array

BESIDE, TURNED = 0.15, np.radians(25.0)
"""A root that was sought freely may be this far from where it stands, in sizes and [rad]."""


class FreeRoot(Template):
    """A template whose fixed root is free, so that it can be sought.

    The root's frame is that of the segment, so that its pose is where it was found to stand.
    """

    kind: Literal["free_root"] = "free_root"
    template: Template
    """The template."""

    def description(self) -> BodyDescription:
        """Returns the description with a free root at the world's origin."""
        found = self.template.description()
        free = {"joint": FreeJoint(), "offset": (0.0, 0.0, 0.0), "rotation_deg": (0.0, 0.0, 0.0)}
        segments = {
            name: one if one.parent is not None else one.model_copy(update=free)
            for name, one in found.segments.items()
        }
        return found.model_copy(update={"segments": segments})

    def given_size(self) -> float | None:
        """Returns the template's given size [m]."""
        return self.template.given_size()

    def name(self) -> str:
        """Returns the template's name."""
        return self.template.name()


def is_fixed(template: Template) -> bool:
    """Returns whether the root of a template is fixed in the world."""
    return not template.body(template.candidate_sizes()[0]).skeleton.free


def at_root(body: Body, pose: Pose) -> Pose:
    """Returns the pose of a body with a fixed root, with the joints of a free one."""
    return Pose(body.skeleton.rest().root, pose.balls, pose.hinges)


def root_of(body: Body) -> Array:
    """Returns where the fixed root of a body stands, T_world_root (4, 4) [m]."""
    return np.asarray(body.place(body.skeleton.rest()).transforms[0])


def standing(finalists: Sequence[Finalist], body: Body) -> list[Finalist]:
    """Returns the finalists whose free root is near the fixed one of a body; all if none is."""
    root = inverse(root_of(body))

    def near(one: Finalist) -> bool:
        off = root @ one.pose.root
        turned = to_vector(from_matrix(off[:3, :3]))
        beside = float(np.linalg.norm(off[:3, 3])) < BESIDE * body.size
        return beside and float(np.linalg.norm(turned)) < TURNED

    return [one for one in finalists if near(one)] or list(finalists)

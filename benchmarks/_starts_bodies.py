"""Bodies and motions of the starts' benchmark, in two sets that share none of them.

``development`` is for the choice of rules and constants, ``test`` only for the figures of the page.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal

import numpy as np

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import Template
from regkit.system.arrays import Array
from regkit_synthesis import assets
from regkit_synthesis.bodies.bodies import HumanBody
from regkit_synthesis.bodies.body_map import body_map
from regkit_synthesis.motion.config import BvhConfig, ClipConfig, KeyframesConfig, MotionConfig

Set = Literal["development", "test"]


@dataclass(frozen=True)
class Subject:
    """A body and the template that is registered to it.

    Attributes:
        name: Its name.
        mesh: Function that returns its mesh.
        template: The template without a size, as in YAML.
        size_field: The template's field of the size.
        size: The body's size, as the template defines it [m].
    """

    name: str
    mesh: Callable[[], SkinnedMesh]
    template: Mapping[str, Any]
    size_field: str
    size: float

    def sized(self) -> Template:
        """Returns the template of the right size."""
        return _template({**self.template, self.size_field: self.size})

    def unsized(self) -> Template:
        """Returns the template of unknown size."""
        return _template(dict(self.template))


def _template(data: dict[str, Any]) -> Template:
    return Template.parse(data, place="benchmark", field="template")


def _middle() -> SkinnedMesh:
    """Returns the body midway between the small and the tall one, of no template's proportions."""
    small, tall = assets.small_human(), assets.tall_human()
    rest = (small.rest + tall.rest) / 2.0
    left, _, right = np.linalg.svd(rest[:, :3, :3])
    rest[:, :3, :3] = left @ right
    return replace(small, vertices=(small.vertices + tall.vertices) / 2.0, rest=rest)


def _human(name: str, mesh: Callable[[], SkinnedMesh], build: str, size: float) -> Subject:
    return Subject(name, mesh, {"kind": "human", "build": build}, "height", size)


SUBJECTS: Mapping[Set, tuple[Subject, ...]] = {
    "development": (
        _human("average", assets.average_human, "average", 1.6327),
        _human("small", assets.small_human, "small", 1.4901),
    ),
    "test": (
        _human("tall", assets.tall_human, "tall", 1.88),
        # The average build in this body's height, as for anyone who is measured with a tape.
        _human("middle", _middle, "average", (1.4901 + 1.88) / 2.0),
    ),
}


@dataclass(frozen=True)
class Motif:
    """A motion and three moments of it.

    Attributes:
        motion: The motion.
        times: Moments [s]; the first one is the start's frame, the others may tell the size.
    """

    motion: MotionConfig
    times: tuple[float, float, float]


MOTIFS: Mapping[Set, Mapping[str, Motif]] = {
    "development": {
        "walk": Motif(ClipConfig(name="walk", way=0.0), (0.3, 0.7, 1.1)),
        "dance": Motif(ClipConfig(name="dance_b", way=0.0), (0.9, 0.3, 1.5)),
        "punch": Motif(ClipConfig(name="punch", way=0.0), (0.9, 0.3, 1.5)),
        "kick": Motif(ClipConfig(name="kick", way=0.0), (0.7, 0.2, 1.2)),
        "squat": Motif(KeyframesConfig(name="squat"), (1.2, 0.2, 2.2)),
        "arms up": Motif(KeyframesConfig(name="arms"), (1.7, 0.5, 3.0)),
    },
    "test": {
        "run": Motif(ClipConfig(name="run", way=0.0), (0.2, 0.4, 0.6)),
        "other dance": Motif(ClipConfig(name="dance_a", way=0.0), (0.8, 0.3, 1.3)),
        "turning kick": Motif(ClipConfig(name="spinkick", way=0.0), (0.6, 0.1, 1.0)),
        "tennis": Motif(KeyframesConfig(name="tennis"), (0.5, 0.0, 1.0)),
        "kneel": Motif(BvhConfig(name="kneel", way=0.0), (7.0, 1.0, 12.0)),
        "wave": Motif(KeyframesConfig(name="wave"), (1.5, 0.0, 2.5)),
    },
}


def motif_named(name: str) -> Motif:
    """Returns a motion of any set by its name."""
    return {one: motif for group in MOTIFS.values() for one, motif in group.items()}[name]


@dataclass(frozen=True)
class Moving:
    """A body that follows a motion.

    Attributes:
        body: The body.
        poses: Function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).
    """

    body: HumanBody
    poses: Callable[[float], Array]


@cache
def moving(subject: str, motif: str) -> Moving:
    """Returns a body that follows a motion of the sets, both by name."""
    bodies = {one.name: one for group in SUBJECTS.values() for one in group}
    return moved_by(bodies[subject], motif_named(motif).motion)


def moved_by(subject: Subject, motion: MotionConfig) -> Moving:
    """Returns a person that follows a motion."""
    body = HumanBody(subject.mesh(), body_map("anny_cmu"))
    return Moving(body, body.moved_by(motion))

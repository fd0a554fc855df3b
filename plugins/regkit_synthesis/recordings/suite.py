"""The evaluation suite: what several people and hands do, and templates that fit them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit_synthesis import assets
from regkit_synthesis.hands.hand_moves import fists, gestures, signs
from regkit_synthesis.recordings.hand_take import HandTake
from regkit_synthesis.recordings.person_take import PersonTake
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import Scene
from regkit_synthesis.templates.templates import (
    FittedTemplate,
    human_template,
    right_hand_template,
)

COMMAND = "python -m regkit_synthesis --suite"

_NOISY = 0.02
"""Standard deviation of the depth in the noisy recordings [m]."""


class Take(Protocol):
    """How a body moves, and from where that is seen."""

    def scene(self, name: str, body: str, mesh: SkinnedMesh) -> Scene:
        """The scene, which is called ``name``, with a mesh that is ``body`` of anny."""
        ...


@dataclass(frozen=True)
class Body:
    """A person or a hand of the suite.

    Attributes:
        mesh: Reads the mesh.
        what: Which of anny's bodies that is.
        template: Makes the template that is fitted to the mesh.
        takes: What the body does, by the name of the recording.
    """

    mesh: Callable[[], SkinnedMesh]
    what: str
    template: Callable[[SkinnedMesh], FittedTemplate]
    takes: Mapping[str, Take]


def rendered(name: str, take: str, seed: int) -> DepthRecording:
    """One recording of the body called ``name``; another seed changes its noise alone.

    Raises:
        DependencyError: If Open3D cannot be loaded.
    """
    body = SUITE[name]
    scene = body.takes[take].scene(take, body.what, body.mesh())
    random = np.random.default_rng([seed, *f"{name}/{take}".encode()])
    return scene.rendered(lambda frame: random)


def _small_human(mesh: SkinnedMesh) -> FittedTemplate:
    return human_template(mesh, "A small person", "a small body", COMMAND)


def _slim_hand(mesh: SkinnedMesh) -> FittedTemplate:
    return right_hand_template(mesh, "A slim right hand", "a slim hand", COMMAND)


_WALK = PersonTake("walk", heading=20.0, place=(0.0, 0.7, 3.0))
_DANCE = PersonTake("dance_b", heading=-20.0, place=(0.25, 0.89, 3.3), start=0.4, speed=0.9)
# The boxer turns to the left by 110 degrees and the kicker by 140: they begin turned to the other
# side of the camera, so as not to show it their backs.
_PUNCH = PersonTake("punch", heading=-40.0, place=(0.0, 0.7, 3.3), frames=64, way=0.0)
_KICK = PersonTake("kick", heading=-55.0, place=(0.15, 0.72, 3.2), way=0.1, speed=0.75)

_IWER = "relaxed, point and pinch of iwer"
_FISTS = "flat, vulcan and fist of handy-work"
_SIGNS = "relax, horns, shaka, vulcan and point of handy-work"

SUITE: Mapping[str, Body] = {
    "human_average": Body(
        assets.average_human,
        "the body",
        lambda mesh: human_template(mesh, command=COMMAND),
        {
            "walk_oblique": PersonTake("walk", heading=60.0, place=(-0.05, 0.76, 3.1)),
            "run": PersonTake("run", heading=20.0, place=(-0.1, 0.76, 3.2), way=0.05),
            "dance": _DANCE,
            "punch": _PUNCH,
            "kick": _KICK,
            "dance_noisy": replace(_DANCE, noise=_NOISY),
            "punch_fast": replace(_PUNCH, speed=2.0, repeated=True),
        },
    ),
    "human_small": Body(
        assets.small_human,
        "a small body",
        _small_human,
        {
            "walk_above": PersonTake("walk", heading=20.0, place=(0.0, 1.7, 3.0), tilt=20.0),
            "jump": PersonTake("jump", heading=0.0, place=(0.0, 0.77, 3.15)),
            "punch_side": replace(_PUNCH, heading=-15.0, place=(0.0, 0.66, 3.1)),
            "walk_noisy": replace(_WALK, way=0.15, noise=_NOISY),
            "walk_fast": replace(_WALK, way=0.05, speed=2.0),
            "kick_noisy": replace(_KICK, place=(0.15, 0.66, 3.1), noise=_NOISY),
        },
    ),
    "hand_average": Body(
        assets.average_hand,
        "the right hand",
        lambda mesh: right_hand_template(mesh, command=COMMAND),
        {
            "gestures": HandTake(gestures, _IWER, frames=68),
            "fists": HandTake(fists, _FISTS, frames=84, phase=np.pi),
            "signs": HandTake(signs, _SIGNS, frames=84),
        },
    ),
    "hand_slim": Body(
        assets.slim_hand,
        "a slim right hand",
        _slim_hand,
        {
            "gestures": HandTake(gestures, _IWER, frames=68, phase=np.pi),
            "fists": HandTake(fists, _FISTS, frames=84),
            "signs": HandTake(signs, _SIGNS, frames=84, phase=np.pi),
        },
    ),
}

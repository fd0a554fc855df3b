"""A pole with an arm, and a ball beside it: a small template of two bodies."""

from pathlib import Path

import numpy as np
from scarecrow import POLE, measured

from regkit.body import Body
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.skeleton import Pose

BALL = """
title: A ball
size: {name: diameter, value: 0.24, range: [0.24, 0.24]}
segments:
  ball:
    joint: {type: free}
    capsules: [{start: [0, 0, 0], end: [0, 0, 0], radius: 0.12}]
    markers: {middle: [0, 0, 0]}
"""

APART = [-0.2, 0.0, 2.4], [0.7, 0.0, 2.4]
"""Places of the pole and the ball, apart from each other [m]."""


def pole_and_ball(folder: Path) -> dict[str, dict[str, object]]:
    """The templates of the pole and the ball, by name."""
    for name, text in (("pole", POLE), ("ball", BALL)):
        (folder / f"{name}.yaml").write_text(text)
    more: dict[str, dict[str, object]] = {"pole": {"size": 1.0}, "ball": {}}
    return {
        name: {"kind": "file", "path": str(folder / f"{name}.yaml"), **fields}
        for name, fields in more.items()
    }


def template(free: dict[str, dict[str, object]]) -> Template:
    return Template.parse({"kind": "composed", "free": free}, place="test", field="template")


def placed(body: Body, pole: list[float], ball: list[float], arm: float = 20.0) -> Pose:
    """A pole that stands upright and a ball, at places in the camera's frame [m]."""
    pose = body.skeleton.rest()
    for one in body.free_bodies:
        own = one.body.skeleton.rest()
        place, hinges = (pole, np.radians([arm])) if one.name == "pole" else (ball, ())
        turn = vector_to_matrix(np.array([np.pi, 0.0, 0.0]))
        own = Pose(rigid(turn, np.array(place)), own.balls, np.array(hinges))
        pose = one.placed(own, pose)
    return pose


def seen(whole: Template, pole: list[float], ball: list[float]) -> tuple[Observation, Body, Pose]:
    body = whole.body(whole.candidate_sizes()[0])
    pose = placed(body, pole, ball)
    return measured(body, pose, voxel=0.016), body, pose

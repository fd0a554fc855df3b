"""The start of a body with parts: its base first, then the parts inside."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from regkit.body import Body, Part
from regkit.body.lifting import Lifting
from regkit.interfaces import Method, Start, Template
from regkit.observation import Observation
from regkit.skeleton import Pose

TURNS = np.radians([[0.0, 0.0, 0.0], [0.0, -50.0, 0.0], [0.0, 50.0, 0.0], [35.0, 0.0, 0.0]])
"""Turns of a part in its socket that are tried: about its bone, and to its front [rad]."""


def with_parts(
    find: Callable[[Template], Start], template: Template, observation: Observation, method: Method
) -> Start | None:
    """Returns the start of a template with parts; None if it has none.

    The base is found as any body is. Then each part in turn is tried in its stances and in some
    turns, registered together with everything else, and the one of least energy stays.

    Args:
        find: Search for the start of a template.
        template: The template.
        observation: The first frame.
        method: Method that registers the tries.
    """
    coarse = template.coarse()
    if coarse is None:
        return None
    start = find(coarse)
    body = template.body(start.body.size)
    lifting = Lifting.of(body)
    assert lifting is not None
    pose = lifting.lifted(start.pose, body.skeleton.rest())
    registrar = method.bind(body)
    for part in body.attached_parts:
        found = [registrar.register(observation, [one]) for one in _tries(body, part, pose)]
        energies = [registrar.evaluate(observation, one.pose).energy for one in found]
        pose = found[int(np.argmin(energies))].pose
    return replace(start, body=body, pose=pose)


def _tries(body: Body, part: Part, pose: Pose) -> Iterator[Pose]:
    """Yields the poses in which a part has the joints of one of its stances, turned."""
    bones = body.skeleton
    own = part.dofs[~np.isin(part.dofs, bones.joint_dofs[bones.names[part.segments[0]]])]
    joint = np.setdiff1d(part.dofs, own)
    turns = TURNS if len(joint) == 3 else TURNS[:1, : len(joint)]
    steps = {tuple(bones.difference(pose, stance.pose)[own].round(6)) for stance in body.stances}
    for inner, turn in product(sorted(steps), turns):
        step = np.zeros(bones.dofs)
        step[own] = inner
        tried = bones.retract(pose, step)
        step = np.zeros(bones.dofs)
        step[joint] = turn
        yield bones.limits.projected(bones.retract(tried, step))

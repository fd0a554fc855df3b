"""The direct method's energy of a frame of several cameras."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from regkit.interfaces import JointEnergy, Prior
from regkit.observation import Observation
from regkit.registration import (
    FrameEnergy,
    Plan,
    PlannedEnergy,
    PlannedJoints,
    ViewEnergy,
    ViewsEnergy,
)
from regkit.skeleton import Pose
from regkit_plugins.methods.direct.effects import Effects

if TYPE_CHECKING:
    from regkit_plugins.methods.direct.bound import BoundDirect


def best_in_views(
    method: BoundDirect,
    observation: Observation,
    candidates: Sequence[Pose],
    prior: Prior,
    smoothing: float,
    plan: Plan | None,
) -> tuple[ViewsEnergy, Pose]:
    """Returns the energy bound to the candidate of least kernel energy, and that candidate.

    All candidates are compared with the kernel bound to the first one.

    Args:
        method: The bound method.
        observation: Data with views.
        candidates: Poses in the world, at least one.
        prior: What is known of the pose before the frame.
        smoothing: Standard deviation of a Gaussian that smooths the energy over space [m].
        plan: The method by compiled functions, if it has them.
    """
    first = best = candidates[0]
    energy = _of_views(method, observation, first, prior, smoothing, plan)
    if len(candidates) > 1:
        best = min(candidates, key=energy.of_kernel)
        if best is not first:
            energy = _of_views(method, observation, best, prior, smoothing, plan)
    return energy, best


def _of_views(
    method: BoundDirect,
    observation: Observation,
    pose: Pose,
    prior: Prior,
    smoothing: float,
    plan: Plan | None,
) -> ViewsEnergy:
    """Returns the energy of all views, each bound in its camera's frame at the same pose."""
    total, views = float(observation.weights.sum()), []
    joints: tuple[JointEnergy, ...] | None = None
    for view in observation.views:
        # What a prior knows besides its pose is an energy of the joints, which counts once.
        at, expected = pose.moved(view.to_camera), Prior(prior.pose.moved(view.to_camera))
        planned = plan and PlannedEnergy.of(plan.of_view, view.data, [at], expected, smoothing)
        energy: FrameEnergy
        if plan is not None and planned:
            energy = planned[0]
            joints = joints or PlannedJoints.of(plan, observation, planned[0].scene, prior)
        else:
            energy = replace(method.summed(view.data, at, expected, smoothing), joints=())
        share = float(view.data.weights.sum()) / total
        views.append(ViewEnergy(energy, view.to_camera, share))
    if joints is None:
        # Joints are bound to the prior and to the landmarks in the world.
        scene = method.scene(observation, pose, prior)
        joints = Effects.of(method.method.terms, method.primitives, scene).joints
    return ViewsEnergy(method.body.skeleton, tuple(views), joints)

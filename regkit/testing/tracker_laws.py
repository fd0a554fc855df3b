"""Laws of trackers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import pytest

from regkit.body import Body
from regkit.interfaces import Evaluation, Past, Prior, Registrar, RegistrationResult, Tracker
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.testing.laws import Laws
from regkit.testing.samples import posed, surface_data
from regkit.testing.verdict import copied, require, same


@dataclass
class Known(Registrar):
    """A registrar that finds the truth from any start, and records the starts.

    Attributes:
        body: The body.
        primitives: One for each segment.
        truth: The pose to find.
        asked: Poses from which registrations started.
    """

    body: Body
    primitives: Primitives
    truth: Pose
    asked: list[Pose] = field(default_factory=list)

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Returns the truth."""
        self.asked += candidates
        return _seen(self.truth)

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns a high inlier probability at the truth, and a low one elsewhere."""
        share = 0.95 if pose is self.truth else 0.2
        return Evaluation(-share, np.full(len(observation.points), share))


def _seen(pose: Pose) -> RegistrationResult:
    return RegistrationResult(pose, -1.0, 0.95, True, 3, 4, "found")


class TrackerLaws(Laws):
    """Laws of trackers."""

    @pytest.mark.parametrize("frames", [0, 1, 4])
    def test_tracker_takes_the_pose_that_explains_the_frame(
        self, tracker: Tracker, body: Body, random: np.random.Generator, frames: int
    ) -> None:
        """With a registrar that finds the truth, it does so from the first frame on."""
        registrar, past = _scene(body, random, frames)
        data = surface_data(body, registrar.truth)
        bound = tracker.bind(registrar)
        at = type(bound).step
        found = bound.step(data, past)
        require(
            bool(registrar.asked), tracker, "returns a pose without registering the frame",
            look_at=at,
        )  # fmt: skip
        require(
            same(found.pose, registrar.truth), tracker,
            "returns another pose than the one that was found and matches the frame", look_at=at,
        )  # fmt: skip

    def test_tracker_sets_out_within_the_joint_limits(
        self, tracker: Tracker, body: Body, random: np.random.Generator
    ) -> None:
        """Solvers keep limits only if the start is within them."""
        registrar, past = _scene(body, random, 4)
        bound = tracker.bind(registrar)
        bound.step(surface_data(body, registrar.truth), past)
        by = max(body.skeleton.limits.violation(pose).max(initial=0.0) for pose in registrar.asked)
        require(
            by < 1e-6, tracker, f"starts from a pose beyond a joint limit, by "
            f"{np.degrees(by):.2g} degrees; use skeleton.limits.projected()",
            look_at=type(bound).step,
        )  # fmt: skip

    def test_tracker_holds_no_state(
        self, tracker: Tracker, body: Body, random: np.random.Generator
    ) -> None:
        """The past is an argument: repeated calls agree, and the past stays unmodified."""
        registrar, past = _scene(body, random, 3)
        data = surface_data(body, registrar.truth)
        bound, before = tracker.bind(registrar), copied(past)
        at = type(bound).step
        first = bound.step(data, past)
        asked, registrar.asked = registrar.asked, []
        second = bound.step(data, past)
        require(
            same(first, second) and same(asked, registrar.asked), tracker,
            "returns another result when called again; all its memory must be in the past",
            look_at=at,
        )  # fmt: skip
        require(same(before, past), tracker, "modifies the past", look_at=at)


def _scene(body: Body, random: np.random.Generator, frames: int) -> tuple[Known, Past]:
    """Returns a registrar, and a past of ``frames`` frames of a body in steady motion."""
    segments = len(body.skeleton.names)
    primitives = Primitives(
        segments=np.arange(segments),
        centres=np.zeros((segments, 3)),
        axes=np.tile(np.eye(3), (segments, 1, 1)),
        scales=np.full((segments, 3), 0.05),
        weights=np.ones(segments),
    )
    bones, pose = body.skeleton, posed(body, random)
    step = 0.1 * random.normal(size=bones.dofs)
    poses = [pose]
    for _ in range(frames + 1):
        poses.append(bones.limits.projected(bones.retract(poses[-1], step)))
    past = Past.start(poses[0])
    for pose in poses[1:-1]:
        past = past.followed_by(_seen(pose))
    return Known(body, primitives, poses[-1]), past

"""Laws of methods."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from regkit.body import Body
from regkit.interfaces import Method, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import DependencyError, RegkitError
from regkit.testing.laws import Laws
from regkit.testing.samples import posed, surface_data
from regkit.testing.verdict import copied, require, same

STAYS = 0.05
"""How far a body may move from where its own surface is, as a part of its size."""
DISTURBED = 0.08
"""By how much a start is off, in each joint [rad] and as a part of the body's size."""


class MethodLaws(Laws):
    """Laws of methods."""

    @pytest.fixture
    def registrar(self, method: Method, body: Body, rigid_body: Body) -> Registrar:
        """The method for the body with joints or, if it refuses that, for the rigid one."""
        refusals = []
        for each in (body, rigid_body):
            try:
                return method.bind(each)
            except DependencyError as error:
                pytest.skip(str(error))
            except RegkitError as error:
                refusals.append(str(error))
        require(
            False, method, f"refuses both sample bodies ({'; '.join(refusals)}); override the "
            "fixture `body` with one that it takes", look_at=type(method).bind,
        )  # fmt: skip
        raise AssertionError

    def test_method_stays_where_it_is_right(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """Set out from the truth, the body stays where its surface is, within a small part."""
        truth = posed(registrar.body, random)
        found = _registered(registrar, surface_data(registrar.body, truth), truth)
        by = _distance(registrar.body, found.pose, truth) / registrar.body.size
        require(
            by < STAYS, method, f"leaves a perfect start by {100 * by:.2g} % of the body's size",
            look_at=type(registrar).register,
        )  # fmt: skip

    def test_method_improves_a_disturbed_start(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """Its pose is nearer to the truth than the start, and its own energy is no worse."""
        body, at = registrar.body, type(registrar).register
        truth = posed(body, random)
        data = surface_data(body, truth)
        step = DISTURBED * random.normal(size=body.skeleton.dofs)
        step[:3] *= body.size
        start = body.skeleton.limits.projected(body.skeleton.retract(truth, step))
        found = _registered(registrar, data, start)
        before, after = (_distance(body, pose, truth) for pose in (start, found.pose))
        require(
            after < 0.9 * before, method, f"brings a body that is {before:.3g} m off to "
            f"{after:.3g} m", look_at=at,
        )  # fmt: skip
        first, last = (registrar.evaluate(data, pose).energy for pose in (start, found.pose))
        require(
            last <= first + 1e-9 * abs(first), method, f"ends with the energy {last:.6g}, worse "
            f"than {first:.6g} at the start", look_at=at,
        )  # fmt: skip

    def test_method_tells_how_far_points_are_explained(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """From 0 to 1 for each point, or NaN where it cannot tell."""
        truth = posed(registrar.body, random)
        data = surface_data(registrar.body, truth)
        explained = registrar.evaluate(data, truth).inlier_probability
        known = explained[np.isfinite(explained)]
        require(
            not len(known)
            or (
                explained.shape == (len(data.points),)
                and known.min() >= 0.0
                and known.max() <= 1.0 + 1e-9
            ), method, f"explains points in the shape {explained.shape}, not as 0 to 1",
            look_at=type(registrar).evaluate,
        )  # fmt: skip

    def test_method_is_deterministic_and_changes_nothing(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """Asked twice it finds the same pose, and writes to neither data nor start."""
        truth = posed(registrar.body, random)
        data, at = surface_data(registrar.body, truth), type(registrar).register
        before = copied((data.points, data.weights, truth.root, truth.balls, truth.hinges))
        first, second = (_registered(registrar, data, truth) for _ in range(2))
        by = _distance(registrar.body, first.pose, second.pose)
        require(
            by < 1e-9, method, f"finds another pose when it is asked again, {by:.2g} m away; seed "
            "what is random", look_at=at,
        )  # fmt: skip
        require(
            same(before, (data.points, data.weights, truth.root, truth.balls, truth.hinges)),
            method, "changes the data or the start that it is given", look_at=at,
        )  # fmt: skip


def _registered(registrar: Registrar, data: Observation, start: Pose) -> RegistrationResult:
    with _foreign_warnings():
        return registrar.register(data, [start])


@contextmanager
def _foreign_warnings() -> Iterator[None]:
    """Libraries that methods call may warn of what they like."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _distance(body: Body, first: Pose, second: Pose) -> float:
    """The mean distance of the surface's points in two poses [m]."""
    assert body.surface is not None
    places: list[Array] = [
        body.surface.place(body.place(pose).transforms) for pose in (first, second)
    ]
    return float(np.linalg.norm(places[0] - places[1], axis=1).mean())

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
"""Maximum motion of a body from its own surface, relative to its size."""
DISTURBED = 0.08
"""Disturbance of a start, in each joint [rad] and relative to the body's size."""


class MethodLaws(Laws):
    """Laws of methods."""

    @pytest.fixture
    def registrar(self, method: Method, body: Body, rigid_body: Body) -> Registrar:
        """Returns the method bound to the body with joints or, if refused, to the rigid one."""
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
            "fixture `body` by one that it accepts", look_at=type(method).bind,
        )  # fmt: skip
        raise AssertionError

    def test_method_stays_where_it_is_right(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """From the true pose, the body hardly moves away from its surface."""
        truth = posed(registrar.body, random)
        found = _registered(registrar, surface_data(registrar.body, truth), truth)
        by = _distance(registrar.body, found.pose, truth) / registrar.body.size
        require(
            by < STAYS, method, f"moves a perfect start by {100 * by:.2g} % of the body's size",
            look_at=type(registrar).register,
        )  # fmt: skip

    def test_method_improves_a_disturbed_start(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """The result is closer to the truth than the start, with no higher energy."""
        body, at = registrar.body, type(registrar).register
        truth = posed(body, random)
        data = surface_data(body, truth)
        step = DISTURBED * random.normal(size=body.skeleton.dofs)
        step[:3] *= body.size
        start = body.skeleton.limits.projected(body.skeleton.retract(truth, step))
        found = _registered(registrar, data, start)
        before, after = (_distance(body, pose, truth) for pose in (start, found.pose))
        require(
            after < 0.9 * before, method, f"brings a start that is {before:.3g} m off only to "
            f"{after:.3g} m", look_at=at,
        )  # fmt: skip
        first, last = (registrar.evaluate(data, pose).energy for pose in (start, found.pose))
        require(
            last <= first + 1e-9 * abs(first), method, f"ends with the energy {last:.6g}, higher "
            f"than {first:.6g} at the start", look_at=at,
        )  # fmt: skip

    def test_method_tells_how_far_points_are_explained(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """Inlier probabilities are 0 to 1 for each point, or NaN if unknown."""
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
            ), method, f"returns inlier probabilities of shape {explained.shape}, or not 0 to 1",
            look_at=type(registrar).evaluate,
        )  # fmt: skip

    def test_method_is_deterministic_and_changes_nothing(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """Repeated, it finds the same pose, and it modifies neither data nor start."""
        truth = posed(registrar.body, random)
        data, at = surface_data(registrar.body, truth), type(registrar).register
        before = copied((data.points, data.weights, truth.root, truth.balls, truth.hinges))
        first, second = (_registered(registrar, data, truth) for _ in range(2))
        by = _distance(registrar.body, first.pose, second.pose)
        require(
            by < 1e-9, method, f"finds a pose {by:.2g} m away when called again; seed random "
            "numbers", look_at=at,
        )  # fmt: skip
        require(
            same(before, (data.points, data.weights, truth.root, truth.balls, truth.hinges)),
            method, "modifies the data or the start", look_at=at,
        )  # fmt: skip

    def test_method_registers_each_start_as_by_itself(
        self, registrar: Registrar, method: Method, random: np.random.Generator
    ) -> None:
        """From several starts there is one result each, close to that of the start alone."""
        truth = posed(registrar.body, random)
        data, at = surface_data(registrar.body, truth), type(registrar).register_each
        away = registrar.body.skeleton.retract(
            truth, np.full(registrar.body.skeleton.dofs, 0.5 * DISTURBED)
        )
        starts = [truth, registrar.body.skeleton.limits.projected(away), truth]
        with _foreign_warnings():
            found = registrar.register_each(data, starts)
        require(
            len(found) == len(starts), method, f"returns {len(found)} results for {len(starts)} "
            "starts", look_at=at,
        )  # fmt: skip
        for start, each in zip(starts, found, strict=True):
            alone = _registered(registrar, data, start).pose
            by = _distance(registrar.body, each.pose, alone) / registrar.body.size
            require(
                by < STAYS, method, f"registers a start {100 * by:.2g} % of the body's size away "
                "from where it registers it alone", look_at=at,
            )  # fmt: skip


def _registered(registrar: Registrar, data: Observation, start: Pose) -> RegistrationResult:
    with _foreign_warnings():
        return registrar.register(data, [start])


@contextmanager
def _foreign_warnings() -> Iterator[None]:
    """Ignores warnings of libraries that methods call."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _distance(body: Body, first: Pose, second: Pose) -> float:
    """Returns the mean distance of the surface's points between two poses [m]."""
    assert body.surface is not None
    places: list[Array] = [
        body.surface.place(body.place(pose).transforms) for pose in (first, second)
    ]
    return float(np.linalg.norm(places[0] - places[1], axis=1).mean())

"""Laws of a shape model's parameters in templates."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from regkit.body import Body, ListedShape, Mirror, Scaling, ShapeParameters, Stretch
from regkit.config.yaml import yaml_data
from regkit.geometry.capsule_moments import capsule_moments
from regkit.interfaces import ShapeModel
from regkit.system.arrays import Array
from regkit.testing.laws import Laws
from regkit.testing.verdict import require

DEFORMATIONS = (
    (Scaling(1.3), 1.3 * np.eye(3)),
    (Stretch.along(np.array([0.0, 1.0, 0.0]), 1.2, 0.9), np.diag([0.9, 1.2, 0.9])),
    (Mirror(), np.diag([-1.0, 1.0, 1.0])),
)
"""Deformations of primitives, and their effect on points."""

SHIFT = 0.1
"""Maximum shift of a stretched primitive's centre, relative to its standard deviation."""

POINTS = 400
"""Number of points inside each segment."""


class ParameterLaws(Laws):
    """Laws of shape models with parameters in templates."""

    def test_shape_fits_its_parameters(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """A fitted primitive has about the mean and spread of the points in its segment."""
        made = made_by(shape)
        for points in flesh_in(body, random).values():
            mean, covariance = made.fitted(points).moments()
            size = float(np.sqrt(np.trace(np.cov(points.T))))
            off = float(np.linalg.norm(mean - points.mean(axis=0)))
            ratio = float(np.sqrt(np.trace(covariance))) / size
            require(
                off < 0.5 * size and 0.5 < ratio < 2.0, shape, f"fits parameters {off:.2g} m from "
                f"the points and {ratio:.2g} times as large; both must match the points",
                look_at=made.fitted,
            )  # fmt: skip

    def test_shape_stands_for_a_capsule(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """The primitive of a capsule has about its mean and spread, and is the same each time."""
        made = made_by(shape)
        for ends, radii in zip(body.capsules.ends, body.capsules.radii, strict=True):
            one = made.of_capsule(ends, radii)
            mean, covariance = one.moments()
            centre, _, deviations = capsule_moments(ends, radii)
            size = float(np.linalg.norm(deviations))
            off = float(np.linalg.norm(mean - centre))
            ratio = float(np.sqrt(np.trace(covariance))) / size
            require(
                off < 0.5 * size and 0.5 < ratio < 2.0, shape, f"has parameters {off:.2g} m from "
                f"the capsule they stand for and {ratio:.2g} times as large; both must match it",
                look_at=made.of_capsule,
            )  # fmt: skip
            require(
                made.of_capsule(ends, radii) == one, shape,
                "has other parameters when they stand for the same capsule again",
                look_at=made.of_capsule,
            )  # fmt: skip

    def test_shape_parameters_follow_the_segment(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """Scaled, stretched or mirrored, a primitive moves like the points of its segment."""
        made = made_by(shape)
        for points in flesh_in(body, random).values():
            one = made.fitted(points)
            mean, covariance = one.moments()
            for deformation, matrix in DEFORMATIONS:
                name = type(deformation).__name__
                after, spread = one.deformed(deformation).moments()
                by = float(np.abs(after - matrix @ mean).max())
                # A stretched primitive may keep its form, as a sphere does, or the ends of a cone.
                loose = isinstance(deformation, Stretch)
                most = SHIFT * float(np.sqrt(np.trace(covariance))) if loose else 1e-9
                require(
                    by < most, shape, f"has parameters whose centre is off by {by:.2g} m after a "
                    f"{name}", look_at=made.deformed,
                )  # fmt: skip
                by = float(np.abs(spread - matrix @ covariance @ matrix.T).max())
                require(
                    loose or by < 1e-9, shape,
                    f"has parameters whose covariance is off by {by:.2g} m^2 after a {name}",
                    look_at=made.deformed,
                )  # fmt: skip

    def test_shape_parameters_are_written_as_they_are_read(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """Rounding in a template's file changes the moments by less than 1 mm."""
        made = made_by(shape)
        for points in flesh_in(body, random).values():
            one = made.fitted(points)
            read = made.model_validate(yaml_data(one.yaml(), shape.kind))
            (mean, covariance), (again, spread) = one.moments(), read.moments()
            by = max(
                float(np.abs(mean - again).max()), float(np.sqrt(np.abs(covariance - spread).max()))
            )
            require(
                by < 5e-3 * body.size, shape, f"has parameters that are written as {one.yaml()} "
                f"and read with moments off by {by:.2g} m", look_at=made.yaml,
            )  # fmt: skip

    def test_shape_takes_the_parameters_of_the_body(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """Listed parameters become primitives on their segments, and scale with the body."""
        made = made_by(shape)
        listed = {name: made.fitted(points) for name, points in flesh_in(body, random).items()}
        own, larger = (
            shape.bind(listing(body, shape.kind, {
                name: one.deformed(Scaling(factor)) for name, one in listed.items()
            }))
            for factor in (1.0, 1.5)
        )  # fmt: skip
        segments = sorted(map(body.skeleton.names.index, listed))
        require(
            sorted(np.unique(own.segments)) == segments, shape,
            f"makes primitives on the segments {sorted(np.unique(own.segments))} of a body that "
            f"lists some on {segments}", look_at=type(shape).bind,
        )  # fmt: skip
        scaled = own.scaled(1.5)
        by = max(
            float(np.abs(larger.centres - scaled.centres).max()),
            float(np.abs(larger.scales - scaled.scales).max()),
        )
        require(
            by < 1e-9, shape, f"makes primitives of scaled parameters that differ by "
            f"{by:.2g} m from its own scaled primitives", look_at=type(shape).bind,
        )  # fmt: skip


def made_by(shape: ShapeModel) -> type[ShapeParameters]:
    """Returns the class of a shape model's parameters; skips the test without one."""
    if shape.parameters is None:
        pytest.skip("it has no parameters in templates")
    return shape.parameters


def flesh_in(body: Body, random: np.random.Generator) -> dict[str, Array]:
    """Returns points inside the capsules of each segment with some, (N, 3) in its frame [m]."""
    found = {}
    for segment in np.unique(body.capsules.segments):
        own = body.capsules.selected(body.capsules.segments == segment)
        low = (own.ends - own.radii[:, :, None]).min(axis=(0, 1))
        high = (own.ends + own.radii[:, :, None]).max(axis=(0, 1))
        points = random.uniform(low, high, size=(20 * POINTS, 3))
        inside = points[own.surface_distance(points) < 0.0]
        found[body.skeleton.names[segment]] = inside[:POINTS]
    return found


def listing(body: Body, kind: str, listed: dict[str, Any]) -> Body:
    """Returns the body with one primitive of a kind on each of some segments."""
    segments = np.array([body.skeleton.names.index(name) for name in listed], dtype=np.intp)
    return replace(body, shapes={kind: ListedShape(segments, tuple(listed.values()))})

"""Laws of the free parameters of a shape model's primitives."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from regkit.body import Body, Freedom, Mirror, ShapeParameters
from regkit.body.freedoms import step_size
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ShapeModel
from regkit.system.arrays import Array
from regkit.testing.laws import Laws
from regkit.testing.parameter_laws import flesh_in, listing, made_by
from regkit.testing.verdict import require

STEPS = {
    Freedom.POSITION: 0.1,
    Freedom.LOG_SCALE: 0.2,
    Freedom.ROTATION: 0.5,
    Freedom.LOG_WEIGHT: 0.5,
}
"""Standard deviation of the steps: relative to the primitive's own, and [rad]."""

EXACT = 1e-9
"""Maximum error relative to the primitive's standard deviation, or to its variance."""

PART = 2e-3
"""Part of a step whose effect is compared with that of its half."""

BENT = 0.02
"""Maximum difference of the two derivatives, relative to the largest."""


class StepLaws(Laws):
    """Laws of shape models whose parameters have ``freedoms``."""

    def test_shape_step_of_zero_changes_nothing(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """``moved(0)`` is the primitive itself."""
        for one in _movable(shape, body, random):
            after = one.moved(np.zeros(step_size(one.freedoms())))
            require(
                _difference(one, after) < EXACT and after.yaml() == one.yaml(), shape,
                f"has parameters {one.yaml()} that a step of zero changes to {after.yaml()}",
                look_at=type(one).moved,
            )  # fmt: skip

    def test_shape_steps_are_smooth(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """Small steps change the moments in proportion: nothing is rounded or clipped."""
        for one in _movable(shape, body, random):
            step = _step(one, random)
            whole, half = (_derivative(one, step, part) for part in (PART, 0.5 * PART))
            by = float(np.abs(whole - half).max() / max(np.abs(whole).max(), 1e-300))
            require(
                by < BENT, shape, "has parameters whose moments do not change smoothly: the "
                f"effects of a small step and of half of it differ by {by:.2g}, relatively",
                look_at=type(one).moved,
            )  # fmt: skip

    def test_shape_steps_move_enlarge_and_rotate(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """Each kind of free parameter does what ``Freedom`` says."""
        for one in _movable(shape, body, random):
            mean, covariance = one.moments()
            size, at = float(np.sqrt(np.trace(covariance))), type(one).moved
            shift, turn = random.normal(size=3), random.normal(size=3)
            turned = vector_to_matrix(turn)
            expected = {
                Freedom.POSITION: (mean + size * shift, covariance),
                Freedom.ROTATION: (mean, turned @ covariance @ turned.T),
            }
            values = {Freedom.POSITION: size * shift, Freedom.ROTATION: turn}
            freedoms = one.freedoms()
            for kind, (place, spread) in expected.items():
                # All positions of a primitive together move it; several rotations are its own.
                if kind not in freedoms or (kind is Freedom.ROTATION and freedoms.count(kind) > 1):
                    continue
                after = one.moved(_only(freedoms, {kind: values[kind]}))
                by = _off(after.moments(), (place, spread), size)
                require(
                    by < EXACT, shape, f"has parameters whose moments are off by {by:.2g} of their "
                    f"size after a step of {kind.name}", look_at=at,
                )  # fmt: skip
            if Freedom.LOG_WEIGHT in freedoms:
                heavier = one.moved(_only(freedoms, {Freedom.LOG_WEIGHT: np.full(1, 0.5)}))
                by = _difference(one, heavier)
                require(
                    by < EXACT, shape, f"has parameters whose moments are off by {by:.2g} of their "
                    "size after a step of the weight alone", look_at=at,
                )  # fmt: skip
            if Freedom.LOG_SCALE in freedoms:
                larger = one.moved(_only(freedoms, {Freedom.LOG_SCALE: np.full(1, 0.1)}))
                ratio = float(np.sqrt(np.trace(larger.moments()[1]))) / size
                require(
                    1.0 < ratio < np.exp(0.1) + EXACT, shape, "has parameters whose lengths, times "
                    f"{np.exp(0.1):.3f}, make the primitive {ratio:.3g} times as large", look_at=at,
                )  # fmt: skip

    def test_shape_weights_are_those_of_its_primitives(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """A step of a weight multiplies the weights of the primitives that are made of it."""
        made = made_by(shape)
        listed = {name: made.fitted(points) for name, points in flesh_in(body, random).items()}
        if not any(Freedom.LOG_WEIGHT in one.freedoms() for one in listed.values()):
            pytest.skip("its parameters have no free weights")
        change = {Freedom.LOG_WEIGHT: np.full(1, 0.5)}
        heavier = {name: one.moved(_only(one.freedoms(), change)) for name, one in listed.items()}
        before, after = (
            shape.bind(listing(body, shape.kind, each)).weights for each in (listed, heavier)
        )
        by = float(np.abs(after / (before * np.exp(0.5)) - 1.0).max())
        require(
            by < EXACT, shape, f"makes primitives whose weights are off by {by:.2g}, relatively, "
            f"after all weights were multiplied by {np.exp(0.5):.3f}", look_at=type(shape).bind,
        )  # fmt: skip

    def test_shape_steps_are_mirrored(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """The mirror image takes the mirrored step to the mirror image of the moved primitive."""
        mirror = Mirror()
        for one in _movable(shape, body, random):
            step = _step(one, random)
            image = one.deformed(mirror).moved(one.mirrored_step(step))
            by = _difference(one.moved(step).deformed(mirror), image)
            require(
                by < EXACT, shape, f"has parameters whose mirrored step is off by {by:.2g} of "
                "their size: the mirror image does not stay the mirror image",
                look_at=type(one).mirrored_step,
            )  # fmt: skip


def _movable(
    shape: ShapeModel, body: Body, random: np.random.Generator
) -> Iterator[ShapeParameters]:
    """Yields a primitive in each segment; skips the test if it has no free parameters."""
    made = made_by(shape)
    for points in flesh_in(body, random).values():
        one = made.fitted(points)
        if not one.freedoms():
            pytest.skip("its parameters have no freedoms")
        yield one


def _step(one: ShapeParameters, random: np.random.Generator) -> Array:
    """Returns a random step (P,)."""
    size = float(np.sqrt(np.trace(one.moments()[1])))
    return np.concatenate(
        [
            (size if kind is Freedom.POSITION else 1.0)
            * STEPS[kind]
            * random.normal(size=kind.size)
            for kind in one.freedoms()
        ]
    )


def _only(freedoms: tuple[Freedom, ...], values: dict[Freedom, Array]) -> Array:
    """Returns a step (P,) with the same value for all free parameters of a kind, else zero."""
    return np.concatenate([values.get(kind, np.zeros(kind.size)) for kind in freedoms])


def _derivative(one: ShapeParameters, step: Array, part: float) -> Array:
    """Returns the moments' change (12,) per step, from a part of it in both directions."""
    size = float(np.sqrt(np.trace(one.moments()[1])))
    (high, wide), (low, narrow) = (one.moved(sign * part * step).moments() for sign in (1, -1))
    changes = [(high - low) / size, (wide - narrow).ravel() / size**2]
    return np.asarray(np.concatenate(changes) / (2.0 * part))


def _difference(one: ShapeParameters, other: ShapeParameters) -> float:
    """Returns the largest difference of two primitives' moments, relative to their size."""
    moments = one.moments()
    return _off(moments, other.moments(), float(np.sqrt(np.trace(moments[1]))))


def _off(one: tuple[Array, Array], other: tuple[Array, Array], size: float) -> float:
    """Returns the largest difference of moments, relative to a standard deviation [m]."""
    mean, covariance = (np.abs(a - b).max() for a, b in zip(one, other, strict=True))
    return max(float(mean) / size, float(covariance) / size**2)

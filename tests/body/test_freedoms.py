"""Free parameters of primitives: steps of their own kinds, exact, and mirrored."""

import numpy as np
import pytest

from regkit.body import (
    BallParameters,
    CapsuleParameters,
    EllipsoidParameters,
    Freedom,
    GaussianParameters,
    IsotropicGaussianParameters,
    Mirror,
    Scaling,
    ShapeParameters,
)
from regkit.body.freedoms import step_size
from regkit.body.vectors import vector
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.system.errors import PluginError

CENTRE = (0.1, -0.2, 0.3)
SOLIDS: dict[str, tuple[ShapeParameters, int]] = {
    "ellipsoid": (
        EllipsoidParameters(centre=CENTRE, sigma=(0.1, 0.2, 0.05), rotation_deg=(10, -30, 50)), 9
    ),
    "over": (
        EllipsoidParameters(centre=CENTRE, sigma=(0.1, 0.2, 0.05), rotation_deg=(10, -30, 300)), 9
    ),
    "sphere": (EllipsoidParameters(centre=CENTRE, sigma=0.1), 4),
    "gaussian": (
        GaussianParameters(
            centre=CENTRE, sigma=(0.1, 0.2, 0.05), rotation_deg=(10, -30, 50), weight=0.5
        ), 10
    ),
    "isotropic": (IsotropicGaussianParameters(centre=CENTRE, sigma=0.1, weight=2.0), 5),
    "ball": (BallParameters(centre=CENTRE, sigma=0.1), 4),
    "tapered": (CapsuleParameters(start=CENTRE, end=(0.2, 0.1, 0.3), radius=(0.1, 0.05)), 8),
    "capsule": (CapsuleParameters(start=CENTRE, end=(0.2, 0.1, 0.3), radius=0.1), 7),
}  # fmt: skip


def same(one: ShapeParameters, other: ShapeParameters) -> None:
    for own, its in zip(one.moments(), other.moments(), strict=True):
        np.testing.assert_allclose(own, its, atol=1e-12)


@pytest.mark.parametrize("name", SOLIDS)
def test_step_has_a_coordinate_for_each_number(name):
    one, count = SOLIDS[name]
    assert step_size(one.freedoms()) == count
    same(one.moved(np.zeros(count)), one)


@pytest.mark.parametrize("name", SOLIDS)
def test_moved_primitive_keeps_its_form_and_what_is_not_free(name, random):
    one, count = SOLIDS[name]
    after = one.moved(0.3 * random.normal(size=count))
    assert after.freedoms() == one.freedoms()
    assert type(one).model_validate(after.model_dump()) == after


def test_lengths_are_multiplied_and_positions_and_rotations_added_exactly():
    one = SOLIDS["ellipsoid"][0]
    step = np.array([1e-7, 0.0, 0.0, 1e-7, 0.0, np.log(2.0), 0.0, 0.0, 1e-7])
    after = one.moved(step)
    assert isinstance(after, EllipsoidParameters)
    np.testing.assert_allclose(after.centre, np.add(CENTRE, step[:3]), rtol=1e-15)
    np.testing.assert_allclose(after.sigma, [0.1 * np.exp(1e-7), 0.2, 0.1], rtol=1e-15)
    turned, before = (vector_to_matrix(np.radians(a.rotation_deg)) for a in (after, one))
    np.testing.assert_allclose(turned, vector_to_matrix(step[6:]) @ before, atol=1e-15)


@pytest.mark.parametrize("name", ["gaussian", "isotropic"])
def test_step_multiplies_the_weight_alone(name):
    one, count = SOLIDS[name]
    step = np.zeros(count)
    step[-1] = np.log(3.0)
    after = one.moved(step)
    same(after, one)
    assert after.weight == pytest.approx(3.0 * one.weight)
    assert after.deformed(Scaling(2.0)).weight == after.weight


@pytest.mark.parametrize("name", SOLIDS)
def test_mirror_image_takes_the_mirrored_step(name, random):
    one, count = SOLIDS[name]
    for step in 0.5 * random.normal(size=(5, count)):
        image = one.deformed(Mirror()).moved(one.mirrored_step(step))
        same(image, one.moved(step).deformed(Mirror()))


@pytest.mark.parametrize("name", SOLIDS)
def test_mirrored_steps_are_linear_and_mirrored_twice_are_themselves(name, random):
    one, count = SOLIDS[name]
    steps = random.normal(size=(3, count))
    mirrored = one.mirrored_step(steps)
    np.testing.assert_allclose(mirrored, steps @ one.mirrored_step(np.eye(count)))
    np.testing.assert_array_equal(one.mirrored_step(mirrored), steps)


def test_step_is_mirrored_between_frames_of_any_rotation(random):
    one, count = SOLIDS["ellipsoid"]
    other = -vector_to_matrix(random.normal(size=3))  # It maps one side's frame to the other's.
    step = 0.5 * random.normal(size=count)
    # The images of the axes, with their signs changed, are a rotation.
    axes = -other @ vector_to_matrix(np.radians(one.rotation_deg))
    image = EllipsoidParameters(
        centre=vector(other @ CENTRE),
        sigma=(0.1, 0.2, 0.05),
        rotation_deg=vector(np.degrees(to_vector(from_matrix(axes)))),
    )
    mean, covariance = one.moved(step).moments()
    after, spread = image.moved(one.mirrored_step(step, other)).moments()
    np.testing.assert_allclose(after, other @ mean, atol=1e-12)
    np.testing.assert_allclose(spread, other @ covariance @ other.T, atol=1e-12)


def test_parameters_without_freedoms_stay_and_those_with_some_must_move():
    class Fixed(BallParameters):
        def freedoms(self) -> tuple[Freedom, ...]:
            return ()

        moved = ShapeParameters.moved

    class Stuck(BallParameters):
        moved = ShapeParameters.moved

    fixed = Fixed(centre=CENTRE, sigma=0.1)
    assert fixed.moved(np.zeros(0)) is fixed
    assert fixed.mirrored_step(np.zeros(0)).shape == (0,)
    with pytest.raises(PluginError, match="Stuck"):
        Stuck(centre=CENTRE, sigma=0.1).moved(np.zeros(4))


def test_step_of_another_size_is_refused():
    with pytest.raises(ValueError, match="3 coordinates, of 4"):
        SOLIDS["ball"][0].mirrored_step(np.zeros(3))

"""Rotations and rigid motions against independent references, and the group's laws."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from regkit.geometry import rigid, rotation

angles = st.floats(-3.1, 3.1)
vectors = st.tuples(angles, angles, angles).map(np.array)
tiny = st.floats(-1e-5, 1e-5)
small_vectors = st.tuples(tiny, tiny, tiny).map(np.array)


@given(vectors | small_vectors)
def test_from_vector_agrees_with_scipy(vector):
    expected = Rotation.from_rotvec(vector).as_matrix()
    np.testing.assert_allclose(rotation.vector_to_matrix(vector), expected, atol=1e-14)


@given(vectors | small_vectors)
def test_to_vector_inverts_from_vector_up_to_half_a_turn(vector):
    quaternion = rotation.from_vector(vector)
    back = rotation.to_vector(quaternion)
    assert np.linalg.norm(back) <= np.pi + 1e-12
    np.testing.assert_allclose(
        rotation.vector_to_matrix(back), rotation.to_matrix(quaternion), atol=1e-12
    )


@given(vectors, vectors)
def test_product_is_the_product_of_the_matrices(first, second):
    a, b = rotation.from_vector(first), rotation.from_vector(second)
    np.testing.assert_allclose(
        rotation.to_matrix(rotation.product(a, b)),
        rotation.to_matrix(a) @ rotation.to_matrix(b),
        atol=1e-14,
    )


@given(vectors)
def test_conjugate_is_the_inverse(vector):
    quaternion = rotation.from_vector(vector)
    product = rotation.product(quaternion, rotation.conjugate(quaternion))
    np.testing.assert_allclose(product, rotation.IDENTITY, atol=1e-14)


@given(vectors)
def test_from_matrix_inverts_to_matrix(vector):
    matrix = rotation.vector_to_matrix(vector)
    np.testing.assert_allclose(rotation.to_matrix(rotation.from_matrix(matrix)), matrix, atol=1e-13)


@pytest.mark.parametrize("axis", np.vstack([np.eye(3), [[0.6, 0.8, 0.0]]]))
def test_from_matrix_of_half_a_turn(axis):
    matrix = rotation.vector_to_matrix(np.pi * axis)
    np.testing.assert_allclose(rotation.to_matrix(rotation.from_matrix(matrix)), matrix, atol=1e-13)


@settings(max_examples=50)
@given(vectors | small_vectors)
def test_right_jacobian_is_the_derivative_of_the_exponential(vector):
    step = 1e-6
    jacobian = rotation.right_jacobian(vector)
    for column in range(3):
        change = step * np.eye(3)[column]
        inverse = rotation.conjugate(rotation.from_vector(vector))
        ahead = rotation.to_vector(rotation.product(inverse, rotation.from_vector(vector + change)))
        behind = rotation.to_vector(
            rotation.product(inverse, rotation.from_vector(vector - change))
        )
        np.testing.assert_allclose(jacobian[:, column], (ahead - behind) / (2 * step), atol=1e-8)


@given(vectors, st.sampled_from([[1.0, 0, 0], [0, 1.0, 0], [0.6, 0, -0.8]]))
def test_swing_times_twist_is_the_rotation(vector, axis):
    axis = np.array(axis)
    quaternion = rotation.from_vector(vector)
    swing, twist = rotation.swing_twist(quaternion, axis)
    assert abs(swing @ axis) < 1e-9
    assert -np.pi - 1e-12 <= twist <= np.pi + 1e-12
    together = rotation.product(rotation.from_vector(swing), rotation.from_vector(twist * axis))
    np.testing.assert_allclose(
        rotation.to_matrix(together), rotation.to_matrix(quaternion), atol=1e-9
    )


def test_swing_twist_of_half_a_turn_of_swing_is_finite():
    swing, twist = rotation.swing_twist(np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    assert twist == 0.0
    np.testing.assert_allclose(np.abs(swing), [np.pi, 0.0, 0.0])


def test_rigid_exp_and_log_agree_with_golden_values(reference_data: Path):
    golden = np.load(reference_data / "se3_fixtures_mit" / "se3_exp_log.npz")
    transforms = golden["transform"]
    # The reference has the angular part first.
    twists = np.roll(golden["twist"], 3, axis=-1)
    # Near zero the reference cancels: its linear part is off by up to 1e-4 of itself.
    tiny = golden["theta"] < 1e-3
    assert (~tiny).sum() > 100
    np.testing.assert_allclose(rigid.exp(twists[tiny]), transforms[tiny], atol=1e-7)
    np.testing.assert_allclose(rigid.exp(twists[~tiny]), transforms[~tiny], atol=1e-12)
    np.testing.assert_allclose(rigid.exp(rigid.log(transforms)), transforms, atol=1e-9)
    inside = ~tiny & (golden["theta"] < np.pi - 1e-3)
    np.testing.assert_allclose(rigid.log(transforms[inside]), twists[inside], atol=1e-9)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-6, 9e-5, 1.1e-4, 1e-2, 1.0, 3.0])
def test_rigid_exp_is_the_matrix_exponential(angle, random):
    axis = random.normal(size=3)
    linear, angular = random.normal(size=3), angle * axis / np.linalg.norm(axis)
    twist = np.concatenate([linear, angular])
    generator = np.zeros((4, 4))
    generator[:3, :3], generator[:3, 3] = rotation.skew(angular), linear
    np.testing.assert_allclose(rigid.exp(twist), expm(generator), atol=1e-14)
    np.testing.assert_allclose(rigid.log(rigid.exp(twist)), twist, atol=1e-12)


@pytest.mark.parametrize("name", ["rotmat_to_quat", "rotmat_to_axisangle"])
def test_conversions_agree_with_golden_values(reference_data: Path, name: str):
    golden = np.load(reference_data / "se3_fixtures_mit" / f"{name}.npz")
    quaternions = rotation.from_matrix(golden["rotmat"])
    if "quat_wxyz" in golden:
        expected = np.roll(golden["quat_wxyz"], -1, axis=1)
        np.testing.assert_allclose(rotation.to_matrix(quaternions), golden["rotmat"], atol=1e-12)
        same = np.abs((quaternions * expected).sum(axis=1))
        np.testing.assert_allclose(same, 1.0, atol=1e-12)
    else:
        matrices = rotation.vector_to_matrix(golden["rotvec"])
        np.testing.assert_allclose(matrices, golden["rotmat"], atol=1e-12)
        back = rotation.vector_to_matrix(rotation.to_vector(quaternions))
        np.testing.assert_allclose(back, golden["rotmat"], atol=1e-12)


@given(vectors, vectors)
def test_inverse_undoes_a_motion(turn, shift):
    transform = rigid.rigid(rotation.vector_to_matrix(turn), shift)
    np.testing.assert_allclose(rigid.inverse(transform) @ transform, np.eye(4), atol=1e-13)


@pytest.mark.parametrize("goal", [[0.3, -0.5, 0.8], [1.0, 2.0, 3.0], [-1.0, -2.0, -3.0]])
def test_between_turns_one_direction_into_another_the_shortest_way(goal):
    start, goal = np.array([1.0, 2.0, 3.0]), np.array(goal)
    turn = rotation.rotation_between(start, goal)
    found = turn @ start / np.linalg.norm(start)
    np.testing.assert_allclose(found, goal / np.linalg.norm(goal), atol=1e-9)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    angle = np.arccos(np.clip(start @ goal / np.linalg.norm(start) / np.linalg.norm(goal), -1, 1))
    turned = np.linalg.norm(rotation.to_vector(rotation.from_matrix(turn)))
    assert turned == pytest.approx(angle, abs=1e-6)

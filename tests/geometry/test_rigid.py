"""Matrices from users and files: rigid motions, and what is not one."""

import numpy as np
import pytest

from regkit.alignment.starts import read_transform
from regkit.geometry.rigid import checked_rigid, rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

T = rigid(vector_to_matrix(np.array([0.3, -1.0, 0.5])), np.array([1.0, -2.0, 3e5]))


def changed(row, column, value):
    matrix = T.copy()
    matrix[row, column] = value
    return matrix


def test_rigid_motion_is_kept():
    np.testing.assert_allclose(checked_rigid(T), T, atol=1e-15)
    turn = [[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    np.testing.assert_array_equal(checked_rigid(turn), turn)


def test_rounded_rotation_is_made_orthogonal(recwarn):
    for digits, told in ((6, 0), (4, 1)):
        matrix = checked_rigid(np.round(T, digits))
        rotation = matrix[:3, :3]
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-14)
        np.testing.assert_allclose(matrix, T, atol=10.0**-digits)
        assert sum(one.category is RegkitWarning for one in recwarn.list) == told


@pytest.mark.parametrize(
    ("matrix", "word"),
    [
        (T.T, "columns"),
        (2.0 * T, "last row"),
        (T @ np.diag([1.1, 1.1, 1.1, 1.0]), "scales by 1.1"),
        (T @ np.diag([1.0, 1.0, 1.1, 1.0]), "stretches"),
        (T @ np.diag([1.0, 1.0, -1.0, 1.0]), "reflects"),
        (T[[1, 0, 2, 3]], "reflects"),
        (T @ np.diag([1.0, 1.0, 0.0, 1.0]), "flattens"),
        (np.zeros((4, 4)), "last row"),
        (np.diag([0.0, 0.0, 0.0, 1.0]), "flattens"),
        (changed(0, 1, 0.9), "shears"),
        (changed(3, 3, 0.0), "last row"),
        (changed(3, 0, 0.1), "last row"),
        (changed(0, 3, np.nan), "finite"),
        (changed(1, 1, np.inf), "finite"),
        (T[:3], "(3, 4)"),
        (T.ravel(), "(16,)"),
        (T[None], "(1, 4, 4)"),
        ([["a"] * 4] * 4, "numbers"),
        ([[1.0], [2.0, 3.0]], "numbers"),
        (None, "4x4"),
    ],
)
def test_matrix_that_is_no_rigid_motion_is_refused(matrix, word):
    with pytest.raises(DataError, match="here: ") as caught:
        checked_rigid(matrix, place="here")
    assert word in caught.value.message


@pytest.mark.parametrize(
    "form", ["{:r}\n", "{:,}\n", "[{:,}],\n", "{:t}\n", "# T_target_source\n{:r}\n"]
)
def test_matrix_is_read_as_people_write_it(tmp_path, form):
    joined = {"r": " ", ",": ", ", "t": "\t"}
    key = form[form.index(":") + 1]
    rows = [joined[key].join(map(repr, row)) for row in T.tolist()]
    path = tmp_path / "T.txt"
    text = form.replace("{:" + key + "}", "{}")
    path.write_text("".join(text.format(row) for row in rows), encoding="utf-8-sig")
    np.testing.assert_allclose(read_transform(str(path)), T, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("1 0 0 0\n0 1 0 0\n0 0 1 0\n", "12 numbers"),
        ("1 0 0 0 0 1 0 0\n0 0 1 0 0 0 0 1\n", "four rows"),
        ("1,0 0,0 0,0 0,0\n" * 4, "32 numbers"),
        ("1 0 0 0\n0 1 0 a\n0 0 1 0\n0 0 0 1\n", "T.txt:2"),
        ("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 0\n", "last row"),
        ("", "0 numbers"),
        ("1 0 0 \0", "NUL"),
    ],
)
def test_file_that_holds_no_rigid_motion_is_refused(tmp_path, text, word):
    path = tmp_path / "T.txt"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        read_transform(str(path))
    assert word in str(caught.value)


def test_a_translation_beyond_any_length_is_refused():
    with pytest.raises(DataError, match="9e"):
        checked_rigid(rigid(np.eye(3), np.array([9e17, 0.0, 0.0])))

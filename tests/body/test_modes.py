"""Shape modes in a file beside a template."""

import re
from dataclasses import replace

import numpy as np
import pytest

from regkit.body.modes import KEYS, Modes
from regkit.system.errors import DataError


@pytest.fixture
def modes(random) -> Modes:
    root = random.normal(size=(2, 2))
    return Modes(
        names=("height", "beta_1"),
        labels=("pelvis", "left_hip", "head"),
        joints=random.normal(size=(2, 3, 3)),
        vertices=random.normal(size=(2, 5, 3)),
        mean=random.normal(size=2),
        covariance=root @ root.T + np.eye(2),
        bounds=np.array([[-3.0, 3.0], [0.0, 1.0]]),
    )


def test_modes_are_read_as_written(tmp_path, modes):
    path = tmp_path / "body_modes.npz"
    modes.write(path)
    read = Modes.read(path)
    assert (read.names, read.labels) == (modes.names, modes.labels)
    for key in KEYS[2:]:
        np.testing.assert_allclose(getattr(read, key), getattr(modes, key), atol=1e-6)
    with np.load(path) as stored:
        assert set(stored) == set(KEYS)
        assert stored["vertices"].dtype == np.float32


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"names": ("a", "a")}, "names must be unique"),
        ({"names": ("a", "b\n")}, "names has .* cannot be printed"),
        ({"labels": ("a",)}, r"joints has the shape \(2, 3, 3\)"),
        ({"joints": np.full((2, 3, 3), np.nan)}, "joints has NaN"),
        ({"vertices": np.zeros((1, 5, 3))}, r"vertices has the shape \(1, 5, 3\)"),
        ({"vertices": np.full((2, 5, 3), 1e9)}, "vertices holds 1e"),
        ({"mean": np.zeros(3)}, r"mean has the shape \(3,\)"),
        ({"covariance": np.array([[1.0, 2.0], [0.0, 1.0]])}, "covariance is not symmetric"),
        ({"covariance": np.array([[1.0, 2.0], [2.0, 1.0]])}, "covariance has the eigenvalue -1"),
        ({"covariance": np.zeros((2, 2))}, "covariance has the eigenvalue 0"),
        ({"bounds": np.array([[0.0, 1.0], [1.0, 0.0]])}, "bounds of mode 1 are reversed"),
    ],
)
def test_damaged_modes_are_refused_with_file_and_array(tmp_path, modes, change, complaint):
    path = tmp_path / "body_modes.npz"
    replace(modes, **change).write(path)
    with pytest.raises(DataError) as raised:
        Modes.read(path)
    assert raised.value.place == str(path)
    assert re.search(complaint, raised.value.message), raised.value.message

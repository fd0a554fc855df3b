"""Parametric body models in the layout of SMPL: archives, and pickles of old and new programs."""

from __future__ import annotations

import io
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from regkit.body.modes import KEYS, Modes
from regkit.interchange.body_model.smpl import BodyModel
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind
from tests.support.body_models import body_arrays, chumpy, python2_pickle, sparse

JOINTS = 4
"""The pelvis, the hips and the first joint of the spine: what grows with a small model is small."""


def _arrays() -> dict[str, Any]:
    whole = body_arrays(modes=2)
    kept = 20 * JOINTS
    weights = whole["weights"][:kept, :JOINTS]
    return {
        "v_template": whole["v_template"][:kept],
        "f": whole["f"][(whole["f"] < kept).all(axis=1)],
        "weights": weights / weights.sum(axis=1, keepdims=True),
        "kintree_table": whole["kintree_table"][:, :JOINTS],
        "J_regressor": whole["J_regressor"][:JOINTS, :kept],
        "shapedirs": whole["shapedirs"][:kept],
        "posedirs": np.zeros((1, 3, 1)),
    }


def _archives() -> list[Files]:
    files = []
    for regressor in (None, scipy.sparse.csc_matrix):
        arrays, stream = _arrays(), io.BytesIO()
        if regressor is not None:
            arrays["J_regressor"] = np.array(regressor(arrays["J_regressor"]))
        np.savez(stream, **arrays)
        files.append({"model.npz": stream.getvalue()})
    return files


def _pickles() -> list[Files]:
    arrays = _arrays()
    matrix = {**arrays, "J_regressor": scipy.sparse.csc_matrix(arrays["J_regressor"])}
    old = {
        **arrays,
        "J_regressor": sparse(arrays["J_regressor"]),
        "shapedirs": chumpy(arrays["shapedirs"]),
    }
    contents = [python2_pickle(old), *(pickle.dumps(matrix, protocol) for protocol in (0, 2, 4, 5))]
    return [{"model.pkl": content} for content in contents]


def _read(path: Path) -> BodyModel:
    return BodyModel.read(path, np.eye(3))


def nonsense(value: BodyModel, file: Damaged) -> Iterator[str]:
    yield from oracles.skin(value.mesh, file)
    if value.modes is not None:
        yield from modes_nonsense(value.modes, file)
        if value.modes.vertices.shape[1:] != value.mesh.vertices.shape:
            yield f"modes: of {value.modes.vertices.shape[1]} vertices"


def modes_nonsense(value: Modes, file: Damaged) -> Iterator[str]:
    for key in KEYS[2:]:
        yield from oracles.numbers(getattr(value, key), key, most=oracles.LARGEST)
    count, segments = len(value.names), len(value.labels)
    if value.joints.shape != (count, segments, 3) or len(value.vertices) != count:
        yield f"modes: of the shapes {value.joints.shape} and {value.vertices.shape}"
    for label in (*value.names, *value.labels):
        yield from oracles.name(label, "mode or segment")


def _modes() -> list[Files]:
    arrays = {
        "names": np.array(["height", "beta_1"]),
        "labels": np.array(["hips", "head"]),
        "joints": np.ones((2, 2, 3), dtype=np.float32),
        "vertices": np.ones((2, 9, 3), dtype=np.float32),
        "mean": np.zeros(2, dtype=np.float32),
        "covariance": np.eye(2, dtype=np.float32),
        "bounds": np.array([[-3.0, 3.0], [0.0, 1.0]], dtype=np.float32),
    }
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return [{"modes.npz": stream.getvalue()}]


BODY_MODELS = (
    Kind(
        "models/npz",
        _archives,
        {"model.npz": "npz"},
        _read,
        nonsense,
        suffixes=(".pkl",),
        weight=3.0,
    ),
    Kind(
        "models/pickle",
        _pickles,
        {"model.pkl": "binary"},
        _read,
        nonsense,
        suffixes=(".npz",),
        weight=4.0,
    ),
    Kind("models/modes", _modes, {"modes.npz": "npz"}, Modes.read, modes_nonsense),
)

"""Body models in the layout of SMPL: template, skinning weights, joint regressor, shape modes.

Source: Loper, Mahmood, Romero, Pons-Moll, Black, SMPL: A Skinned Multi-Person Linear Model, ACM
Trans. Graph. 34, 2015. The rest vertices are v_template + shapedirs beta (eq. 8), the joints are
J_regressor times them (eq. 10), and linear blend skinning moves them (eq. 2 to 4).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.body.modes import Modes
from regkit.geometry.mesh_file import (
    FARTHEST,
    Arrays,
    checked_indices,
    checked_shape,
    checked_weights,
)
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.body_model.joint_tree import JointTree
from regkit.interchange.body_model.joints import shape_count
from regkit.interchange.body_model.model_file import ModelFile
from regkit.system.arrays import Array, Indices, read_only
from regkit.system.brief import Brief
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.notes import note

REQUIRED = ("v_template", "f", "weights", "kintree_table", "J_regressor", "shapedirs")
"""Names of the arrays that are read."""

MODES = 10
"""Number of shape modes that are read by default; most programs use as many."""

MOST_VERTICES = 200_000
"""Number of vertices that no body model has."""

MOST_MODES = 1000
"""Number of modes that no body model has."""

MOST_FACES = 10
"""Number of triangles for each vertex that no surface has; a closed one has two."""

BOUND = 5.0
"""Largest coefficient of a mode, in its standard deviations."""

NEGLIGIBLE = 1e-4
"""Weights below this are left out; they move a vertex by less than 0.1 mm for each metre."""

UNEVEN = 0.01
"""Largest deviation of a joint regressor's row sums from one."""


@dataclass(frozen=True)
class BodyModel(Brief):
    """A parametric body model at rest, with its root joint at the origin.

    Attributes:
        mesh: The mean surface; its bones are the joints, and their frames are parallel at rest.
        modes: Its shape modes; None if none are asked for.
        family: Name of the family of models with these joints; None if it is unknown.
        available: Number of shape modes in the file.
    """

    mesh: SkinnedMesh
    modes: Modes | None
    family: str | None
    available: int

    @classmethod
    def read(cls, path: Path, axes: Array, *, scale: float = 1.0, modes: int = MODES) -> BodyModel:
        """Reads an ``.npz`` archive or a pickle, without executing anything in it.

        What is not used is told: pose-dependent corrections, modes of the expression, and the
        principal components of a hand's poses.

        Args:
            path: The file.
            axes: ``R_body_file``, (3, 3).
            scale: Metres per unit of the file.
            modes: Number of shape modes to read.

        Raises:
            DataError: If the file is missing or damaged, has another layout, or asks to run
                something.
        """
        with reading(path, "a body model in an .npz file or a pickle"):
            file = ModelFile.open(path)
            file.check_kind()
            file.require(*REQUIRED)
            return cls._of(file, scale * axes, modes)

    @classmethod
    def _of(cls, file: ModelFile, to_body: Array, wanted: int) -> BodyModel:
        arrays = {name: file.array(name) for name in REQUIRED}
        tree = JointTree.of(arrays["kintree_table"], file)
        count = len(arrays["v_template"]) if arrays["v_template"].ndim else 0
        if not 0 < count <= MOST_VERTICES:
            raise DataError(f"v_template has {count} vertices; it needs 1 to {MOST_VERTICES}")
        vertices = checked_shape(arrays, "v_template", None, 3, most=FARTHEST)
        indices, weights = _carriers(arrays, tree, len(vertices), file.path)
        regressor = _regressor(arrays, tree, len(vertices), file.path)
        vertices = vertices @ to_body.T
        joints = regressor @ vertices
        mesh = SkinnedMesh(
            vertices=read_only(vertices - joints[0]),
            faces=_faces(arrays, len(vertices)),
            labels=tree.names,
            parents=np.array(tree.parents, dtype=np.intp),
            rest=read_only(rigid(np.tile(np.eye(3), (len(joints), 1, 1)), joints - joints[0])),
            indices=indices,
            weights=read_only(weights),
        )
        directions = _directions(arrays, len(vertices))
        available = shape_count(tree.family, len(directions))
        _tell(file, len(directions) - available)
        taken = directions[: min(wanted, available)] @ to_body.T
        modes = _modes(taken, regressor, tree.names) if len(taken) else None
        return cls(mesh, modes, tree.family, available)


def _faces(arrays: Arrays, vertices: int) -> Indices:
    """Returns the vertices of the triangles, (F, 3)."""
    count = len(arrays["f"]) if arrays["f"].ndim else 0
    if not 0 < count <= MOST_FACES * vertices:
        raise DataError(
            f"f has {count} triangles of {vertices} vertices; a surface has about two for each "
            "vertex"
        )
    return checked_indices(arrays, "f", 3, 0, vertices)


def _carriers(arrays: Arrays, tree: JointTree, vertices: int, path: Path) -> tuple[Indices, Array]:
    """Returns the joints that carry each vertex and their weights, (V, A), the largest first."""
    checked_shape(arrays, "weights", vertices, len(tree.names))
    weights = checked_weights(arrays, "weights", path)[:, list(tree.order)]
    weights = np.where(weights < NEGLIGIBLE, 0.0, weights)
    used = int((weights > 0.0).sum(axis=1).max())
    indices = np.argsort(-weights, axis=1, kind="stable")[:, :used]
    weights = np.take_along_axis(weights, indices, axis=1)
    return np.where(weights > 0.0, indices, 0), weights / weights.sum(axis=1, keepdims=True)


def _regressor(arrays: Arrays, tree: JointTree, vertices: int, path: Path) -> Array:
    """Returns the joint regressor, (J, V)."""
    regressor = checked_shape(arrays, "J_regressor", len(tree.names), vertices, most=FARTHEST)
    sums = regressor.sum(axis=1)
    uneven = np.abs(sums - 1.0) > UNEVEN
    if uneven.any():
        joint = int(np.argmax(uneven))
        note(
            f"J_regressor of {int(uneven.sum())} joints does not sum to 1, that of joint {joint} "
            f"to {sums[joint]:.4g}; these joints may lie outside the body",
            place=path,
        )
    return np.asarray(regressor[list(tree.order)])


def _directions(arrays: Arrays, vertices: int) -> Array:
    """Returns the displacements of the vertices by each mode, (K, V, 3)."""
    shape = arrays["shapedirs"].shape
    if len(shape) == 3 and shape[2] > MOST_MODES:
        raise DataError(f"shapedirs has {shape[2]} modes; at most {MOST_MODES}")
    return np.moveaxis(checked_shape(arrays, "shapedirs", vertices, 3, None, most=FARTHEST), 2, 0)


def _modes(vertices: Array, regressor: Array, names: tuple[str, ...]) -> Modes:
    """Returns the modes; their coefficients are independent, with unit variances."""
    count = len(vertices)
    return Modes(
        names=tuple(f"beta_{number + 1}" for number in range(count)),
        labels=names,
        joints=read_only(regressor @ vertices),
        vertices=read_only(vertices),
        mean=np.zeros(count),
        covariance=np.eye(count),
        bounds=np.tile([-BOUND, BOUND], (count, 1)),
    )


def _tell(file: ModelFile, expressions: int) -> None:
    """Tells what of the file is not used."""
    if "posedirs" in file.names:
        note(
            "posedirs are not used: joints bend by linear blend skinning, without the corrections "
            "that depend on the pose",
            place=file.path,
        )
    if expressions:
        note(f"modes of the expression are left out: {expressions}", place=file.path)
    if any(name.startswith("hands_components") for name in file.names):
        note(
            "hands_components are not used: each finger's joint is free, without the principal "
            "components of hands' poses",
            place=file.path,
        )

"""Small body models in the layout of SMPL, and pickles as Python 2 wrote them."""

import pickle
import struct
import sys
import types
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from regkit.interchange.body_model.joints import FAMILIES

Arrays = dict[str, Any]

_PLACES = {
    "pelvis": (0, 0.95, 0),
    "hip": (0.09, 0.87, 0),
    "knee": (0.1, 0.48, 0),
    "ankle": (0.1, 0.08, -0.03),
    "foot": (0.11, 0.03, 0.1),
    "spine1": (0, 1.05, 0),
    "spine2": (0, 1.18, 0),
    "spine3": (0, 1.28, 0),
    "neck": (0, 1.48, 0),
    "head": (0, 1.58, 0.02),
    "collar": (0.07, 1.4, 0),
    "shoulder": (0.17, 1.42, 0),
    "elbow": (0.43, 1.42, -0.02),
    "wrist": (0.68, 1.42, 0),
    "hand": (0.77, 1.41, 0),
    "jaw": (0, 1.57, 0.06),
    "eye": (0.03, 1.63, 0.08),
}
"""Joints of the left side and the middle of a body in the T-pose [m]."""


def tree_of(family: str) -> tuple[list[str], list[int]]:
    """The names and the parents of a family's joints."""
    tree = FAMILIES[family]
    names = list(tree)
    return names, [-1 if above is None else names.index(above) for above in tree.values()]


RINGS = 5
"""Number of squares of vertices along each box."""


def _place(name: str) -> np.ndarray:
    side, _, part = name.rpartition("_")
    if part in _PLACES:
        place = np.array(_PLACES[part], dtype=float)
    else:  # The fingers are in a row, one behind another.
        finger, joint = part[:-1], int(part[-1])
        across = ("index", "middle", "ring", "pinky", "thumb").index(finger)
        place = np.array([0.74 + 0.03 * joint, 1.42, 0.04 - 0.025 * across])
    return place * [-1.0 if side == "right" else 1.0, 1.0, 1.0]


def body_arrays(family: str = "SMPL", modes: int = 3) -> Arrays:
    """A figure of closed boxes, one for each joint, as the arrays of a body model.

    The near end of a box is at its joint, whose regressor is the mean of that end's corners; they
    follow the parent in part.
    """
    random = np.random.default_rng(5)
    names, parents = tree_of(family)
    joints = np.array([_place(name) for name in names])
    vertices: list[np.ndarray] = []
    faces, weights, count = [], [], 4 * RINGS * len(names)
    regressor = np.zeros((len(names), count))
    for index in range(len(names)):
        children = [joints[child] for child, above in enumerate(parents) if above == index]
        away = joints[index] - joints[max(parents[index], 0)]
        along = np.mean(children, axis=0) - joints[index] if children else 0.6 * away
        length = max(float(np.linalg.norm(along)), 0.02)
        axis = along / np.linalg.norm(along) if np.linalg.norm(along) > 1e-6 else np.eye(3)[1]
        side = np.cross(axis, [0.31, 0.52, 0.79])
        side /= np.linalg.norm(side)
        half = 0.18 * min(length, 0.25)
        square = [side + other for other in (np.cross(axis, side), -np.cross(axis, side))]
        corners = [half * one for one in (square[0], square[1], -square[0], -square[1])]
        heights = length * np.linspace(0.0, 0.9, RINGS)
        start, last = len(vertices), 4 * (RINGS - 1)
        vertices += [joints[index] + at * axis + corner for at in heights for corner in corners]
        edges = [(4 * r + k, 4 * r + (k + 1) % 4) for r in range(RINGS - 1) for k in range(4)]
        box = [(a, b, b + 4) for a, b in edges] + [(a, b + 4, a + 4) for a, b in edges]
        box += [(0, 2, 1), (0, 3, 2), (last, last + 1, last + 2), (last, last + 2, last + 3)]
        faces += [[start + corner for corner in one] for one in box]
        regressor[index, start : start + 4] = 0.25
        for corner in range(4 * RINGS):
            row = np.zeros(len(names))
            shared = (0.4 if corner < 4 else 0.1) if parents[index] >= 0 else 0.0
            row[index] = 1.0 - shared
            row[parents[index]] += shared
            weights.append(row)
    directions = 0.01 * random.normal(size=(count, 3, modes))
    if modes:
        directions[..., 0] += 0.05 * np.array(vertices)
    known = [2**32 - 1, *parents[1:]]
    return {
        "v_template": np.array(vertices),
        "f": np.array(faces, dtype=np.uint32),
        "weights": np.array(weights),
        "kintree_table": np.array([known, range(len(names))], dtype=np.uint32),
        "J_regressor": regressor,
        "shapedirs": directions,
    }


def posed(
    arrays: Arrays, betas: np.ndarray, rotations: np.ndarray, trans: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and joints by the formula of SMPL, without pose-dependent corrections.

    Args:
        arrays: The model.
        betas: Coefficients, (K,).
        rotations: Rotation of each joint relative to its parent, (J, 3, 3).
        trans: Translation, (3,).
    """
    vertices = arrays["v_template"] + arrays["shapedirs"] @ betas
    joints = arrays["J_regressor"] @ vertices
    parents = arrays["kintree_table"][0].astype(np.int64)
    motions: list[np.ndarray] = []
    for joint, rotation in enumerate(rotations):
        local = np.eye(4)
        local[:3, :3] = rotation
        local[:3, 3] = joints[joint] - (joints[parents[joint]] if joint else 0.0)
        motions.append(motions[parents[joint]] @ local if joint else local)
    placed = np.array(motions)
    moved = placed.copy()
    moved[:, :3, 3] -= np.einsum("jab,jb->ja", placed[:, :3, :3], joints)
    blended = np.einsum("vj,jab->vab", arrays["weights"], moved)
    skinned = np.einsum("vab,vb->va", blended[:, :3, :3], vertices) + blended[:, :3, 3]
    return skinned + trans, placed[:, :3, 3] + trans


def write_npz(path: Path, arrays: Mapping[str, Any]) -> Path:
    """Write an archive; what is no array becomes an array of Python objects."""
    with path.open("wb") as stream:
        np.savez(stream, **arrays)
    return path


class Instance:
    """An instance of a class of Python 2, by its name and its state."""

    def __init__(self, module: str, name: str, state: dict[str, Any]) -> None:
        self.module, self.name, self.state = module, name, state


def chumpy(values: np.ndarray) -> Instance:
    """An array of chumpy, as it is in the models of 2015."""
    state = {"x": values, "_dirty_vars": Instance("__builtin__", "set", {}), "_itr": None}
    return Instance("chumpy.ch", "Ch", state)


def sparse(values: np.ndarray) -> Instance:
    """A sparse matrix of an old SciPy."""
    matrix = scipy.sparse.csc_matrix(values)
    state = {
        "_shape": values.shape,
        "data": matrix.data,
        "indices": matrix.indices,
        "indptr": matrix.indptr,
        "format": "csc",
        "maxprint": 50,
    }
    return Instance("scipy.sparse.csc", "csc_matrix", state)


def python2_pickle(value: Any) -> bytes:
    """A pickle of protocol 2 as Python 2 writes it, whose strings are bytes."""
    return b"\x80\x02" + b"".join(_opcodes(value)) + b"."


def _opcodes(value: Any) -> Iterator[bytes]:
    if isinstance(value, Instance):
        yield f"c{value.module}\n{value.name}\n".encode() + b")\x81"
        yield from _opcodes(value.state)
        yield b"b"
    elif isinstance(value, np.ndarray):
        yield b"cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\n"
        yield from _opcodes((0,))
        yield b"U\x01b\x87R("
        yield from (part for one in (1, value.shape) for part in _opcodes(one))
        yield b"cnumpy\ndtype\n"
        yield from _opcodes((value.dtype.str[1:], 0, 1))
        yield b"R"
        yield from _opcodes((3, value.dtype.str[0], None, None, None, -1, -1, 0))
        yield b"b\x89"
        yield from _opcodes(np.ascontiguousarray(value).tobytes())
        yield b"tb"
    elif isinstance(value, dict):
        yield b"}("
        for key, own in value.items():
            yield from _opcodes(key)
            yield from _opcodes(own)
        yield b"u"
    elif isinstance(value, (tuple, list)):
        yield b"("
        for one in value:
            yield from _opcodes(one)
        yield b"t"
    elif isinstance(value, (str, bytes)):
        content = value.encode() if isinstance(value, str) else value
        yield b"T" + struct.pack("<i", len(content)) + content
    elif value is None:
        yield b"N"
    else:
        yield b"J" + struct.pack("<i", value)


@contextmanager
def known_class(module: str, name: str) -> Iterator[type]:
    """A class of a module that is not installed, which exists while a pickle is written."""
    made = type(name, (), {"__module__": module})
    parts = module.split(".")
    packages = [".".join(parts[: n + 1]) for n in range(len(parts))]
    before = {package: sys.modules.get(package) for package in packages}
    for package in packages:
        sys.modules[package] = types.ModuleType(package)
    setattr(sys.modules[module], name, made)
    try:
        yield made
    finally:
        for package, was in before.items():
            if was is None:
                del sys.modules[package]
            else:
                sys.modules[package] = was


def python3_pickle(arrays: Mapping[str, Any], protocol: int, *, as_chumpy: str = "") -> bytes:
    """A pickle of today's Python; one array may be of chumpy."""
    with known_class("chumpy.ch", "Ch") as made:
        values = dict(arrays)
        if as_chumpy:
            held = made()
            held.x = values[as_chumpy]
            values[as_chumpy] = held
        return pickle.dumps(values, protocol=protocol)

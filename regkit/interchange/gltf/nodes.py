"""The node hierarchy of a glTF file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import to_matrix
from regkit.interchange.gltf.file import GltfFile
from regkit.system.arrays import Array
from regkit.system.printable import plain_name

HUGE = 1e30
"""Largest number in a transform."""


@dataclass(frozen=True)
class NodeMotion:
    """Transforms of all N nodes relative to their parents: scale, then rotation, then translation.

    Attributes:
        translations: Translations, (N, 3) [m].
        rotations: Unit quaternions (x, y, z, w), (N, 4).
        scales: Scale factors, (N, 3).
    """

    translations: Array
    rotations: Array
    scales: Array

    def copy(self) -> NodeMotion:
        """Returns a writable copy."""
        return NodeMotion(self.translations.copy(), self.rotations.copy(), self.scales.copy())


@dataclass(frozen=True)
class Nodes:
    """The nodes of a file.

    Attributes:
        names: Unique names, (N,), generated where the file has none or a duplicate.
        parents: Index of each node's parent, (N,); -1 for none.
        ordered: Indices of the nodes, parents before children.
        given: Transforms in the file.
        matrices: Transform by index of nodes with a matrix instead, which cannot be animated.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    ordered: tuple[int, ...]
    given: NodeMotion
    matrices: dict[int, Array]

    @classmethod
    def of(cls, file: GltfFile) -> Nodes:
        """Returns the nodes of a file.

        Raises:
            DataError: If the file has no nodes, they are not a forest, or a transform is invalid.
        """
        nodes = file.content.nodes
        if not nodes or None in nodes:
            raise file.wrong("the file has no nodes, or an empty one; it needs a skinned mesh")
        parents = [-1] * len(nodes)
        for index, node in enumerate(nodes):
            for child in node.children or ():
                if not isinstance(child, int) or not 0 <= child < len(nodes) or parents[child] >= 0:
                    raise file.wrong(
                        f"node {index} has the child {child}, which is missing or has another "
                        "parent"
                    )
                parents[child] = index
        ordered = [index for index, parent in enumerate(parents) if parent < 0]
        for index in ordered:
            ordered += list(nodes[index].children or ())
        if len(ordered) < len(nodes):
            raise file.wrong("the nodes form a cycle; they must form a tree")
        try:
            given = NodeMotion(
                _rows([node.translation for node in nodes], (0.0, 0.0, 0.0)),
                _unit(_rows([node.rotation for node in nodes], (0.0, 0.0, 0.0, 1.0))),
                _rows([node.scale for node in nodes], (1.0, 1.0, 1.0)),
            )
            matrices = {
                index: np.array(node.matrix, dtype=np.float64).reshape(4, 4).T
                for index, node in enumerate(nodes)
                if node.matrix
            }
        except (TypeError, ValueError) as error:
            raise file.wrong(f"the transform of a node has the wrong size: {error}") from None
        numbers = [given.translations, given.rotations, given.scales, *matrices.values()]
        # Products of larger numbers overflow; the comparison is false for NaN.
        if not all((np.abs(one) < HUGE).all() for one in numbers):
            raise file.wrong("the transform of a node is not finite, or has a rotation of zero")
        return cls(_names(nodes), tuple(parents), tuple(ordered), given, matrices)

    def placed(self, motion: NodeMotion) -> Array:
        """Returns ``T_scene_node`` of all nodes, (N, 4, 4)."""
        own = np.zeros((len(self.names), 4, 4))
        own[:, :3, :3] = to_matrix(motion.rotations) * motion.scales[:, None, :]
        own[:, :3, 3] = motion.translations
        own[:, 3, 3] = 1.0
        for index, matrix in self.matrices.items():
            own[index] = matrix
        for index in self.ordered:
            if self.parents[index] >= 0:
                own[index] = own[self.parents[index]] @ own[index]
        return own

    def nearest(self, index: int, among: frozenset[int]) -> int:
        """Returns the nearest ancestor of a node that is in ``among``, or -1."""
        above = self.parents[index]
        while above >= 0 and above not in among:
            above = self.parents[above]
        return above


def _rows(rows: list[list[float] | None], default: tuple[float, ...]) -> Array:
    return np.array([default if row is None else row for row in rows], dtype=np.float64).reshape(
        -1, len(default)
    )


def _unit(quaternions: Array) -> Array:
    """Returns unit quaternions (N, 4); NaN for a zero one."""
    lengths = np.linalg.norm(quaternions, axis=1, keepdims=True)
    return quaternions / np.where(lengths > 0.0, lengths, np.nan)


def _names(nodes: list[object]) -> tuple[str, ...]:
    names: list[str] = []
    taken: set[str] = set()
    for index, node in enumerate(nodes):
        name = plain_name(str(getattr(node, "name", None) or ""))
        name = name if name.strip() else f"node_{index}"
        if name in taken:
            name = f"{name}_{index}"
        while name in taken:
            name += "_"
        taken.add(name)
        names.append(name)
    return tuple(names)

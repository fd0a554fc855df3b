"""The tree of a glTF file's nodes, which may be moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.rotation import normalized, to_matrix
from regkit.interchange.gltf.file import GltfFile
from regkit.system.arrays import Array


@dataclass(frozen=True)
class NodeMotion:
    """How all N nodes stand in their parents' frames: scaled, then turned, then moved.

    Attributes:
        translations: (N, 3).
        rotations: (N, 4) unit quaternions.
        scales: (N, 3).
    """

    translations: Array
    rotations: Array
    scales: Array

    def copy(self) -> NodeMotion:
        """One that may be changed."""
        return NodeMotion(self.translations.copy(), self.rotations.copy(), self.scales.copy())


@dataclass(frozen=True)
class Nodes:
    """The nodes of a file.

    Attributes:
        names: (N,) a name for each, made up where the file has none or has it twice.
        parents: (N,) index of each one's parent, -1 for none.
        ordered: The indices, parents first.
        given: How they stand in the file.
        matrices: What stands instead for the nodes that are given by a matrix, which cannot move.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    ordered: tuple[int, ...]
    given: NodeMotion
    matrices: dict[int, Array]

    @classmethod
    def of(cls, file: GltfFile) -> Nodes:
        """The nodes of a file.

        Raises:
            DataError: If they are no forest, or a number is missing.
        """
        nodes = file.content.nodes
        if not nodes or None in nodes:
            raise file.wrong("has no nodes, or an empty one")
        parents = [-1] * len(nodes)
        for index, node in enumerate(nodes):
            for child in node.children or ():
                if not 0 <= child < len(nodes) or parents[child] >= 0:
                    raise file.wrong(f"node {index} has a child {child} that is none of its own")
                parents[child] = index
        ordered = [index for index, parent in enumerate(parents) if parent < 0]
        for index in ordered:
            ordered += list(nodes[index].children or ())
        if len(ordered) < len(nodes):
            raise file.wrong("the nodes form a cycle")
        try:
            given = NodeMotion(
                _rows([node.translation for node in nodes], (0.0, 0.0, 0.0)),
                normalized(_rows([node.rotation for node in nodes], (0.0, 0.0, 0.0, 1.0))),
                _rows([node.scale for node in nodes], (1.0, 1.0, 1.0)),
            )
            matrices = {
                index: np.array(node.matrix, dtype=np.float64).reshape(4, 4).T
                for index, node in enumerate(nodes)
                if node.matrix
            }
        except ValueError as error:
            raise file.wrong(f"a node's transform has a wrong number of numbers: {error}") from None
        return cls(_names(nodes), tuple(parents), tuple(ordered), given, matrices)

    def placed(self, motion: NodeMotion) -> Array:
        """``T_scene_node`` of all nodes, (N, 4, 4)."""
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
        """The nearest node ``among`` those above a node, or -1."""
        above = self.parents[index]
        while above >= 0 and above not in among:
            above = self.parents[above]
        return above


def _rows(rows: list[list[float] | None], default: tuple[float, ...]) -> Array:
    return np.array([default if row is None else row for row in rows], dtype=np.float64).reshape(
        -1, len(default)
    )


def _names(nodes: list[object]) -> tuple[str, ...]:
    names: list[str] = []
    for index, node in enumerate(nodes):
        name = str(getattr(node, "name", None) or f"node_{index}")
        names.append(f"{name}_{index}" if name in names else name)
    return tuple(names)

"""The tree of a body model's joints, parents first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from regkit.interchange.body_model.joints import FAMILIES, family_of
from regkit.interchange.body_model.model_file import ModelFile
from regkit.interchange.body_model.recorded_arrays import Numbers
from regkit.interchange.bones import check_count
from regkit.system.errors import DataError
from regkit.system.printable import is_name


@dataclass(frozen=True)
class JointTree:
    """J joints, parents before children.

    Attributes:
        names: Their names.
        parents: Index of each joint's parent; -1 for the root.
        order: Index of each joint in the file.
        family: Name of the family of models with these joints; None if it is unknown.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    order: tuple[int, ...]
    family: str | None

    @classmethod
    def of(cls, table: Numbers, file: ModelFile) -> JointTree:
        """Returns the tree in ``kintree_table``, (2, J): the parent and the number of each joint.

        The first joint is the root, whatever its parent is. Joints of a known family have its
        names, others those of the file, or numbers.

        Raises:
            DataError: If it is not a tree.
        """
        check_count(table.shape[-1] if table.ndim else 0, file.path)
        parents = _parents(table)
        family = family_of(parents)
        names = list(FAMILIES[family]) if family else _names(file, len(parents))
        order = _parents_first(parents, names)
        place = {joint: index for index, joint in enumerate(order)}
        return cls(
            names=tuple(names[joint] for joint in order),
            parents=tuple(place.get(parents[joint], -1) for joint in order),
            order=tuple(order),
            family=family,
        )


def _parents(table: Numbers) -> list[int]:
    """Returns the index of each joint's parent; -1 for the first joint."""
    if table.ndim != 2 or len(table) != 2 or not table.size or table.dtype.kind not in "fiu":
        raise DataError(
            f"kintree_table has the shape {table.shape} and the type {table.dtype}; it needs two "
            "rows: the parent and the number of each joint"
        )
    above, numbers = (row.tolist() for row in table)
    index_of = {number: index for index, number in enumerate(numbers)}
    if len(index_of) < len(numbers):
        raise DataError("kintree_table has a joint's number twice, in its second row")
    parents = [-1]
    for joint, parent in enumerate(above[1:], start=1):
        if parent not in index_of:
            raise DataError(
                f"kintree_table has the parent {parent:g} for joint {joint}; there is no such joint"
            )
        parents.append(index_of[parent])
    return parents


def _parents_first(parents: Sequence[int], names: Sequence[str]) -> list[int]:
    """Returns the joints with each parent before its children, otherwise in their order."""
    if all(parent < joint for joint, parent in enumerate(parents)):
        return list(range(len(parents)))
    order = [0]
    for joint in order:
        order += [child for child, parent in enumerate(parents) if parent == joint]
    if len(order) < len(parents):
        cut = [names[joint] for joint in range(len(parents)) if joint not in set(order)]
        raise DataError(
            f"kintree_table is no tree: the parents of {', '.join(cut[:5])} form a cycle"
        )
    return order


def _names(file: ModelFile, count: int) -> list[str]:
    """Returns the names of the joints in the file, or numbers."""
    stored = file.value("joint2num") if "joint2num" in file.names else None
    numbers = [f"joint_{joint}" for joint in range(count)]
    if not isinstance(stored, dict):
        return numbers
    by_number = {number: name for name, number in stored.items() if isinstance(number, int)}
    names = [by_number.get(joint) for joint in range(count)]
    if all(isinstance(name, str) and is_name(name) for name in names) and len(set(names)) == count:
        return [str(name) for name in names]
    return numbers

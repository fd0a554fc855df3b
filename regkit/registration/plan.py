"""Plans: methods whose parts all offer compiled functions, bound to a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.interfaces import (
    CompiledEnergy,
    CompiledJoints,
    CompiledPart,
    CompiledWeights,
    Kernel,
    Term,
)
from regkit.interfaces.compiled import BIND, EXPLAIN, RESPOND, RESPOND_JOINTS, WEIGH
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.primitives.arrays import PrimitiveArrays
from regkit.registration.compiled_plan import PlanArrays
from regkit.system.arrays import Array
from regkit.system.calls import Pointer
from regkit.system.compiled import Compiled
from regkit.system.errors import PluginError


@dataclass(frozen=True, eq=False)
class Plan:
    """The compiled parts of a method, bound to a body.

    Attributes:
        body: The body.
        primitives: Primitives of its shape model.
        parts: The parts: first energies, of which the kernel is the first, then weights, then joint
            energies.
    """

    body: Body
    primitives: PrimitiveArrays
    parts: tuple[CompiledPart, ...]

    @classmethod
    def of(
        cls, body: Body, primitives: Primitives, kernel: Kernel, terms: Sequence[Term]
    ) -> Plan | None:
        """Returns the plan of a kernel and terms; None if one of them has no compiled function."""
        if type(primitives).place is not Primitives.place:
            return None
        offered: list[CompiledPart | None] = [
            kernel.compiled(primitives) if _offers(kernel) else None
        ]
        for term in terms:
            part = term.compiled(body, primitives) if _offers(term) else None
            # A term that does not declare what it is gets its error from the readable form.
            declared = isinstance(part, CompiledWeights) is term.weighs
            offered.append(part if declared else None)
        parts = [part for part in offered if part is not None]
        if len(parts) < len(offered):
            return None
        order = (CompiledEnergy, CompiledWeights, CompiledJoints)
        ordered = sorted(parts, key=lambda part: order.index(type(part)))
        return cls(body, PrimitiveArrays.of(primitives), tuple(ordered))

    @cached_property
    def arrays(self) -> PlanArrays:
        """The parts as compiled functions take them.

        Raises:
            PluginError: If a part's function has other annotations than its prototype.
        """
        numbers = [np.asarray([part.numbers], dtype=np.float64) for part in self.parts]
        tables = [np.asarray(part.table, dtype=np.float64) for part in self.parts]
        return PlanArrays(
            energies=sum(isinstance(part, CompiledEnergy) for part in self.parts),
            weights=sum(isinstance(part, CompiledWeights) for part in self.parts),
            functions=np.array([_addresses(part) for part in self.parts], dtype=np.int64),
            numbers=_stacked(numbers),
            table=_stacked(tables),
            table_rows=_ends([len(table) for table in tables]),
            state_rows=_ends([rows for rows, _ in self._shapes]),
        )

    def arrays_of(self, observation: Observation) -> PlanArrays:
        """Returns the arrays for a frame: tables that depend on its data are filled."""
        arrays, table = self.arrays, None
        for index, part in enumerate(self.parts):
            if not isinstance(part, CompiledJoints) or part.of_frame is None:
                continue
            own = part.of_frame(observation)
            if own is not None:
                table = arrays.table.copy() if table is None else table
                first, end = arrays.table_rows[index], arrays.table_rows[index + 1]
                table[first:end, : part.table.shape[1]] = own
        return arrays if table is None else arrays._replace(table=table)

    @cached_property
    def of_view(self) -> Plan:
        """The plan of a view, without the energies of the joints."""
        parts = tuple(part for part in self.parts if not isinstance(part, CompiledJoints))
        return self if len(parts) == len(self.parts) else replace(self, parts=parts)

    @cached_property
    def of_joints(self) -> Plan | None:
        """The plan of the energies of the joints alone; None without any."""
        parts = tuple(part for part in self.parts if isinstance(part, CompiledJoints))
        return replace(self, parts=parts) if parts else None

    @property
    def explains(self) -> bool:
        """Whether the kernel knows inlier probabilities."""
        kernel = self.parts[0]
        return isinstance(kernel, CompiledEnergy) and kernel.explain is not None

    def states(self) -> Array:
        """Returns room for the states of all parts, (R, C)."""
        rows, columns = zip(*self._shapes, strict=True)
        return np.empty((sum(rows), max(columns)))

    @property
    def _shapes(self) -> list[tuple[int, int]]:
        """Shapes of the parts' states."""
        return [part.state if isinstance(part, CompiledEnergy) else (0, 0) for part in self.parts]


def _offers(part: Kernel | Term) -> bool:
    """Returns whether a plug-in's compiled function belongs to its readable form.

    It does not if a subclass has overridden the readable form alone.
    """
    order = type(part).__mro__
    defining = {name: next(c for c in order if name in vars(c)) for name in ("bind", "compiled")}
    return issubclass(defining["compiled"], defining["bind"])


def _addresses(part: CompiledPart) -> tuple[int, int, int]:
    """Returns the addresses of ``bind``, ``respond`` or ``weigh``, and ``explain``; 0 for none."""
    if isinstance(part, CompiledEnergy):
        bind = 0 if part.bind is None else _address(part.bind, BIND)
        explain = 0 if part.explain is None else _address(part.explain, EXPLAIN)
        return bind, _address(part.respond, RESPOND), explain
    if isinstance(part, CompiledWeights):
        return 0, _address(part.weigh, WEIGH), 0
    return 0, _address(part.respond, RESPOND_JOINTS), 0


def _address(function: Compiled[Any, Any], pointer: Pointer) -> int:
    """Returns a function's address.

    Raises:
        PluginError: If its annotations are not those of the pointer's prototype.
    """
    if not pointer.accepts(function.function):
        name = f"{function.function.__module__}.{function.function.__qualname__}"
        wanted = f"{pointer.prototype.__module__}.{pointer.prototype.__qualname__}"
        raise PluginError(f"the compiled function {name} must have the annotations of {wanted}")
    return function.address


def _stacked(tables: Sequence[Array]) -> Array:
    """Returns tables one below the other, as wide as the widest."""
    widest = max((table.shape[1] for table in tables), default=0)
    wide = [np.pad(table, ((0, 0), (0, widest - table.shape[1]))) for table in tables]
    return np.ascontiguousarray(np.concatenate(wide))


def _ends(counts: Sequence[int]) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)

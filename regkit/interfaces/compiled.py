"""Compiled parts: what a kernel or a term may offer beside its readable form.

A method runs compiled as a whole if all its parts offer a compiled function, and reads as before if
one does not. The functions below are prototypes: a part's function has the same annotations, and
the conformance tests hold it to the readable form. A part's constants are ``numbers`` and a
``table``; what it computes once a frame goes into its ``state``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from regkit.observation import Observation
from regkit.observation.arrays import ObservationArrays
from regkit.primitives.arrays import PrimitiveArrays
from regkit.skeleton.arrays import PoseArrays, SkeletonArrays
from regkit.system.arrays import Array
from regkit.system.calls import Pointer
from regkit.system.compiled import Compiled
from regkit.system.machine_types import Matrix, Stack, Vector


class PriorArrays(NamedTuple):
    """What is known of a pose before its frame; see ``Prior``.

    Attributes:
        pose: The mean.
        stiffness: Its information in the unit of the energy, (n, n); empty for a pose alone.
    """

    pose: PoseArrays
    stiffness: Matrix


class SceneArrays(NamedTuple):
    """The state at the start of a frame's registration; see ``Scene``.

    Attributes:
        data: The frame's data.
        primitives: The primitives in the frames of their segments.
        weights: Weights of the primitives in this frame, with their visibility, (K,).
        centres: Positions of the primitives in the start pose, (K, 3) [m].
        axes: R_world_primitive in the start pose, (K, 3, 3).
        smoothing: Standard deviation of a Gaussian that smooths the energy over space [m].
    """

    data: ObservationArrays
    primitives: PrimitiveArrays
    weights: Vector
    centres: Matrix
    axes: Stack
    smoothing: float


def bind(scene: SceneArrays, numbers: Vector, table: Matrix, state: Matrix) -> None:
    """Writes what an energy needs of a frame into its state."""


def respond(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    order: int,
    wrenches: Matrix,
    stiffness: Stack,
) -> float:
    """Returns the energy of placed primitives and adds its derivatives; see ``Response``.

    Args:
        scene: The state at the start.
        centres: Positions of the primitives, (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
        numbers: The part's numbers.
        table: The part's table.
        state: The part's state.
        order: 0 for the energy alone, 1 for wrenches too, 2 for blocks too.
        wrenches: Added to, (K, 6).
        stiffness: Added to, (K, 6, 6).
    """
    raise NotImplementedError


def explain(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    probability: Vector,
) -> None:
    """Writes the probability (N,) that each point is an inlier; NaN if it is unknown."""


def weigh(scene: SceneArrays, numbers: Vector, table: Matrix, factors: Vector) -> None:
    """Writes the factors (K,) of the primitives' weights; see ``VisibilityWeights``."""


def respond_joints(
    skeleton: SkeletonArrays,
    prior: PriorArrays,
    pose: PoseArrays,
    numbers: Vector,
    table: Matrix,
    force: Vector,
    matrix: Matrix,
) -> float:
    """Returns an energy of the joints and adds its derivatives; see ``JointResponse``.

    Args:
        skeleton: The skeleton.
        prior: What is known of the pose.
        pose: The pose.
        numbers: The part's numbers.
        table: The part's table.
        force: Added to, (n,).
        matrix: Added to, (n, n).
    """
    raise NotImplementedError


BIND, RESPOND, EXPLAIN = Pointer(bind), Pointer(respond), Pointer(explain)
WEIGH, RESPOND_JOINTS = Pointer(weigh), Pointer(respond_joints)


def _nothing() -> Array:
    return np.zeros((0, 0))


@dataclass(frozen=True)
class CompiledEnergy:
    """An energy of the primitives: a kernel, or a term that is one.

    Attributes:
        respond: Compiled ``respond``.
        numbers: Numbers that it needs.
        table: Rows of numbers that it needs, (R, C).
        bind: Compiled ``bind``, if it has a state.
        state: Shape of the state.
        explain: Compiled ``explain``, of a kernel that knows inlier probabilities.
    """

    respond: Compiled[Any, float]
    numbers: tuple[float, ...] = ()
    table: Array = field(default_factory=_nothing)
    bind: Compiled[Any, None] | None = None
    state: tuple[int, int] = (0, 0)
    explain: Compiled[Any, None] | None = None


@dataclass(frozen=True)
class CompiledWeights:
    """Weights of the primitives.

    Attributes:
        weigh: Compiled ``weigh``.
        numbers: Numbers that it needs.
        table: Rows of numbers that it needs, (R, C).
    """

    weigh: Compiled[Any, None]
    numbers: tuple[float, ...] = ()
    table: Array = field(default_factory=_nothing)


@dataclass(frozen=True)
class CompiledJoints:
    """An energy of the joints.

    Attributes:
        respond: Compiled ``respond_joints``.
        numbers: Numbers that it needs.
        table: Rows of numbers that it needs, (R, C).
        of_frame: Function that returns the table of a frame, of the same shape, for a part that
            depends on more of the data than the points; None from it stands for ``table``.
    """

    respond: Compiled[Any, float]
    numbers: tuple[float, ...] = ()
    table: Array = field(default_factory=_nothing)
    of_frame: Callable[[Observation], Array | None] | None = None


CompiledPart = CompiledEnergy | CompiledWeights | CompiledJoints
"""What a term may offer."""

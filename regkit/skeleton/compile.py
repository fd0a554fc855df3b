"""Compilation of a skeleton's YAML description into the arrays of a ``Skeleton``."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import from_vector, vector_to_matrix
from regkit.skeleton.couplings import Couplings
from regkit.skeleton.description import SkeletonDescription, parents_first
from regkit.skeleton.joints import (
    BallJoint,
    CouplingDescription,
    FreeJoint,
    HingeJoint,
    PrismaticCouplingDescription,
    PrismaticJoint,
    Range,
    UniversalJoint,
    Vector,
)
from regkit.skeleton.limits import Limits
from regkit.skeleton.skeleton import Skeleton
from regkit.system.arrays import Array, Indices

_UNLIMITED = (-np.inf, np.inf)


@dataclass(frozen=True)
class _Hinge:
    """A joint with one axis.

    Attributes:
        link: Its link.
        twist: Its unit twist in the link's frame, linear first, (6,).
        limits: Smallest and largest angle [rad] or displacement [m].
    """

    link: int
    twist: Array
    limits: tuple[float, float]


@dataclass(frozen=True)
class _Coupling:
    """A hinge that follows that of another segment; the offset is in radians or metres."""

    follower: int
    to: str
    ratio: float
    offset: float


@dataclass
class _Links:
    """The links accumulated so far."""

    parents: list[int] = field(default_factory=list)
    offsets: list[Array] = field(default_factory=list)
    balls: list[tuple[int, BallJoint]] = field(default_factory=list)
    hinges: list[_Hinge] = field(default_factory=list)
    couplings: list[_Coupling] = field(default_factory=list)

    def add(self, parent: int, offset: Array) -> int:
        self.parents.append(parent)
        self.offsets.append(offset)
        return len(self.parents) - 1

    def add_hinge(self, link: int, axis: Vector, limits_deg: Range | None) -> None:
        low, high = np.radians(_UNLIMITED if limits_deg is None else limits_deg)
        self.hinges.append(_Hinge(link, np.array([0.0, 0.0, 0.0, *axis]), (low, high)))

    def add_slide(self, link: int, joint: PrismaticJoint, scale: float) -> None:
        low, high = joint.limits
        twist = np.array([*joint.axis, 0.0, 0.0, 0.0])
        self.hinges.append(_Hinge(link, twist, (scale * low, scale * high)))

    def add_free(self, link: int) -> int:
        """Returns the last link of a free joint: three displacements, then a ball."""
        for axis in np.eye(3):
            twist = np.array([*axis, 0.0, 0.0, 0.0])
            self.hinges.append(_Hinge(link, twist, _UNLIMITED))
            link = self.add(link, np.eye(4))
        self.balls.append((link, BallJoint(type="ball")))
        return link

    def couple(
        self, coupled: CouplingDescription | PrismaticCouplingDescription | None, scale: float
    ) -> None:
        """Couples the hinge that is added next."""
        match coupled:
            case CouplingDescription(to=to, ratio=ratio, offset_deg=degrees):
                offset = float(np.radians(degrees))
            case PrismaticCouplingDescription(to=to, ratio=ratio, offset=metres):
                offset = scale * metres
            case None:
                return
        self.couplings.append(_Coupling(len(self.hinges), to, ratio, offset))


def compiled(description: SkeletonDescription, scale: float = 1.0) -> Skeleton:
    """Returns the skeleton of a description, with all lengths multiplied by ``scale``."""
    names = parents_first(description.segments)
    links = _Links()
    segment_links: dict[str, int] = {}
    for name in names:
        segment = description.segments[name]
        rotation = vector_to_matrix(np.radians(segment.rotation_deg))
        offset = rigid(rotation, scale * np.array(segment.offset))
        link = links.add(-1 if segment.parent is None else segment_links[segment.parent], offset)
        match segment.joint:
            case BallJoint() as ball:
                links.balls.append((link, ball))
            case HingeJoint() as hinge:
                links.couple(hinge.coupled, scale)
                links.add_hinge(link, hinge.axis, hinge.limits_deg)
            case PrismaticJoint() as prismatic:
                links.couple(prismatic.coupled, scale)
                links.add_slide(link, prismatic, scale)
            case UniversalJoint() as universal:
                first, second = universal.limits_deg or (None, None)
                links.add_hinge(link, universal.axes[0], first)
                link = links.add(link, np.eye(4))
                links.add_hinge(link, universal.axes[1], second)
            case FreeJoint() if segment.parent is not None:
                link = links.add_free(link)
        segment_links[name] = link
    free = isinstance(description.segments[names[0]].joint, FreeJoint)
    return _skeleton(names, description, links, segment_links, free=free)


def _skeleton(
    names: list[str],
    description: SkeletonDescription,
    links: _Links,
    segment_links: dict[str, int],
    *,
    free: bool,
) -> Skeleton:
    parents = [description.segments[name].parent for name in names]
    place = {name: index for index, name in enumerate(names)}
    ball_links = np.array([link for link, _ in links.balls], dtype=np.intp)
    hinge_links = np.array([hinge.link for hinge in links.hinges], dtype=np.intp)
    movers = np.array(
        [*([0] * 6 if free else []), *np.repeat(ball_links, 3), *hinge_links], dtype=np.intp
    )
    moved = _ancestors(links.parents)[[segment_links[name] for name in names]]
    return Skeleton(
        names=tuple(names),
        parents=np.array([-1 if p is None else place[p] for p in parents], dtype=np.intp),
        free=free,
        segment_links=np.array([segment_links[name] for name in names], dtype=np.intp),
        link_parents=np.array(links.parents, dtype=np.intp),
        link_offsets=_numbers(links.offsets),
        ball_links=ball_links,
        hinge_links=hinge_links,
        hinge_twists=_numbers([hinge.twist for hinge in links.hinges]).reshape(-1, 6),
        joint_dofs=_joint_dofs(links, segment_links, first=6 if free else 0),
        dof_mask=_numbers(moved[:, movers].T),
        limits=_limits(links, segment_links),
    )


def _joint_dofs(links: _Links, segment_links: dict[str, int], *, first: int) -> dict[str, Indices]:
    """Returns the dof indices of each joint, in the order of its links.

    They are 6 of a free joint, translation first, 3 of a ball, 2 of a universal joint, and 1 of the
    others.
    """
    dofs: dict[int, list[int]] = {}
    for link, _ in links.balls:
        dofs[link] = [first, first + 1, first + 2]
        first += 3
    for hinge in links.hinges:
        dofs[hinge.link] = [first]
        first += 1
    owned = set(segment_links.values())
    joints: dict[str, Indices] = {}
    for name, link in segment_links.items():
        own = dofs.get(link, [])
        parent = links.parents[link]
        while parent >= 0 and parent not in owned:
            own = dofs.get(parent, []) + own
            parent = links.parents[parent]
        if own:
            joints[name] = np.array(own, dtype=np.intp)
    return joints


def _ancestors(parents: list[int]) -> NDArray[np.bool_]:
    """Returns which links (L, L) are, by column, the link of a row or one of its ancestors."""
    found = np.eye(len(parents), dtype=bool)
    for link, parent in enumerate(parents):
        if parent >= 0:
            found[link] |= found[parent]
    return found


def _limits(links: _Links, segment_links: dict[str, int]) -> Limits:
    balls = [ball for _, ball in links.balls]
    hinge = _numbers([hinge.limits for hinge in links.hinges]).reshape(-1, 2)
    couplings = _couplings(links, segment_links)
    return Limits(
        hinge=_numbers(couplings.narrowed(hinge)),
        prismatic=np.array([hinge.twist[:3].any() for hinge in links.hinges], dtype=np.bool_),
        couplings=couplings,
        centre=from_vector(np.radians([ball.centre_deg for ball in balls]).reshape(-1, 3)),
        twist_axis=_numbers([ball.twist_axis for ball in balls]).reshape(-1, 3),
        swing_axis=_numbers([ball.swing_axis for ball in balls]).reshape(-1, 3),
        swing=np.radians([ball.swing_deg or (np.inf, np.inf) for ball in balls]).reshape(-1, 2),
        twist=np.radians([ball.twist_deg or _UNLIMITED for ball in balls]).reshape(-1, 2),
    )


def _couplings(links: _Links, segment_links: dict[str, int]) -> Couplings:
    hinge_of = {hinge.link: index for index, hinge in enumerate(links.hinges)}
    return Couplings(
        hinges=len(links.hinges),
        followers=np.array([coupling.follower for coupling in links.couplings], dtype=np.intp),
        leaders=np.array(
            [hinge_of[segment_links[coupling.to]] for coupling in links.couplings], dtype=np.intp
        ),
        ratios=_numbers([coupling.ratio for coupling in links.couplings]),
        offsets=_numbers([coupling.offset for coupling in links.couplings]),
    )


def _numbers(values: ArrayLike) -> Array:
    """Returns an array as compiled loops take it; a read-only one would compile them anew."""
    return np.array(values, dtype=np.float64, order="C")

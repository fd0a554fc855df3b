"""Compositions: the members of a composed template at their sizes, and what they make together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from regkit.body.body import Body
from regkit.body.composing import attached, beside
from regkit.body.description import BodyDescription
from regkit.body.free_body import FreeBody
from regkit.body.members import Member
from regkit.geometry.joined_surface import in_frame, joined, moved_rest, on_segments_of, without
from regkit.geometry.rigid import inverse, rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.surface import SkinnedSurface
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Sized:
    """A member with its own body.

    Attributes:
        member: The member, with its description at its size.
        make: Makes its body of the same size, when it is needed.
    """

    member: Member
    make: Callable[[], Body]

    @cached_property
    def body(self) -> Body:
        """Its own body."""
        return self.make()


@dataclass(frozen=True)
class Composition:
    """Bodies beside each other, the first of which may have parts.

    Attributes:
        bodies: The bodies that move freely, at least one.
        parts: Parts of the first one.
        leading: Index of the body whose size is that of the whole.
    """

    bodies: Sequence[Sized]
    parts: Sequence[Sized]
    leading: int = 0

    @cached_property
    def description(self) -> BodyDescription:
        """The description of the whole.

        Raises:
            ConfigError: If two segments, markers or parts have the same name.
        """
        first, *others = (one.member for one in self.bodies)
        if self.parts:
            whole = attached(first, [part.member for part in self.parts])
            first = Member(first.name, whole, first.prefix)
        if not others and first.prefix == "":
            return first.description
        return beside([first, *others], self.leading)

    def body(self, name: str) -> Body:
        """Returns the body of the whole, called ``name``."""
        whole = self.description.body(name, self.description.size.value)
        whole = replace(whole, surface=self._surface(whole.skeleton.names))
        if len(self.bodies) == 1:
            return replace(whole, base=self.bodies[0].body if self.parts else None)
        return replace(whole, free_bodies=tuple(self._each(whole)))

    def _each(self, whole: Body) -> Iterator[FreeBody]:
        """Yields each of several bodies, the first one with its parts."""
        for index, one in enumerate(self.bodies):
            alone = one.body
            if self.parts and not index:
                alone = Composition([one], self.parts).body(one.member.name)
            yield FreeBody.of(one.member.name, alone, whole, one.member.prefix)

    def _surface(self, segments: Sequence[str]) -> SkinnedSurface | None:
        """Returns the surface of the whole; None if a member has none.

        Args:
            segments: Names of the whole's segments, in the order of its skeleton.
        """
        surfaces = [_on(one, segments) for one in (*self.bodies, *self.parts)]
        known = [one for one in surfaces if one is not None]
        if len(known) < len(surfaces):
            return None
        first, parts = known[0], known[len(self.bodies) :]
        sockets = self.bodies[0].member.description.sockets
        for index, part in enumerate(self.parts):
            socket = sockets[part.member.root]
            at = segments.index(part.member.root)
            rotation = vector_to_matrix(np.radians(socket.rotation_deg))
            first = in_frame(without(first, at), at, rigid(rotation, np.array(socket.offset)))
            parts[index] = moved_rest(parts[index], _onto(first, parts[index], at))
        return joined([first, *known[1 : len(self.bodies)], *parts], len(segments))


def _on(one: Sized, segments: Sequence[str]) -> SkinnedSurface | None:
    """Returns a member's surface on the segments of the whole."""
    if one.body.surface is None:
        return None
    order = [segments.index(one.member.names[name]) for name in one.body.skeleton.names]
    return on_segments_of(one.body.surface, np.array(order, dtype=np.intp), len(segments))


def _onto(body: SkinnedSurface, part: SkinnedSurface, segment: int) -> Array:
    """Returns the transform (4, 4) of a part to where a segment of a body was made."""
    if body.rest is None or part.rest is None:
        return np.eye(4)
    return np.asarray(body.rest[segment] @ inverse(part.rest[segment]))

"""Remarks on what an import passes over, told together at its end."""

from __future__ import annotations

from dataclasses import dataclass, field

from regkit.system.notes import note

SHOWN = 3
"""Number of members of a kind that a remark names."""


@dataclass(frozen=True)
class Remarks:
    """What a reader passed over, by kind.

    An exporter writes the same placeholder for every joint of a robot, so one note for each kind
    says more than one for each joint.

    Attributes:
        members: For each kind, what it was found on, and the place of each.
    """

    members: dict[str, list[tuple[str, str]]] = field(default_factory=dict)

    def add(self, kind: str, member: str, place: str) -> None:
        """Adds a remark.

        Args:
            kind: What was passed over, and what follows from it.
            member: What it was found on, such as a joint's name.
            place: ``file:line``.
        """
        self.members.setdefault(kind, []).append((member, place))

    def tell(self) -> None:
        """Tells one note for each kind, at the place of its first member."""
        for kind, found in self.members.items():
            names = ", ".join(member for member, _ in found[:SHOWN])
            more = f" and {len(found) - SHOWN} more" if len(found) > SHOWN else ""
            note(f"{kind} ({names}{more})", place=found[0][1])

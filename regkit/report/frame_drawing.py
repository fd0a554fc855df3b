"""Drawings of tracked frames: the data, the placed shape model, the bones and the joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from regkit.body.bones import bone_ends, bones_of
from regkit.interfaces import Registrar
from regkit.primitives import Gaussians, Primitives, TaperedCapsules, Volumes
from regkit.skeleton import Placement
from regkit.system.arrays import Array, real_numbers
from regkit.tracking import Snapshot

MAX_POINTS = 1500
"""Maximum number of points in a plot; more add nothing visible."""

MAX_OUTLINES = 300
"""Maximum number of outlines; more would occlude each other and are drawn as points."""


@dataclass(frozen=True)
class DrawnPrimitives:
    """K placed primitives in the form in which they are drawn.

    Attributes:
        kind: ``gaussians``, ``capsules``, ``solids`` or ``points``; points have centres only.
        centres: Centres, (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
        scales: Standard deviations along the axes, (K, 3) [m].
        weights: Weights, (K,).
        halves: Half the distance of a capsule's ends along its second axis, (K,) [m].
        radii: Radii of a capsule at its ends, (K, 2) [m].
        surfaces: Surface samples of other solids in their own axes, (K, P, 3) [m].
    """

    kind: str
    centres: Array
    axes: Array
    scales: Array
    weights: Array
    halves: Array
    radii: Array
    surfaces: Array

    @classmethod
    def of(cls, primitives: Primitives, placement: Placement) -> Self:
        """Returns the primitives of a placed body."""
        placed = primitives.place(placement.transforms)
        count = len(primitives)
        kind, halves, radii = "points", np.zeros(0), np.zeros((0, 2))
        surfaces = np.zeros((0, 0, 3))
        every = 1
        if isinstance(primitives, TaperedCapsules) and count <= MAX_OUTLINES:
            kind, halves, radii = "capsules", primitives.halves, primitives.radii
        elif isinstance(primitives, Gaussians) and count <= MAX_OUTLINES:
            kind = "gaussians"
        elif isinstance(primitives, Volumes) and count <= MAX_OUTLINES:
            kind, surfaces = "solids", primitives.surface_points()
        else:
            every = -(-count // MAX_POINTS)
        return cls(
            kind=kind,
            centres=placed.centres[::every],
            axes=placed.axes[: count if every == 1 else 0],
            scales=primitives.scales[: count if every == 1 else 0],
            weights=primitives.weights[: count if every == 1 else 0],
            halves=halves,
            radii=radii,
            surfaces=surfaces,
        )

    def covariances(self) -> Array:
        """Returns the covariances ``R diag(scales^2) R^T``, (K, 3, 3) [m^2]."""
        return np.asarray((self.axes * self.scales[:, None, :] ** 2) @ np.swapaxes(self.axes, 1, 2))


@dataclass(frozen=True)
class FrameDrawing:
    """One tracked frame in the camera frame (x right, y down, z forward).

    Attributes:
        frame: Index of the frame.
        why: Reason for its selection, such as ``worst``.
        points: A subset of the data, (N, 3) [m].
        primitives: The shape model.
        bones: Line segments between segment origins, and to the markers, (B, 2, 3) [m].
        markers: The markers of the body, (M, 3) [m].
        reference: The reference joints, (J, 3) [m], NaN where unknown; J may be 0.
    """

    frame: int
    why: str
    points: Array
    primitives: DrawnPrimitives
    bones: Array
    markers: Array
    reference: Array

    @classmethod
    def at(
        cls,
        why: str,
        snapshot: Snapshot,
        registrar: Registrar,
        reference: Array | None,
    ) -> Self:
        """Returns the drawing of a tracked frame.

        Args:
            why: Reason for its selection.
            snapshot: The tracked frame.
            registrar: The registrar that registered it.
            reference: Reference joints, (J, 3) [m], if there are any.
        """
        body = registrar.body
        placement = body.place(snapshot.pose)
        points = snapshot.points
        ends = bone_ends(body, placement.transforms)
        return cls(
            frame=snapshot.frame,
            why=why,
            points=points[:: -(-len(points) // MAX_POINTS)],
            primitives=DrawnPrimitives.of(registrar.primitives, placement),
            bones=ends[bones_of(body)],
            markers=ends[len(placement.transforms) :],
            reference=np.zeros((0, 3)) if reference is None else reference,
        )

    def arrays(self) -> dict[str, np.ndarray[Any, Any]]:
        """Returns the drawing as named arrays of single precision."""
        primitives = {
            name: array for name, array in vars(self.primitives).items() if name != "kind"
        }
        own = {name: vars(self)[name] for name in ("points", "bones", "markers", "reference")}
        named = {name: array.astype(np.float32) for name, array in (primitives | own).items()}
        return named | {
            "frame": np.array(self.frame),
            "why": np.array(self.why),
            "kind": np.array(self.primitives.kind),
        }

    @classmethod
    def from_arrays(cls, named: Mapping[str, np.ndarray[Any, Any]]) -> Self:
        """Returns the drawing of named arrays from ``arrays``.

        Raises:
            KeyError: If an array is missing.
            DataError: If an array holds no numbers.
            ValueError: If an array has a wrong shape.
        """

        def many(name: str, *shape: int) -> Array:
            return real_numbers(named[name], name).reshape(-1, *shape)

        surfaces = real_numbers(named["surfaces"], "surfaces")
        return cls(
            frame=int(named["frame"]),
            why=str(named["why"]),
            primitives=DrawnPrimitives(
                kind=str(named["kind"]),
                centres=many("centres", 3),
                axes=many("axes", 3, 3),
                scales=many("scales", 3),
                weights=many("weights"),
                halves=many("halves"),
                radii=many("radii", 2),
                surfaces=surfaces.reshape(len(surfaces), -1, 3) if surfaces.size else surfaces,
            ),
            points=many("points", 3),
            bones=many("bones", 2, 3),
            markers=many("markers", 3),
            reference=many("reference", 3),
        )

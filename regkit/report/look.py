"""What is seen of one frame: the data, the placed shape model, the bones and the joints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from regkit.body import Body
from regkit.interfaces import Registrar
from regkit.primitives import Gaussians, Primitives, TaperedCapsules, Volumes
from regkit.skeleton import Placement
from regkit.system.arrays import Array
from regkit.tracking import Snapshot

MOST_POINTS = 1500
"""More dots than this show no more in a picture."""

MANY = 300
"""More outlines than this would only hide each other: the primitives are shown as dots."""


@dataclass(frozen=True)
class Form:
    """K placed primitives, as they are drawn.

    Attributes:
        kind: ``gaussians``, ``capsules``, ``solids`` or ``points``; of the last only the centres
            are known.
        centres: (K, 3) [m].
        axes: R_world_primitive, (K, 3, 3).
        scales: Standard deviations along the axes, (K, 3) [m].
        weights: (K,).
        halves: Of capsules, half the distance of the ends on the second axis, (K,) [m].
        radii: Of capsules, at the ends, (K, 2) [m].
        surfaces: Of other solids, points all over each in its own axes, (K, P, 3) [m].
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
        """The primitives of a body in a pose."""
        placed = primitives.place(placement.transforms)
        count = len(primitives)
        kind, halves, radii = "points", np.zeros(0), np.zeros((0, 2))
        surfaces = np.zeros((0, 0, 3))
        every = 1
        if isinstance(primitives, TaperedCapsules) and count <= MANY:
            kind, halves, radii = "capsules", primitives.halves, primitives.radii
        elif isinstance(primitives, Gaussians) and count <= MANY:
            kind = "gaussians"
        elif isinstance(primitives, Volumes) and count <= MANY:
            kind, surfaces = "solids", primitives.surface_points()
        else:
            every = -(-count // MOST_POINTS)
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
        """``R diag(scales^2) R^T``, (K, 3, 3) [m^2]."""
        return np.asarray((self.axes * self.scales[:, None, :] ** 2) @ np.swapaxes(self.axes, 1, 2))


@dataclass(frozen=True)
class Look:
    """One frame in the camera's coordinates (x right, y down, z forward).

    Attributes:
        frame: Its number.
        why: What it was chosen for.
        points: Some of the data, (N, 3) [m].
        form: The shape model.
        bones: Lines from segment to segment and on to the markers, (B, 2, 3) [m].
        markers: The joints found, (M, 3) [m].
        reference: The reference joints, (J, 3) [m], NaN where they are unknown; J may be 0.
    """

    frame: int
    why: str
    points: Array
    form: Form
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
        """A look at a tracked frame."""
        body = registrar.body
        placement = body.place(snapshot.pose)
        points = snapshot.points
        bones = list(_bones(body, placement))
        return cls(
            frame=snapshot.frame,
            why=why,
            points=points[:: -(-len(points) // MOST_POINTS)],
            form=Form.of(registrar.primitives, placement),
            bones=np.array(bones).reshape(-1, 2, 3),
            markers=body.markers.place(placement.transforms),
            reference=np.zeros((0, 3)) if reference is None else reference,
        )

    def arrays(self) -> dict[str, np.ndarray[Any, Any]]:
        """The look as named arrays of single precision."""
        form = {name: array for name, array in vars(self.form).items() if name != "kind"}
        own = {name: vars(self)[name] for name in ("points", "bones", "markers", "reference")}
        named = {name: array.astype(np.float32) for name, array in (form | own).items()}
        return named | {
            "frame": np.array(self.frame),
            "why": np.array(self.why),
            "kind": np.array(self.form.kind),
        }

    @classmethod
    def from_arrays(cls, named: Mapping[str, np.ndarray[Any, Any]]) -> Self:
        """The look that was written as ``arrays``.

        Raises:
            KeyError: If one is missing.
        """
        many = {name: np.asarray(array, dtype=float) for name, array in named.items()
                if array.dtype == np.float32}  # fmt: skip
        form = ("centres", "axes", "scales", "weights", "halves", "radii", "surfaces")
        own = ("points", "bones", "markers", "reference")
        return cls(
            frame=int(named["frame"]),
            why=str(named["why"]),
            form=Form(str(named["kind"]), *(many[name] for name in form)),
            **{name: many[name] for name in own},
        )


def _bones(body: Body, placement: Placement) -> Iterator[tuple[Array, Array]]:
    """Lines from each segment's origin to its parent's, and to the markers that it carries."""
    origins = placement.transforms[:, :3, 3]
    for segment, parent in enumerate(body.skeleton.parents):
        if parent >= 0:
            yield origins[parent], origins[segment]
    for segment, marker in zip(
        body.markers.segments, body.markers.place(placement.transforms), strict=True
    ):
        yield origins[segment], marker

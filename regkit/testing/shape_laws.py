"""Laws of shape models."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import Body
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ShapeModel
from regkit.primitives import Primitives, Volumes
from regkit.system.errors import RegkitError
from regkit.testing.laws import Laws
from regkit.testing.samples import posed
from regkit.testing.verdict import copied, require, same

OUTSIDE = 0.05
"""Maximum distance of a centre from its segment's surface, relative to the body's size."""
TURNED = 1.5
"""Maximum ratio of the distances outside with the given and with the inverse axes."""


def attached(shape: ShapeModel, body: Body) -> Primitives:
    """Returns the primitives of a body; fails the test if the shape model makes none."""
    try:
        primitives = shape.bind(body)
    except RegkitError as error:
        require(
            False, shape,
            f"refuses the sample body ({error}); override the fixture `body` by another",
            look_at=type(shape).bind,
        )  # fmt: skip
        raise
    require(
        isinstance(primitives, shape.makes), shape,
        f"declares makes = {shape.makes.__name__}, but makes {type(primitives).__name__}",
        look_at=type(shape).bind,
    )  # fmt: skip
    return primitives


class ShapeLaws(Laws):
    """Laws of shape models."""

    def test_shape_makes_what_it_says(self, shape: ShapeModel, body: Body) -> None:
        """``bind`` returns primitives of the type ``makes``, with arrays of the right shapes."""
        primitives, make = attached(shape, body), type(shape).bind
        count = len(primitives)
        for name, expected in {
            "segments": (count,), "centres": (count, 3), "axes": (count, 3, 3),
            "scales": (count, 3), "weights": (count,),
        }.items():  # fmt: skip
            values = np.asarray(getattr(primitives, name))
            require(
                values.shape == expected and np.isfinite(values).all(), shape,
                f"makes {name} of shape {values.shape}, or not finite; they must be finite, "
                f"{expected}", look_at=make,
            )  # fmt: skip
        off = np.abs(primitives.axes @ np.swapaxes(primitives.axes, 1, 2) - np.eye(3)).max()
        require(
            off < 1e-6 and (np.linalg.det(primitives.axes) > 0.0).all(), shape,
            f"makes axes that are not rotations, by {off:.2g}; their columns must be orthogonal "
            "unit vectors, right-handed", look_at=make,
        )  # fmt: skip
        require(
            (primitives.weights > 0.0).all() and (primitives.scales >= 0.0).all(), shape,
            "makes weights that are not positive, or negative scales", look_at=make,
        )  # fmt: skip

    def test_shape_covers_every_segment(self, shape: ShapeModel, body: Body) -> None:
        """Each segment with a surface has a primitive; without one, no force acts on it."""
        primitives, names = attached(shape, body), body.skeleton.names
        fleshy = np.unique(body.capsules.segments)
        bare = [names[segment] for segment in np.setdiff1d(fleshy, primitives.segments)]
        require(
            not bare, shape, f"has segments without a primitive: {', '.join(bare)}",
            look_at=type(shape).bind,
        )  # fmt: skip

    def test_shape_lies_where_its_segments_are(self, shape: ShapeModel, body: Body) -> None:
        """Each centre is inside its own segment, or outside by at most 5 % of the body's size."""
        primitives, transforms = attached(shape, body), body.place(body.skeleton.rest()).transforms
        centres, flesh = primitives.place(transforms).centres, body.capsules.place(transforms)
        for segment in np.unique(np.intersect1d(primitives.segments, flesh.segments)):
            own = centres[primitives.segments == segment]
            outside = flesh.selected(flesh.segments == segment).surface_distance(own)
            require(
                outside.max() < OUTSIDE * body.size, shape, f"has a primitive {outside.max():.2g} "
                f"m outside its segment '{body.skeleton.names[segment]}'; centres must be in "
                "the frame of their segment", look_at=type(shape).bind,
            )  # fmt: skip

    def test_shape_has_its_axes_as_columns(self, shape: ShapeModel, body: Body) -> None:
        """The axes fit the body as rotations to the segment's frame, not as their inverses."""
        primitives = attached(shape, body)
        if not isinstance(primitives, Volumes):
            pytest.skip("its primitives have no surface")
        inverse = replace(primitives, axes=np.swapaxes(primitives.axes, 1, 2))
        given, turned = _outside(primitives, body), _outside(inverse, body)
        require(
            given < TURNED * turned + 1e-3 * body.size, shape, f"has surfaces {given:.2g} m "
            f"outside their segments, but {turned:.2g} m with transposed axes; the "
            "columns must be a primitive's own axes", look_at=type(shape).bind,
        )  # fmt: skip

    def test_shape_moves_with_the_body(
        self, shape: ShapeModel, body: Body, random: np.random.Generator
    ) -> None:
        """``place(G T) == G place(T)`` for a rigid motion G and the transforms T of a pose."""
        primitives = attached(shape, body)
        transforms = body.place(posed(body, random)).transforms
        motion = rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3))
        before, after = primitives.place(transforms), primitives.place(motion @ transforms)
        turned = before.centres @ motion[:3, :3].T + motion[:3, 3]
        by = np.abs(after.centres - turned).max()
        place = type(primitives).place
        require(
            by < 1e-9, shape, f"does not move with the body: place(G T) differs from G place(T) by "
            f"{by:.2g} m in the centres", look_at=place,
        )  # fmt: skip
        by = np.abs(after.axes - motion[:3, :3] @ before.axes).max()
        require(
            by < 1e-9, shape, f"does not rotate with the body: place(G T) differs from G place(T) "
            f"by {by:.2g} in the axes", look_at=place,
        )  # fmt: skip

    def test_shape_is_deterministic_and_leaves_the_body_alone(
        self, shape: ShapeModel, body: Body
    ) -> None:
        """Bound twice, it makes the same to the last bit, and does not modify the body."""
        before = copied(body.capsules), copied(body.surface), copied(dict(body.shapes))
        first, second = attached(shape, body), attached(shape, body)
        make = type(shape).bind
        require(
            same(first, second), shape, "makes other primitives when called again",
            look_at=make,
        )  # fmt: skip
        require(
            same(before, (body.capsules, body.surface, dict(body.shapes))), shape,
            "modifies the body; copy arrays before writing to them",
            look_at=make,
        )  # fmt: skip

    def test_shape_stays_in_its_place_when_scaled(self, shape: ShapeModel, body: Body) -> None:
        """``scaled`` multiplies all lengths: centres, scales, and the surface if any."""
        primitives = attached(shape, body)
        transforms = body.place(body.skeleton.rest()).transforms.copy()
        before = primitives.place(transforms).centres
        transforms[:, :3, 3] *= 1.5
        larger = primitives.scaled(1.5)
        lengths = {
            "centres": (larger.place(transforms).centres, before),
            "scales": (larger.scales, primitives.scales),
        }
        if isinstance(primitives, Volumes) and isinstance(larger, Volumes):
            lengths["surface points"] = larger.surface_points(), primitives.surface_points()
        for name, (after, own) in lengths.items():
            by = np.abs(after - 1.5 * own).max()
            require(
                by < 1e-9, shape, f"has primitives whose scaled() does not scale {name}: off by "
                f"{by:.2g} m", look_at=type(primitives).scaled,
            )  # fmt: skip


def _outside(volumes: Volumes, body: Body) -> float:
    """Returns the mean distance of the surfaces outside their segments [m]."""
    transforms = body.place(body.skeleton.rest()).transforms
    placed, flesh = volumes.place(transforms), body.capsules.place(transforms)
    surfaces = volumes.surface_points() @ np.swapaxes(placed.axes, 1, 2) + placed.centres[:, None]
    distances = [
        flesh.selected(flesh.segments == segment).surface_distance(
            surfaces[volumes.segments == segment].reshape(-1, 3)
        )
        for segment in np.intersect1d(volumes.segments, flesh.segments)
    ]
    return float(np.maximum(np.concatenate(distances), 0.0).mean())

"""The YAML description of a template: a skeleton with size, stances, shapes and mesh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, ClassVar

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from regkit.body.body import Body, Markers, Stance
from regkit.body.checks import check_lengths, check_modes, check_stances
from regkit.body.deformation import Scaling
from regkit.body.listed import ListedShape
from regkit.body.parts import PartDescription, SocketDescription, check_parts, parts_of
from regkit.body.shape_parameters import ShapeParameters, UncheckedParameters
from regkit.body.shapes import Shapes
from regkit.config.model import InputPath, Model, did_you_mean, misplaced
from regkit.config.quantities import Length
from regkit.geometry.capsules import Capsules
from regkit.geometry.surface import SkinnedSurface, surface_in
from regkit.skeleton import PoseDescription, SkeletonDescription
from regkit.skeleton.compile import compiled
from regkit.skeleton.description import Name
from regkit.skeleton.joints import in_order

ROUNDED = 1e-3
"""Part of a size by which rounding may move it out of its range."""


class SizeDescription(Model):
    """The characteristic length of a body."""

    name: str
    """Name of the length, such as height for a person or length for a hand."""
    value: Length
    """Value for which all other lengths of the file hold [m]."""
    range: Annotated[tuple[Length, Length], AfterValidator(in_order)]
    """Smallest and largest occurring value [m], searched if no size is given."""

    @model_validator(mode="after")
    def _within_its_range(self) -> SizeDescription:
        smallest, largest = self.range
        # Both are rounded when a template is written.
        if not smallest * (1.0 - ROUNDED) <= self.value <= largest * (1.0 + ROUNDED):
            raise misplaced(
                type(self),
                f"the value {self.value:g} is outside the range {list(self.range)}",
                "range",
            )
        return self


class BodyDescription(SkeletonDescription):
    """A template: skeleton, surface, markers, and parameters of shape models."""

    renamed: ClassVar[dict[str, str]] = {"gaussians": "shapes"}

    title: str
    """Description of the template in one line."""
    sources: tuple[str, ...] = ()
    """Sources of the proportions and the joint limits."""
    size: SizeDescription
    """Size for which the lengths hold."""
    stances: dict[str, PoseDescription] = Field(default_factory=dict)
    """Likely poses in the first frame, facing the camera; the rest pose is always tried."""
    upright: bool = False
    """Whether the body's y axis points up in the first frame; otherwise all rotations about the
    line of sight are tried, for the front and the back."""
    shapes: Shapes = Field(default_factory=dict)
    """Parameters of shape models, by kind and then by segment: a list with one entry per primitive.
    ``KIND/NAME`` is another list for the same kind, which a shape model takes if ``tuned`` names
    it. A shape model that is not listed makes its primitives from the capsules."""
    parts: dict[Name, PartDescription] = Field(default_factory=dict)
    """Parts of a composed body, such as a person's hands or several objects, by name."""
    sockets: dict[Name, SocketDescription] = Field(default_factory=dict)
    """By segment: how a part that a composed template puts in its place is attached."""
    mesh: InputPath | None = None
    """Skinned mesh for shape models that use one: an ``.npz`` file whose bones are named after the
    segments."""
    modes: InputPath | None = None
    """Linear shape modes of the skeleton and of ``mesh``: an ``.npz`` file. ``regkit calibrate``,
    and ``regkit register`` of a scan, then find the shape of a body as a combination of them."""

    @model_validator(mode="after")
    def _shapes_are_on_segments(self) -> BodyDescription:
        for key, by_segment in self.shapes.items():
            for name in by_segment:
                if name not in self.segments:
                    raise misplaced(
                        type(self),
                        f"'{name}' is not a segment (there are: {', '.join(self.segments)})"
                        + did_you_mean(name, list(self.segments)),
                        "shapes",
                        key,
                        name,
                    )
        return self

    @model_validator(mode="after")
    def _modes_are_of_the_mesh(self) -> BodyDescription:
        check_modes(type(self), self.modes, self.mesh, self.segments)
        return self

    @model_validator(mode="after")
    def _parts_fit_together(self) -> BodyDescription:
        check_lengths(type(self), self.segments, self.size.value)
        check_parts(type(self), self.segments, self.parts, self.sockets)
        if self.stances:
            check_stances(type(self), compiled(self), self.stances)
        return self

    def body(self, name: str, size: float) -> Body:
        """Returns the body called ``name``, scaled so that its size is ``size`` [m].

        Raises:
            DataError: If the mesh is missing or invalid.
        """
        scale = size / self.size.value
        skeleton = compiled(self, scale)
        order = {segment: index for index, segment in enumerate(skeleton.names)}
        capsules = [
            (order[segment], [capsule.start, capsule.end], np.broadcast_to(capsule.radius, 2))
            for segment, description in self.segments.items()
            for capsule in description.capsules
        ]
        markers = [
            (marker, order[segment], point)
            for segment, description in self.segments.items()
            for marker, point in description.markers.items()
        ]
        unchecked = self.unchecked()
        stances = [Stance("rest", skeleton.rest())]
        for stance, pose in self.stances.items():
            stances.append(Stance(stance, skeleton.pose(pose, scale)))
        return Body(
            name=name,
            skeleton=skeleton,
            capsules=Capsules(
                np.array([segment for segment, _, _ in capsules], dtype=np.intp),
                scale * np.array([ends for _, ends, _ in capsules]).reshape(-1, 2, 3),
                scale * np.array([radii for _, _, radii in capsules]).reshape(-1, 2),
            ),
            markers=Markers(
                tuple(marker for marker, _, _ in markers),
                np.array([segment for _, segment, _ in markers], dtype=np.intp),
                scale * np.array([point for _, _, point in markers]).reshape(-1, 3),
            ),
            shapes={
                key: _listed(by_segment, order, Scaling(scale))
                for key, by_segment in self.shapes.items()
                if key not in unchecked
            },
            stances=tuple(stances),
            size=size,
            upright=self.upright,
            surface=self._surface(skeleton.names, scale),
            optional=tuple(order[name] for name, one in self.segments.items() if one.optional),
            parts=parts_of(skeleton, self.parts, scale),
        )

    def unchecked(self) -> dict[str, str]:
        """Returns the reasons why listed shape models cannot be loaded, by key."""
        return {one.key: one.reason for one in self._unchecked()}

    def check_shapes(self) -> None:
        """Checks that all listed shapes can be stretched and fitted.

        Raises:
            ConfigError: If a listed shape model cannot be loaded.
        """
        for one in self._unchecked():
            one.refuse()

    def _unchecked(self) -> Iterator[UncheckedParameters]:
        for by_segment in self.shapes.values():
            for several in by_segment.values():
                yield from (one for one in several if isinstance(one, UncheckedParameters))

    def _surface(self, segments: tuple[str, ...], scale: float) -> SkinnedSurface | None:
        return None if self.mesh is None else surface_in(self.mesh, segments).scaled(scale)


def _listed(
    by_segment: Mapping[str, Sequence[ShapeParameters]],
    order: Mapping[str, int],
    scaling: Scaling,
) -> ListedShape[ShapeParameters]:
    rows = [(order[name], one) for name, several in by_segment.items() for one in several]
    return ListedShape(
        np.array([segment for segment, _ in rows], dtype=np.intp),
        tuple(one if scaling.factor == 1.0 else one.deformed(scaling) for _, one in rows),
    )

"""What a template's YAML holds beyond its skeleton: a size, stances, shapes and a mesh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, ClassVar

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from regkit.body.body import Body, Markers, Stance
from regkit.body.deformation import Scaling
from regkit.body.listed import ListedShape
from regkit.body.shape_parameters import ShapeParameters, UncheckedParameters
from regkit.body.shapes import Shapes
from regkit.config.model import InputPath, Model, did_you_mean, misplaced
from regkit.geometry.capsules import Capsules
from regkit.geometry.surface import SkinnedSurface, surface_in
from regkit.skeleton import PoseDescription, SkeletonDescription
from regkit.skeleton.compile import compiled
from regkit.skeleton.joints import Range
from regkit.system.errors import ConfigError


def _positive(value: tuple[float, float]) -> tuple[float, float]:
    if value[0] <= 0.0:
        raise ValueError(f"a length must be positive: {list(value)}")
    return value


class SizeDescription(Model):
    """The length by which a person would name the body's size."""

    name: str
    """What is measured: the height of a person, the length of a hand."""
    value: Annotated[float, Field(gt=0.0)]
    """The length at which all other lengths of this file hold [m]."""
    range: Annotated[Range, AfterValidator(_positive)]
    """The smallest and the largest that occur [m]; tried where no size is given."""


class BodyDescription(SkeletonDescription):
    """A template: skeleton, surface, markers, and the parameters of shape models."""

    renamed: ClassVar[dict[str, str]] = {"gaussians": "shapes"}

    title: str
    """What it is, in a line."""
    sources: tuple[str, ...] = ()
    """Where the proportions and the joint limits come from."""
    size: SizeDescription
    """The size at which the lengths hold."""
    stances: dict[str, PoseDescription] = Field(default_factory=dict)
    """Likely poses of the first frame, facing the camera; the rest pose is always tried."""
    upright: bool = False
    """Whether the body's y axis points up in the first frame; without it every turn about the line
    of sight is tried, and the back as well as the front."""
    shapes: Shapes = Field(default_factory=dict)
    """Parameters of shape models, by their kind and then by segment: a list with those of each
    primitive. A shape model that is not listed makes its primitives from the capsules."""
    mesh: InputPath | None = None
    """A skinned mesh for shape models that take one: an ``.npz`` file whose bones have the names of
    segments."""

    @model_validator(mode="after")
    def _shapes_are_on_segments(self) -> BodyDescription:
        for kind, by_segment in self.shapes.items():
            for name in by_segment:
                if name not in self.segments:
                    raise misplaced(
                        type(self),
                        f"'{name}' is not a segment (there are: {', '.join(self.segments)})"
                        + did_you_mean(name, list(self.segments)),
                        "shapes",
                        kind,
                        name,
                    )
        return self

    def body(self, name: str, size: float) -> Body:
        """Returns the body called ``name``, scaled so that its size is ``size`` [m].

        Raises:
            ConfigError: If a stance names a joint that there is not.
            DataError: If the mesh is missing or wrong.
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
            try:
                stances.append(Stance(stance, skeleton.pose(pose)))
            except ConfigError as error:
                raise error.at(f"stances.{stance} of {name}") from None
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
                kind: _listed(by_segment, order, Scaling(scale))
                for kind, by_segment in self.shapes.items()
                if kind not in unchecked
            },
            stances=tuple(stances),
            size=size,
            upright=self.upright,
            surface=self._surface(skeleton.names, scale),
        )

    def unchecked(self) -> dict[str, str]:
        """Why shape models that the template lists cannot be loaded, by their kind."""
        return {one.kind: one.reason for one in self._unchecked()}

    def check_shapes(self) -> None:
        """Refuse a template whose shapes cannot all be stretched and fitted.

        Raises:
            ConfigError: If it lists a shape model that cannot be loaded.
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

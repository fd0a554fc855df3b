"""What a template's YAML holds beyond its skeleton: a size, stances and Gaussians."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from regkit.body.body import Body, Markers, Stance
from regkit.config.model import InputPath, Model, did_you_mean, misplaced
from regkit.geometry.capsules import Capsules
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.surface import SkinnedSurface, surface_in
from regkit.primitives import Gaussians
from regkit.skeleton import PoseDescription, SkeletonDescription
from regkit.skeleton.compile import compiled
from regkit.skeleton.joints import Range, Vector
from regkit.system.arrays import read_only
from regkit.system.errors import ConfigError

Deviation = Annotated[float, Field(gt=1e-6)]


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


class GaussianDescription(Model):
    """One Gaussian in a segment's frame."""

    centre: Vector
    """Mean [m]."""
    sigma: Deviation | tuple[Deviation, Deviation, Deviation]
    """Standard deviation [m]: one for a sphere, or three along the Gaussian's own axes."""
    rotation_deg: Vector = (0.0, 0.0, 0.0)
    """Rotation vector that turns the Gaussian's own axes in the segment's frame [deg]."""


class BodyDescription(SkeletonDescription):
    """A template: skeleton, surface, markers, and the Gaussians of its shape models."""

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
    gaussians: dict[str, dict[str, tuple[GaussianDescription, ...]]] = Field(default_factory=dict)
    """By the kind of shape model (sog, gsog), then by segment; others are made from the
    capsules."""
    mesh: InputPath | None = None
    """A skinned mesh for shape models that take one: an ``.npz`` file whose bones have the names of
    segments."""

    @model_validator(mode="after")
    def _gaussians_are_on_segments(self) -> BodyDescription:
        for kind, by_segment in self.gaussians.items():
            for name in by_segment:
                if name not in self.segments:
                    raise misplaced(
                        type(self),
                        f"'{name}' is not a segment (there are: {', '.join(self.segments)})"
                        + did_you_mean(name, list(self.segments)),
                        "gaussians",
                        kind,
                        name,
                    )
        return self

    def body(self, name: str, size: float) -> Body:
        """The body called ``name``, scaled so that its size is ``size`` [m].

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
            gaussians={
                kind: _gaussians(by_segment, order).scaled(scale)
                for kind, by_segment in self.gaussians.items()
            },
            stances=tuple(stances),
            size=size,
            upright=self.upright,
            surface=self._surface(skeleton.names, scale),
        )

    def _surface(self, segments: tuple[str, ...], scale: float) -> SkinnedSurface | None:
        return None if self.mesh is None else surface_in(self.mesh, segments).scaled(scale)


def _gaussians(
    by_segment: dict[str, tuple[GaussianDescription, ...]], order: dict[str, int]
) -> Gaussians:
    rows = [(order[name], one) for name, several in by_segment.items() for one in several]
    return Gaussians(
        segments=np.array([segment for segment, _ in rows], dtype=np.intp),
        centres=read_only([one.centre for _, one in rows]).reshape(-1, 3),
        axes=vector_to_matrix(np.radians([one.rotation_deg for _, one in rows]).reshape(-1, 3)),
        scales=read_only([np.broadcast_to(one.sigma, 3) for _, one in rows]).reshape(-1, 3),
        weights=np.ones(len(rows)),
    )

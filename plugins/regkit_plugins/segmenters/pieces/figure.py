"""What a template tells of the pieces that may be its body: area, length and roundness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit_plugins.segmenters.pieces.piece import Piece, roundness

CELLS = 50
"""Number of cells of a silhouette's raster along the body's size."""

ROUNDED = 4
"""The roundness is measured in one of this many views, since all are alike."""

POINTS = 150
"""Number of points on each sphere of a limb; the cells are not much finer on a trunk."""

AREA, LENGTH, LONG = 0.7, 0.4, 0.6
"""Deviations of the logarithms of area and length, and of a length beyond the usual. A body that
folds or turns shows much less of its area and a little less of its length; a forearm is longer than
its hand."""

FLAT = 0.25
"""Deviation of the roundness, as a part of the template's."""

CUT = 0.1
"""Weight of missing area and length of a piece at the border of the image."""

LEAST_FIT = 9.0
"""A piece with a larger cost, three deviations in all, is not the body."""


@dataclass(frozen=True)
class Figure:
    """The body as a piece of a scene, in its usual size.

    Attributes:
        size: The size [m].
        area: Area that it usually shows to a camera [m^2].
        largest: Largest area that it shows [m^2].
        length: Usual extent along its longest axis [m].
        roundness: Usual roundness of its surface.
        extended: The figure with the further parts that the data may show; None without any.
    """

    size: float
    area: float
    largest: float
    length: float
    roundness: float
    extended: Figure | None = None

    @classmethod
    def of(cls, template: Template) -> Self:
        """Returns the medians of a template over its stances, seen from front, side and top.

        Raises:
            ConfigError: If the template has no surface.
        """
        size = float(np.median(template.candidate_sizes()))
        body = template.body(size)
        if not has_surface(body):
            raise ConfigError(
                f"the template '{template.name()}' has no capsules and no surface, to which a "
                "piece of the scene would fit; leave out the segmenters pieces and room"
            )
        clouds = _clouds(body)
        views = [_visible(cloud, axis, size / CELLS) for cloud in clouds for axis in range(3)]
        areas = [len(points) * (size / CELLS) ** 2 for points in views]
        longer = template.extended()
        extended = None if longer is None else cls.of(longer)
        return cls(
            size,
            float(np.median(areas)),
            max(float(np.max(areas)), 0.0 if extended is None else extended.largest),
            float(np.median([_length(points) for points in views])),
            float(np.median([roundness(points, size) for points in views[::ROUNDED]])),
            extended,
        )

    @classmethod
    def of_each(cls, template: Template) -> tuple[Self, ...]:
        """Returns the figure of each of several bodies, the largest first; of one body, its own.

        Raises:
            ConfigError: If a body has no surface.
        """
        each = template.free_bodies().values() or (template,)
        return tuple(sorted(map(cls.of, each), key=lambda one: -one.area))

    def cost(self, piece: Piece) -> float:
        """Returns how unlike the body a piece is: the sum of squared deviations.

        It may have the further parts or not.
        """
        own = self._cost(piece)
        return own if self.extended is None else min(own, self.extended.cost(piece))

    def _cost(self, piece: Piece) -> float:
        cost = 0.0
        for found, usual, less, more in (
            (piece.area, self.area, AREA, AREA),
            (piece.length, self.length, LENGTH, LONG),
        ):
            excess = np.log(max(found, 1e-9) / usual)
            if excess > 0.0:
                cost += (excess / more) ** 2
            else:
                cost += (CUT if piece.cut else 1.0) * (excess / less) ** 2
        return float(cost + (self.flatness(piece) / FLAT) ** 2)

    def flatness(self, piece: Piece) -> float:
        """Returns how much flatter a piece is than the body, from 0 to 1."""
        return max(0.0, 1.0 - roundness(piece.sample, self.size) / max(self.roundness, 1e-9))


def has_surface(body: Body) -> bool:
    """Returns whether a body has capsules or a surface, which show an area."""
    return bool(len(body.capsules)) or body.surface is not None


def _clouds(body: Body) -> list[Array]:
    """Returns points (N, 3) [m] in the body, or on its surface, in each stance."""
    poses = [stance.pose for stance in body.stances] or [body.skeleton.rest()]
    places = [body.place(pose).transforms for pose in poses]
    if body.surface is not None and not len(body.capsules):
        return [body.surface.place(transforms) for transforms in places]
    axes = body.capsules.axis_points(body.size / CELLS)
    around = axes.radii[:, None, None] * _sphere(POINTS)
    return [(axes.place(at)[:, None] + around).reshape(-1, 3) for at in places]


def _sphere(count: int) -> Array:
    """Returns points evenly spread over the unit sphere, (count, 3), on a spiral."""
    height = (2.0 * np.arange(count) + 1.0) / count - 1.0
    turn = np.pi * (1.0 + np.sqrt(5.0)) * np.arange(count)
    radius = np.sqrt(1.0 - height**2)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])


def _visible(cloud: Array, axis: int, cell: float) -> Array:
    """Returns the points of a cloud (N, 3) that are visible along an axis, one in each cell."""
    order = np.argsort(cloud[:, axis])
    first, second = np.floor(np.delete(cloud[order], axis, axis=1) / cell).astype(np.int64).T
    cells = first * (np.ptp(second) + 1) + second - second.min()
    return np.asarray(cloud[order[np.unique(cells, return_index=True)[1]]])


def _length(points: Array) -> float:
    centred = points - points.mean(axis=0)
    axis = np.linalg.eigh(centred.T @ centred)[1][:, -1]
    return float(np.ptp(np.percentile(centred @ axis, [1.0, 99.0])))

"""The atlas: a template's own poses seen from all sides, as compressed small depth images."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from regkit.body import Body
from regkit.search.exemplars.descriptors import exemplar_descriptors
from regkit.search.exemplars.poses import sampled_poses, sampled_views
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array, Singles

DIMENSIONS = 64
"""Number of principal components of the descriptors."""

SAMPLE = 6000
"""Number of descriptors that determine the principal components."""

SPACING = 0.04
"""Distance of the spheres on a body's axes, as a fraction of its size."""

ABSENT = 0.4
"""Fraction of the exemplars that lack the parts that the data may lack."""

BATCH = 1000
"""Number of poses that are placed at once."""


@dataclass(frozen=True)
class AtlasSettings:
    """What an atlas holds.

    Attributes:
        count: Number N of exemplars.
        elevation: Least and greatest angle of the camera above the body's horizon [rad].
        cropped: Fraction of the exemplars of which the picture shows only a part.
        seed: Seed of the poses and views.
    """

    count: int = 30_000
    elevation: tuple[float, float] = (-np.pi / 2, np.pi / 2)
    cropped: float = 0.0
    seed: int = 0


@dataclass(frozen=True)
class Atlas:
    """Exemplars of a body; lengths are in units of its size.

    Attributes:
        balls: Unit quaternions of the ball joints, (N, n_ball, 4).
        hinges: Hinge angles, (N, n_hinge) [rad].
        views: R_view_body, (N, 3, 3).
        centres: Centres of the images in the view's axes, from the body's root, (N, 3) [size].
        mean: Mean descriptor, (D,).
        basis: Principal components, (D, d).
        codes: Singless on these components, (N, d).
    """

    balls: Singles
    hinges: Singles
    views: Singles
    centres: Singles
    mean: Singles
    basis: Singles
    codes: Singles

    @classmethod
    def of(cls, body: Body, settings: AtlasSettings) -> Atlas:
        """Samples and renders the exemplars of a body."""
        random = np.random.default_rng(settings.seed)
        balls, hinges = sampled_poses(body, random, settings.count)
        views = sampled_views(random, settings.count, settings.elevation)
        cuts = _sampled_cuts(random, settings.count, settings.cropped)
        axes = body.capsules.axis_points(SPACING * body.size)
        # A part that the data may lack is seen up to any distance from its joint.
        lengths = np.linalg.norm(axes.points, axis=1) / body.size
        far = np.where(body.is_optional(axes.segments), lengths, 0.0)
        reaches = _sampled_reaches(random, settings.count, float(far.max(initial=0.0)))
        parts = []
        for first in range(0, settings.count, BATCH):
            some = slice(first, first + BATCH)
            poses = Pose(np.eye(4), balls[some], hinges[some])
            places = axes.place(Placement.of(body.skeleton, poses).transforms) / body.size
            radii = axes.radii / body.size
            parts.append(
                exemplar_descriptors(places, radii, far, views[some], cuts[some], reaches[some])
            )
        descriptors = np.concatenate([part[0] for part in parts])
        mean = descriptors.mean(axis=0)
        sample = (descriptors[:SAMPLE] - mean).astype(float)
        _, vectors = np.linalg.eigh(sample.T @ sample)
        basis = np.ascontiguousarray(vectors[:, ::-1][:, :DIMENSIONS], dtype=np.float32)
        return cls(
            balls.astype(np.float32),
            hinges.astype(np.float32),
            views.astype(np.float32),
            np.concatenate([part[1] for part in parts]).astype(np.float32),
            mean,
            basis,
            (descriptors - mean) @ basis,
        )

    def __len__(self) -> int:
        """Number N of exemplars."""
        return len(self.codes)

    def arrays(self) -> dict[str, Singles]:
        """Returns the arrays by name, for a file."""
        return asdict(self)


def _sampled_reaches(random: np.random.Generator, count: int, most: float) -> Array:
    """Returns how far optional parts are seen, (count,); 0 where they are not."""
    reaches = random.uniform(0.0, most, count)
    reaches[random.uniform(size=count) < ABSENT] = 0.0
    return np.asarray(reaches)


def _sampled_cuts(random: np.random.Generator, count: int, share: float) -> Array:
    """Returns lines (count, 3) at which pictures end; infinitely far for whole bodies."""
    angle = random.uniform(0.0, 2.0 * np.pi, count)
    offset = random.uniform(-0.15, 0.35, count)
    offset[random.uniform(size=count) >= share] = np.inf
    return np.column_stack([np.cos(angle), np.sin(angle), offset])

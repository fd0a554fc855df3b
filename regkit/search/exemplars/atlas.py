"""The atlas: a template's own poses seen from all sides, as compressed small depth images."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.search.exemplars.descriptors import HALF, exemplar_descriptors
from regkit.search.exemplars.poses import rolled, sampled_poses, sampled_views
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array, Singles

DIMENSIONS = 64
"""Number of principal components of the descriptors."""

SAMPLE = 6000
"""Number of descriptors that determine the principal components."""

SYMMETRIC = 0.5
"""Probability that two limbs of an exemplar are mirror images.

With it 100 % of 120 folded people are right, with 0.3 97.5 % and without it 95.0 %; of 120 people
each of whom 65 and 50 % are in view 94.2 and 84.2 %, without it 91.7 and 83.3 % (development set of
``benchmarks/starts.py``). Of 42 sizes of people before a depth camera (UTD-MHAD) the mean error is
1.2 %, with 0.33 1.3 and without it 1.8 %.
"""

SPACING = 0.04
"""Distance of the spheres on a body's axes, as a fraction of its size."""

FEW = 0.001
"""Fraction of the exemplars that may show less than ``least_area``."""
ABSENT = 0.4
"""Fraction of the exemplars that lack the parts that the data may lack."""

BATCH = 1000
"""Number of poses that are placed at once."""

IN_VIEW = (0.3, 0.97)
"""Range of the share of a body that is in view beside the first line of a cut picture."""

TWICE, STILL_IN_VIEW = 0.4, (0.6, 0.97)
"""Probability of a second line, and what it leaves of that share."""


@dataclass(frozen=True)
class AtlasSettings:
    """What an atlas holds.

    Attributes:
        count: Number N of exemplars.
        elevation: Least and greatest angle of the camera above the body's horizon [rad].
        cut: Whether the picture shows only a part of each; it ends below, and may end elsewhere.
        seed: Seed of the poses and views.
    """

    count: int = 30_000
    elevation: tuple[float, float] = (-np.pi / 2, np.pi / 2)
    cut: bool = False
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
        codes: Coordinates on these components, (N, d).
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
        balls, hinges = sampled_poses(body, random, settings.count, symmetric=SYMMETRIC)
        views = sampled_views(random, settings.count, settings.elevation)
        cuts = np.zeros((settings.count, 0, 3))
        if settings.cut:
            views = rolled(views, random.uniform(0.0, 2.0 * np.pi, settings.count))
            cuts = _sampled_cuts(random, settings.count)
        descriptors, centres = _rendered(body, balls, hinges, views, cuts, random)
        mean = descriptors.mean(axis=0)
        sample = (descriptors[:SAMPLE] - mean).astype(float)
        _, vectors = np.linalg.eigh(sample.T @ sample)
        basis = np.ascontiguousarray(vectors[:, ::-1][:, :DIMENSIONS], dtype=np.float32)
        return cls(
            balls.astype(np.float32),
            hinges.astype(np.float32),
            views.astype(np.float32),
            centres,
            mean,
            basis,
            (descriptors - mean) @ basis,
        )

    def with_pose(self, body: Body, pose: Pose, count: int) -> Atlas:
        """Returns the atlas with one more pose, seen from evenly many sides.

        Args:
            body: The body.
            pose: The pose.
            count: Number of views.
        """
        random = np.random.default_rng(0)
        balls, hinges = np.tile(pose.balls, (count, 1, 1)), np.tile(pose.hinges, (count, 1))
        views = sampled_views(random, count, (-np.pi / 2, np.pi / 2))
        cuts = np.zeros((count, 0, 3))
        descriptors, centres = _rendered(body, balls, hinges, views, cuts, random)
        return Atlas(
            np.concatenate([self.balls, balls.astype(np.float32)]),
            np.concatenate([self.hinges, hinges.astype(np.float32)]),
            np.concatenate([self.views, views.astype(np.float32)]),
            np.concatenate([self.centres, centres]),
            self.mean,
            self.basis,
            np.concatenate([self.codes, (descriptors - self.mean) @ self.basis]),
        )

    def __len__(self) -> int:
        """Number N of exemplars."""
        return len(self.codes)

    @cached_property
    def norms(self) -> Singles:
        """Squared lengths of the codes, (N,)."""
        return np.asarray((self.codes**2).sum(axis=1))

    def least_area(self) -> float:
        """Returns the area [size^2] that an image of a whole body shows at least, but for a few."""
        cells = len(self.mean) // 2
        shown = self.mean[:cells].sum() + self.codes @ self.basis[:cells].sum(axis=0)
        return float(np.quantile(shown, FEW)) * (2.0 * HALF) ** 2 / cells

    def arrays(self) -> dict[str, Singles]:
        """Returns the arrays by name, for a file."""
        return asdict(self)


def _rendered(
    body: Body,
    balls: Array,
    hinges: Array,
    views: Array,
    cuts: Array,
    random: np.random.Generator,
) -> tuple[Singles, Singles]:
    """Returns the descriptors (N, D) of exemplars, and the centres of their images (N, 3) [size].

    Args:
        body: The body.
        balls: Unit quaternions of the ball joints, (N, n_ball, 4).
        hinges: Hinge angles, (N, n_hinge) [rad].
        views: R_view_body, (N, 3, 3).
        cuts: Lines at which their pictures end, (N, C, 3).
        random: Source of how far optional parts are seen.
    """
    axes, parts = body.capsules.axis_points(SPACING * body.size), []
    radii = axes.radii / body.size
    # A part that the data may lack is seen up to any distance from its joint.
    lengths = np.linalg.norm(axes.points, axis=1) / body.size
    far = np.where(body.is_optional(axes.segments), lengths, 0.0)
    reaches = _sampled_reaches(random, len(views), float(far.max(initial=0.0)))
    for first in range(0, len(views), BATCH):
        some = slice(first, first + BATCH)
        poses = Pose(np.eye(4), balls[some], hinges[some])
        places = axes.place(Placement.of(body.skeleton, poses).transforms) / body.size
        parts.append(
            exemplar_descriptors(places, radii, far, views[some], cuts[some], reaches[some])
        )
    descriptors = np.concatenate([part[0] for part in parts])
    return descriptors, np.concatenate([part[1] for part in parts]).astype(np.float32)


def _sampled_reaches(random: np.random.Generator, count: int, most: float) -> Array:
    """Returns how far optional parts are seen, (count,); 0 where they are not."""
    reaches = random.uniform(0.0, most, count)
    reaches[random.uniform(size=count) < ABSENT] = 0.0
    return np.asarray(reaches)


def _sampled_cuts(random: np.random.Generator, count: int) -> Array:
    """Returns lines (count, 2, 3) at which pictures end: direction, and the share in view.

    The first one is below. The second one is at another side, or nowhere.
    """
    turn = np.radians(90.0) * (1 + random.integers(1, 4, size=count))
    shares = random.uniform(*IN_VIEW, count)
    others = np.where(
        random.uniform(size=count) < TWICE, random.uniform(*STILL_IN_VIEW, count), 1.0
    )
    below = np.column_stack([np.zeros(count), np.ones(count), shares])
    beside = np.column_stack([np.cos(turn), np.sin(turn), others])
    return np.stack([below, beside], axis=1)

"""Reinitialization: a lost body is sought anew among its exemplars, seen from all sides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated

from pydantic import Field

from regkit.body import Body
from regkit.body.each import unexplained_by_others
from regkit.config.model import Model
from regkit.interfaces import Past, RegistrationResult
from regkit.interfaces.tracker import SEARCHES
from regkit.observation import Observation
from regkit.search.exemplars import AtlasSettings, Finder, Pictures, atlas_of, even_rolls
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.start import Finalist
from regkit_plugins.trackers.constant_velocity.lost_bodies import lost_bodies

FEWEST_POINTS = 30
"""Fewer points than this show no body."""

LEAST_AGES = tuple(4 * (2**k - 1) for k in range(1, SEARCHES + 1))
"""Least number of frames since the last search, the one before it, and so on."""

SPAN = 100
"""In so many frames there are at most ``SEARCHES`` searches, whatever the reason."""

VIEWS = 300
"""Number of sides from which the last pose is looked up too."""

GROWN = 1.5
"""A body that enters the picture is sought again when it has this many times the points."""


class Reinitialization(Model):
    """Seeks a lost body anew among its exemplars, as the search ``exemplars`` for a start does.

    It searches when the limbs do not explain the outliers of a frame, when the points jump, and in
    the first frame with data after frames without. The best of the poses that it finds replaces the
    tracked one only if it has fewer outliers, less energy and clearly less misfit to the data.
    Searches that repeat become rarer: the k-th last one is at least 4 (2^k - 1) frames ago. Of
    several bodies that move freely, each that is not surely found is sought among the points that
    the others do not explain.
    """

    exemplars: Annotated[int, Field(ge=100, le=1_000_000)] = 30_000
    """Number of exemplars; the atlas is shared with a start of equally many."""
    looked_up: Annotated[int, Field(ge=1, le=100_000)] = 600
    """Number of similar exemplars that are rendered."""
    refined: Annotated[int, Field(ge=1, le=10_000)] = 40
    """Number of these that are refined."""
    finalists: Annotated[int, Field(ge=1, le=1000)] = 4
    """Number of refined poses that are registered."""
    alarm: Annotated[float, Field(ge=0.0, le=1.0)] = 0.05
    """Search if the fraction of outliers exceeds the usual one, times the factor of the limbs'
    alarm, by this much after the search for limbs."""
    jump: Annotated[float, Field(ge=0.0, le=1.0)] = 0.125
    """Search also if it does so by this much before the search for limbs, in a frame after one
    without alarm: the points have jumped, which limbs may hide."""
    gain: Annotated[float, Field(ge=0.0, le=4.0)] = 0.05
    """Minimum decrease of the misfit for accepting a pose, which ranges from 0 to 4."""

    def bind(self, limbs: LimbRecovery) -> BoundReinitialization | None:
        """Binds the search to a body; None if the body has no exemplars.

        Args:
            limbs: The search of the body's limbs, with its registrar.
        """
        body = limbs.registrar.body
        free = body.skeleton.free or bool(body.free_bodies)
        if not free or not len(body.capsules):
            return None
        return BoundReinitialization(self, limbs)


@dataclass(frozen=True)
class BoundReinitialization:
    """``Reinitialization`` bound to a registrar.

    Attributes:
        settings: The settings.
        limbs: Search for the configurations of the limbs.
    """

    settings: Reinitialization
    limbs: LimbRecovery

    def checked(
        self,
        observation: Observation,
        registered: RegistrationResult,
        found: RegistrationResult,
        past: Past,
        usual: float,
    ) -> RegistrationResult:
        """Returns the registration, or a clearly better one of the body in another pose.

        Args:
            observation: The frame's data.
            registered: Its registration before the search for limbs.
            found: Its registration after the search for limbs.
            past: Results of previous frames.
            usual: Fraction of outliers that raises no alarm of the limbs.
        """
        points = len(observation.points)
        outliers = [1.0 - one.inlier_share - usual for one in (past.last, registered, found)]
        if points < FEWEST_POINTS or not self._due(points, past, outliers):
            return found
        size = self.limbs.registrar.body.size
        tracked = Finalist.registered(self.limbs, found, observation, size)
        if self.limbs.registrar.body.free_bodies:
            found = self._each_anew(observation, tracked).result
            return replace(found, searched=points)
        rivals = self._finalists(observation, past.last.pose)
        best = min(rivals, key=_cost, default=tracked)
        if self._better(best, tracked):
            found = best.result
        return replace(found, searched=points)

    def _each_anew(self, observation: Observation, tracked: Finalist) -> Finalist:
        """Returns the best pose after each lost one of several bodies is sought, the worst first.

        A body is sought among the points that the others do not explain.
        """
        body, points = tracked.body, observation.points
        for at in lost_bodies(body, tracked.pose, observation):
            rest = unexplained_by_others(body, tracked.pose, points, at)
            if rest.sum() < FEWEST_POINTS:
                continue
            one = body.free_bodies[at]
            rivals = [
                self._registered(observation, one.placed(found, tracked.pose))
                for found in self._sought(one.body, observation.only(rest), one.alone(tracked.pose))
            ]
            best = min(rivals, key=_cost, default=tracked)
            if self._better(best, tracked):
                result = self.limbs.recovered(observation, best.result)
                tracked = Finalist.registered(self.limbs, result, observation, body.size)
        return tracked

    def _registered(self, observation: Observation, pose: Pose) -> Finalist:
        """Returns a pose after registration."""
        result = self.limbs.registrar.register(observation, [pose])
        return Finalist.registered(self.limbs, result, observation, self.limbs.registrar.body.size)

    def _due(self, points: int, past: Past, outliers: Sequence[float]) -> bool:
        """Returns whether to seek a body that may be lost, unless it was sought too often already.

        Args:
            points: Number of points.
            past: Results of previous frames.
            outliers: Fraction of outliers beyond the usual one in the last frame, and in this frame
                before and after the search for limbs.
        """
        last = past.searches[::-1]
        begins = not past.frames  # The start has just been sought.
        if begins or (len(last) == SEARCHES and last[-1].age < SPAN):
            return False
        earlier, before, after = outliers
        alarm = self.settings.alarm
        if past.missed or (before > self.settings.jump and earlier <= alarm):
            return True
        grown = not last or points >= GROWN * last[0].points
        rested = all(one.age >= least for one, least in zip(last, LEAST_AGES, strict=False))
        return after > alarm and (grown or rested)

    def _finalists(self, observation: Observation, last: Pose) -> list[Finalist]:
        body = self.limbs.registrar.body
        return [
            Finalist.of(self.limbs, pose, observation, body.size)
            for pose in self._sought(body, observation, last)
        ]

    def _sought(self, body: Body, observation: Observation, last: Pose) -> list[Pose]:
        """Returns the likeliest poses of a body in data, as its exemplars show them.

        Args:
            body: The body.
            observation: The data.
            last: Its last pose.
        """
        settings = self.settings
        # A body that was turned meanwhile may have kept its pose.
        atlas = atlas_of(body, AtlasSettings(settings.exemplars)).with_pose(body, last, VIEWS)
        finder = Finder([body], atlas, even_rolls(), settings.looked_up, settings.refined)
        return [
            one.pose.moved(view.T_world_camera)
            for view in observation.each_view
            for one in finder.candidates(Pictures.of(view.data, body.size))[: settings.finalists]
        ]

    def _better(self, new: Finalist, old: Finalist) -> bool:
        """Returns whether a pose explains the frame clearly better, by every measure there is."""
        gain = new.result.inlier_share - old.result.inlier_share
        return (
            new.energy < old.energy
            and new.misfit < old.misfit - self.settings.gain
            # A method without inlier shares has none to compare.
            and not gain < self.limbs.gain
        )


def _cost(finalist: Finalist) -> float:
    return finalist.cost

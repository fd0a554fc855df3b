"""Clocks of several cameras: a moving body shows one whose frames are of another time."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Mapping

import numpy as np

from regkit.interfaces import Registrar
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.notes import note

REACH = 2
"""A view is compared with the poses of so many frames before and after its own."""

SPAN = np.arange(-REACH, REACH + 1)

SHIFTED = 0.75
"""A clock is wrong if a view fits best so many frames away from where the others do. In a motion in
one direction, a biased pose looks like a shift of less.

On the 28 recordings of the preset ``smmc_like`` with two cameras, on which it was chosen, 25 clocks
that are 1.5 frames off are told, and one right one.
"""

FEWEST, MOST = 12, 24
"""Number of frames with motion that a decision needs, and after which few are compared."""

RARELY = 10
"""From then on, one frame of so many is compared."""

LONGEST_TRIAL = 60
"""Largest number of frames that are tracked on trial to compare the clocks."""

MOVING = 0.01
"""Least mean motion of the markers over the compared poses, as a fraction of the body's size."""


class ClockWatch:
    """Finds cameras whose clock is wrong while a body is tracked, and tells of them.

    The energy of a view alone, as a function of which frame's pose it is evaluated at, is least at
    the time when the view was taken. Poses that all cameras found together lie between the times of
    the cameras, which shifts all of them alike.

    Args:
        registrar: Method bound to the body.
        fps: Frame rate of the instants [1/s].
        place: Name of the recording.
    """

    def __init__(self, registrar: Registrar, fps: float, place: str) -> None:
        self._registrar, self._fps, self._place = registrar, fps, place
        self._last: deque[tuple[Observation, Pose]] = deque(maxlen=len(SPAN))
        self._energies: dict[str, list[Array]] = defaultdict(list)
        self._wait = 0
        self.is_decided = False
        """Whether the clocks were compared in enough frames, or no two are right."""
        self.shifts: dict[str, float] = {}
        """How much later than their times the frames of cameras with a wrong clock are [s]."""

    def trusted(self, observation: Observation) -> Observation:
        """Returns the data of the cameras whose clocks are right; all if there are no others."""
        kept = [view for view in observation.views if view.name not in self.shifts]
        if not kept or len(kept) == len(observation.views):
            return observation
        return Observation.of_views(kept, observation.landmarks)

    def restart(self) -> None:
        """Begins with the first frame again, with what is known of the clocks."""
        self._last.clear()
        self._decide()

    def pause(self) -> None:
        """Tells that the motion since the last frame is unknown."""
        self._last.clear()

    def add(self, observation: Observation, pose: Pose) -> None:
        """Takes the next frame with the pose that was found in it."""
        self._last.append((observation, pose))
        if len(self._last) < len(SPAN):
            return
        if self._wait:
            self._wait -= 1
            return
        poses = [one for _, one in self._last]
        views = self.trusted(self._last[REACH][0]).views
        if len(views) < 2 or not self._moves(poses):
            return
        for view in views:
            seen = [pose.moved(view.to_camera) for pose in poses]
            energies = [self._registrar.evaluate(view.data, one).energy for one in seen]
            self._energies[view.name].append(np.array(energies))
        self._wait = RARELY - 1 if self.is_decided else 0
        self._judge()

    def _moves(self, poses: list[Pose]) -> bool:
        body = self._registrar.body
        first, last = (body.markers.place(body.place(poses[at]).transforms) for at in (0, -1))
        moved = float(np.linalg.norm(last - first, axis=-1).mean())
        return moved >= MOVING * body.size

    def _judge(self) -> None:
        counts = [len(each) for each in self._energies.values()]
        if min(counts) < FEWEST or len(counts) < 2:
            return
        # A shift must show in both halves of the frames, apart from each other.
        halves = [_shifts(self._energies, part) for part in (slice(0, None, 2), slice(1, None, 2))]
        for name in list(self._energies):
            found = [half[name] for half in halves]
            if min(found) > SHIFTED or max(found) < -SHIFTED:
                self._leave_out(name, float(np.mean(found)) / self._fps)
        if max(counts) >= MOST or len(self._energies) < 2:
            self._decide()

    def _decide(self) -> None:
        """Compares the clocks anew, but rarely."""
        self._energies.clear()
        self.is_decided, self._wait = True, RARELY

    def _leave_out(self, name: str, seconds: float) -> None:
        self.shifts[name] = seconds
        del self._energies[name]
        way = "behind" if seconds > 0.0 else "ahead"
        note(
            f"the clock of camera '{name}' is about {1000.0 * abs(seconds):.0f} ms {way}; it is "
            f"left out (in cameras.json, time_offset_s: {seconds:.3f} would correct it)",
            place=self._place,
        )


def _shifts(energies: Mapping[str, list[Array]], part: slice) -> dict[str, float]:
    """Returns how many frames later than most others each view fits best; NaN if it is unknown.

    Args:
        energies: Energies of each view at the poses of ``SPAN``, by the cameras' names.
        part: The frames that count.
    """
    best = {name: _least(np.mean(each[part], axis=0)) for name, each in energies.items()}
    # Of two cameras, the first is right.
    known = sorted(best.values()) if len(best) > 2 else [next(iter(best.values()))]
    usual = known[len(known) // 2]
    return {name: one - usual for name, one in best.items()}


def _least(energies: Array) -> float:
    """Returns where a parabola through energies (5,) at ``SPAN`` is least; NaN if nowhere."""
    curvature, slope, _ = np.polyfit(SPAN, energies, 2)
    if not curvature > 0.0:
        return float("nan")
    return float(np.clip(-slope / (2.0 * curvature), SPAN[0], SPAN[-1]))

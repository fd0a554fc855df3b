"""The motion of a body in one of several cameras, tracked in this camera alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.body.support import WEAK
from regkit.body.verdict import Verdict
from regkit.skeleton import Mirroring
from regkit.system.arrays import Array
from regkit.tracking import Track


@dataclass(frozen=True)
class Motion:
    """The markers of a body in the frames in which a camera surely sees it.

    Attributes:
        times: Times of the frames [s], (T,), ascending.
        markers: Their places in the camera's frame, (T, M, 3) [m].
        weights: 1 for a marker that data support, less for a guess, (T, M).
    """

    times: Array
    markers: Array
    weights: Array

    @classmethod
    def of(cls, track: Track, body: Body, times: Array) -> Motion:
        """Returns the motion of a track.

        Args:
            track: The track.
            body: The tracked body.
            times: Times of all frames of the track [s].
        """
        surely = np.array([one is Verdict.FOUND for one in track.verdicts], dtype=bool)
        supports = np.nan_to_num(track.supports[:, body.markers.segments], nan=1.0)
        weights = np.clip(supports / (2.0 * WEAK), 0.05, 1.0)
        return cls(times[surely], track.markers[surely], weights[surely])

    @classmethod
    def mirrored(cls, track: Track, body: Body, times: Array) -> Motion | None:
        """Returns the motion with near and far exchanged, which looks alike to one camera.

        Who is tracked from behind may be taken to face the camera. None for a body that is not its
        own mirror image.
        """
        mirroring = Mirroring.of(body.skeleton)
        if mirroring is None:
            return None
        surely = [at for at, one in enumerate(track.verdicts) if one is Verdict.FOUND]
        places = []
        for at in surely:
            middle = track.markers[at].mean(axis=0)
            ray = middle / np.linalg.norm(middle)
            pose = mirroring.mirrored(track.pose(at), ray, middle)
            places.append(body.markers.place(body.place(pose).transforms))
        shape = (len(surely), len(body.markers.names))
        return cls(times[surely], np.reshape(places, (*shape, 3)), np.ones(shape))

    def at(self, times: Array, gap: float) -> tuple[Array, Array]:
        """Returns markers (N, M, 3) and weights (N, M) at some times, interpolated.

        Weights are zero outside of the motion, and in gaps that are longer than ``gap`` [s].
        """
        if len(self.times) < 2:
            return np.zeros((len(times), *self.markers.shape[1:])), np.zeros((len(times), 1))
        after = np.clip(np.searchsorted(self.times, times), 1, len(self.times) - 1)
        low, high = self.times[after - 1], self.times[after]
        share = np.clip((times - low) / (high - low), 0.0, 1.0)[:, None]
        known = (times >= self.times[0]) & (times <= self.times[-1]) & (high - low <= gap)
        markers = (1.0 - share[..., None]) * self.markers[after - 1]
        markers += share[..., None] * self.markers[after]
        weights = np.minimum(self.weights[after - 1], self.weights[after])
        return markers, weights * known[:, None]

"""The verdict of a track, with its reason."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body.verdict import FLAT, SURE_MISFIT, Verdict
from regkit.interfaces import Start
from regkit.tracking.track import Track

MANY = 0.1
"""A track is doubtful if a larger fraction of its frames is doubtful or has no data."""

MOST = 0.5
"""A track is lost if the body is lost in a larger fraction of its frames."""

TOLD = {
    Verdict.LOST: "the body is lost in {}",
    Verdict.DOUBTFUL: "it is doubtful in {}",
    Verdict.NO_DATA: "{} have no data",
}
"""What is told of the frames with each verdict."""


@dataclass(frozen=True)
class TrackVerdict:
    """The verdict of a whole track.

    Attributes:
        verdict: Whether the body was found.
        reason: Why the result is doubtful or the body lost, or how many frames have no data; empty
            if there is nothing to tell.
    """

    verdict: Verdict
    reason: str = ""

    @classmethod
    def of(cls, track: Track, start: Start | None = None) -> TrackVerdict:
        """Returns the verdict of a track.

        The body is lost if it is lost in the last frame with data, or in most of them. The track is
        doubtful if the body is lost in a frame, doubtful in the last one or in many, or if many
        frames have no data.

        Args:
            track: The track.
            start: The start. A track is doubtful or lost if its start is, however well its frames
                fit: a body that is turned round, or furniture, fits nearly as well.
        """
        names = [] if start is None else [one.name for one in start.body.free_bodies]
        judged = cls._of_frames(track, names)
        if start is None or start.verdict is Verdict.FOUND:
            return judged
        lost = Verdict.LOST in (start.verdict, judged.verdict)
        reasons = [*filter(None, [judged.reason]), f"{start.summary}: {start.reason}"]
        return cls(Verdict.LOST if lost else Verdict.DOUBTFUL, "; ".join(reasons))

    @classmethod
    def _of_frames(cls, track: Track, names: Sequence[str]) -> TrackVerdict:
        """Returns the verdict of the frames, with the names of several bodies."""
        frames = Counter(track.verdicts)
        seen = [verdict for verdict in track.verdicts if verdict is not Verdict.NO_DATA]
        if not seen:
            return cls(Verdict.LOST, "no frame has data")
        lost, doubtful = (frames[one] / len(seen) for one in (Verdict.LOST, Verdict.DOUBTFUL))
        missing = frames[Verdict.NO_DATA] / len(track)
        if seen[-1] is Verdict.LOST or lost > MOST:
            verdict = Verdict.LOST
        elif lost or doubtful > MANY or seen[-1] is Verdict.DOUBTFUL or missing > MANY:
            verdict = Verdict.DOUBTFUL
        else:
            told = TOLD[Verdict.NO_DATA].format(_share_of(frames[Verdict.NO_DATA], track))
            return cls(Verdict.FOUND, told if missing else "")
        return cls(verdict, "; ".join([*_of_bodies(track, names), _reason(track)]))


def _of_bodies(track: Track, names: Sequence[str]) -> list[str]:
    """Returns which of several bodies is lost or doubtful, and in how many frames."""
    told = []
    for at, name in enumerate(names if track.body_shares is not None else ()):
        frames = Counter(bodies[at] for bodies in track.body_verdicts)
        bad = [one for one in (Verdict.LOST, Verdict.DOUBTFUL) if frames[one]]
        if bad:
            counts = " and ".join(f"{one} in {_share_of(frames[one], track)}" for one in bad)
            told.append(f"'{name}' is {counts}")
    return told


def _reason(track: Track) -> str:
    """Returns how many frames have which verdict, and the worst shares of one."""
    frames, parts = Counter(track.verdicts), []
    if len(track) > 1:
        parts.append(
            ", ".join(
                text.format(_share_of(frames[one], track))
                for one, text in TOLD.items()
                if frames[one]
            )
        )
    flat = np.flatnonzero(track.reliefs < FLAT)
    if len(flat):
        where = f"in frame {track.numbers[flat[0]]:.0f} " if len(track) > 1 else ""
        parts.append(f"{where}the data are as flat as a wall")
    shares = np.fmin(track.inlier_shares, track.coverages)
    if frames[Verdict.LOST] or frames[Verdict.DOUBTFUL]:
        # Where the shares are high, the distance of both sides decides.
        worst = int(np.nanargmax(1.0 - shares + np.nan_to_num(track.misfits)))
        where = f"in frame {track.numbers[worst]:.0f} " if len(track) > 1 else ""
        told = [f"{100.0 * track.inlier_shares[worst]:.0f} % of the points lie on the body"]
        if np.isfinite(track.coverages[worst]):
            told.append(f"{100.0 * track.coverages[worst]:.0f} % of the visible body has data")
        if track.misfits[worst] > SURE_MISFIT:
            told.append(f"both are {track.misfits[worst]:.2g} limb radii apart")
        parts.append(
            f"{where}{', '.join(told)}; check the template, its size, and the crop of the "
            "surroundings"
        )
    return ": ".join(parts)


def _share_of(count: int, track: Track) -> str:
    return f"{count} of {len(track)} frames"

"""The piece segmenter: keeps one connected piece of the scene, or one for each body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.config.quantities import Length, Share
from regkit.interfaces import BoundSegmenter, Expected, Recording, Segmenter, Template
from regkit.observation import Frame
from regkit.system.errors import DataError
from regkit_plugins.segmenters.pieces.components import components
from regkit_plugins.segmenters.pieces.figure import Figure
from regkit_plugins.segmenters.pieces.fitting import fitting
from regkit_plugins.segmenters.pieces.growth import grown, with_fragments
from regkit_plugins.segmenters.pieces.motion import Motion
from regkit_plugins.segmenters.pieces.piece import Piece
from regkit_plugins.segmenters.sampling import sampled

GAP = 0.03
"""Default distance of pieces, as a fraction of the body's size: less than the depth of a limb."""

NEAR = 0.06
"""A piece that was within this distance of the last body, in sizes of the body, is a part of it."""

SLOWEST = 7.5
"""At a lower frame rate [1/s] a limb moves farther than to another piece, and each frame is chosen
from anew."""

CERTAIN, CERTAINLY_ROUND = 2.0, 0.3
"""Of several pieces, those with a smaller cost and a smaller flatness are bodies, since furniture
seldom is as like one."""


class Pieces(Segmenter):
    """Keeps one connected piece of the scene, and pieces that something before it cuts off.

    In an image, neighbouring pixels of like depth are connected; in a cloud, neighbouring points.
    A piece belongs to another if what is between them is hidden by something nearer. In tracking,
    the pieces where the last body was are kept, and those that a large part of it touches; a piece
    is chosen only at the start and after the body was lost. A frame in which no piece is chosen has
    no data. Of a template of several bodies that move freely, a piece is chosen for each, or one
    for several that touch.
    """

    kind: Literal["pieces"] = "pieces"

    choose: (
        Literal["fits", "nearest", "largest", "moving"] | Annotated[int, Field(ge=0, le=1000)]
    ) = "fits"
    """The piece to keep: the nearest of those whose area, length and roundness fit the template
    alike (``fits``); the ``nearest``; the one that shows the ``largest`` area; the one
    that moves most in the recording (``moving``); or its number, counted from 0 at the nearest."""
    gap: Length | None = None
    """Distance of pieces [m]; by default 3 % of the body's size."""
    least: Annotated[Share, Field(gt=0.0)] = 0.1
    """Least area of a piece that is chosen, as a part of the body's."""

    def bind(self, recording: Recording, template: Template) -> BoundPieces:
        """Binds the segmenter; ``moving`` learns what is static.

        Raises:
            DataError: If the motion cannot be seen in the recording.
        """
        motion = Motion.of(recording, template) if self.choose == "moving" else None
        return BoundPieces(self, template, motion, follows=recording.fps >= SLOWEST)

    def each(self, recording: Recording, template: Template) -> tuple[Pieces, ...]:
        """Returns a segmenter for each piece of the first frame that fits, from near to far."""
        frame = next(sampled(recording, 1), None)
        bound = BoundPieces(self, template, None)
        pieces = [] if frame is None else bound.pieces(frame)
        numbers: list[int] = []
        seen = np.zeros(0 if frame is None else len(frame.points), dtype=bool)
        for number, piece in enumerate(bound.candidates(pieces)):
            whole, cost = grown(piece, pieces, bound.figures[0])
            # The part of a body that was found is no other body.
            certain = cost < CERTAIN and bound.figures[0].flatness(whole) < CERTAINLY_ROUND
            if certain and not seen[piece.at].any():
                numbers.append(number)
                seen[whole.at] = True
        return tuple(self.model_copy(update={"choose": number}) for number in numbers) or (self,)


@dataclass(frozen=True)
class BoundPieces(BoundSegmenter):
    """``Pieces`` bound to a recording.

    Attributes:
        settings: The segmenter.
        template: Template of the body.
        motion: What moves, for the choice of what moves.
        follows: Whether the last body tells where the next one is.
    """

    settings: Pieces
    template: Template
    motion: Motion | None
    follows: bool = True

    @cached_property
    def figures(self) -> tuple[Figure, ...]:
        """What the template tells of the pieces of each of its bodies, the largest body first."""
        return Figure.of_each(self.template)

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with the points of the body's piece; without points if none fits."""
        if not len(frame.points):
            return frame
        pieces = self.pieces(frame)
        kept = np.zeros(len(frame.points), dtype=bool)
        piece = self._last(pieces, expected) or self.chosen(pieces)
        if piece is not None:
            kept[piece.at] = True
        return frame.only(kept)

    def pieces(self, frame: Frame) -> list[Piece]:
        """Returns all pieces of a frame from the nearest to the farthest."""
        if not len(frame.points):
            return []
        gap = self.settings.gap or GAP * self.figures[-1].size
        labels = components(frame, gap)
        ends = np.cumsum(np.bincount(labels))[:-1]
        found = [Piece(frame, at, gap) for at in np.split(np.argsort(labels, kind="stable"), ends)]
        return sorted(found, key=lambda piece: piece.depth)

    def candidates(self, pieces: list[Piece]) -> list[Piece]:
        """Returns the pieces that are large enough to be chosen."""
        return [piece for piece in pieces if piece.area >= self._least]

    @property
    def _least(self) -> float:
        """Least area of a piece that is chosen [m^2]."""
        return self.settings.least * self.figures[-1].area

    def chosen(self, pieces: list[Piece]) -> Piece | None:
        """Returns the chosen one of all pieces, with those that belong to it; None if none is.

        Of several bodies it is one piece for each, as one.
        """
        whole, rest = None, pieces
        for number, figure in enumerate(self.figures):
            # Bodies that touch are one piece.
            if whole is not None and held(whole.area, self.figures) > number:
                continue
            best = self._chosen(rest, figure)
            if best is None:
                continue
            whole = best if whole is None else whole.with_piece(best)
            rest = [piece for piece in rest if not np.isin(piece.at[0], best.at)]
            if isinstance(self.settings.choose, int):
                break
        return whole

    def _chosen(self, pieces: list[Piece], figure: Figure) -> Piece | None:
        """Returns the chosen piece of one body."""
        found, choose = self.candidates(pieces), self.settings.choose
        if not found:
            return None
        if choose == "fits":
            return fitting(found, pieces, figure)
        if isinstance(choose, int):
            if choose >= len(found):
                raise DataError(
                    f"there is no piece {choose} (there are {len(found)}, numbered from 0); "
                    "change segmentation.pieces.choose",
                    place=found[0].frame.place,
                )
            best = found[choose]
        elif choose == "nearest":
            best = found[0]
        elif self.motion is not None:
            best = max(found, key=self.motion.of_piece)
        else:
            best = max(found, key=lambda piece: piece.area)
        return grown(best, pieces, figure)[0]

    def _last(self, pieces: list[Piece], expected: Expected | None) -> Piece | None:
        """Returns the pieces where the last body was; None if that is unknown, or too little."""
        if expected is None or not self.follows:
            return None
        reach = NEAR * expected.body.size * (1 + expected.missed)
        near = expected.within(pieces[0].frame.points, reach)
        found = [one for one in pieces if self._holds_body(one, near[one.at])]
        if sum(piece.area for piece in found) < self._least:
            return None
        others = [piece for piece in pieces if all(piece is not one for one in found)]
        whole = replace(found[0], at=np.sort(np.concatenate([piece.at for piece in found])))
        return with_fragments(whole, others, self.figures[0])

    def _holds_body(self, piece: Piece, near: NDArray[np.bool_]) -> bool:
        """Returns whether a piece is a part of the last body, or is joined to a large part of it.

        Args:
            piece: The piece.
            near: Mask of its points where the last body was.
        """
        if near.mean() >= 0.5:
            return True
        return bool(near.any()) and replace(piece, at=piece.at[near]).area >= self._least


def held(area: float, figures: Sequence[Figure]) -> int:
    """Returns how many bodies, the largest first, a chosen area [m^2] holds: the likeliest number.

    Args:
        area: The area.
        figures: The bodies' figures, the largest first.
    """
    sums = np.cumsum([one.area for one in figures])
    return 1 + int(np.abs(np.log(area / sums)).argmin())

"""The room segmenter: what a scene needs that is larger than the body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from regkit.interfaces import Chain, Recording, SegmentedRecording, Segmenter, Template
from regkit.observation import Frame
from regkit.system.notes import note
from regkit.tracking.extent import LARGE, extent_of
from regkit_plugins.segmenters.gate import Gate
from regkit_plugins.segmenters.pieces import Pieces
from regkit_plugins.segmenters.pieces.figure import Figure, has_surface
from regkit_plugins.segmenters.pieces.piece import Piece
from regkit_plugins.segmenters.pieces.pieces import BoundPieces
from regkit_plugins.segmenters.planes import Planes
from regkit_plugins.segmenters.planes.planes import BoundPlanes
from regkit_plugins.segmenters.sampling import sampled
from regkit_plugins.segmenters.unmeasured import Surroundings

AMPLE = 1.5
"""A scene that shows more area than this, in units of the body's largest area, is a room."""

ALL_SIDES = 3.0
"""A scan from all sides occupies so many times the area of one view: two surfaces, and more of them
oblique to the cells."""

CELLS = 50
"""Number of cells along a body's size by which the area of a cloud is measured."""

FRAMES = 3
"""Number of frames, spread over the recording, whose extent is compared with the template's."""


class Room(Segmenter):
    """Takes the body out of a room; does nothing where the scene is no larger than the body.

    Floor and walls are removed (``planes``), and of the rest the piece that fits the template is
    kept (``pieces``), in tracking without what is far from the last body (``gate``). Pixels without
    a measurement among measured ones are unknown.
    """

    kind: Literal["room"] = "room"

    planes: Planes = Planes()
    """Removal of floor and walls."""
    gate: Gate = Gate()
    """Removal of what is far from the last body."""
    pieces: Pieces = Pieces()
    """Choice of the piece that is the body."""

    def bind(self, recording: Recording, template: Template) -> Chain:
        """Compares a few frames with the template, and binds what is needed."""
        # A body without a surface shows no area, and nothing can be told from it.
        known = has_surface(template.body(template.candidate_sizes()[0]))
        frames = list(sampled(recording, FRAMES)) if known else []
        figures = Figure.of_each(template) if known else ()
        if not figures or not any(_is_larger(frame, template, figures) for frame in frames):
            return Chain()
        extent = max(extent_of(frame.points) for frame in frames)
        steps = (self.planes, self.pieces, self.gate)
        chain = Chain.of(steps, recording, template)
        note(_told(frames[0], chain, extent), place=recording.name)
        return Surroundings(chain.steps, chain.names)

    def each(self, recording: Recording, template: Template) -> tuple[Room, ...]:
        """Returns a room for each piece of the first frame that fits."""
        left = SegmentedRecording.of(recording, self.planes.bind(recording, template))
        pieces = self.pieces.each(left, template)
        return tuple(self.model_copy(update={"pieces": one}) for one in pieces)


def _is_larger(frame: Frame, template: Template, figures: Sequence[Figure]) -> bool:
    """Returns whether a frame extends over more than the body, or shows a larger area.

    Several bodies may be far apart, so that their area alone counts.
    """
    usual = float(np.median(template.candidate_sizes()))
    largest = template.candidate_sizes()[-1]
    whole = Piece(frame, np.arange(len(frame.points)), largest / CELLS)
    # A cloud that no camera saw may be a scan.
    sides = 1.0 if frame.camera is not None or frame.views else ALL_SIDES
    area = sum(figure.largest for figure in figures) * (largest / usual) ** 2
    extends = len(figures) == 1 and extent_of(frame.points) > LARGE * largest
    return extends or whole.area > sides * AMPLE * area


def _told(frame: Frame, chain: Chain, extent: float) -> str:
    """Returns what was removed from the first frame."""
    planes, pieces, _ = chain.steps
    assert isinstance(planes, BoundPlanes)
    assert isinstance(pieces, BoundPieces)
    found = pieces.pieces(planes.segmented(frame, None))
    chosen, counted = pieces.chosen(found), pieces.candidates(found)
    numbers = [
        number
        for number, piece in enumerate(counted)
        if chosen is not None and np.isin(piece.at, chosen.at).any()
    ]
    what = f"{len(planes.planes)} plane{'s' * (len(planes.planes) != 1)}"
    if planes.floor is not None:
        what += ", one of them the floor,"
    kept = " and ".join(map(str, numbers))
    rest = f"kept piece {kept}" if numbers else "found no piece that fits"
    return (
        f"took the body out of a scene of {extent:.2g} m: removed {what} and {rest} of "
        f"{len(counted)}, numbered from 0 at the nearest; regkit preview shows it, and an empty "
        "segmentation takes the frames as they are"
    )

"""What moves in a recording."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.interfaces import Recording, Template
from regkit_plugins.segmenters.background.background import Background, BoundBackground, in_front
from regkit_plugins.segmenters.pieces.piece import Piece


@dataclass(frozen=True)
class Motion:
    """The motion in a recording, as what is in front of its static background.

    Attributes:
        background: The background.
    """

    background: BoundBackground

    @classmethod
    def of(cls, recording: Recording, template: Template) -> Motion:
        """Learns what is static.

        Raises:
            DataError: If the frames are not depth images, or too few.
        """
        return cls(Background().bind(recording, template))

    def of_piece(self, piece: Piece) -> float:
        """Returns the area of a piece that is in front of the background [m^2]."""
        moving = in_front(piece.frame, self.background.static, self.background.margin)
        return float(moving[piece.at].mean() * piece.area)

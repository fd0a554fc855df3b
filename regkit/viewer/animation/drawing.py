"""The picture of a frame: shadow, model, points, bones and words."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from regkit.body.verdict import Verdict
from regkit.system.arrays import Array, Indices
from regkit.viewer.animation.canvas import PAPER, Canvas
from regkit.viewer.animation.model import add_shape
from regkit.viewer.animation.pose import ShownPose
from regkit.viewer.animation.view import FINER, FOOT, Sheet, View
from regkit.viewer.shapes import Shape

if TYPE_CHECKING:
    from PIL.Image import Image as Picture
    from PIL.ImageFont import FreeTypeFont

INK, POINT, WORD = (38, 50, 66), (58, 76, 102), (110, 120, 134)
"""Colours of bones, points and words."""

TOLD = {
    Verdict.DOUBTFUL: ("doubtful", (176, 112, 0)),
    Verdict.LOST: ("lost: do not believe this pose", (190, 30, 40)),
    Verdict.NO_DATA: ("no body in sight: the last pose", (110, 110, 118)),
}
"""What is written over a frame whose body was not found, and its colour."""

OPACITY = 0.62
"""Opacity of the model, through which points behind its front are seen."""

NEAR_GROUND = 0.1
"""Markers within this part of a body's height above the ground throw a shadow on it."""


@dataclass(frozen=True)
class Drawing:
    """What all pictures of a track share.

    Attributes:
        sheet: Size of a picture.
        views: Its two halves.
        shape: The shape model.
        bones: Ends of the bones, (B, 2).
        ground: How far the ground is below the camera [m]; None without a ground.
    """

    sheet: Sheet
    views: tuple[View, View]
    shape: Shape
    bones: Indices
    ground: float | None = None

    def picture(self, pose: ShownPose, presence: float = 1.0) -> Picture:
        """Returns the picture of a frame.

        Args:
            pose: The frame.
            presence: How much of the model is there: 0 shows the points alone.
        """
        from PIL import Image

        canvas = Canvas.blank(self.sheet)
        for view in self.views:
            self._add_shadow(canvas, view, pose)
            add_shape(self.shape, canvas, view, pose)
        canvas.blend_solids(OPACITY * presence)
        for view in self.views:
            _add_points(canvas, view, pose, presence)
        image = Image.fromarray(np.rint(canvas.colours).astype(np.uint8))
        image = self._with_bones(image, pose, presence)
        self._write(image, pose)
        return image.resize((self.sheet.width, self.sheet.height), Image.Resampling.LANCZOS)

    def _add_shadow(self, canvas: Canvas, view: View, pose: ShownPose) -> None:
        """Draws soft shadows on the ground below what is near it."""
        if self.ground is None:
            return
        heights = self.ground - pose.ends[:, 1]
        low = pose.ends[heights < NEAR_GROUND * np.ptp(pose.ends[:, 1])]
        for x, _, z in low:
            seen = view.moved(np.array([[x, self.ground, z]]))
            (spot,) = view.pixels(seen)
            across = 0.16 * np.ptp(pose.ends[:, 1]) * view.focal / seen[0, 2] * 0.8
            _shade(canvas, spot, across, 0.14 * across, 0.35 / max(len(low), 1))

    def _with_bones(self, image: Picture, pose: ShownPose, presence: float) -> Picture:
        """Returns the picture with bones and their ends over it."""
        from PIL import Image, ImageDraw

        over = image.copy()
        pen = ImageDraw.Draw(over)
        for view in self.views:
            places = view.pixels(view.moved(pose.ends))
            for width, colour in ((4.2, PAPER), (2.0, INK)):
                for bone in self.bones:
                    pen.line([tuple(one) for one in places[bone]], colour, round(FINER * width))
            for x, y in places[np.unique(self.bones)]:
                for radius, colour in ((3.6, PAPER), (2.9, INK), (1.6, PAPER)):
                    r = FINER * radius
                    pen.ellipse((x - r, y - r, x + r, y + r), fill=colour)
        return Image.blend(image, over, 0.92 * presence)

    def _write(self, image: Picture, pose: ShownPose) -> None:
        """Writes titles, the frame's number, and a warning where the body was not found."""
        from PIL import ImageDraw

        pen = ImageDraw.Draw(image)
        width, height = (FINER * one for one in (self.sheet.width, self.sheet.height))
        foot = height - FINER * FOOT * 0.3
        for column, view in enumerate(self.views):
            at = (width * (0.25 + 0.5 * column), foot)
            pen.text(at, view.title, fill=WORD, font=_font(13), anchor="ms")
        pen.text(
            (width - FINER * 10, foot), f"{pose.frame}", fill=WORD, font=_font(11), anchor="rs"
        )
        for verdict, (words, colour) in TOLD.items():
            if pose.verdict == verdict:
                at = (width / 2, FINER * 10)
                box = pen.textbbox(at, words, font=_font(15), anchor="ma")
                wide, high = FINER * 10, FINER * 5
                area = (box[0] - wide, box[1] - high, box[2] + wide, box[3] + high)
                pen.rounded_rectangle(area, FINER * 5, fill=colour)
                pen.text(at, words, fill=PAPER, font=_font(15), anchor="ma")


def _add_points(canvas: Canvas, view: View, pose: ShownPose, presence: float) -> None:
    """Draws points, fainter where the model hides them."""
    seen = view.moved(pose.points)
    seen = seen[seen[:, 2] > 0.0]
    at = np.rint(view.pixels(seen)).astype(int)
    there = canvas.inside(at, 1)
    seen, at = seen[there], at[there]
    slack = 0.01 * float(np.ptp(pose.ends, axis=0).max())
    hidden = seen[:, 2] > canvas.depths[at[:, 1], at[:, 0]] + slack
    opacity = np.where(hidden, 0.9 - 0.72 * presence, 0.9)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            share = opacity * (1.0 if down == 0 or right == 0 else 0.45) * 0.85
            columns, rows = at[:, 0] + right, at[:, 1] + down
            before = canvas.colours[rows, columns]
            canvas.colours[rows, columns] = before + share[:, None] * (np.array(POINT) - before)


def _shade(canvas: Canvas, spot: Array, across: float, along: float, depth: float) -> None:
    """Darkens an ellipse around a pixel (2,), softly."""
    size = canvas.depths.shape[::-1]
    reach = np.array([3.0 * across, 3.0 * along])
    low = np.clip(spot - reach, 0, size).astype(int)
    high = np.clip(spot + reach, 0, size).astype(int)
    part = canvas.colours[low[1] : high[1], low[0] : high[0]]
    down, right = np.indices(part.shape[:2])
    far = ((right + low[0] - spot[0]) / across) ** 2 + ((down + low[1] - spot[1]) / along) ** 2
    part *= 1.0 - depth * np.exp(-far)[..., None]


@cache
def _font(size: int) -> FreeTypeFont:
    """Returns the font of words, which Matplotlib brings along."""
    import matplotlib
    from PIL import ImageFont

    file = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    return ImageFont.truetype(str(file), FINER * size)

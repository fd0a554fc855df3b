"""Draws a snapshot: shadow, ellipsoids, points, bones. Each is drawn finer and then shrunk."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from _animation.ellipsoids import shaded
from _animation.snapshot import Snapshot
from _animation.view import FINER, HEIGHT, WIDTH, View
from regkit.system.arrays import Array

PAPER, INK, POINT = (251, 251, 253), (38, 50, 66), (58, 76, 102)

BONES = (
    ("head", "neck"),
    ("neck", "spine"),
    ("spine", "pelvis"),
    *(
        (f"{side}_{start}" if start not in ("neck", "pelvis") else start, f"{side}_{end}")
        for side in ("left", "right")
        for start, end in (
            ("neck", "shoulder"),
            ("shoulder", "elbow"),
            ("elbow", "wrist"),
            ("wrist", "hand"),
            ("pelvis", "hip"),
            ("hip", "knee"),
            ("knee", "ankle"),
            ("ankle", "foot"),
        )
    ),
)
"""The markers that bones are drawn between."""

_OPACITY = 0.62


def drawn(snapshot: Snapshot, both: tuple[View, View], presence: float) -> Image.Image:
    """One picture; of the model a part, ``presence``, is there: 0 shows the points alone."""
    canvas = np.tile(np.array(PAPER, dtype=float), (FINER * HEIGHT, FINER * WIDTH, 1))
    for view in both:
        _draw_ground(canvas, view, snapshot)
        nearest = _draw_model(canvas, view, snapshot, _OPACITY * presence)
        _draw_points(canvas, view, snapshot, nearest, presence)
    image = Image.fromarray(np.rint(canvas).astype(np.uint8))
    for view in both:
        image = _with_bones(image, view, snapshot, presence)
    _write(image, both)
    return image.resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)


def _draw_ground(canvas: Array, view: View, snapshot: Snapshot) -> None:
    """A soft shadow on the ground below each foot and between both."""
    feet = np.array([snapshot.markers[f"{side}_ankle"] for side in ("left", "right")])
    for x, _, z in (*feet, feet.mean(axis=0)):
        (spot,) = view.pixels(view.moved(np.array([[x, snapshot.ground, z]])))
        across, along = FINER * 44.0, FINER * 6.0
        columns = slice(int(max(spot[0] - 3 * across, 0)), int(spot[0] + 3 * across))
        rows = slice(int(spot[1] - 3 * along), int(spot[1] + 3 * along))
        part = canvas[rows, columns]
        down, right = np.indices(part.shape[:2])
        far = ((right + columns.start - spot[0]) / across) ** 2
        far += ((down + rows.start - spot[1]) / along) ** 2
        part *= 1.0 - 0.09 * np.exp(-far)[..., None]


def _draw_model(canvas: Array, view: View, snapshot: Snapshot, opacity: float) -> Array:
    """Blend the front of all ellipsoids into the canvas; their depth in each pixel [m]."""
    nearest = np.full(canvas.shape[:2], np.inf)
    colours = np.zeros_like(canvas)
    rotation = view.T_view_camera[:3, :3]
    for centre, covariance, colour in zip(
        view.moved(snapshot.centres), snapshot.covariances, snapshot.colours, strict=True
    ):
        shape = np.linalg.inv(4.0 * rotation @ covariance @ rotation.T)
        pixels, depth, shades = shaded(view, centre, shape, colour)
        columns, rows = pixels.T
        nearer = depth < nearest[rows, columns]
        nearest[rows[nearer], columns[nearer]] = depth[nearer]
        colours[rows[nearer], columns[nearer]] = shades[nearer]
    seen = np.isfinite(nearest)
    canvas[seen] += opacity * (colours[seen] - canvas[seen])
    return nearest


def _draw_points(
    canvas: Array, view: View, snapshot: Snapshot, nearest: Array, presence: float
) -> None:
    """Blend the points into the canvas, fainter where the model hides them."""
    points = view.moved(snapshot.points)
    at = np.rint(view.pixels(points)).astype(int)
    hidden = points[:, 2] > nearest[at[:, 1], at[:, 0]] + 0.02
    opacity = np.where(hidden, 0.9 - 0.72 * presence, 0.9)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            share = opacity * (1.0 if down == 0 or right == 0 else 0.45) * 0.85
            columns, rows = at[:, 0] + right, at[:, 1] + down
            before = canvas[rows, columns]
            canvas[rows, columns] = before + share[:, None] * (np.array(POINT) - before)


def _with_bones(image: Image.Image, view: View, snapshot: Snapshot, presence: float) -> Image.Image:
    """The picture with bones and markers over it."""
    over = image.copy()
    pen = ImageDraw.Draw(over)
    places = dict(
        zip(
            snapshot.markers,
            view.pixels(view.moved(np.array(list(snapshot.markers.values())))),
            strict=True,
        )
    )
    for width, colour in ((4.2, PAPER), (2.0, INK)):
        for start, end in BONES:
            line = [tuple(places[start]), tuple(places[end])]
            pen.line(line, fill=colour, width=round(FINER * width))
    for x, y in {name: places[name] for bone in BONES for name in bone}.values():
        for radius, colour in ((4.4, PAPER), (3.6, INK), (2.0, PAPER)):
            r = FINER * radius
            pen.ellipse((x - r, y - r, x + r, y + r), fill=colour)
    return Image.blend(image, over, 0.92 * presence)


def _write(image: Image.Image, both: tuple[View, View]) -> None:
    """Write the views' titles."""
    pen = ImageDraw.Draw(image)
    font = ImageFont.truetype(
        str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"), FINER * 14
    )
    for view in both:
        at = (FINER * (view.left + WIDTH / 4.0), FINER * (HEIGHT - 12.0))
        pen.text(at, view.title, fill=(110, 120, 134), font=font, anchor="ms")

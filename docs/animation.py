"""The animated picture of a track at the top of the README, drawn from a real run.

Ellipsoids are the Gaussians of the human template at two standard deviations, ray-cast and shaded;
dots are the points of the depth images. Each frame is drawn at twice its size and then halved.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

import regkit
from regkit.api import Tracking
from regkit.system.arrays import Array
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians

WIDTH, HEIGHT, FINER = 800, 470, 2
"""Size of the picture [px], and how many times finer it is drawn."""

MILLISECONDS = 66
"""How long each frame is shown: the walk of two seconds takes four."""

PAPER, INK, POINT = (251, 251, 253), (38, 50, 66), (58, 76, 102)
TRUNK, LEFT, RIGHT = (240, 190, 104), (86, 178, 170), (236, 128, 110)

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

_LIGHT = np.array([-0.35, -0.75, -0.56])
"""Where the light comes from, in a view's axes: from the left, above and before."""

_OPACITY = 0.62

_SOLE = 0.01
"""How far the sole is below the lowest marker, at the toes [m]."""


@dataclass(frozen=True)
class View:
    """Half of the picture, and the pinhole camera that it shows.

    Attributes:
        title: What is written below it.
        left: Its first column [px].
        T_view_camera: (4, 4) from the depth camera's axes to its own.
        focal: Focal length [px].
    """

    title: str
    left: float
    T_view_camera: Array
    focal: float = 690.0

    def moved(self, points: Array) -> Array:
        """Points (N, 3) of the depth camera in this view's axes [m]."""
        return np.asarray(points @ self.T_view_camera[:3, :3].T + self.T_view_camera[:3, 3])

    def pixels(self, points: Array) -> Array:
        """Where points (N, 3) in this view's axes are in the picture (N, 2) [px]."""
        middle = FINER * np.array([self.left + WIDTH / 4.0, HEIGHT / 2.0 - 20.0])
        return np.asarray(FINER * self.focal * points[:, :2] / points[:, 2:] + middle)


def views(middle: Array) -> tuple[View, View]:
    """From the depth camera, and from the person's side; both look at ``middle`` (3,) [m]."""
    ahead = np.eye(4)
    ahead[:2, 3] = -middle[:2]
    turn, tilt = np.radians(-72.0), np.radians(9.0)
    about_y = np.array(
        [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
    )
    about_x = np.array(
        [[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
    )
    aside = np.eye(4)
    aside[:3, :3] = about_x @ about_y
    aside[:3, 3] = [0.0, 0.0, middle[2]] - aside[:3, :3] @ middle
    return View("from the camera", 0.0, ahead), View("from the side", WIDTH / 2.0, aside)


def shaded(view: View, centre: Array, shape: Array, colour: Array) -> tuple[Array, Array, Array]:
    """An ellipsoid's pixels (N, 2), their depths (N,) [m] and colours (N, 3).

    Args:
        view: From where it is seen.
        centre: Its centre (3,) in the view's axes [m].
        shape: The matrix (3, 3) of x^T A x = 1 on its surface.
        colour: Its colour (3,).
    """
    extent = np.sqrt(np.linalg.inv(shape).diagonal()[:2]) * 1.25
    corners = centre + np.array([[sx, sy, 0.0] for sx in (-1, 1) for sy in (-1, 1)]) * np.array(
        [*extent, 0.0]
    )
    box = view.pixels(corners)
    low, high = np.floor(box.min(axis=0)).astype(int), np.ceil(box.max(axis=0)).astype(int)
    columns, rows = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    pixels = np.stack([columns.ravel(), rows.ravel()], axis=1)
    middle = view.pixels(np.array([[0.0, 0.0, 1.0]]))[0]
    rays = np.column_stack([(pixels - middle) / (FINER * view.focal), np.ones(len(pixels))])
    # The nearer root of |t ray - centre| = 1 in the metric of the ellipsoid.
    a = np.einsum("ni,ij,nj->n", rays, shape, rays)
    b = rays @ shape @ centre
    c = centre @ shape @ centre - 1.0
    hit = b * b > a * c
    hit &= ((pixels >= 0) & (pixels < [FINER * WIDTH, FINER * HEIGHT])).all(axis=1)
    depth = (b[hit] - np.sqrt(b[hit] ** 2 - a[hit] * c)) / a[hit]
    normals = (depth[:, None] * rays[hit] - centre) @ shape
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    light = np.clip(normals @ (_LIGHT / np.linalg.norm(_LIGHT)), 0.0, 1.0)
    rim = np.clip(1.0 + normals[:, 2], 0.0, 1.0) ** 2
    brightness = 0.72 + 0.36 * light - 0.30 * rim
    shades = np.clip(brightness[:, None] * colour + 26.0 * light[:, None] ** 6, 0.0, 255.0)
    return pixels[hit], depth, shades


@dataclass(frozen=True)
class Snapshot:
    """A tracked frame as it is drawn, in the depth camera's axes.

    Attributes:
        points: (N, 3) measured points [m].
        centres: (G, 3) centres of the Gaussians [m].
        covariances: (G, 3, 3) their covariances [m^2].
        colours: (G, 3) their colours.
        markers: Where each marker is (3,) [m], by name.
        ground: How far the ground is below the camera [m].
    """

    points: Array
    centres: Array
    covariances: Array
    colours: Array
    markers: dict[str, Array]
    ground: float

    @classmethod
    def of(cls, tracked: Tracking, index: int, points: Array, ground: float) -> Snapshot:
        """A frame of a track, with all points of its depth image."""
        gaussians = GeneralizedSumOfGaussians().bind(tracked.body)
        placed = gaussians.place(tracked.segments[index])
        spread = placed.axes * gaussians.scales[:, None, :]
        names = [tracked.body.skeleton.names[segment] for segment in gaussians.segments]
        colours = [
            LEFT if name.startswith("left") else RIGHT if name.startswith("right") else TRUNK
            for name in names
        ]
        markers = dict(zip(tracked.joint_names, tracked.markers[index], strict=True))
        covariances = spread @ spread.transpose(0, 2, 1)
        shades = np.array(colours, dtype=float)
        return cls(points, placed.centres, covariances, shades, markers, ground)


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


def pictures(snapshots: list[Snapshot]) -> Iterator[Image.Image]:
    """The points alone, the model that appears in them, the walk, and the model that goes."""
    both = views(np.mean([snapshot.markers["pelvis"] for snapshot in snapshots], axis=0))
    for presence in (0.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75):
        yield drawn(snapshots[0], both, presence)
    for snapshot in snapshots:
        yield drawn(snapshot, both, 1.0)
    for presence in (1.0, 1.0, 1.0, 0.66, 0.33):
        yield drawn(snapshots[-1], both, presence)


def write_animation(recording_folder: Path, file: Path) -> None:
    """Track the walk, and write its animated picture (WebP)."""
    walk = regkit.load_recording(recording_folder)
    tracked = regkit.track(walk, regkit.load_template("human", height=1.63))
    ground = _SOLE + float(tracked.markers[..., 1].max())
    snapshots = [
        Snapshot.of(tracked, index, frame.points, ground)
        for index, frame in enumerate(walk.frames())
    ]
    first, *others = pictures(snapshots)
    first.save(
        file,
        save_all=True,
        append_images=others,
        duration=MILLISECONDS,
        loop=0,
        quality=84,
        method=6,
    )

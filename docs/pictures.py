"""Make the documentation's pictures again, from real runs: ``make pictures``.

The pictures of real recordings are not among them, for the recordings are not shipped.
"""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from matplotlib.figure import Figure
from PIL import Image
from playwright.sync_api import sync_playwright

import regkit
from regkit.api.viewing import scene_of
from regkit.interfaces import Method
from regkit.report.figures.density import projected
from regkit.report.frame_drawing import DrawnPrimitives
from regkit.viewer.animation.film import drawing_of, encoded
from regkit.viewer.animation.pose import ShownPose
from regkit.viewer.animation.view import Sheet
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_synthesis.rooms import ROOMS

DOCS = Path(__file__).parent
DATA = DOCS / "examples" / "data"

MILLISECONDS = 66
"""How long each picture of the walk is shown: its two seconds take four."""

CHROMIUM = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
"""Options of the browser, for machines without a graphics card."""

VIEWS = {
    "from the front": np.diag([1.0, -1.0, -1.0]),
    "from the left": np.array([[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]]),
}
"""R_view_body (x right, y down, z away from the viewer) of an upright body that faces z."""

SOLE = 0.01
"""How far the sole is below the lowest marker, at the toes [m]."""


def track() -> None:
    """The sample walk as the README shows it: points, the model that appears in them, the walk."""
    walk = regkit.load_recording(DATA / "human_walk")
    tracked = regkit.track(walk, regkit.load_template("human", height=1.63))
    scene = scene_of(tracked)
    poses = [ShownPose.of(scene, index, frame.points) for index, frame in enumerate(walk.frames())]
    ground = SOLE + float(tracked.markers[..., 1].max())
    drawing = drawing_of(scene, poses, Sheet(800, 470), ground)
    appearing = [(poses[0], presence) for presence in (0.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75)]
    going = [(poses[-1], presence) for presence in (1.0, 1.0, 1.0, 0.66, 0.33)]
    shown = [*appearing, *((pose, 1.0) for pose in poses), *going]
    pictures = [drawing.picture(pose, presence) for pose, presence in shown]
    content = encoded(pictures, [MILLISECONDS] * len(pictures), ".webp")
    (DOCS / "images" / "track.webp").write_bytes(content)
    print("docs/images/track.webp")


def notebook() -> None:
    """The sample walk as the notebook's page tracks it."""
    walk = regkit.load_recording(DATA / "human_walk", frames=12)
    person = regkit.load_template("human", height=1.63)
    tracked = regkit.track(walk, person)
    _save("notebook", tracked.plot(walk.truth()))


def view() -> None:
    """The scene of the sample walk, as a browser draws it."""
    walk = regkit.load_recording(DATA / "human_walk", frames=12)
    tracked = regkit.track(walk, regkit.load_template("human", height=1.63))
    path = DOCS / "images" / "view.png"
    with TemporaryDirectory() as folder, sync_playwright() as started:
        file = Path(folder) / "walk.html"
        tracked.view(walk.truth()).save(file)
        browser = started.chromium.launch(
            executable_path=shutil.which("chromium"), args=list(CHROMIUM)
        )
        page = browser.new_page(viewport={"width": 960, "height": 560}, color_scheme="light")
        page.goto(f"{file.as_uri()}#frame=3")
        page.wait_for_selector("html[data-ready='3']")
        page.screenshot(path=path)
        browser.close()
    Image.open(path).convert("RGB").quantize(128).save(path, optimize=True)
    print("docs/images/view.png")


def hand() -> None:
    """The sample gestures."""
    gestures = regkit.load_recording(DATA / "hand_gestures")
    _save("hand", regkit.track(gestures, "hand").plot(gestures.truth()))


def clouds() -> None:
    """Two views of a figure that turned in between."""
    views = [DATA / "mannequin" / "clouds" / f"{number:06d}.npz" for number in (0, 3)]
    _save("clouds", regkit.align(*views).plot())


def room() -> None:
    """What the default segmentation removes from a room."""
    take = {"motion": "walk", "frames": 10, "room": "furnished"}
    (furnished,) = Synthetic.model_validate({"takes": {"furnished": take}}).chosen()
    regkit.preview(furnished, "human", count=2).save(DOCS / "images" / "room.png")
    print("docs/images/room.png")


def rooms() -> None:
    """The same walk in each room, and in one of them from other views."""
    takes: dict[str, dict[str, object]] = {
        **{name: {"room": name} for name in ROOMS if name != "none"},
        "furnished from above": {
            "room": "furnished", "view": {"elevation_deg": 60, "heading_deg": 40},
        },
        "furnished rolled": {"room": "furnished", "view": {"elevation_deg": 20, "roll_deg": 60}},
    }  # fmt: skip
    walk = {"motion": "walk", "frames": 10}
    recordings = Synthetic.model_validate({"defaults": walk, "takes": takes}).chosen()
    figure = Figure(figsize=(8.0, 3.5), layout="constrained")
    for axes, recording in zip(figure.subplots(2, 4).flat, recordings, strict=True):
        assert isinstance(recording, SyntheticRecording)
        depth = [frame.depth for frame in recording.frames()][-1]
        body = list(recording.labels())[-1] == 1
        seen = np.where(depth > 0.0, depth, np.nan)
        axes.imshow(seen, cmap="gray_r", vmin=np.nanmin(seen) - 0.5)
        axes.contour(body, levels=[0.5], colors="tab:orange", linewidths=0.7)
        axes.set_title(recording.name, fontsize=8)
        axes.set_axis_off()
    _save("rooms", figure)
    path = DOCS / "images" / "rooms.png"
    Image.open(path).convert("RGB").quantize(64).save(path, optimize=True)


def tuned_densities() -> None:
    """The Gaussians before and after tuning, summed along the line of sight, and the skin."""
    body = regkit.load_template("human").body(1.7)
    placed = body.place(body.skeleton.rest())
    assert body.surface is not None
    skin = body.surface.place(placed.transforms)
    methods = {
        "13, of the solid's moments": {"preset": "paper_exact"},
        "13, tuned to paper_exact": {"preset": "paper_exact", "shape": {"tuned": "paper_exact"}},
        "13, tuned to best": {"preset": "best", "shape": {"tuned": "best"}},
        "41, tuned to best": {"preset": "best", "shape": {"tuned": "best_41"}},
    }
    down = np.arange(-0.95, 0.95, 0.005)
    figure = Figure(figsize=(7.6, 8.2), layout="constrained")
    grid = figure.subplots(len(VIEWS), len(methods), squeeze=False)
    for column, (title, method) in enumerate(methods.items()):
        registrar = Method.parse(method, place="picture", field="method").bind(body)
        drawn = DrawnPrimitives.of(registrar.primitives, placed)
        for axes, (seen, turn) in zip(grid[:, column], VIEWS.items(), strict=True):
            x, y, _ = turn @ (skin - skin.mean(axis=0)).T
            across = np.arange(-0.4, 0.4, 0.005) + 0.5 * float(x.min() + x.max())
            centres = (drawn.centres - skin.mean(axis=0)) @ turn.T
            turned = replace(drawn, centres=centres, axes=turn @ drawn.axes)
            middle = down + 0.5 * float(y.min() + y.max())
            density = projected(turned, across, middle)
            extent = (across[0], across[-1], middle[-1], middle[0])
            axes.imshow(density, cmap="cividis", extent=extent, interpolation="bilinear")
            axes.scatter(x, y, s=0.3, color="white", alpha=0.35, linewidths=0)
            axes.set_title(title if axes is grid[0, column] else "", fontsize=8)
            axes.set_ylabel(seen if column == 0 else "", fontsize=8)
            axes.set_xticks([])
            axes.set_yticks([])
    _save("tuned_densities", figure)
    path = DOCS / "images" / "tuned_densities.png"
    Image.open(path).convert("RGB").quantize(128).save(path, optimize=True)


def tuning_curve() -> None:
    """Error against number of primitives and time, from the figures of ``benchmarks/tuning.py``."""
    shapes = json.loads((DOCS / "images" / "tuning_curve.json").read_text())["shapes"]
    curves: dict[str, list[dict[str, float]]] = {}
    for shape in shapes:
        people, like = shape["people"], shape["smmc_like"]
        curves.setdefault(shape["curve"], []).append({
            "number of primitives": shape["primitives"],
            "time per frame [ms]": shape["ms"],
            "raw": (13 * people[0] + 28 * like[0]) / 41,
            "adjusted": (13 * people[1] + 28 * like[1]) / 41,
        })  # fmt: skip
    figure = Figure(figsize=(8.0, 3.6), layout="constrained")
    for axes, across in zip(
        figure.subplots(1, 2, sharey=True), ("number of primitives", "time per frame [ms]"),
        strict=True,
    ):  # fmt: skip
        for number, (name, points) in enumerate(curves.items()):
            x = [point[across] for point in points]
            colour = f"C{number}"
            axes.plot(x, [one["raw"] for one in points], "o-", color=colour, label=name)
            axes.plot(x, [one["adjusted"] for one in points], "o--", color=colour, markersize=3)
        axes.set_xlabel(across)
        axes.set_ylim(bottom=0.0)
        axes.grid(alpha=0.3)
    axes.legend(fontsize=8, title="solid: raw, dashed: adjusted", title_fontsize=8)
    figure.axes[0].set_ylabel("mean error of 41 recordings [cm]")
    _save("tuning_curve", figure)


def _save(name: str, figure: Figure) -> None:
    figure.savefig(DOCS / "images" / f"{name}.png", dpi=100, metadata={"Software": None})
    print(f"docs/images/{name}.png")


if __name__ == "__main__":
    track()
    notebook()
    view()
    hand()
    clouds()
    room()
    rooms()
    tuned_densities()
    tuning_curve()

"""Make the documentation's pictures again, from real runs: ``make pictures``.

The pictures of real recordings are not among them, for the recordings are not shipped.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from _animation import write_animation
from matplotlib.figure import Figure
from PIL import Image

import regkit
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_synthesis.rooms import ROOMS

DOCS = Path(__file__).parent
DATA = DOCS / "examples" / "data"


def track() -> None:
    """The sample walk as the README shows it."""
    write_animation(DATA / "human_walk", DOCS / "images" / "track.webp")
    print("docs/images/track.webp")


def notebook() -> None:
    """The sample walk as the notebook's page tracks it."""
    walk = regkit.load_recording(DATA / "human_walk", frames=12)
    person = regkit.load_template("human", height=1.63)
    tracked = regkit.track(walk, person)
    _save("notebook", tracked.plot(walk.truth()))


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


def _save(name: str, figure: Figure) -> None:
    figure.savefig(DOCS / "images" / f"{name}.png", dpi=100, metadata={"Software": None})
    print(f"docs/images/{name}.png")


if __name__ == "__main__":
    track()
    notebook()
    hand()
    clouds()
    room()
    rooms()

"""Make the documentation's pictures again, from real runs: ``make pictures``.

The pictures of real recordings are not among them, for the recordings are not shipped.
"""

from __future__ import annotations

from pathlib import Path

from _animation import write_animation
from matplotlib.figure import Figure

import regkit

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


def _save(name: str, figure: Figure) -> None:
    figure.savefig(DOCS / "images" / f"{name}.png", dpi=100, metadata={"Software": None})
    print(f"docs/images/{name}.png")


if __name__ == "__main__":
    track()
    notebook()
    hand()
    clouds()

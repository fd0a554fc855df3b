"""Tunes the shipped templates: ``python -m regkit_synthesis.templates.tuned OUT``.

Each list is tuned as ``regkit tune`` does it, in three to five minutes on two cores.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.body.tuned_lists import TunedLists
from regkit.interfaces import Method, Preprocessor, Template, Tracker
from regkit.sensors import CameraName
from regkit.system.errors import RegkitError
from regkit.system.files import write_text
from regkit.tuning import SampleSets, TunedList, tuned
from regkit.tuning.tuning import PRIOR
from regkit_synthesis.templates import mirror

JOBS = 2
"""Number of processes."""

RIGHT, LEFT = "hand_right.yaml", "hand_left.yaml"
"""Files of the hands."""

PAPER = {
    "preset": "paper_exact",
    # The same energy, whose minimum these find in a tenth of the time.
    "coordinates": "tangent",
    "solver": {"kind": "gauss_newton", "max_iterations": 12, "value_tolerance": 0.001},
}


@dataclass(frozen=True)
class Recipe:
    """How a list is tuned.

    Attributes:
        name: Its name.
        method: The method to which it is tuned.
        primitives: Number of primitives; by default those that the template lists are tuned.
        samples: Number of training samples.
        iterations: Maximum number of steps.
        prior: Weight of the squared parameters.
    """

    name: str
    method: Mapping[str, Any]
    primitives: int | None = None
    samples: int = 160
    iterations: int = 12
    prior: float = PRIOR


STIFF = 4e-4
"""Weight with which the lists of the template's own number of primitives were made."""

PERSON = (
    Recipe("best", {"preset": "best"}, prior=STIFF),
    Recipe("best_26", {"preset": "best"}, 26, 240),
    Recipe("best_41", {"preset": "best"}, 41, 240),  # One for each capsule.
    Recipe("paper_exact", PAPER, prior=STIFF),
    Recipe("paper_exact", {**PAPER, "shape": "sog"}, prior=STIFF),
    Recipe("spheres", {"preset": "spheres"}),
)
"""The lists of a person."""

HAND = (Recipe("best_48", {"preset": "best"}, 48, 120, 6),)
"""The lists of a hand."""


@dataclass(frozen=True)
class Shipped:
    """A shipped template with tuned lists.

    Attributes:
        template: The template.
        recipes: How its lists are tuned.
        camera: The camera.
        voxel: Side of a voxel in which points are averaged [m].
        sigma: Standard deviation of the data [m].
    """

    template: Mapping[str, Any]
    recipes: tuple[Recipe, ...] = PERSON
    camera: CameraName = "sr4000"
    voxel: float = 0.03
    sigma: float = 0.01

    def sets(self, file: str) -> SampleSets:
        """Returns the sets of samples."""
        points = {"kind": "points", "voxel": self.voxel, "sigma": self.sigma}
        return SampleSets(
            Template.parse(self.template, place=file, field="template"),
            Preprocessor.parse(points, place=file, field="preprocessor"),
            camera=self.camera,
        )


SHIPPED = {
    "human.yaml": Shipped({"kind": "human", "build": "average"}),
    "human_small.yaml": Shipped({"kind": "human", "build": "small"}),
    "human_tall.yaml": Shipped({"kind": "human", "build": "tall"}),
    RIGHT: Shipped({"kind": "hand"}, HAND, "sr305", 0.008, 0.003),
}
"""Templates by the file of their lists; the left hand is the mirror image of the right one."""

OPENING = """\
Primitives of the template {file} that are tuned to methods, on rendered frames. This file is made
by `python -m regkit_synthesis.templates.tuned`."""


def tuned_by(recipe: Recipe, sets: SampleSets) -> TunedList:
    """Returns a template with a tuned list.

    Raises:
        RegkitError: If it cannot be tuned.
    """
    method = Method.parse(recipe.method, place=recipe.name, field="method")
    default = Tracker.default()
    return tuned(
        sets,
        method,
        method.tracker or Tracker.parse(default, place=recipe.name, field="tracker"),
        name=recipe.name,
        primitives=recipe.primitives,
        samples=recipe.samples,
        iterations=recipe.iterations,
        prior=recipe.prior,
        jobs=JOBS,
    )


def lists(found: Sequence[tuple[Recipe, TunedList]]) -> TunedLists:
    """Returns tuned lists, with what they change as their sources."""
    return TunedLists(
        sources=tuple(_source(recipe.samples, one) for recipe, one in found),
        shapes={one.key: one.description.shapes[one.key] for _, one in found},
    )


def mirrored(right: TunedLists) -> TunedLists:
    """Returns the lists of the left hand."""
    shapes = {
        key: {name: tuple(map(mirror.primitive, several)) for name, several in own.items()}
        for key, own in right.shapes.items()
    }
    return right.model_copy(update={"shapes": shapes})


def _source(samples: int, one: TunedList) -> str:
    changes = ", ".join(
        f"{each.name} {100.0 * each.before.mean:.2f} to {100.0 * each.after.mean:.2f} cm"
        for each in one.comparisons
    )
    return f"{one.key}: tuned on {samples} samples, seed 0; mean errors of {changes}"


def _write(path: Path, found: TunedLists) -> None:
    write_text(path, found.text(OPENING.format(file=path.name)))
    print(path)


def main() -> int:
    """Writes the lists of all templates to the folder in the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_synthesis.templates.tuned",
        description="Tune the primitives of the shipped templates to methods.",
    )
    parser.add_argument("out", type=Path, help="folder that the YAML files go into")
    out: Path = parser.parse_args().out
    try:
        for file, shipped in SHIPPED.items():
            sets = shipped.sets(file)
            found = lists([(one, tuned_by(one, sets)) for one in shipped.recipes])
            _write(out / file, found)
            if file == RIGHT:
                _write(out / LEFT, mirrored(found))
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

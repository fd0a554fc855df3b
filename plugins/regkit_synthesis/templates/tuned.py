"""Tunes the shipped templates: ``python -m regkit_synthesis.templates.tuned OUT``.

Each list is tuned as ``regkit tune`` does it, in some three minutes on two cores.
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
from regkit.system.errors import RegkitError
from regkit.system.files import write_text
from regkit.tuning import SampleSets, TunedList, tuned

JOBS = 2
"""Number of processes."""

PREPROCESSOR = {"kind": "points", "voxel": 0.03, "sigma": 0.01}

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
    """

    name: str
    method: Mapping[str, Any]
    primitives: int | None = None
    samples: int = 160


RECIPES = (
    Recipe("best", {"preset": "best"}),
    Recipe("best_26", {"preset": "best"}, 26, 240),
    Recipe("best_41", {"preset": "best"}, 41, 240),  # One for each capsule.
    Recipe("paper_exact", PAPER),
    Recipe("paper_exact", {**PAPER, "shape": "sog"}),
)
"""The lists of a person."""

BUILDS = {"average": "human.yaml", "small": "human_small.yaml", "tall": "human_tall.yaml"}
"""File of each build."""

OPENING = """\
Primitives of the template {file} that are tuned to methods, on rendered frames. This file is made
by `python -m regkit_synthesis.templates.tuned`."""


def tuned_by(recipe: Recipe, template: Template) -> TunedList:
    """Returns a template with a tuned list.

    Raises:
        RegkitError: If it cannot be tuned.
    """
    method = Method.parse(recipe.method, place=recipe.name, field="method")
    default = Tracker.default()
    return tuned(
        SampleSets(
            template, Preprocessor.parse(PREPROCESSOR, place=recipe.name, field="preprocessor")
        ),
        method,
        method.tracker or Tracker.parse(default, place=recipe.name, field="tracker"),
        name=recipe.name,
        primitives=recipe.primitives,
        samples=recipe.samples,
        jobs=JOBS,
    )


def lists(found: Sequence[tuple[Recipe, TunedList]]) -> TunedLists:
    """Returns tuned lists, with what they change as their sources."""
    return TunedLists(
        sources=tuple(_source(recipe.samples, one) for recipe, one in found),
        shapes={one.key: one.description.shapes[one.key] for _, one in found},
    )


def _source(samples: int, one: TunedList) -> str:
    changes = ", ".join(
        f"{each.name} {100.0 * each.before.mean:.2f} to {100.0 * each.after.mean:.2f} cm"
        for each in one.comparisons
    )
    return f"{one.key}: tuned on {samples} samples, seed 0; mean errors of {changes}"


def main() -> int:
    """Writes the lists of all builds to the folder in the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_synthesis.templates.tuned",
        description="Tune the primitives of the shipped people to methods.",
    )
    parser.add_argument("out", type=Path, help="folder that the YAML files go into")
    out: Path = parser.parse_args().out
    try:
        for build, file in BUILDS.items():
            template = Template.parse(
                {"kind": "human", "build": build}, place=file, field="template"
            )
            found = lists([(recipe, tuned_by(recipe, template)) for recipe in RECIPES])
            write_text(out / file, found.text(OPENING.format(file=file)))
            print(out / file)
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

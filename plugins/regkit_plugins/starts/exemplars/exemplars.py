"""The search for the start among exemplars: the template's own poses, seen from all sides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field

from regkit.body import Body
from regkit.config.plugin import slot_default
from regkit.interfaces import Method, Start, StartSearch, Template
from regkit.observation import Observation
from regkit.search.exemplars import Atlas, AtlasSettings, Finder, Pictures, atlas_of
from regkit.start import Candidate, Scan, rigid_start
from regkit.start.sizes import fit, resized
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.exemplars.finalists import Comparison, Finalist

ROLLS = 24
"""Number of rolls in a full turn."""


class Exemplars(StartSearch):
    """Looks the first frame up among the template's own poses, seen from all sides.

    The atlas holds poses within the joint limits, in all views, as small depth images. The most
    similar ones, over all rolls and sizes, are rendered in the camera and refined; the best few are
    registered with a search of their limbs, and the one of least energy and misfit is the start.
    """

    kind: Literal["exemplars"] = "exemplars"

    exemplars: Annotated[int, Field(ge=100, le=1_000_000)] = 30_000
    """Number of exemplars; 30,000 of a person take some seconds to make, once, and 13 MB."""
    elevation_deg: tuple[float, float] = (-90.0, 90.0)
    """Least and greatest angle of the camera above the body's horizon [deg]."""
    roll_deg: tuple[float, float] = (-180.0, 180.0)
    """Least and greatest roll of the body in the picture [deg]."""
    looked_up: Annotated[int, Field(ge=1, le=100_000)] = 600
    """Number of similar exemplars that are rendered."""
    refined: Annotated[int, Field(ge=1, le=10_000)] = 40
    """Number of these that are refined."""
    finalists: Annotated[int, Field(ge=1, le=1000)] = 6
    """Number of refined poses that are registered."""
    method: Method = slot_default(Method)
    """Method that registers the finalists."""

    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the start of least energy and misfit.

        Raises:
            ConfigError: If the template has no capsules, or no free root.
        """
        rigid = rigid_start(template, observations[0])
        if rigid is not None:
            return rigid
        with one_blas_thread():
            best, _ = _Search(self, template).best(observations[0])
        return Start(best.body, best.pose)


class _Search:
    def __init__(self, exemplars: Exemplars, template: Template) -> None:
        self.exemplars, self.template = exemplars, template
        self.sizes = template.candidate_sizes()
        usual = self.sizes[len(self.sizes) // 2]
        self.bodies = [template.body(size) for size in self.sizes]
        low, high = np.radians(exemplars.elevation_deg)
        settings = AtlasSettings(exemplars.exemplars, (float(low), float(high)))
        self.atlas = atlas_of(self.bodies[len(self.bodies) // 2], settings)
        self.comparison = Comparison(exemplars.method, usual)

    def best(self, observation: Observation) -> tuple[Finalist, list[Finalist]]:
        rolls = np.arange(ROLLS) * 2 * np.pi / ROLLS
        finder = Finder(self.bodies, self.atlas, rolls, self.exemplars.looked_up, self.exemplars.refined)
        pictures = Pictures.of(observation, self.bodies[len(self.bodies) // 2].size)
        scan = Scan(observation.points)
        finalists = [
            self.comparison.finalist(one.body, one.pose, observation, scan)
            for one in finder.candidates(pictures)[: self.exemplars.finalists]
        ]
        return min(finalists, key=lambda one: one.cost), finalists

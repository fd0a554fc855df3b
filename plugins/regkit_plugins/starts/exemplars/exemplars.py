"""The search for the start among exemplars: the template's own poses, seen from all sides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field

from regkit.config.plugin import slot_default
from regkit.interfaces import Method, Start, StartSearch, Template
from regkit.observation import Observation
from regkit.search.exemplars import AtlasSettings, atlas_of, even_rolls
from regkit.skeleton.joints import in_order
from regkit.start import (
    FreeRoot,
    at_root,
    is_fixed,
    judged,
    rested,
    rigid_start,
    standing,
    with_free_bodies,
    with_further_parts,
    with_parts,
)
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.exemplars.finalists import Comparison, margin, mean_pose
from regkit_plugins.starts.exemplars.search import Search

Elevation = Annotated[float, Field(ge=-90.0, le=90.0)]
Roll = Annotated[float, Field(ge=-180.0, le=180.0)]

CUT = 4
"""Factor of the number of exemplars of a body that is cut off; their borders fix their rolls."""


class Exemplars(StartSearch):
    """Looks the first frame up among the template's own poses, seen from all sides.

    The atlas holds poses within the joint limits, in all views, as small depth images. The most
    similar ones, over all rolls and sizes, are rendered in the camera and refined; the best few are
    registered, some with a search of their limbs. The start is the mean of the one of least energy
    and misfit and those like it, which differ where the data show nothing.
    """

    kind: Literal["exemplars"] = "exemplars"

    exemplars: Annotated[int, Field(ge=100, le=1_000_000)] = 30_000
    """Number of exemplars; 30,000 of a person take some seconds to make, once, and 13 MB."""
    elevation_deg: Annotated[tuple[Elevation, Elevation], AfterValidator(in_order)] = (-90.0, 90.0)
    """Least and greatest angle of the camera above the body's horizon [deg]."""
    roll_deg: Annotated[tuple[Roll, Roll], AfterValidator(in_order)] = (-180.0, 180.0)
    """Least and greatest roll of the body in the picture [deg]."""
    looked_up: Annotated[int, Field(ge=1, le=100_000)] = 600
    """Number of similar exemplars that are rendered."""
    refined: Annotated[int, Field(ge=1, le=10_000)] = 40
    """Number of these that are refined."""
    finalists: Annotated[int, Field(ge=1, le=1000)] = 16
    """Number of refined poses that are registered."""
    method: Method = slot_default(Method)
    """Method that registers the finalists."""

    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the start: the mean of the poses of least energy and misfit that are alike.

        A body whose root is fixed is sought with a free one; of the finalists, those count whose
        root is near where it stands, and their joints are registered there.

        Raises:
            ConfigError: If the template has no capsules.
        """
        shown = with_further_parts(self.find, template, observations)
        inside = shown or with_parts(
            lambda base: self.find(base, observations), template, observations[0], self.method
        )
        beside = inside or with_free_bodies(self.find, template, observations, self.method)
        rigid = beside or rigid_start(template, observations[0])
        if rigid is not None:
            return rigid
        fixed = is_fixed(template)
        sought = FreeRoot(template=template) if fixed else template
        with one_blas_thread():
            search = self._search(sought)
            sizes = sought.candidate_sizes()
            if len(sizes) > 1:
                finalists = search.unsized(observations)
            else:
                finalists = search.sized(sought.body(sizes[0]), observations[0])
            doubts = search.doubts(finalists[0].body, observations[0])
            body = finalists[0].body
            if fixed:
                body = template.body(body.size)
                finalists = standing(finalists, body)
            pose = rested(body, mean_pose(finalists), observations[0])
            if fixed:
                pose = at_root(body, pose)
                pose = self.method.bind(body).register(observations[0], [pose]).pose
            start = judged(body, pose, observations[0], margin(finalists), doubts)
            rivals = () if fixed else tuple(one.pose for one in finalists)
            return replace(start, rivals=rivals)

    def _search(self, template: Template) -> Search:
        sizes = template.candidate_sizes()
        usual = template.body(sizes[len(sizes) // 2])
        low, high = np.radians(self.elevation_deg)
        whole = AtlasSettings(self.exemplars, (float(low), float(high)))
        cut = replace(whole, count=CUT * self.exemplars, cut=True)
        return Search(
            template=template,
            atlas=atlas_of(usual, whole),
            cut_atlas=partial(atlas_of, usual, cut),
            comparison=Comparison(self.method, usual.size),
            rolls=even_rolls(*np.radians(self.roll_deg).tolist()),
            looked_up=self.looked_up,
            refined=self.refined,
            finalists=self.finalists,
        )

"""Laws of starts."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.interfaces import StartSearch, Template
from regkit.observation import Observation
from regkit.testing.laws import Laws
from regkit.testing.samples import LINKAGE, exact_landmarks, posed
from regkit.testing.verdict import copied, require, same

SIZE = 1.2
"""Size of the linkage [m]."""


class StartLaws(Laws):
    """Laws of starts."""

    @pytest.fixture
    def linkage_template(self) -> Template:
        """Returns the template of the linkage, with its size."""
        data = Template.default("file", path=str(LINKAGE), size=SIZE)
        return Template.parse(data, place="the laws", field="template")

    @pytest.fixture
    def seen(self, linkage_template: Template) -> Observation:
        """Returns data of the linkage."""
        body = linkage_template.body(SIZE)
        pose = posed(body, np.random.default_rng(2))
        capsules = body.capsules.place(body.place(pose).transforms)
        points = capsules.axis_points(0.02).points
        return Observation(
            points,
            np.ones(len(points)),
            np.full(len(points), 1e-4),
            landmarks=exact_landmarks(body, pose),
        )

    def test_start_has_a_body_within_its_limits(
        self, start: StartSearch, linkage_template: Template, seen: Observation
    ) -> None:
        """The body has the given size, and its pose is one of its own skeleton."""
        found, at = start.find(linkage_template, [seen]), type(start).find
        require(
            found.body.size == SIZE, start,
            f"returns a body of size {found.body.size} of a template whose size is {SIZE}",
            look_at=at,
        )  # fmt: skip
        rest = found.body.skeleton.rest()
        shapes = [
            (name, np.shape(getattr(found.pose, name)), np.shape(getattr(rest, name)))
            for name in ("root", "balls", "hinges")
        ]
        for name, got, needed in shapes:
            require(
                got == needed, start, f"returns {name} of the shape {got}; it must be {needed}",
                look_at=at,
            )  # fmt: skip
        by = float(found.body.skeleton.limits.violation(found.pose).max(initial=0.0))
        require(
            not start.searches or by < 1e-6, start,
            f"returns a pose beyond a joint limit, by {np.degrees(by):.2g} degrees", look_at=at,
        )  # fmt: skip

    def test_start_is_the_same_again(
        self, start: StartSearch, linkage_template: Template, seen: Observation
    ) -> None:
        """It has no state and no unseeded chance, and leaves the data alone."""
        before, at = copied(seen), type(start).find
        first = start.find(linkage_template, [seen])
        second = start.find(linkage_template, [seen])
        require(
            same(first.pose, second.pose) and first.body.size == second.body.size, start,
            "returns another start when called again", look_at=at,
        )  # fmt: skip
        require(same(before, seen), start, "modifies the data", look_at=at)

"""A body's proportions as the vector that a solver moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.system.arrays import Array

USUAL_LENGTH, USUAL_GIRTH = 0.05, 0.07
"""By how much the logarithms of a person's lengths and girths usually differ from those of a
template of the person's size."""


@dataclass(frozen=True)
class Shape:
    """A template whose proportions are the vector (1 + 2 G) of logarithms.

    First comes that of a common factor; then, for the groups' lengths and for their girths, by how
    much theirs differ from it.

    Attributes:
        template: What has factors of one.

    Raises:
        ConfigError: If the template lists a shape model that cannot be loaded.
    """

    template: BodyDescription

    def __post_init__(self) -> None:
        """Refuse what could not be stretched."""
        self.template.check_shapes()

    @cached_property
    def groups(self) -> Groups:
        """The groups of segments."""
        return Groups.of(self.template)

    def __len__(self) -> int:
        """The number 1 + 2 G."""
        return 1 + 2 * len(self.groups.names)

    def origin(self, size: float) -> Array:
        """Returns the template's own proportions at a size [m], (1 + 2 G)."""
        x = np.zeros(len(self))
        x[0] = np.log(size / self.template.size.value)
        return x

    def proportions(self, x: Array) -> Proportions:
        """Returns the proportions of a vector (1 + 2 G)."""
        lengths, girths = np.split(np.exp(x[0] + x[1:]), 2)
        return Proportions(self.groups, lengths, girths)

    def description(self, x: Array) -> BodyDescription:
        """Returns the template with the proportions of a vector (1 + 2 G)."""
        return self.proportions(x).applied(self.template)

    def body(self, x: Array) -> Body:
        """Returns the body with the proportions of a vector (1 + 2 G)."""
        subject = self.description(x)
        return subject.body("subject", subject.size.value)

    def springs(self) -> Array:
        """What draws each number to zero, (1 + 2 G); any common size is as good as any other."""
        count = len(self.groups.names)
        usual = np.repeat([np.inf, USUAL_LENGTH, USUAL_GIRTH], [1, count, count])
        return np.asarray(1.0 / usual**2)

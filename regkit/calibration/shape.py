"""A body's proportions as the variables of a solver."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.system.arrays import Array

USUAL_LENGTH, USUAL_GIRTH = 0.05, 0.07
"""Standard deviations of the logarithms of people's lengths and girths, relative to a template of
the same size."""


@dataclass(frozen=True)
class Shape:
    """A template whose proportions are a vector (1 + 2 G) of logarithms.

    The first is the logarithm of a common factor; the groups' lengths and then their girths follow,
    relative to it.

    Attributes:
        template: The template, with all factors equal to one.

    Raises:
        ConfigError: If the template lists a shape model that cannot be loaded.
    """

    template: BodyDescription

    def __post_init__(self) -> None:
        """Checks that all shape models can be stretched."""
        self.template.check_shapes()

    @cached_property
    def groups(self) -> Groups:
        """The groups of segments."""
        return Groups.of(self.template)

    def __len__(self) -> int:
        """Number 1 + 2 G of shape parameters."""
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
        """Returns the stiffness (1 + 2 G) of the prior; the common factor is free."""
        count = len(self.groups.names)
        usual = np.repeat([np.inf, USUAL_LENGTH, USUAL_GIRTH], [1, count, count])
        return np.asarray(1.0 / usual**2)

"""Bodies that a tuned template meets: of other proportions, and of other templates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.geometry.surface import surface_on


def other_body(
    description: BodyDescription, name: str, size: float, spread: float, random: np.random.Generator
) -> Body:
    """Returns a body of a template's kind with other proportions, at the same size.

    Each group of segments, such as both thighs, has another length and girth.

    Args:
        description: The template.
        name: Its name.
        size: Size of the body [m].
        spread: Standard deviation of the logarithms of lengths and girths.
        random: Source of the proportions.

    Raises:
        DataError: If the template's mesh is missing or invalid.
    """
    groups = Groups.of(description)
    lengths, girths = np.exp(spread * random.standard_normal((2, len(groups.names))))
    proportions = Proportions(groups, lengths, girths)
    subject = proportions.applied(description)
    body = subject.body(name, size)
    skin = proportions.skin(description)
    if skin is None:
        return body
    surface = surface_on(skin, body.skeleton.names, place=str(description.mesh))
    return replace(body, surface=surface.scaled(size / subject.size.value))

"""The start of a template that may have further parts: the data decide whether it has."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from regkit.interfaces import Start, Template
from regkit.observation import Observation

SHOWN = 0.12
"""A part is shown by data if so large a share of all points is nearest to it.

It is more for 54 of 60 hands with 2 to 12 cm of a forearm, of which as many are right as with a
forearm for all, and less for all of 60 without one (development set of ``benchmarks/starts.py``).
"""


def with_further_parts(
    find: Callable[[Template, Sequence[Observation]], Start],
    template: Template,
    observations: Sequence[Observation],
) -> Start | None:
    """Returns the start of the extended template, if there is one whose further parts have data.

    Args:
        find: Search for the start of a template.
        template: The template.
        observations: The first frame, and more that may show the size better.
    """
    extended = template.extended()
    if extended is None:
        return None
    start = find(extended, observations)
    body = start.body
    placed = body.capsules.place(body.place(start.pose).transforms)
    nearest, _, _ = placed.nearest(observations[0].points)
    share = float(np.mean(body.is_optional(placed.segments[nearest])))
    return replace(start, extended=True) if share >= SHOWN else None

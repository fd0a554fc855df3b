"""The start of a body with parts: its base first, then the parts inside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from regkit.body.lifting import Lifting
from regkit.interfaces import Method, Start, Template
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.search.limb_search import LimbSearch

SAMPLES, STARTS = 1000, 12
"""Numbers of configurations of a part that are sampled and registered."""


def with_parts(
    find: Callable[[Template], Start], template: Template, observation: Observation, method: Method
) -> Start | None:
    """Returns the start of a template with parts; None if it has none.

    The base is found as any body is. Then each part in turn is sought among its stances, turned
    anywhere. The configurations that match the data best are registered together with everything
    else, and the one of least energy stays. At last all limbs are searched.

    Args:
        find: Search for the start of a template.
        template: The template.
        observation: The first frame.
        method: Method that registers the tries.
    """
    coarse = template.coarse()
    if coarse is None:
        return None
    start = find(coarse)
    body = template.body(start.body.size)
    lifting = Lifting.of(body)
    assert lifting is not None
    registrar = method.bind(body)
    best = registrar.register(observation, [lifting.lifted(start.pose, body.skeleton.rest())])
    least = registrar.evaluate(observation, best.pose).energy
    for search in LimbSearch.of_parts(body, np.random.default_rng(0), SAMPLES):
        for tried in search.starts(observation.points, best.pose, STARTS, observation.sight):
            found = registrar.register(observation, [tried])
            energy = registrar.evaluate(observation, found.pose).energy
            if energy < least:
                best, least = found, energy
    best = LimbRecovery.of(registrar).recovered(observation, best)
    return replace(start, body=body, pose=best.pose)

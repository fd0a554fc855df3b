"""The first pose of rigid templates, and what a template needs for a search."""

from __future__ import annotations

from regkit.interfaces import Start, Template
from regkit.observation import Observation
from regkit.start.cloud import cloud_pose
from regkit.system.errors import ConfigError


def rigid_start(template: Template, observation: Observation) -> Start | None:
    """Returns the start of a rigid surface without capsules; None for other templates.

    Raises:
        ConfigError: If the template has no capsules.
    """
    body = template.body(template.candidate_sizes()[0])
    alone = body.skeleton.free and len(body.skeleton.names) == 1
    if alone and body.surface is not None and not len(body.capsules):
        return Start(body, cloud_pose(body, body.surface, observation))
    if not len(body.capsules):
        raise ConfigError(
            f"the template '{body.name}' has no capsules, which the search for a start needs; "
            "give one (start:), and the template's size"
        )
    return None

"""Takes completed with the fields that all takes of a dataset share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from regkit.config.changes import with_changes

_SOURCES = frozenset({"name", "path", "frames"})
"""Alternative fields that select a body or motion."""

_ALONE = frozenset({"body", "motion", "course", "markers"})
"""Fields of a single body, instead of which there may be several."""


def completed(take: Mapping[str, Any], defaults: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the data of a take completed with those of the defaults."""
    common, own = dict(defaults), dict(take)
    for field, kind in (("body", "shipped"), ("motion", "clip")):
        if isinstance(common.get(field), dict) and field in own:
            if isinstance(own[field], str):
                own[field] = {"kind": kind, "name": own[field]}
            if isinstance(own[field], dict) and not _SOURCES.isdisjoint(own[field]):
                # These fields exclude each other.
                common[field] = {k: v for k, v in common[field].items() if k not in _SOURCES}
    if "views" in own and "view" not in own:
        common.pop("view", None)
    if "view" in own and "views" not in own:
        common.pop("views", None)
    if "bodies" in own:
        common = {k: v for k, v in common.items() if k not in _ALONE}
    elif not _ALONE.isdisjoint(own):
        common.pop("bodies", None)
    if isinstance(common.get("room"), str) and isinstance(own.get("room"), dict):
        del common["room"]  # Parts replace a room by its name, and are added to other parts.
    # A preset's name is invalid in a take; it is kept here to be refused by validation.
    preset = {"preset": own["preset"]} if "preset" in own else {}
    return {**with_changes(common, own), **preset}

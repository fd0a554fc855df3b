"""Errors by the parts of a composed body, and parts of like joints that a track exchanges."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from regkit.body import Body
from regkit.system.arrays import Array


def parts_of_markers(body: Body, markers: Sequence[int]) -> tuple[str, ...]:
    """Returns the name of the part of each of some markers; empty for those of none."""
    owners = {segment: part.name for part in body.parts for segment in part.segments.tolist()}
    return tuple(owners.get(int(body.markers.segments[at]), "") for at in markers)


def exchanged_frames(
    markers: Sequence[str], parts: Sequence[str], places: Array, truth: Array
) -> Array | None:
    """Returns in which frames two parts, exchanged, would be nearer to the truth, (T,).

    Parts are alike if their markers have the same names after those of the parts, such as a left
    and a right hand. Joints without a reference do not count.

    Args:
        markers: Names of J markers.
        parts: Names of their parts.
        places: Positions of the markers, (T, J, 3) [m].
        truth: Positions of their reference joints, (T, J, 3) [m]; NaN where unknown.

    Returns:
        1 in these frames, else 0; None if no parts are alike.
    """
    own: dict[str, dict[str, int]] = {}
    for column, (marker, part) in enumerate(zip(markers, parts, strict=True)):
        own.setdefault(part, {})[marker.removeprefix(f"{part}_")] = column
    found: Array | None = None
    for first, second in combinations([name for name in own if name], 2):
        if own[first].keys() != own[second].keys():
            continue
        here = np.array(list(own[first].values()))
        there = np.array([own[second][name] for name in own[first]])
        kept, exchanged = (
            _sums(places[:, here] - truth[:, a], places[:, there] - truth[:, b])
            for a, b in ((here, there), (there, here))
        )
        switched = (exchanged < kept).astype(np.float64)
        found = switched if found is None else np.maximum(found, switched)
    return found


def _sums(first: Array, second: Array) -> Array:
    """Returns the sum of the lengths of differences (T, J, 3) of two parts, (T,).

    A joint counts if it is known of both parts, so that both sums have the same joints.
    """
    lengths = np.linalg.norm(first, axis=2) + np.linalg.norm(second, axis=2)
    return np.asarray(np.nansum(lengths, axis=1))

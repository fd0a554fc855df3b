"""Atlases kept in memory and in the cache folder, by a digest of what they are made of."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import astuple, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.search.exemplars.atlas import Atlas, AtlasSettings
from regkit.system.archives import read_arrays
from regkit.system.cache import VARIABLE, cache_folder
from regkit.system.errors import DataError, RegkitError
from regkit.system.files import write_arrays
from regkit.system.notes import note
from regkit.system.progress import working

FORMAT = "7"
"""Changes with the code that makes atlases."""

KEPT, REMEMBERED = 32, 4
"""Number of atlases in the cache folder and in memory, those that were used last."""

DECIMALS = 6
"""Lengths that agree to this many decimals of the body's size are equal."""

_REMEMBERED: dict[str, Atlas] = {}


def atlas_of(body: Body, settings: AtlasSettings) -> Atlas:
    """Returns the atlas of a body: from memory, the cache folder, or newly made.

    All sizes of a template share one atlas.
    """
    digest = _digest(body, settings)
    atlas = _REMEMBERED.pop(digest, None)
    if atlas is None:
        atlas = _read(_file(digest)) or _made(body, settings, _file(digest))
    _REMEMBERED[digest] = atlas
    for old in list(_REMEMBERED)[:-REMEMBERED]:
        del _REMEMBERED[old]
    return atlas


def _made(body: Body, settings: AtlasSettings, file: Path) -> Atlas:
    with working(f"making the atlas of '{body.name}', once for this template"):
        atlas = Atlas.of(body, settings)
    try:
        write_arrays(file, atlas.arrays())
        _forget(file.parent)
    except DataError as error:
        note(
            f"{error}; the atlas is made again next time (the environment variable {VARIABLE} can "
            "name another folder)",
            place=file,
        )
    return atlas


def _read(file: Path) -> Atlas | None:
    """Returns a stored atlas; None if there is none."""
    if not file.exists():
        return None
    names = [field.name for field in fields(Atlas)]
    try:
        atlas = Atlas(**read_arrays(file, names, "an atlas"))
        file.touch()
    except (RegkitError, OSError) as error:
        note(f"{error}; the atlas is made again", place=file)
        return None
    return atlas


def _forget(folder: Path) -> None:
    """Removes atlases that were not used for long."""
    files = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime)
    for file in files[:-KEPT]:
        file.unlink(missing_ok=True)


def _file(digest: str) -> Path:
    return cache_folder() / "atlases" / f"{digest}.npz"


def _digest(body: Body, settings: AtlasSettings) -> str:
    """Returns the digest of all that an atlas depends on."""
    made = hashlib.sha256(f"{FORMAT} {astuple(settings)}".encode())
    for part in _parts(body):
        # Zero has no sign, so that rounding cannot give another digest.
        made.update(str(part.shape).encode())
        made.update((np.round(part.astype(float), DECIMALS) + 0.0).tobytes())
    return made.hexdigest()[:32]


def _parts(body: Body) -> Iterator[NDArray[np.generic]]:
    bones, limits, size = body.skeleton, body.skeleton.limits, body.size
    offsets = bones.link_offsets.copy()
    offsets[:, :3, 3] /= size
    yield offsets
    yield from (bones.link_parents, bones.ball_links, bones.hinge_links, bones.hinge_twists)
    yield from (bones.segment_links, bones.dof_mask)
    yield from (limits.hinge, limits.centre, limits.twist_axis, limits.swing_axis)
    yield from (limits.swing, limits.twist)
    couplings = limits.couplings
    yield from (couplings.followers, couplings.leaders, couplings.ratios, couplings.offsets)
    yield from (body.capsules.segments, body.capsules.ends / size, body.capsules.radii / size)
    yield np.array(body.optional, dtype=np.intp)
    for stance in body.stances:
        yield from (stance.pose.balls, stance.pose.hinges)

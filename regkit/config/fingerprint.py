"""A digest of the installed plug-ins, taken without importing them."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Iterator

from regkit.config.installed import OWN, all_entry_points, search_path
from regkit.system.digests import Stamp, data_digest


def plugins_fingerprint() -> str:
    """Returns a digest that changes with every plug-in, its package, and what is installed.

    It covers the Python version, the search path with the time of the last installation in each
    of its folders, all entry points of regkit's groups with the versions of their distributions,
    and size and times of every file of their packages and of regkit.
    """
    points = sorted(
        (group, point.name, point.value, point.dist.version if point.dist else "")
        for group, found in all_entry_points().items()
        if group.startswith(f"{OWN}.")
        for point in found
    )
    packages = {OWN, *(value.partition(":")[0].partition(".")[0] for _, _, value, _ in points)}
    files = [[name, *_stamps(name)] for name in sorted(packages)]
    return data_digest([sys.version, search_path(), points, files])


def _stamps(package: str) -> Iterator[tuple[str, Stamp]]:
    """Yields the files of a package or module, with their stamps."""
    try:
        spec = importlib.util.find_spec(package)
    except (ImportError, ValueError):
        return
    if spec is None:
        return
    for folder in spec.submodule_search_locations or ():
        for parent, folders, names in os.walk(folder):
            folders[:] = sorted(name for name in folders if name != "__pycache__")
            for name in sorted(names):
                path = os.path.join(parent, name)  # noqa: PTH118 - of many files, as text.
                yield path, Stamp.of(path)
    if spec.submodule_search_locations is None and spec.origin is not None:
        yield spec.origin, Stamp.of(spec.origin)

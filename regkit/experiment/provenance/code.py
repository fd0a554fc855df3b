"""The code of plug-ins, and the versions of the libraries that compute."""

from __future__ import annotations

import hashlib
import inspect
import re
import sys
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError, requires
from pathlib import Path

from regkit import __version__
from regkit.config.installed import Installed
from regkit.config.plugin import Plugin
from regkit.config.registry import registered
from regkit.experiment.environment import installed
from regkit.experiment.provenance.listing import files_by_name
from regkit.system.digests import Stamp, data_digest, file_digest

NUMERICAL = (
    "numpy",
    "scipy",
    "numba",
    "llvmlite",
    "casadi",
    "open3d",
    "open3d-cpu",
    "small_gicp",
    "biocpd",
    "probreg",
    "pycpd",
    "rustcpd",
    "trimesh",
    "pillow",
    "h5py",
)
"""Distributions whose versions may change a result."""


def versions(plugins: Iterable[Plugin]) -> dict[str, str]:
    """Returns the versions of regkit, of numerical libraries, and of the plug-ins' distributions.

    Of a third party's plug-in the libraries that its distribution requires are included.
    """
    found = {"regkit": __version__}
    names: dict[str, None] = dict.fromkeys(NUMERICAL)
    for plugin in plugins:
        origin = type(plugin).available().get(plugin.kind)
        if isinstance(origin, Installed):
            names.update(dict.fromkeys(origin.distributions))
            for distribution in origin.distributions:
                if distribution != "regkit":
                    names.update(dict.fromkeys(_required(distribution)))
    versions = {name: installed(name) for name in names}
    return found | {name: one for name, one in versions.items() if one and name != "regkit"}


def code(plugins: Iterable[Plugin]) -> dict[str, str]:
    """Returns the digests of the code of plug-ins, by package or by plug-in file and class."""
    found: dict[str, str] = {}
    for one in {type(plugin): None for plugin in plugins}:
        for base in one.__mro__:
            if issubclass(base, Plugin):
                package = base.__module__.partition(".")[0]
                if not _in_package(base, package):
                    name, digest = _own(base)
                    found[name] = digest
                elif package not in found:
                    found[package] = _package(package)
    return dict(sorted(found.items()))


def _in_package(plugin: type[Plugin], package: str) -> bool:
    """Whether a class is of a package, not of a plug-in file, a script or a notebook."""
    of_this_process = plugin in registered(getattr(plugin, "group", "")).values()
    return not of_this_process and hasattr(sys.modules.get(package), "__path__")


def _own(plugin: type[Plugin]) -> tuple[str, str]:
    """Returns name and digest of a class outside of packages; that of a notebook may be unknown."""
    module = sys.modules.get(plugin.__module__)
    file = getattr(module, "__file__", None)
    if file and Path(file).is_file():
        return f"{Path(file).name}: {plugin.__qualname__}", file_digest(file, Stamp.of(file))
    try:
        digest = hashlib.sha256(inspect.getsource(plugin).encode()).hexdigest()
    except (OSError, TypeError):
        digest = ""
    return plugin.__qualname__, digest


@cache
def _package(name: str) -> str:
    """Returns the digest of a package's files; a process keeps the code that it loaded."""
    files = files_by_name(Path(path) for path in sys.modules[name].__path__)
    return data_digest({key: file_digest(file, Stamp.of(file)) for key, file in files.items()})


def _required(distribution: str) -> list[str]:
    try:
        lines = requires(distribution) or []
    except PackageNotFoundError:
        return []
    return [found[0] for line in lines if (found := re.match(r"[\w.-]+", line))]

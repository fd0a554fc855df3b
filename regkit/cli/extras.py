"""Optional libraries: which are installed, and what each is for."""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from regkit.alignment.rigid_method import RigidMethod
from regkit.deformation import LibraryDeformation
from regkit.interfaces import Method
from regkit.system.errors import RegkitError
from regkit.system.optional import load_library

EXTRAS = {
    "distributed": ("cluster", "regkit run --cluster"),
    "h5py": ("hdf5", "datasets in HDF5 files"),
    "pyrealsense2": ("realsense", "RealSense cameras and recordings"),
    "rosbags": ("ros", "bags of ROS, MCAP files"),
    "pytest": ("testing", "conformance tests of your own plug-ins"),
}
"""Modules of regkit's own extras, with the extra and what it is for."""


@dataclass
class Extra:
    """An optional library.

    Attributes:
        name: Its module.
        version: Its version; None if it is not installed.
        command: Command that installs it.
        purposes: What it is for.
    """

    name: str
    version: str | None = None
    command: str = ""
    purposes: list[str] = field(default_factory=list)


def extras(besides: set[str]) -> list[Extra]:
    """Returns the optional libraries of regkit and of the installed methods.

    Args:
        besides: Modules that are listed elsewhere, as they are required.
    """
    found: dict[str, Extra] = {}
    for module, (extra, purpose) in EXTRAS.items():
        found[module] = _extra(module, f'pip install "regkit[{extra}]"', purpose)
    for kind in Method.available():
        one = _of_method(kind)
        if one is None or one.name in besides:
            continue
        found.setdefault(one.name, one).purposes.append(kind)
    for one in found.values():
        if one.name not in EXTRAS:
            one.purposes = [f"method {', '.join(one.purposes)}"]
    return list(found.values())


def _extra(module: str, command: str, purpose: str) -> Extra:
    try:
        return Extra(module, _version(load_library(module)), command, [purpose])
    except RegkitError:
        return Extra(module, None, command, [purpose])


def _of_method(kind: str) -> Extra | None:
    """Returns the library that a method calls; None if it calls none, or is broken."""
    try:
        plugin = Method.load(kind)
        library: Any = None
        if issubclass(plugin, (RigidMethod, LibraryDeformation)):
            library = plugin.model_validate({}).library()
    except RegkitError as error:
        state, _, command = str(error).rpartition("run: ")
        return Extra(state.split()[0].partition(".")[0], None, command) if command else None
    return None if library is None else Extra(library.__name__.partition(".")[0], _version(library))


def _version(library: Any) -> str:
    name = library.__name__.partition(".")[0]
    try:
        return version(name)
    except PackageNotFoundError:
        return str(getattr(library, "__version__", "installed"))

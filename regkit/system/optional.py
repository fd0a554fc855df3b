"""Heavy or optional libraries, imported on first use."""

from __future__ import annotations

import importlib
import sys
from contextlib import AbstractContextManager
from typing import Any

from regkit.system.errors import DependencyError

INSTALL = {
    "distributed": 'pip install "regkit[cluster]"',
    "ezc3d": 'pip install "regkit[markers]"',
    "open3d": "pip install open3d-cpu" if sys.platform == "linux" else "pip install open3d",
    "pytest": 'pip install "regkit[testing]"',
}
"""Commands to install a library, if its name alone is not enough."""

SYSTEM_PACKAGES = {"open3d": "libusb-1.0-0 libgl1 libegl1 libx11-6 libgomp1"}
"""Packages of Debian and Ubuntu that a library's wheel needs to load."""


def load_library(module: str, *, install: str | None = None) -> Any:
    """Imports a library.

    Args:
        module: Name of its Python module.
        install: Command to install it; by default from ``INSTALL``, or pip with its name.

    Raises:
        DependencyError: If it, or a system library that it needs, is missing; the message names
            the command to install it.
    """
    name = module.partition(".")[0]
    command = install or INSTALL.get(name, f"pip install {name}")
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        raise DependencyError(f"{error.name} is not installed; run: {command}") from None
    except (ImportError, OSError) as error:
        packages = SYSTEM_PACKAGES.get(name)
        if packages is not None:
            command = f"sudo apt-get install -y {packages}"
        where = "on Debian or Ubuntu run" if packages is not None else "run"
        raise DependencyError(f"{module} cannot be loaded ({error}); {where}: {command}") from None


def one_blas_thread() -> AbstractContextManager[object]:
    """Context manager: NumPy's matrix products use one thread.

    The products here are small, so a second thread costs more than it gains.
    """
    return _limited(user_api="blas")


def one_thread() -> AbstractContextManager[object]:
    """Context manager: all loaded libraries use one thread, in OpenMP too.

    The order in which threads add up changes the last bits of a sum; one thread makes results
    reproducible.
    """
    return _limited()


def _limited(**which: str) -> AbstractContextManager[object]:
    limits: AbstractContextManager[object] = load_library("threadpoolctl").threadpool_limits(
        1, **which
    )
    return limits

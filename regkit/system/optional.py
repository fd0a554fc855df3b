"""Libraries that are heavy or that not everyone has, imported when they are first used."""

from __future__ import annotations

import importlib
import sys
from contextlib import AbstractContextManager
from typing import Any

from regkit.system.errors import DependencyError

INSTALL = {
    "distributed": 'pip install "regkit[cluster]"',
    "open3d": "pip install open3d-cpu" if sys.platform == "linux" else "pip install open3d",
    "pytest": 'pip install "regkit[testing]"',
}
"""Commands that install a library, where its own name is not enough."""

SYSTEM_PACKAGES = {"open3d": "libusb-1.0-0 libgl1 libegl1 libx11-6 libgomp1"}
"""Packages of Debian and Ubuntu without which a library's wheel cannot be imported."""


def load_library(module: str, *, install: str | None = None) -> Any:
    """Import a library.

    Args:
        module: Its name in Python.
        install: The command that installs it, if regkit does not know.

    Raises:
        DependencyError: If it, or a system library that it needs, is missing; the message holds
            the command that installs it.
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
    """A context in which NumPy's matrix products use one thread.

    The products here are small; a second thread costs several times more than it brings.
    """
    return _limited(user_api="blas")


def one_thread() -> AbstractContextManager[object]:
    """A context in which the libraries that are loaded use one thread, in OpenMP too.

    The order in which threads add up changes the last bits of a sum, and with one thread there is
    one order.
    """
    return _limited()


def _limited(**which: str) -> AbstractContextManager[object]:
    limits: AbstractContextManager[object] = load_library("threadpoolctl").threadpool_limits(
        1, **which
    )
    return limits

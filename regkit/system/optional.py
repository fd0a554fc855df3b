"""Heavy or untyped libraries, imported when first used; errors hold the mending command."""

from __future__ import annotations

import importlib
import sys
from contextlib import AbstractContextManager
from typing import Any

from regkit.system.errors import DependencyError

DEBIAN_PACKAGES = "libusb-1.0-0 libgl1 libegl1 libx11-6 libgomp1"
"""System libraries without which Open3D's wheel cannot be imported on Debian and Ubuntu."""


def open3d() -> Any:
    """The module ``open3d``.

    Raises:
        DependencyError: If it, or a system library that it needs, is missing.
    """
    try:
        return importlib.import_module("open3d")
    except ModuleNotFoundError:
        package = "open3d-cpu" if sys.platform == "linux" else "open3d"
        raise DependencyError(f"Open3D is not installed; run: pip install {package}") from None
    except (ImportError, OSError) as error:
        raise DependencyError(
            f"Open3D cannot be loaded ({error}); on Debian or Ubuntu run: "
            f"sudo apt-get install -y {DEBIAN_PACKAGES}"
        ) from None


def numba() -> Any:
    """The module ``numba``.

    Raises:
        DependencyError: If it is missing.
    """
    try:
        return importlib.import_module("numba")
    except ImportError as error:
        raise DependencyError(f"Numba cannot be loaded ({error}); run: pip install numba") from None


def casadi() -> Any:
    """The module ``casadi``.

    Raises:
        DependencyError: If it is missing.
    """
    try:
        return importlib.import_module("casadi")
    except ImportError as error:
        raise DependencyError(
            f"CasADi cannot be loaded ({error}); run: pip install casadi"
        ) from None


def library(module: str, *, install: str) -> Any:
    """A library that only some plug-ins need.

    Args:
        module: Its name in Python.
        install: The command that installs it.

    Raises:
        DependencyError: If it is missing or cannot be loaded.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        raise DependencyError(f"{error.name} is not installed; run: {install}") from None
    except (ImportError, OSError) as error:
        raise DependencyError(f"{module} cannot be loaded ({error}); run: {install}") from None


def one_blas_thread() -> AbstractContextManager[object]:
    """A context in which NumPy's matrix products use one thread.

    The products here are small; a second thread costs several times more than it brings.
    """
    limits: AbstractContextManager[object] = importlib.import_module(
        "threadpoolctl"
    ).threadpool_limits(1, user_api="blas")
    return limits


def one_thread() -> AbstractContextManager[object]:
    """A context in which the libraries that are loaded use one thread, in OpenMP too.

    The order in which threads add up changes the last bits of a sum, and with one thread there is
    one order.
    """
    limits: AbstractContextManager[object] = importlib.import_module(
        "threadpoolctl"
    ).threadpool_limits(1)
    return limits

"""The library of RealSense cameras."""

from __future__ import annotations

from typing import Any

from regkit.system.optional import load_library


def realsense() -> Any:
    """Returns the module ``pyrealsense2``.

    Raises:
        DependencyError: If it is not installed.
    """
    return load_library("pyrealsense2", install='pip install "regkit[realsense]"')

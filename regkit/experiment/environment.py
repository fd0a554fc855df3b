"""On what machine and with what versions results were made."""

from __future__ import annotations

import os
import platform
from datetime import datetime
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from regkit import __version__

LIBRARIES = ("numpy", "scipy", "numba", "pydantic", "open3d-cpu", "open3d", "casadi", "matplotlib")


def environment() -> dict[str, Any]:
    """Versions and machine, and when it was looked at, as JSON."""
    return {
        "date": f"{datetime.now().astimezone():%Y-%m-%d %H:%M %z}",
        "regkit": __version__,
        "python": platform.python_version(),
        "libraries": {name: installed(name) for name in LIBRARIES if installed(name)},
        "system": platform.platform(),
        "processor": _processor(),
        "cores": os.cpu_count(),
    }


def installed(distribution: str) -> str | None:
    """The version of an installed distribution, or None."""
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def _processor() -> str:
    """The processor's name; Linux keeps it where ``platform`` does not look."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:  # noqa: PTH123
            for line in lines:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor()

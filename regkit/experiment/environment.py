"""Machine and versions with which results were made."""

from __future__ import annotations

import os
import platform
from contextlib import suppress
from datetime import datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from regkit import __version__
from regkit.experiment.results_format import FORMAT
from regkit.system.errors import RegkitError
from regkit.system.json_files import read_json

LIBRARIES = (
    "numpy",
    "scipy",
    "numba",
    "pydantic",
    "open3d-cpu",
    "open3d",
    "casadi",
    "matplotlib",
    "joblib",
    "distributed",
)


def environment(earlier: Path, workers: str) -> dict[str, Any]:
    """Returns versions, machine, workers, format of the results and start time of the run, as JSON.

    Args:
        earlier: The file of the run's first start, if it is continued.
        workers: Description of the current workers, whose frames per second are measured.
    """
    known, begun = [], f"{datetime.now().astimezone():%Y-%m-%d %H:%M %z}"
    with suppress(RegkitError, KeyError, TypeError):
        before = read_json(earlier)
        known, begun = list(before["workers"]), str(before["date"])
    return {
        "date": begun,
        "regkit": __version__,
        "format": FORMAT,
        "python": platform.python_version(),
        "libraries": {name: installed(name) for name in LIBRARIES if installed(name)},
        "system": platform.platform(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "workers": list(dict.fromkeys([*known, workers])),
    }


@cache
def installed(distribution: str) -> str | None:
    """Returns the version of an installed distribution, or None; a process keeps what it loaded."""
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def _processor() -> str:
    """Returns the processor's name, which ``platform`` does not know on Linux."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:  # noqa: PTH123
            for line in lines:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor()

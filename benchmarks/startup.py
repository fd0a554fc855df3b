"""Start of regkit: processor time of short commands, and what the first run of the demo waits for.

A command's time is the user and system time of its whole process, the least of ``RUNS``. The demo
runs twice in one empty folder for compiled loops; the difference of the wall times is what the
first run waits for, and that of the processor times is what other programs do not disturb.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

RUNS = 7
"""Runs of each command."""

DEMO = Path(__file__).parent.parent / "docs" / "examples" / "demo.yaml"

COMMANDS = {
    "python -c pass": ["-c", "pass"],
    "import regkit": ["-c", "import regkit"],
    "regkit --help": ["-m", "regkit", "--help"],
    "regkit plugins": ["-m", "regkit", "plugins"],
    "regkit plugins direct": ["-m", "regkit", "plugins", "direct"],
    "regkit validate demo.yaml": ["-m", "regkit", "validate", str(DEMO)],
}


def main() -> None:
    """Prints the tables, and the figures as JSON."""
    seconds = {
        name: min(run(command)[0] for _ in range(RUNS)) for name, command in COMMANDS.items()
    }
    completing = {"_REGKIT_COMPLETE": "complete_bash", "COMP_WORDS": "regkit track --method "}
    command = ["-m", "regkit"]
    seconds["shell completion"] = min(
        run(command, {**completing, "COMP_CWORD": "3"})[0] for _ in range(RUNS)
    )
    print("command                      processor time [s]")
    for name, least in seconds.items():
        print(f"{name:28} {least:18.3f}")
    with TemporaryDirectory() as folder:
        times = [demo(Path(folder), name) for name in ("first", "second")]
    print("\nregkit run demo.yaml    wall [s]   processor [s]")
    for name, (processor, wall) in zip(("first run", "second run"), times, strict=True):
        print(f"{name:20} {wall:11.1f} {processor:15.1f}")
    extra = [first - second for first, second in zip(*times, strict=True)]
    print(f"{'the first waits':20} {extra[1]:11.1f} {extra[0]:15.1f}")
    print(
        json.dumps({
            "import_seconds": round(seconds["import regkit"], 3),
            "help_seconds": round(seconds["regkit --help"], 3),
            "plugins_seconds": round(seconds["regkit plugins"], 3),
            "plugin_seconds": round(seconds["regkit plugins direct"], 3),
            "validate_seconds": round(seconds["regkit validate demo.yaml"], 3),
            "completion_seconds": round(seconds["shell completion"], 3),
            "first_run_extra_seconds": round(extra[1], 1),
            "first_run_extra_processor_seconds": round(extra[0], 1),
        })
    )  # fmt: skip


def demo(folder: Path, name: str) -> tuple[float, float]:
    """Returns processor and wall time [s] of the demo, with compiled loops in a folder."""
    arguments = ["-m", "regkit", "run", str(DEMO), "--out", str(folder / name)]
    return run(arguments, {"NUMBA_CACHE_DIR": str(folder / "loops")})


def run(arguments: list[str], variables: Mapping[str, str] | None = None) -> tuple[float, float]:
    """Returns processor and wall time [s] of a Python process, which may fail."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(
        [sys.executable, *arguments],
        env={**os.environ, **(variables or {})},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=variables is None,
    )
    wall, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


if __name__ == "__main__":
    main()

"""Tries damaged inputs and YAML on every reader.

A case is given by the seed and its number alone: ``--only`` tries it again. What fails is kept in a
folder for looking at it. The last line is one JSON object with all figures.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path

SUPPORT = str(Path(__file__).parents[1] / "support")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--seed", type=int, default=0, help="seed of all cases")
    parser.add_argument("--yaml", type=int, default=0, metavar="N", help="number of YAML files")
    parser.add_argument("--inputs", type=int, default=0, metavar="N", help="number of other inputs")
    parser.add_argument("--only", type=int, metavar="N", help="the case of this number alone")
    parser.add_argument("--kind", default="", help="only kinds whose names begin so: clouds/pcd")
    parser.add_argument("--jobs", type=int, default=1, help="number of processes")
    parser.add_argument("--keep", type=Path, default=Path(".fuzz"), help="folder for failures")
    return parser.parse_args()


def main() -> int:
    """Returns 1 if anything failed."""
    given = _arguments()
    # The workers inherit both: one thread each, and the helpers of the tests.
    os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"
    os.environ["PYTHONPATH"] = os.pathsep.join(
        filter(None, (SUPPORT, os.environ.get("PYTHONPATH")))
    )
    sys.path.append(SUPPORT)
    from tests.fuzz.case import drawn
    from tests.fuzz.seeds import results
    from tests.fuzz.summary import Summary
    from tests.fuzz.workers import outcomes

    counts = {"yaml": given.yaml, "inputs": given.inputs}
    numbers = [
        (group, number)
        for group, count in counts.items()
        for number in ([given.only] if count and given.only is not None else range(count))
        if drawn(group, given.seed, number)[1].name.startswith(given.kind)
    ]
    summary, progress = Summary(given.seed, given.keep), _Progress(len(numbers))
    with tempfile.TemporaryDirectory(prefix="regkit-fuzz-") as scratch:
        os.environ.setdefault(results.FOLDER, str(Path(scratch) / "results"))
        if given.inputs:
            results.seeds()
        for number, outcome in outcomes(given.seed, numbers, given.jobs):
            summary.add(number, outcome)
            progress.step(summary.figures()["failed"])
    progress.end()
    print(summary.table(), "", summary.listed(), sep="\n")
    summary.write()
    figures = {**summary.figures(), "seconds": round(progress.seconds)}
    print(json.dumps(figures))
    return int(figures["failed"] > 0)


class _Progress:
    """On a terminal a line that changes, in a pipe a line per minute."""

    def __init__(self, count: int) -> None:
        self._count, self._done, self._begun = count, 0, time.monotonic()
        self._shown = self._begun
        self._every = 0.2 if sys.stderr.isatty() else 60.0

    @property
    def seconds(self) -> float:
        return time.monotonic() - self._begun

    def step(self, failed: int) -> None:
        self._done += 1
        if time.monotonic() - self._shown < self._every:
            return
        self._shown = time.monotonic()
        text = f"{self._done} of {self._count} cases, {failed} failed, {self.seconds:.0f} s"
        print(text, end="\r" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)

    def end(self) -> None:
        if sys.stderr.isatty():
            print(file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())

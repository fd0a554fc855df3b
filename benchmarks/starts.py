"""Starts: people, hands and scans found from any side, cut off, lost, and in rooms.

    python benchmarks/starts.py [--only people,hands] [--some 360] [--set test] [--jobs 1]

Every body is rendered with exact joints (`_starts_*.py`, one scenario each), its start is sought in
a single frame, and the method `best` is registered from there with its tracker's recovery. Frames
are rendered on first use and stored in the user's cache folder. Rules and constants are chosen on
the set `development`; the figures of the documentation are those of the set `test`, which shares
neither bodies nor motions with it. Processor time of the search alone, one thread.
"""

from __future__ import annotations

import json
import os
import warnings
from argparse import ArgumentDefaultsHelpFormatter, ArgumentParser
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import get_args

# Before NumPy is loaded: processor time sums over threads.
os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", NUMBA_NUM_THREADS="1")

from _starts_bodies import Set
from _starts_options import Options

from regkit.system.notes import RegkitWarning

SYNTHETIC = ("people", "folded", "hands", "cropped", "scans", "recovery")
"""Scenarios whose starts are compared with the truth."""

SCENARIOS = (*SYNTHETIC, "rooms", "empty", "utd", "sr305", "scene")


def options() -> tuple[Options, list[str]]:
    """Returns the options of the command line, and the names of the scenarios."""
    parser = ArgumentParser(description=__doc__.splitlines()[0], formatter_class=_Format)
    parser.add_argument("--only", help=f"scenarios to run, of {','.join(SCENARIOS)}")
    parser.add_argument("--some", type=int, default=360, help="most cases of a scenario, at random")
    parser.add_argument("--seed", type=int, default=0, help="seed of this choice")
    parser.add_argument("--set", choices=get_args(Set), default="test", help="bodies and motions")
    parser.add_argument(
        "--start", default="exemplars", help="the search: exemplars or stances; or truth"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--each", action="store_true", help="print every case")
    given = parser.parse_args()
    known = SYNTHETIC if given.start == "truth" else SCENARIOS
    names = given.only.split(",") if given.only else list(known)
    for name in names:
        if name not in known:
            told = f"with --start {given.start} there are: {', '.join(known)}"
            parser.error(f"there is no scenario '{name}' ({told})")
    return Options(given.start, given.set, given.some, given.seed, given.jobs, given.each), names


class _Format(ArgumentDefaultsHelpFormatter):
    """Help with default values."""


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    chosen, names = options()
    # What is passed over or assumed is told of recordings, and here are thousands.
    warnings.simplefilter("ignore", RegkitWarning)
    print(
        f"set {chosen.chosen}, start {chosen.start}, at most {chosen.some} cases of each scenario"
    )
    found: dict[str, object] = {"threads": 1, "set": chosen.chosen, "start": chosen.start}
    for name in names:
        figures: Callable[[Options], Mapping[str, object]]
        figures = import_module(f"_starts_{name}").figures
        found |= figures(chosen)
    print(json.dumps(found))


if __name__ == "__main__":
    main()

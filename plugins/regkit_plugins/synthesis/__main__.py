"""Makes the sample sequences: ``python -m regkit_plugins.synthesis OUT``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from regkit.errors import RegkitError
from regkit_plugins.synthesis.samples import hand_gestures, human_walk


def main() -> int:
    """Make the samples that the command line asks for, and print what was written."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_plugins.synthesis",
        description="Make the sample depth sequences human_walk and hand_gestures.",
    )
    parser.add_argument("out", type=Path, help="folder that the sequences go into")
    parser.add_argument("--seed", type=int, default=0, help="seed of the noise (default: 0)")
    arguments = parser.parse_args()
    out: Path = arguments.out
    try:
        print(f"{'sequence':<32}{'frames':>8}{'joints':>8}{'pixels/frame':>14}{'kB':>8}")
        for make in (human_walk, hand_gestures):
            sequence = make(arguments.seed)
            folder = out / sequence.name
            sequence.write(folder)
            size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
            pixels = (sequence.depth > 0).sum() / len(sequence.depth)
            print(
                f"{folder!s:<32}{len(sequence.depth):>8}{len(sequence.joints):>8}"
                f"{pixels:>14.0f}{size / 1000:>8.0f}"
            )
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

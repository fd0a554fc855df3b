"""Makes depth recordings: ``python -m regkit_synthesis OUT``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from regkit.system.errors import RegkitError
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.samples.depth import hand_gestures, human_walk


def main() -> int:
    """Make the recordings that the command line asks for, and print what was written."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_synthesis",
        description="Make the sample depth recordings human_walk and hand_gestures.",
    )
    parser.add_argument("out", type=Path, help="folder that the recordings go into")
    parser.add_argument("--seed", type=int, default=0, help="seed of the noise (default: 0)")
    arguments = parser.parse_args()
    out: Path = arguments.out
    try:
        print(
            f"{'recording':<32}{'frames':>8}{'joints':>8}{'pixels/frame':>14}{'kB':>8}", flush=True
        )
        for make in (human_walk, hand_gestures):
            recording = make(arguments.seed)
            _write(recording, out / recording.name)
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


def _write(recording: DepthRecording, folder: Path) -> None:
    """Write a recording and print a row about it."""
    recording.write(folder)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    pixels = (recording.depth > 0).sum() / len(recording.depth)
    print(
        f"{folder!s:<32}{len(recording.depth):>8}{len(recording.joints):>8}"
        f"{pixels:>14.0f}{size / 1000:>8.0f}",
        flush=True,
    )


if __name__ == "__main__":
    sys.exit(main())

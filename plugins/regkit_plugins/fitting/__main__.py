"""Makes the templates' files: ``python -m regkit_plugins.fitting OUT``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from regkit.errors import RegkitError
from regkit.files import write_text
from regkit_plugins.fitting.hand import left_hand, right_hand
from regkit_plugins.fitting.human import human
from regkit_plugins.fitting.texts import hand_text, human_text
from regkit_plugins.synthesis import assets


def texts() -> dict[str, str]:
    """The text of each file, by its name."""
    right = right_hand(assets.average_hand())
    return {
        "human.yaml": human_text(human(assets.average_human())),
        "hand_right.yaml": hand_text(right, "right"),
        "hand_left.yaml": hand_text(left_hand(right), "left"),
    }


def main() -> int:
    """Write the three files to the folder that the command line names."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_plugins.fitting",
        description="Fit the human and the hand templates to the meshes that ship with regkit.",
    )
    parser.add_argument("out", type=Path, help="folder that the YAML files go into")
    out: Path = parser.parse_args().out
    try:
        for name, text in texts().items():
            write_text(out / name, text)
            print(out / name)
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

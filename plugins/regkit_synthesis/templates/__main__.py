"""Generates the template files: ``python -m regkit_synthesis.templates OUT``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from regkit.system.errors import RegkitError
from regkit_synthesis import assets
from regkit_synthesis.templates.templates import (
    FittedTemplate,
    human_template,
    left_hand_template,
    right_hand_template,
)


def templates() -> dict[str, FittedTemplate]:
    """Returns the templates by file name."""
    right = right_hand_template(assets.average_hand())
    return {
        "human.yaml": human_template(assets.average_human()),
        "human_small.yaml": human_template(assets.small_human(), "A small person", "a small body"),
        "human_tall.yaml": human_template(assets.tall_human(), "A tall person", "a tall body"),
        "hand_right.yaml": right,
        "hand_left.yaml": left_hand_template(right),
    }


def main() -> int:
    """Writes the templates and their meshes to the folder in the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m regkit_synthesis.templates",
        description="Fit the human and the hand templates to the meshes that ship with regkit.",
    )
    parser.add_argument("out", type=Path, help="folder that the YAML files and meshes go into")
    out: Path = parser.parse_args().out
    try:
        for name, template in templates().items():
            for path in template.write(out / name):
                print(path)
    except RegkitError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Presets: whole methods and datasets as YAML files, to use by name or to copy."""

from pathlib import Path

_FOLDER = Path(__file__).parent

BEST = _FOLDER / "best.yaml"
FILTERED = _FOLDER / "filtered.yaml"
ICP = _FOLDER / "icp.yaml"
MARKERS = _FOLDER / "markers.yaml"
PAPER = _FOLDER / "paper.yaml"
PAPER_EXACT = _FOLDER / "paper_exact.yaml"
RIGID = _FOLDER / "rigid.yaml"
ROBOTS = _FOLDER / "robots.yaml"
SPHERES = _FOLDER / "spheres.yaml"

HANDS = _FOLDER / "hands.yaml"
PEOPLE = _FOLDER / "people.yaml"
SMMC_LIKE = _FOLDER / "smmc_like.yaml"
TWO_HANDS = _FOLDER / "two_hands.yaml"

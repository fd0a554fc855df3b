"""Where the files that tests read are."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "docs" / "examples"
DATA = EXAMPLES / "data"
ASSETS = ROOT / "tests" / "assets"
CASES = ROOT / "tests" / "cases"

REFERENCE = ROOT.parent / "shared" / "data"
"""The reference data, which lie beside the project where it is developed."""

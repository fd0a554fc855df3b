"""Effect of ``regkit calibrate`` on a body with other proportions than the template.

    python benchmarks/calibration.py

The method ``best`` tracks the six recordings of the small body with a template of the true lengths,
with the generic template, and with templates calibrated on one recording each.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from _suite import HEADER, last_line, recordings, row, tracked

BODY, METHOD = "human_small", "{preset: best}"
CALIBRATED_ON = ("walk_fast", "walk_above", "punch_side")


def main() -> None:
    """Prints the table, and its figures as one JSON object in the last line."""
    print(HEADER)
    figures = {
        "right lengths": row("right lengths", tracked(BODY, METHOD)),
        "generic": row("generic", tracked(BODY, METHOD, template="human")),
    }
    folders = {recording.name: recording.folder() for recording in recordings(BODY)}
    with TemporaryDirectory() as temporary:
        for recording in CALIBRATED_ON:
            file = Path(temporary) / f"{recording}.yaml"
            command = [
                sys.executable,
                "-m",
                "regkit",
                "calibrate",
                str(folders[f"small_{recording}"]),
            ]
            subprocess.run([*command, "--out", str(file)], check=True, stdout=sys.stderr)
            template = f"{{kind: file, path: {file}}}"
            name = f"calibrated on {recording}"
            figures[name] = row(name, tracked(BODY, METHOD, template=template))
    last_line(figures)


if __name__ == "__main__":
    main()

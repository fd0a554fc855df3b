"""Files of markers, as motion-capture programs write them."""

from pathlib import Path

import numpy as np


def write_trc(path: Path, names, positions, *, fps=100.0, unit="m", scale=1.0) -> Path:
    """Writes a TRC file; NaN is an empty cell."""
    head = ["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units"]
    values = [f"{fps:g}", f"{fps:g}", str(len(positions)), str(len(names)), unit]
    axes = [f"{axis}{n}" for n in range(1, len(names) + 1) for axis in "XYZ"]
    lines = [
        "\t".join(["PathFileType", "4", "(X/Y/Z)", path.name]),
        "\t".join(head),
        "\t".join(values),
        "\t".join(["Frame#", "Time", *(cell for name in names for cell in (name, "", ""))]),
        "\t".join(["", "", *axes]),
        "",
    ]
    for number, places in enumerate(np.asarray(positions)):
        cells = ["" if np.isnan(one) else f"{scale * one:.6f}" for one in places.ravel()]
        lines.append("\t".join([str(number + 1), f"{number / fps:.4f}", *cells]))
    path.write_text("\n".join(lines) + "\n")
    return path

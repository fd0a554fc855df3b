"""Marker-based solving of a walk, compared with the joint angles of a biomechanics program.

The recording has 51 markers of a walking person at 100 Hz. Both programs define the zero of an
angle in their own way, so a constant offset is removed. The calibration takes 12 of the 131 frames.
"""

from __future__ import annotations

import time
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from _suite import last_line

import regkit
from regkit.body.template_file import write_template
from regkit.calibration import MarkerSet, MarkerSubject
from regkit.config.document import Document
from regkit.interfaces import Dataset, Template
from regkit.system.arrays import Array
from regkit.system.optional import one_blas_thread

DATA = Path(__file__).parents[2] / "shared" / "data" / "mocap_markers"
MARKERS = Path(__file__).parents[1] / "docs" / "examples" / "markers" / "full_body.yaml"

SEGMENTS = {
    "knee": ("shin", "knee_angle"),
    "hip": ("thigh", "hip_flexion"),
    "elbow": ("forearm", "elbow_flex"),
}
"""Segment beyond each joint, and the program's name of its flexion."""


def reference() -> dict[str, Array]:
    """Returns the program's angles by name [deg]."""
    lines = (DATA / "walking1_ik.mot").read_text().splitlines()
    begin = lines.index("endheader") + 1
    names = lines[begin].split("\t")
    values = np.array([[float(cell) for cell in line.split()] for line in lines[begin + 1 :]])
    return dict(zip(names, np.degrees(values).T, strict=True))


def flexion(tracked: regkit.Tracking, segment: str) -> Array:
    """Returns the angle (T,) of a segment's axis in its parent's sagittal plane [deg]."""
    bones = tracked.body.skeleton
    own = bones.names.index(segment)
    rotations = tracked.segments[:, :, :3, :3]
    parent = rotations[:, int(bones.parents[own])]
    down = (parent.transpose(0, 2, 1) @ -rotations[:, own, :, 1:2])[:, :, 0]
    return np.degrees(np.unwrap(np.arctan2(down[:, 2], -down[:, 1])))


def main() -> None:
    """Prints the distances of the markers and the agreement of the angles."""
    warnings.simplefilter("ignore", regkit.RegkitWarning)
    with one_blas_thread():
        recording = Dataset.parse(
            Dataset.at(DATA / "walking1.trc"), place="markers", field="dataset"
        ).only()
        human = Template.parse("human", place="markers", field="template")
        begun = time.process_time()
        markers = Document.read(MARKERS).validated(MarkerSet)
        subject = MarkerSubject.of(human, markers, recording)
        calibrated = time.process_time() - begun
        with TemporaryDirectory() as folder:
            file = Path(folder) / "subject.yaml"
            skin = subject.proportions.skin(human.description())
            write_template(file, subject.description, skin, "A subject.")
            tracked = regkit.track(recording, str(file), {"preset": "markers"}, start="landmarks")
    columns = [tracked.joint_names.index(name) for name in subject.names]
    measured = np.array([frame.landmarks.positions for frame in recording.frames()])
    order = [recording.trajectories.names.index(name) for name in subject.names]
    distances = np.linalg.norm(tracked.markers[:, columns] - measured[:, order], axis=2)
    rms = 1000.0 * float(np.sqrt(np.nanmean(distances**2)))
    print(f"markers: {rms:.1f} mm root mean square, worst {1000 * np.nanmax(distances):.0f} mm")
    print("| angle | correlation | RMS [deg] | range [deg] |\n|---|--:|--:|--:|")
    told, angles = reference(), {}
    for joint, (segment, name) in SEGMENTS.items():
        for side in ("left", "right"):
            own, other = flexion(tracked, f"{side}_{segment}"), told[f"{name}_{side[0]}"]
            # A knee bends backwards, which counts as flexion.
            own = -own if joint == "knee" else own
            apart = own - other
            angles[f"{side}_{joint}"] = {
                "correlation": round(float(np.corrcoef(own, other)[0, 1]), 4),
                "rms_deg": round(float(np.std(apart)), 2),
                "range_deg": round(float(np.ptp(other)), 1),
            }
            row = angles[f"{side}_{joint}"]
            print(f"| {side} {joint} | " + " | ".join(f"{one:g}" for one in row.values()) + " |")
    last_line({
        "rms_mm": round(rms, 2), "calibration_cpu_s": round(calibrated, 1),
        "frames_per_second": round(tracked.measure().fps), **angles,
    })  # fmt: skip


if __name__ == "__main__":
    main()

"""A person in a real room, whose joints nobody knows: a picture to look at."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from _starts_options import Options
from _starts_picture import drawn, write_sheet
from _starts_sessions import experiment, single

from regkit.api.frame_files import load_frame
from regkit.body.verdict import Verdict
from regkit.geometry.camera import Camera
from regkit.observation import Observation
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError

DATA = Path(__file__).parents[2] / "shared" / "data" / "kinect_pcl_bsd" / "person.pcd"

CAMERA = Camera(640, 480, 525.0, 525.0, 319.5, 239.5)


def figures(options: Options) -> dict[str, object]:
    """Prints what is found in a real room and draws it; nothing without the data."""
    if not DATA.is_file():
        print(f"scene is left out: the data are not at {DATA}", file=sys.stderr)
        return {}
    frame = load_frame(DATA)
    folder = {"kind": "clouds", "root": str(DATA.parent)}
    try:
        start, found = single(experiment(options.start, {"kind": "human"}, folder), [frame])
    except RegkitError as error:
        print(f"\n{DATA.name}: {error}")
        return {"scene": {"verdict": str(Verdict.LOST)}}
    observation, pose = found.observation, found.registered.pose
    assert observation is not None
    surface = start.body.capsules.place(start.body.place(pose).transforms)
    away = 1000.0 * float(np.median(np.abs(surface.surface_distance(observation.points))))
    told = f"{DATA.name}: {start.verdict}, {start.body.size:.2f} m, surface {away:.0f} mm"
    print(f"\n{told}")
    shown = Observation(
        observation.points, observation.weights, observation.variances, CAMERA, _depth(frame.points)
    )
    picture = drawn(shown, start.body, pose, told, {})
    write_sheet(Path("results") / "starts_scene.png", [picture], across=1)
    return {"scene": {"verdict": str(start.verdict), "surface_mm": round(away, 1)}}


def _depth(points: Array) -> Array:
    """Returns the depth image (H, W) [m] of points (N, 3)."""
    depth = np.zeros((CAMERA.height, CAMERA.width))
    columns, rows = np.rint(CAMERA.projected(points)).astype(int).T
    inside = (columns >= 0) & (columns < CAMERA.width) & (rows >= 0) & (rows < CAMERA.height)
    depth[rows[inside], columns[inside]] = points[inside, 2]
    return depth

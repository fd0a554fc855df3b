"""The shape of a body in one frame, for notebooks: a mesh, a template and distances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.api.registration import Registration
from regkit.api.tables import Summary
from regkit.body.template_file import check_replaceable, write_template
from regkit.calibration.scan_fit import ScanFit
from regkit.clouds.mesh_writing import write_mesh
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

OPENING = """\
Made by regkit from {recording}: the template '{template}' in the shape of the body there.
To use it: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees."""


@dataclass(frozen=True, repr=False)
class ShapedBody(Summary):
    """A body's shape and pose in one frame.

    Attributes:
        registration: The body with its average shape, and the verdict.
        fit: The shape.
        template: Name of the template.
    """

    registration: Registration
    fit: ScanFit
    template: str

    @property
    def size(self) -> float:
        """Size of the body [m]."""
        return self.fit.size

    @property
    def pose(self) -> Pose:
        """The pose of root and joints."""
        return self.fit.pose

    @property
    def vertices(self) -> Array:
        """The posed and shaped skin, in the template's vertex order, (V, 3) [m]."""
        return self.fit.vertices

    @property
    def faces(self) -> Indices:
        """Vertex indices of its triangles, (F, 3)."""
        return self.fit.faces

    @property
    def coefficients(self) -> Mapping[str, float]:
        """Coefficients of the shape modes, by name."""
        return self.fit.coefficients()

    @property
    def data_to_skin(self) -> Array:
        """Distances of the data to the skin, (N,) [m]."""
        return self.fit.to_skin

    @property
    def skin_to_data(self) -> Array:
        """Distances of the skin's vertices to the nearest data, (V,) [m].

        Those of parts without data are large.
        """
        return self.fit.to_data

    def save_mesh(self, path: str | Path) -> None:
        """Writes the posed and shaped mesh: ``.ply``, ``.obj``, ``.glb`` or ``.stl``.

        Raises:
            RegkitError: If the format is unknown, or the file cannot be written.
        """
        write_mesh(Path(path), self.vertices, self.faces)

    def save_template(self, path: str | Path) -> None:
        """Writes the template in this shape, as a YAML file with its skin beside it.

        Raises:
            RegkitError: If another file is there, or the file cannot be written.
        """
        out = Path(path)
        check_replaceable(out, place="path")
        name = self.registration.tracking.name
        opening = OPENING.format(recording=name, template=self.template, file=out.name)
        write_template(out, self.fit.description(), self.fit.skin(), opening)

    def figures(self) -> dict[str, object]:
        """Returns the shape and its distances for ``result.json``."""
        return {
            "size": self.size,
            "coefficients": dict(self.coefficients),
            "data_to_skin_mm": _summary(self.data_to_skin),
            "skin_to_data_mm": _summary(self.skin_to_data),
        }

    def shape_rows(self) -> dict[str, str]:
        """Returns the rows of a table about the shape: size, distances, largest coefficients."""
        strong = sorted(self.coefficients.items(), key=lambda one: -abs(one[1]))[:SHOWN]
        return {
            "shaped body": f"{self.size:.4g} m",
            "data to skin": _told(self.data_to_skin),
            "skin to data": _told(self.skin_to_data),
            "shape": ", ".join(f"{name} {value:+.2f}" for name, value in strong),
        }

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: frame, template, shape and verdict."""
        return {
            "frame": self.registration.tracking.name,
            "template": self.template,
            **self.shape_rows(),
            "verdict": str(self.registration.verdict),
        }


SHOWN = 5
"""Number of coefficients in the table."""


def _summary(distances: Array) -> dict[str, float]:
    millimetres = 1000.0 * distances
    return {
        "median": float(np.median(millimetres)),
        "mean": float(millimetres.mean()),
        "p95": float(np.percentile(millimetres, 95.0)),
    }


def _told(distances: Array) -> str:
    figures = _summary(distances)
    return f"{figures['median']:.1f} mm (median), 95 % within {figures['p95']:.1f} mm"

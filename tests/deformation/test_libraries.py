"""Deformations by other libraries: the same pose first, any unit, and all points move along."""

import importlib
import pickle

import numpy as np
import pytest
import scipy

import regkit
from regkit.deformation import InterpolatedDisplacements
from regkit.interfaces import Method
from regkit.system.errors import DataError, DependencyError

LIBRARIES = {
    "pycpd": "pycpd",
    "rustcpd": "rustcpd",
    "biocpd_deformable": "biocpd",
    "trimesh_nricp": "trimesh",
}


def method_of(kind: str, **options: float) -> Method:
    return Method.parse({"kind": kind, **options}, place="test", field="method")


def blob(random: np.random.Generator, count: int) -> np.ndarray:
    """Points on the surface of an ellipsoid with three different axes."""
    points = random.normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None] * [1.0, 0.6, 0.4]


def bent(points: np.ndarray) -> np.ndarray:
    x, y, z = points.T
    return np.column_stack([x, y, z + 0.15 * x**2])


@pytest.mark.parametrize("kind", LIBRARIES)
@pytest.mark.filterwarnings("default")  # Other libraries may warn of what they like.
def test_library_moves_a_cloud_closer_in_any_unit(random, kind):
    pytest.importorskip(LIBRARIES[kind])
    source, target = blob(random, 400), bent(blob(random, 400))
    found = [regkit.align(unit * source, unit * target, kind, start="nearest") for unit in (1, 1e3)]
    surface = scipy.spatial.KDTree(bent(blob(random, 50_000)))
    posed = found[0].aligned - found[0].displacements
    before, after = (surface.query(points)[0].mean() for points in (posed, found[0].aligned))
    assert after < 0.7 * before
    np.testing.assert_allclose(found[1].aligned / 1e3, found[0].aligned, atol=2e-3)


@pytest.mark.parametrize("kind", LIBRARIES)
@pytest.mark.filterwarnings("default")
def test_other_points_move_with_the_registered_ones(random, kind):
    pytest.importorskip(LIBRARIES[kind])
    source, target = blob(random, 300), bent(blob(random, 300))
    found = method_of(kind).deformed(source, target)
    moved = found.deformation.moved(source)
    near = source + 1e-4
    step = np.linalg.norm(found.deformation.moved(near) - moved, axis=1)
    assert step.max() < 20.0 * 1e-4
    assert found.probability.shape == (300,)
    again = pickle.loads(pickle.dumps(found.deformation))
    origin = np.array([4.0, -5.0, 6.0])
    np.testing.assert_allclose(again.shifted(origin).moved(source + origin), moved + origin)


@pytest.mark.parametrize("kind", ["pycpd", "rustcpd", "biocpd_deformable"])
@pytest.mark.filterwarnings("default")
def test_kernel_moves_the_source_as_the_library_does(random, kind):
    library = pytest.importorskip(LIBRARIES[kind])
    source, target = blob(random, 200), bent(blob(random, 200))
    own = method_of(kind).displaced(source, target)
    if kind == "rustcpd":
        expected = library.register_deformable(target, source, parallel=False).points
    else:
        expected = library.DeformableRegistration(X=target, Y=source).register()[0]
    np.testing.assert_allclose(source + own.moving.displacements(source), expected, atol=0.01)


def test_interpolation_passes_through_what_is_known(random):
    places, known = random.normal(size=(2, 80, 3))
    moving = InterpolatedDisplacements(places, known)
    np.testing.assert_allclose(moving.displacements(places), known, atol=1e-8)


@pytest.mark.parametrize("kind", LIBRARIES)
def test_missing_library_is_told_before_anything_runs(monkeypatch, linkage, kind):
    def missing(module, *_):
        raise ModuleNotFoundError(module, name=module.partition(".")[0])

    method = method_of(kind)
    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(DependencyError, match=r"is not installed; run: pip install"):
        method.bind(linkage)


def test_failure_of_a_library_is_told(monkeypatch, random):
    method = method_of("trimesh_nricp")

    def failing(*_):
        raise ValueError("no luck")

    monkeypatch.setattr(type(method), "displaced", failing)
    source = blob(random, 100)
    with pytest.raises(DataError, match="method 'trimesh_nricp' failed: ValueError: no luck"):
        method.deformed(source, source)

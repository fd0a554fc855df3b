"""The builds of the human template are those of the bodies that synthetic data have."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from regkit_plugins.templates.human import FILES, Human
from regkit_synthesis.bodies.bodies import ShippedBody
from regkit_synthesis.templates.human_layout import human_layout

BONES = [
    ("left_shoulder", "left_elbow"),
    ("right_elbow", "right_wrist"),
    ("left_hip", "left_knee"),
    ("right_knee", "right_ankle"),
    ("left_ankle", "left_foot"),
    ("left_hip", "right_hip"),
    ("spine", "neck"),
]


@cache
def _template(build):
    template = Human(build=build)
    return template.body(template.description().size.value)


@pytest.mark.parametrize("build", FILES)
def test_build_has_the_lengths_of_its_body(build):
    own = _template(build)
    rest = own.markers.place(own.place(own.skeleton.rest()).transforms)
    joints = dict(zip(own.markers.names, rest, strict=True))
    body = ShippedBody(name=build).body()
    true = {name: mark.position for name, mark in body.landmarks.items()}
    for start, end in BONES:
        length = np.linalg.norm(true[end] - true[start])
        assert np.linalg.norm(joints[end] - joints[start]) == pytest.approx(length, abs=0.002)


@pytest.mark.parametrize("build", FILES)
def test_build_has_the_height_and_the_surface_of_its_body(build):
    mesh = ShippedBody(name=build).body().mesh
    vertices = human_layout(mesh).neutral(mesh)
    own = _template(build)
    assert own.size == pytest.approx(np.ptp(vertices[:, 1]), abs=1e-4)
    surface = own.capsules.place(own.place(own.skeleton.rest()).transforms)
    distances = np.abs(surface.surface_distance(vertices))
    assert np.median(distances) < 0.006
    assert np.quantile(distances, 0.9) < 0.02 * own.size


@pytest.mark.parametrize("build", FILES)
def test_build_has_as_many_gaussians_as_the_paper(build):
    gaussians = _template(build).shapes
    assert (len(gaussians["sog"]), len(gaussians["gsog"])) == (58, 13)


def test_builds_differ_in_size():
    sizes = {build: _template(build).size for build in FILES}
    assert sizes["small"] < 1.5 < sizes["average"] < 1.7 < sizes["tall"]


def test_tall_body_is_its_own_mirror_image():
    mesh = ShippedBody(name="tall").body().mesh
    for label in mesh.labels:
        if label.startswith("Left"):
            mirrored = mesh.origin(label.replace("Left", "Right")) * [-1.0, 1.0, 1.0]
            assert np.allclose(mesh.origin(label), mirrored, atol=1e-4)

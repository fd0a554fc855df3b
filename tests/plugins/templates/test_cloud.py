"""Clouds as templates, and where their first pose is found."""

import numpy as np
import pytest
from places import DATA

from regkit.clouds import write_cloud
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.system.errors import DataError
from regkit_plugins.methods.coarse_to_fine.resolutions import voxel_downsampled_surface
from regkit_plugins.starts.exemplars import Exemplars
from regkit_plugins.templates.cloud import CloudTemplate
from regkit_synthesis.samples.mannequin import main

SAMPLE = DATA / "mannequin"


@pytest.fixture
def template(tmp_path, lump):
    write_cloud(tmp_path / "lump.npz", lump)
    return CloudTemplate(path=tmp_path / "lump.npz", markers={"tip": tuple(lump[3])})


def test_cloud_is_a_body_of_one_free_segment_about_its_middle(template, lump):
    body = template.body(template.given_size())
    assert body.name == "lump"
    assert body.skeleton.dofs == 6
    assert template.given_size() == pytest.approx(np.linalg.norm(np.ptp(lump, axis=0)))
    middle = rigid(np.eye(3), lump.mean(axis=0))
    transforms = body.place(body.skeleton.rest(middle)).transforms
    np.testing.assert_allclose(body.surface.place(transforms), lump, atol=1e-12)
    np.testing.assert_allclose(body.markers.place(transforms)[0], lump[3])


def test_placed_surface_moves_with_the_body(template):
    body = template.body(1.0)
    pose = body.skeleton.rest(rigid(vector_to_matrix(np.array([0.1, 0.9, 0.2])), np.ones(3)))
    motion = rigid(vector_to_matrix(np.array([1.0, 0.2, -0.3])), np.array([0.0, 2.0, 1.0]))
    there = body.skeleton.rest(motion @ pose.root)
    np.testing.assert_allclose(
        body.surface.place(body.place(there).transforms),
        transformed(motion, body.surface.place(body.place(pose).transforms)),
    )


@pytest.mark.parametrize("turn", [[0.0, 0.0, 0.0], [0.5, 2.5, -0.7], [3.0, 0.3, 0.1]])
def test_start_is_found_in_any_orientation(template, lump, turn):
    """Of the lump only one side is seen."""
    truth = rigid(vector_to_matrix(np.array(turn)), np.array([0.3, 0.1, 2.0]))
    middle = rigid(np.eye(3), lump.mean(axis=0))
    seen = transformed(truth, lump)
    seen = seen[seen[:, 2] < seen[:, 2].mean() + 0.02]
    start = Exemplars().find(template, [Observation(seen, np.ones(len(seen)), np.ones(len(seen)))])
    off = np.linalg.norm(
        start.body.surface.place(start.body.place(start.pose).transforms)
        - transformed(truth @ middle, lump - lump.mean(axis=0)),
        axis=1,
    )
    assert off.mean() < 0.03


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (None, "there is no such file"),
        ("1 2 3\n", "the cloud has 1 different points of 1; at least 10 are needed"),
        ("words\nand more\n", "a.txt:2: the file contains no points"),
    ],
)
def test_cloud_that_cannot_be_is_told(tmp_path, content, expected):
    path = tmp_path / "a.txt"
    if content is not None:
        path.write_text(content)
    with pytest.raises(DataError) as caught:
        CloudTemplate(path=path).description()
    assert expected in str(caught.value)


def test_thinned_surface_keeps_points_on_their_segments(linkage, random):
    from dataclasses import replace

    from regkit.alignment import cloud_body

    surface = cloud_body("c", random.normal(size=(400, 3))).surface
    owners = random.integers(0, 3, size=(400, 1))
    thin = voxel_downsampled_surface(replace(surface, segments=owners), 0.5)
    assert len(thin) < 400
    assert set(thin.segments[:, 0]) == {0, 1, 2}
    for segment in range(3):
        own = thin.points[thin.segments[:, 0] == segment, 0]
        cells = np.floor((own + 1e-9) / 0.5)
        assert len(np.unique(cells, axis=0)) == len(own)


def test_sample_is_what_its_maker_makes(tmp_path):
    pytest.importorskip("open3d")
    main(tmp_path)
    made = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*") if path.is_file())
    assert len(made) == 11
    for name in made:
        assert (tmp_path / name).read_bytes() == (SAMPLE / name).read_bytes(), name

"""Skinned surfaces: linear blend skinning, the templates' meshes, and what is wrong with a file."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.fitting.skin import decimated, on_segments
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface, surface_in, vertex_normals
from regkit.system.errors import DataError
from regkit.system.optional import load_library
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human
from regkit_synthesis.assets import average_hand, average_human
from regkit_synthesis.templates.hand_layout import hand_layout
from regkit_synthesis.templates.human_layout import human_layout
from regkit_synthesis.templates.mirror import reflected

BODIES = [Human(), Hand(side="right"), Hand(side="left")]


def body_of(template, size=None):
    return template.body(template.description().size.value if size is None else size)


def posed(body, random):
    bones = body.skeleton
    start = bones.rest(rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3)))
    return body.place(bones.retract(start, 0.3 * random.normal(size=bones.dofs))).transforms


@pytest.mark.parametrize("source", ["anny_body", "anny_body_cmu_rig", "anny_hand_R"])
def test_place_reproduces_the_posed_vertices_of_anny(reference_data, source):
    """With anny's own bones for segments, to a hundredth of a millimetre."""
    data = np.load(reference_data / "anny_cc0" / f"{source}.npz")
    for shape, bone_poses, expected in zip(
        data["posed_shape_id"], data["posed_bone_poses"], data["posed_vertices"], strict=True
    ):
        mesh = SkinnedMesh(
            data["rest_vertices"][shape].astype(float),
            data["faces"].astype(np.intp),
            tuple(data["labels"]),
            data["parents"].astype(np.intp),
            data["rest_bone_poses"][shape].astype(float),
            data["skin_i"].astype(np.intp),
            data["skin_w"].astype(float),
        )
        placed = SkinnedSurface.of(mesh).place(bone_poses.astype(float))
        assert np.abs(placed - expected).max() < 1e-5


@pytest.mark.parametrize("template", BODIES, ids=lambda t: t.kind)
def test_place_moves_with_the_whole_body(template, random):
    body = body_of(template)
    transforms = posed(body, random)
    motion = rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3))
    np.testing.assert_allclose(
        body.surface.place(motion @ transforms),
        body.surface.place(transforms) @ motion[:3, :3].T + motion[:3, 3],
        atol=1e-12,
    )


@pytest.mark.parametrize("template", BODIES, ids=lambda t: t.kind)
def test_surface_scales_with_the_body(template, random):
    small, large = body_of(template, 0.5), body_of(template, 1.0)
    bones = small.skeleton
    step = 0.3 * random.normal(size=bones.dofs)
    step[:3] = 0.0
    placed = [
        one.surface.place(one.place(one.skeleton.retract(one.skeleton.rest(), step)).transforms)
        for one in (small, large)
    ]
    np.testing.assert_allclose(2.0 * placed[0], placed[1], atol=1e-12)


@pytest.mark.parametrize("template", BODIES, ids=lambda t: t.kind)
def test_surface_is_that_of_the_capsules(template):
    """Mesh and capsules were fitted to the same body: most of the one lies on the other."""
    body = body_of(template)
    transforms = body.place(body.stances[-1].pose).transforms
    gaps = np.abs(body.capsules.place(transforms).surface_distance(body.surface.place(transforms)))
    assert np.median(gaps) < 0.006 * body.size
    assert np.quantile(gaps, 0.95) < 0.04 * body.size


def test_left_hand_is_the_mirror_image_of_the_right_one():
    right, left = (body_of(Hand(side=side)) for side in ("right", "left"))
    for mine, other in zip(right.stances, left.stances, strict=True):
        np.testing.assert_allclose(
            left.surface.place(left.place(other.pose).transforms),
            right.surface.place(right.place(mine.pose).transforms) * [-1.0, 1.0, 1.0],
            atol=1e-7,
        )


@pytest.mark.parametrize("template", BODIES, ids=lambda t: t.kind)
def test_normals_point_outward(template):
    """The volume that the faces enclose is positive, and normals agree with the faces."""
    body = body_of(template)
    transforms = body.place(body.skeleton.rest()).transforms
    vertices = body.surface.place(transforms)
    first, second, third = vertices[body.surface.faces].transpose(1, 0, 2)
    assert (first * np.cross(second, third)).sum() > 0.0
    carriers = transforms[body.surface.segments[:, 0], :3, :3]
    normals = (carriers @ body.surface.normals[:, 0, :, None])[:, :, 0]
    agreement = (normals * vertex_normals(vertices, body.surface.faces)).sum(axis=1)
    assert np.quantile(agreement, 0.05) > 0.7


@pytest.mark.parametrize(
    ("make", "layout", "template", "count", "mean", "largest"),
    [
        (average_human, human_layout, Human(), 1500, 2.0e-3, 12e-3),
        (average_hand, hand_layout, Hand(), 800, 0.3e-3, 2e-3),
    ],
)
def test_decimated_mesh_is_near_the_full_one(make, layout, template, count, mean, largest):
    """Its vertices are vertices of the full mesh, whose others are near its triangles."""
    mesh = make()
    full = decimated(on_segments(mesh, layout(mesh), template.description()), len(mesh.vertices))
    found = decimated(full, count)
    assert len(found.vertices) == count
    assert set(map(tuple, found.vertices)) <= set(map(tuple, full.vertices))
    assert set(found.faces.ravel()) == set(range(count))
    distances = distance_to(full, found)
    assert distances.mean() < mean
    assert distances.max() < largest


def distance_to(mesh, other):
    """How far each vertex of a mesh at rest is from the surface of another, (V,) [m]."""
    library = load_library("open3d")
    scene = library.t.geometry.RaycastingScene()
    scene.add_triangles(
        library.core.Tensor(other.vertices.astype(np.float32)),
        library.core.Tensor(other.faces.astype(np.uint32)),
    )
    query = library.core.Tensor(mesh.vertices.astype(np.float32))
    return scene.compute_distance(query).numpy()


CUBE = SkinnedMesh(
    vertices=np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]),
    faces=np.array([
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]),
    labels=("base", "arm"),
    parents=np.array([-1, 0]),
    rest=np.tile(np.eye(4), (2, 1, 1)),
    indices=np.tile([0, 1], (8, 1)),
    weights=np.tile([0.75, 0.25], (8, 1)),
)  # fmt: skip


def test_mesh_is_written_as_it_is_read(tmp_path):
    CUBE.write(tmp_path / "cube.npz")
    again = SkinnedMesh.read(tmp_path / "cube.npz")
    for one, other in zip(vars(CUBE).values(), vars(again).values(), strict=True):
        np.testing.assert_array_equal(one, other)


def test_reflected_mesh_faces_outward():
    normals = vertex_normals(*(getattr(reflected(CUBE), name) for name in ("vertices", "faces")))
    assert (normals * (reflected(CUBE).vertices - [-0.5, 0.5, 0.5])).sum(axis=1).min() > 0.0


def test_stretched_bones_carry_their_skin_and_their_children(random):
    """In its own frame a bone stretches the vertices that follow it alone, and nothing else."""
    rest = rigid(vector_to_matrix(random.normal(size=(2, 3))), random.normal(size=(2, 3)))
    weights = np.array([[1.0, 0.0]] * 4 + [[0.0, 1.0]] * 4)
    mesh = replace(CUBE, rest=rest, weights=weights)
    matrices = np.array([np.diag([2.0, 1.0, 0.5]), np.diag([1.0, 3.0, 1.0])])
    found = mesh.stretched(matrices)
    np.testing.assert_allclose(found.rest[:, :3, :3], rest[:, :3, :3])
    for bone, own in ((0, slice(0, 4)), (1, slice(4, 8))):
        before, after = (
            transformed(inverse(one.rest[bone]), one.vertices[own]) for one in (mesh, found)
        )
        np.testing.assert_allclose(after, before @ matrices[bone].T, atol=1e-12)
    ways = [transformed(inverse(one.rest[0]), one.rest[1:, :3, 3]) for one in (mesh, found)]
    np.testing.assert_allclose(ways[1], ways[0] @ matrices[0].T, atol=1e-12)


def described(linkage_text, tmp_path, mesh):
    mesh.write(tmp_path / "skin.npz")
    (tmp_path / "linkage.yaml").write_text(f"{linkage_text}mesh: skin.npz\n")
    return Document.read(tmp_path / "linkage.yaml").validated(BodyDescription)


def test_template_finds_its_mesh_beside_it(linkage_text, tmp_path):
    """Bones are told apart by their names, in whatever order they stand."""
    other_order = replace(CUBE, labels=("arm", "base"), indices=1 - CUBE.indices)
    surfaces = [
        described(linkage_text, tmp_path / name, mesh).body("linkage", 2.0).surface
        for name, mesh in (("one", CUBE), ("other", other_order))
    ]
    np.testing.assert_array_equal(surfaces[0].segments, surfaces[1].segments)
    np.testing.assert_allclose(surfaces[0].points[:, 0], 2.0 * CUBE.vertices)


def test_bone_that_is_no_segment_is_named(linkage_text, tmp_path):
    wrong = replace(CUBE, labels=("base", "Arm"))
    with pytest.raises(DataError, match=r"bone 'Arm' is not a segment.*did you mean 'arm'") as told:
        described(linkage_text, tmp_path, wrong).body("linkage", 1.0)
    assert "skin.npz" in str(told.value)


def test_missing_mesh_is_named(tmp_path):
    with pytest.raises(DataError, match="no such file"):
        surface_in(tmp_path / "none.npz", ("base",))

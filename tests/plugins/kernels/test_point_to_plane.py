"""Laws of surfels and of the kernels that match data with them, point to point and to plane."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.surface import SkinnedSurface
from regkit.interfaces import Response, Similarity
from regkit.observation import Frame, Observation
from regkit.registration import COORDINATES, RegistrationProblem, Robust
from regkit.system.errors import ConfigError
from regkit_plugins.kernels.point_to_plane.point_to_plane import PointToPlane
from regkit_plugins.kernels.point_to_plane.visible import visible
from regkit_plugins.kernels.point_to_point import PointToPoint
from regkit_plugins.methods.direct.direct import Direct
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.shapes.mesh import Mesh
from regkit_plugins.solvers.gauss_newton import GaussNewton
from regkit_plugins.templates.human import Human
from regkit_plugins.terms.intersection import Intersection
from regkit_plugins.terms.visibility import Visibility

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)


@pytest.fixture
def skinned(linkage, random):
    """The linkage in a skin whose points follow up to three segments, and face anywhere."""
    segments, count = len(linkage.skeleton.names), 60
    bones = np.array([random.permutation(segments)[:3] for _ in range(count)])
    blend = random.dirichlet(np.ones(3), size=count)
    blend[: count // 3] = [1.0, 0.0, 0.0]
    transforms = linkage.place(linkage.skeleton.rest()).transforms
    vertices = transforms[bones[:, 0], :3, 3] + random.normal(size=(count, 3)) * [0.2, 0.1, 0.15]
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    inverse = np.linalg.inv(transforms)[bones]
    surface = SkinnedSurface(
        segments=bones,
        points=np.einsum("vaij,vj->vai", inverse[..., :3, :3], vertices) + inverse[..., :3, 3],
        blend=blend,
        normals=np.einsum("vaij,vj->vai", inverse[..., :3, :3], normals),
        faces=np.zeros((0, 3), dtype=np.intp),
    )
    return replace(linkage, surface=surface)


def scene(body, random):
    """A posed body before the camera, and anisotropic data with normals about it."""
    bones = body.skeleton
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.2, -0.1, 2.0]))
    start = bones.retract(bones.rest(root), 0.4 * random.normal(size=bones.dofs))
    surfels = Mesh().bind(body)
    middle = surfels.place(body.place(start).transforms).centres.mean(axis=0)
    points = middle + random.normal(size=(150, 3)) * [0.3, 0.2, 0.15]
    normals = random.normal(size=(150, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    weights = random.uniform(0.5, 2.0, 150)
    return start, surfels, Observation(points, weights, np.full(150, 1e-4), CAMERA, None, normals)


class Springs(Similarity):
    """Any wrench on any surfel: a quadratic energy of positions and normals."""

    def __init__(self, random, count):
        self.places, self.ways = random.normal(size=(2, count, 3))

    def __call__(self, placed, *, curvature=False):
        offsets, normals = placed.centres - self.places, placed.axes[:, :, 2]
        along = (offsets * normals).sum(axis=1, keepdims=True)
        wrenches = np.concatenate(
            [offsets + along * normals, along * np.cross(normals, offsets)], axis=1
        )
        wrenches[:, 3:] += np.cross(normals, self.ways)
        energy = 0.5 * (offsets**2).sum() + 0.5 * (along**2).sum() + (normals * self.ways).sum()
        return Response(float(energy), wrenches, np.tile(np.eye(6), (len(placed), 1, 1)))


def differences(problem, x, step=1e-6):
    return np.array(
        [
            problem.value_and_gradient(x + step * e)[0]
            - problem.value_and_gradient(x - step * e)[0]
            for e in np.eye(len(x))
        ]
    ) / (2 * step)


@pytest.mark.parametrize("coordinates", COORDINATES)
def test_forces_on_blended_points_and_normals_are_pulled_back_exactly(skinned, random, coordinates):
    start, surfels, _ = scene(skinned, random)
    chart = COORDINATES[coordinates](skinned.skeleton, start)
    problem = RegistrationProblem(chart, surfels, {"springs": Springs(random, len(surfels))})
    x = problem.start + 0.2 * random.normal(size=len(problem.start))
    _, gradient = problem.value_and_gradient(x)
    np.testing.assert_allclose(
        gradient, differences(problem, x), atol=1e-6 * np.abs(gradient).max()
    )


def unblended(body):
    """The same skin, whose points follow one segment each."""
    skin = body.surface
    alone = replace(
        skin,
        segments=skin.segments[:, :1],
        points=skin.points[:, :1],
        blend=np.ones((len(skin), 1)),
        normals=skin.normals[:, :1],
    )
    return replace(body, surface=alone)


def test_normal_matrix_is_that_of_the_residuals(skinned, random):
    """J^T W J by brute force, with the derivatives of the residuals by finite differences."""
    skinned = unblended(skinned)
    start, surfels, data = scene(skinned, random)
    bones = skinned.skeleton
    kernel = PointToPlane(
        point_share=0.3,
        max_correspondence_distance=1e6,
        matches="fixed",
        robust=Robust(loss="squares", scale=1.0),
    )
    data = replace(data, normals=None, camera=None)
    placed = surfels.place(skinned.place(start).transforms)
    similarity = kernel.bind(data, placed)
    chart = COORDINATES["tangent"](bones, start)
    _, _, matrix = RegistrationProblem(chart, surfels, {"kernel": similarity}).normal_equations(
        np.zeros(bones.dofs)
    )
    nearest = np.linalg.norm(data.points[:, None] - placed.centres, axis=2).argmin(axis=1)

    def residuals(step):
        moved = surfels.place(skinned.place(bones.retract(start, step)).transforms)
        offsets = data.points - moved.centres[nearest]
        along = (offsets * moved.axes[nearest, :, 2]).sum(axis=1)
        parts = [np.sqrt(0.7) * along, *(np.sqrt(0.3) * offsets.T)]
        return np.concatenate([np.sqrt(data.weights / data.weights.sum()) * part for part in parts])

    columns = [residuals(1e-6 * e) - residuals(-1e-6 * e) for e in np.eye(bones.dofs)]
    jacobian = np.array(columns).T / 2e-6
    np.testing.assert_allclose(matrix, jacobian.T @ jacobian, atol=1e-7 * np.abs(matrix).max())


def test_surfels_of_one_segment_each_feel_what_rigid_primitives_feel(skinned, random):
    """Blending adds nothing where there is nothing to blend."""
    start, surfels, _ = scene(unblended(skinned), random)
    placement = skinned.place(start)
    placed = surfels.place(placement.transforms)
    rigidly = super(type(surfels), surfels).place(placement.transforms)
    np.testing.assert_allclose(placed.centres, rigidly.centres, atol=1e-12)
    np.testing.assert_allclose(placed.axes, rigidly.axes, atol=1e-12)
    wrenches = random.normal(size=(len(surfels), 6))
    # A surfel does not spin about its normal.
    normals = placed.axes[:, :, 2]
    wrenches[:, 3:] -= (wrenches[:, 3:] * normals).sum(axis=1, keepdims=True) * normals
    segments = len(skinned.skeleton.names)
    np.testing.assert_allclose(
        placed.accumulate(wrenches, segments), rigidly.accumulate(wrenches, segments), atol=1e-12
    )
    blocks = wrenches[:, :, None] * wrenches[:, None, :]
    np.testing.assert_allclose(
        placed.accumulate_stiffness(blocks, segments),
        rigidly.accumulate_stiffness(blocks, segments),
        atol=1e-11,
    )


def person(random):
    """A person who stands before the camera, and the points of the body that it sees."""
    body = Human().body(1.7)
    turn = np.diag([1.0, -1.0, -1.0])
    pose = body.skeleton.rest(rigid(turn, np.array([0.0, -0.1, 3.0])))
    surfels = Mesh().bind(body)
    placed = surfels.place(body.place(pose).transforms)
    points = placed.centres[visible(placed)]
    return body, pose, surfels, PointsPreprocessor(sigma=0.01).preprocess(Frame(points, CAMERA))


def test_camera_sees_the_front_and_nothing_behind_it(random):
    body, pose, surfels, _ = person(random)
    placed = surfels.place(body.place(pose).transforms)
    shown = visible(placed)
    assert 0.3 * len(placed) < len(shown) < 0.55 * len(placed)
    towards = -(placed.axes[shown, :, 2] * placed.centres[shown]).sum(axis=1)
    assert towards.min() > 0.0
    # A second person right behind the first is hidden.
    behind = replace(placed, centres=placed.centres * 1.2)
    both = replace(
        placed,
        centres=np.concatenate([placed.centres, behind.centres]),
        axes=np.concatenate([placed.axes, behind.axes]),
    )
    seen = visible(both)
    assert (seen < len(placed)).mean() > 0.95


@pytest.mark.parametrize("kernel", [PointToPoint(), PointToPlane()], ids=lambda kernel: kernel.kind)
def test_solver_finds_the_pose_of_the_data(random, kernel):
    """From 3 cm and some degrees beside it; points to points take longer."""
    body, pose, _, data = person(random)
    step = 0.06 * random.normal(size=body.skeleton.dofs)
    step[:3] = [0.02, -0.02, 0.01]
    start = body.skeleton.limits.projected(body.skeleton.retract(pose, step))
    method = Direct(shape=Mesh(), kernel=kernel, solver=GaussNewton(max_iterations=40))
    found = method.bind(body).register(data, [start])
    markers = [body.markers.place(body.place(one).transforms) for one in (pose, start, found.pose)]
    before, after = (np.linalg.norm(m - markers[0], axis=1).mean() for m in markers[1:])
    assert after < 0.2 * before
    assert found.inlier_share > 0.95


def test_points_are_explained_where_the_surfels_are_and_nowhere_else(random):
    body, pose, surfels, data = person(random)
    placed = surfels.place(body.place(pose).transforms)
    strange = np.array([[1.0, 0.0, 2.5], [0.0, 0.0, 2.0]])
    data = PointsPreprocessor(sigma=0.01).preprocess(
        Frame(np.concatenate([data.points, strange]), CAMERA)
    )
    explained = PointToPlane().bind(data, placed).inlier_probability(placed)
    np.testing.assert_allclose(explained[:-2], 1.0, atol=1e-9)
    np.testing.assert_array_equal(explained[-2:], 0.0)


def test_point_that_faces_elsewhere_has_no_partner(random):
    body, pose, surfels, data = person(random)
    placed = surfels.place(body.place(pose).transforms)
    # Data's normals may point to either side.
    signs = random.choice([-1.0, 1.0], size=(len(data.points), 1))
    normals = signs * placed.axes[visible(placed), :, 2]
    normals[0] = np.roll(normals[0], 1)
    data = replace(data, normals=normals)
    for kernel in (PointToPoint(angle_deg=60), PointToPlane(angle_deg=60)):
        explained = kernel.bind(data, placed).inlier_probability(placed)
        assert explained[0] == 0.0
        assert (explained[1:] > 0.99).all()


def test_preprocessor_gives_normals_of_a_plane(random):
    normal = np.array([0.6, 0.0, -0.8])
    flat = np.linalg.svd(normal[None])[2][1:]
    points = random.uniform(-0.5, 0.5, size=(300, 2)) @ flat + [0.0, 0.0, 2.0]
    seen = PointsPreprocessor(normals=8).preprocess(Frame(points, CAMERA))
    np.testing.assert_allclose(np.abs(seen.normals @ normal), 1.0, atol=1e-9)
    assert PointsPreprocessor().preprocess(Frame(points, CAMERA)).normals is None


def test_missing_normals_are_told(skinned, random):
    start, surfels, data = scene(skinned, random)
    placed = surfels.place(skinned.place(start).transforms)
    for kernel in (PointToPlane(normals="data"), PointToPoint(angle_deg=60)):
        with pytest.raises(ConfigError, match=r"preprocessor\.normals"):
            kernel.bind(replace(data, normals=None), placed)


def test_body_without_a_mesh_is_told(linkage):
    with pytest.raises(ConfigError, match="'linkage' has no mesh"):
        Mesh().bind(linkage)


@pytest.mark.parametrize("term", [Visibility(), Intersection()], ids=lambda term: term.kind)
def test_terms_of_solid_primitives_refuse_a_mesh(term):
    with pytest.raises(ValueError, match=f"term '{term.kind}' looks at Volumes"):
        Direct(shape=Mesh(), kernel=PointToPlane(), solver=GaussNewton(), terms=(term,))


@pytest.mark.parametrize("reverse_weight", [0.0, 0.5])
def test_whitened_residuals_are_those_of_the_points(skinned, random, reverse_weight):
    """Each point has its own, in its place; one without a correspondence has none."""
    start, surfels, data = scene(skinned, random)
    placed = surfels.place(skinned.place(start).transforms)
    kernel = PointToPlane(reverse_weight=reverse_weight, noise=3.0, robust=Robust(loss="tukey"))
    residuals, shares = kernel.bind(data, placed).whitened(placed)
    assert residuals.shape == (150, 1)
    assert 0.0 < shares.mean() < 1.0
    assert (residuals[shares == 0.0] == 0.0).all()
    few = replace(
        data,
        points=data.points[::2],
        weights=data.weights[::2],
        variances=data.variances[::2],
        normals=data.normals[::2],
    )
    found, some = kernel.bind(few, placed).whitened(placed)
    np.testing.assert_allclose(found, residuals[::2], atol=1e-9)
    np.testing.assert_array_equal(some, shares[::2])

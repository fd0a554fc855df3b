"""Body models in the layout of SMPL: what is read, and how the imported template moves."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy
from body_models import (
    Instance,
    body_arrays,
    chumpy,
    posed,
    python2_pickle,
    python3_pickle,
    sparse,
    tree_of,
    write_npz,
)

from regkit.body import BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.body.template_file import write_template
from regkit.config.document import Document
from regkit.fitting.body_model import body_model_template
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import from_matrix, from_vector, to_matrix
from regkit.interchange.body_model.joints import family_of
from regkit.interchange.body_model.smpl import BodyModel
from regkit.interchange.imported import ImportedSkeleton
from regkit.skeleton import Pose
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

UPRIGHT = np.eye(3)


@pytest.fixture(scope="module")
def imported(tmp_path_factory) -> ImportedSkeleton:
    path = tmp_path_factory.mktemp("body") / "model.npz"
    return body_model_template(write_npz(path, body_arrays()))


def shaped(model: BodyModel, betas: np.ndarray):
    """The skin of a model with coefficients: its modes are displacements at rest."""
    modes, mesh = model.modes, model.mesh
    assert modes is not None
    rest = mesh.rest.copy()
    rest[:, :3, 3] += np.tensordot(betas, modes.joints, 1)
    return replace(mesh, vertices=mesh.vertices + np.tensordot(betas, modes.vertices, 1), rest=rest)


def world_rotations(rotations: np.ndarray, parents: list[int]) -> np.ndarray:
    world = rotations.copy()
    for joint, parent in enumerate(parents):
        if parent >= 0:
            world[joint] = world[parent] @ rotations[joint]
    return world


def random_rotations(random: np.random.Generator, count: int) -> np.ndarray:
    return to_matrix(from_vector(0.7 * random.normal(size=(count, 3))))


@pytest.mark.parametrize("family", ["SMPL", "SMPL-H", "SMPL-X"])
def test_shaped_and_posed_vertices_are_those_of_the_formula(tmp_path, random, family):
    arrays = body_arrays(family)
    model = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    names, parents = tree_of(family)
    assert (model.family, model.mesh.labels) == (family, tuple(names))
    for _ in range(3):
        betas, trans = random.normal(size=3), random.normal(size=3)
        rotations = random_rotations(random, len(names))
        vertices, joints = posed(arrays, betas, rotations, trans)
        skin = shaped(model, betas)
        # The root of SMPL turns about its own joint.
        poses = skin.rotated(world_rotations(rotations, parents), joints[0])
        np.testing.assert_allclose(poses[:, :3, 3], joints, atol=1e-12)
        np.testing.assert_allclose(skin.posed(poses), vertices, atol=1e-12)


def test_the_template_moves_as_the_model_does(tmp_path, random, imported):
    arrays = body_arrays()
    out = tmp_path / "body.yaml"
    write_template(out, imported.description, imported.skin, "Made.", {}, imported.modes)
    body = (
        Document.read(out).validated(BodyDescription).body("body", imported.description.size.value)
    )
    assert body.surface is not None
    names, _ = tree_of("SMPL")
    rotations, trans = random_rotations(random, len(names)), random.normal(size=3)
    vertices, joints = posed(arrays, np.zeros(3), rotations, trans)
    order = [names.index(name) for name in body.skeleton.names]
    rest = body.skeleton.rest()
    quaternions = from_matrix(rotations[order])
    pose = Pose(rigid(rotations[0], joints[0]), quaternions[1:], rest.hinges)
    placed = body.place(pose).transforms
    # Offsets in the file are rounded to 0.1 mm.
    np.testing.assert_allclose(placed[:, :3, 3], joints[order], atol=5e-4)
    np.testing.assert_allclose(body.surface.place(placed), vertices, atol=1e-3)
    np.testing.assert_allclose(body.markers.place(placed), placed[:, :3, 3], atol=1e-9)


def test_a_template_of_other_proportions_has_no_modes(tmp_path, imported):
    out = tmp_path / "body.yaml"
    write_template(out, imported.description, imported.skin, "Made.", {}, imported.modes)
    description = Document.read(out).validated(BodyDescription)
    assert description.modes == tmp_path / "body_modes.npz"
    groups = Groups.of(description)
    factors = np.full(len(groups.names), 1.1)
    stretched = Proportions(groups, factors, factors).applied(description)
    assert (stretched.mesh, stretched.modes) == (None, None)


def test_axes_and_units_of_a_file_are_taken_into_account(tmp_path):
    arrays = body_arrays()
    straight = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    R_file_body = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    turned = {
        **arrays,
        "v_template": 100.0 * arrays["v_template"] @ R_file_body.T,
        "shapedirs": 100.0 * np.einsum("ab,vbk->vak", R_file_body, arrays["shapedirs"]),
    }
    path = write_npz(tmp_path / "turned.npz", turned)
    imported = body_model_template(path, scale=0.01, up="z", front="x")
    assert imported.modes is not None
    assert straight.modes is not None
    np.testing.assert_allclose(imported.skin.vertices, straight.mesh.vertices, atol=1e-12)
    np.testing.assert_allclose(imported.modes.vertices, straight.modes.vertices, atol=1e-12)
    np.testing.assert_allclose(imported.modes.joints, straight.modes.joints, atol=1e-12)


def forms(arrays: dict) -> dict[str, bytes]:
    """The same model as files of several programs."""
    old = {
        **arrays,
        "shapedirs": chumpy(arrays["shapedirs"]),
        "J_regressor": sparse(arrays["J_regressor"]),
        "weights": Instance(
            "chumpy.reordering",
            "Select",
            {
                "a": chumpy(np.append(arrays["weights"].ravel(), 7.0)),
                "idxs": np.arange(arrays["weights"].size),
                "preferred_shape": arrays["weights"].shape,
            },
        ),
        "bs_style": "lbs",
        "posedirs_note": "Ümlaut".encode("latin1"),
    }
    matrices = {
        protocol: {**arrays, "J_regressor": made(arrays["J_regressor"])}
        for protocol, made in (
            (2, scipy.sparse.csc_matrix),
            (3, scipy.sparse.csr_matrix),
            (4, scipy.sparse.coo_matrix),
            (5, scipy.sparse.csc_array),
        )
    }
    matrices[4]["f"] = np.asfortranarray(arrays["f"].astype(">i8"))
    return {"python 2": python2_pickle(old)} | {
        f"protocol {protocol}": python3_pickle(values, protocol, as_chumpy="shapedirs")
        for protocol, values in matrices.items()
    }


@pytest.mark.parametrize("form", list(forms(body_arrays())))
def test_pickles_of_old_and_new_programs_hold_the_same_model(tmp_path, form):
    arrays = body_arrays()
    expected = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    path = tmp_path / "model.pkl"
    path.write_bytes(forms(arrays)[form])
    assert same(BodyModel.read(path, UPRIGHT), expected)


def test_python_objects_in_an_archive_are_read_as_data(tmp_path):
    arrays = body_arrays()
    expected = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    matrix = scipy.sparse.csc_matrix(arrays["J_regressor"])
    packed = write_npz(tmp_path / "packed.npz", {**arrays, "J_regressor": np.array(matrix)})
    assert same(BodyModel.read(packed, UPRIGHT), expected)
    # The content decides, not the suffix.
    assert same(BodyModel.read(packed.rename(tmp_path / "packed.pkl"), UPRIGHT), expected)


def test_an_array_that_chumpy_computes_is_told(tmp_path):
    added = Instance("chumpy.ch", "add", {"a": chumpy(np.zeros(3)), "b": chumpy(np.zeros(3))})
    path = tmp_path / "model.pkl"
    path.write_bytes(python2_pickle({**body_arrays(), "weights": added}))
    with pytest.raises(DataError, match=r"weights is computed by 'chumpy.ch.add'"):
        BodyModel.read(path, UPRIGHT)


def same(model: BodyModel, other: BodyModel) -> bool:
    assert model.modes is not None
    assert other.modes is not None
    pairs = [
        (getattr(one, name), getattr(two, name))
        for one, two, names in (
            (
                model.mesh,
                other.mesh,
                ("vertices", "faces", "parents", "rest", "indices", "weights"),
            ),
            (model.modes, other.modes, ("joints", "vertices", "mean", "covariance", "bounds")),
        )
        for name in names
    ]
    return model.mesh.labels == other.mesh.labels and all(
        np.array_equal(one, two) for one, two in pairs
    )


@pytest.mark.parametrize(
    ("family", "parents"),
    [
        ("SMPL", "-1 0 0 0 1 2 3 4 5 6 7 8 9 9 9 12 13 14 16 17 18 19 20 21"),
        (
            "SMPL-H",
            "-1 0 0 0 1 2 3 4 5 6 7 8 9 9 9 12 13 14 16 17 18 19 20 22 23 20 25 26 20 28 29 20 31 "
            "32 20 34 35 21 37 38 21 40 41 21 43 44 21 46 47 21 49 50",
        ),
        (
            "SMPL-X",
            "-1 0 0 0 1 2 3 4 5 6 7 8 9 9 9 12 13 14 16 17 18 19 15 15 15 20 25 26 20 28 29 20 31 "
            "32 20 34 35 20 37 38 21 40 41 21 43 44 21 46 47 21 49 50 21 52 53",
        ),
        ("MANO", "-1 0 1 2 0 4 5 0 7 8 0 10 11 0 13 14"),
        ("FLAME", "-1 0 1 1 1"),
    ],
)
def test_the_trees_of_known_models_are_told(family, parents):
    assert family_of([int(parent) for parent in parents.split()]) == family


def test_joints_that_are_no_known_model_have_the_names_of_the_file_or_numbers(tmp_path):
    arrays = body_arrays()
    count = 7
    arrays["kintree_table"] = arrays["kintree_table"][:, :count]
    arrays["weights"] = arrays["weights"][:, :count] + 1e-3
    arrays["weights"] /= arrays["weights"].sum(axis=1, keepdims=True)
    arrays["J_regressor"] = arrays["J_regressor"][:count]
    model = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    assert (model.family, model.mesh.labels[:2]) == (None, ("joint_0", "joint_1"))
    named = {**arrays, "joint2num": {f"bone {n}": n for n in range(count)}}
    model = BodyModel.read(write_npz(tmp_path / "named.npz", named), UPRIGHT)
    assert model.mesh.labels[:2] == ("bone 0", "bone 1")
    imported = body_model_template(tmp_path / "named.npz")
    joints = [one.joint for one in imported.description.segments.values()][1:]
    assert all(joint is not None and joint.swing_deg is None for joint in joints)
    assert not imported.description.upright
    assert not imported.description.stances


def test_joints_in_any_order_are_put_parents_first(tmp_path, random):
    arrays = body_arrays()
    straight = BodyModel.read(write_npz(tmp_path / "model.npz", arrays), UPRIGHT)
    order = np.concatenate([[0], 1 + random.permutation(23)])
    mixed = {
        **arrays,
        "kintree_table": arrays["kintree_table"][:, order].astype(np.int64),
        "weights": arrays["weights"][:, order],
        "J_regressor": arrays["J_regressor"][order],
        "joint2num": {tree_of("SMPL")[0][joint]: n for n, joint in enumerate(order)},
    }
    model = BodyModel.read(write_npz(tmp_path / "mixed.npz", mixed), UPRIGHT)
    assert all(parent < joint for joint, parent in enumerate(model.mesh.parents))
    place = [model.mesh.labels.index(label) for label in straight.mesh.labels]
    np.testing.assert_array_equal(model.mesh.rest[place], straight.mesh.rest)
    assert [model.mesh.labels[n] if n >= 0 else "" for n in model.mesh.parents[place]] == [
        straight.mesh.labels[n] if n >= 0 else "" for n in straight.mesh.parents
    ]


def test_stances_and_the_rest_pose_are_within_the_limits(tmp_path):
    description = body_model_template(
        write_npz(tmp_path / "m.npz", body_arrays("SMPL-X"))
    ).description
    body = description.body("body", description.size.value)
    assert {"relaxed", "sitting"} <= {stance.name for stance in body.stances}
    for stance in body.stances:
        assert np.degrees(body.skeleton.limits.violation(stance.pose).max()) < 0.1, stance.name
    # Arms that hang down, knees that do not bend forward.
    relaxed = next(stance.pose for stance in body.stances if stance.name == "relaxed")
    placed = body.place(relaxed).transforms
    at = {name: placed[index, :3, 3] for index, name in enumerate(body.skeleton.names)}
    for side in ("left", "right"):
        assert at[f"{side}_wrist"][1] < at[f"{side}_elbow"][1] < at[f"{side}_shoulder"][1]
        assert at[f"{side}_wrist"][2] > at[f"{side}_elbow"][2]  # The forearm bends to the front.
    knee = body.skeleton.names.index("left_knee")
    balls = body.skeleton.rest().balls.copy()
    balls[knee - 1] = from_vector(np.radians([-60.0, 0.0, 0.0]))
    bent = Pose(relaxed.root, balls, relaxed.hinges)
    assert np.degrees(body.skeleton.limits.violation(bent).max()) > 30.0


def test_limits_of_both_sides_are_mirror_images(imported):
    description = imported.description
    for name, segment in description.segments.items():
        if name.startswith("left_"):
            left, right = segment.joint, description.segments[name.replace("left", "right")].joint
            for field in ("twist_axis", "swing_axis", "centre_deg"):
                mirrored = np.array(getattr(right, field)) * [1.0, -1.0, -1.0]
                np.testing.assert_allclose(getattr(left, field), mirrored, atol=1e-12)
            assert (left.swing_deg, left.twist_deg) == (right.swing_deg, right.twist_deg)


def test_the_capsules_fill_the_surface(imported):
    description = imported.description
    body = description.body("body", description.size.value)
    assert set(body.capsules.segments) == set(range(24))
    placed = body.capsules.place(body.place(body.skeleton.rest()).transforms)
    order = [body.skeleton.names.index(label) for label in imported.skin.labels]
    centres = imported.skin.vertices.reshape(24, -1, 3).mean(axis=1)
    for segment, ends in zip(placed.segments, placed.ends, strict=True):
        own = order.index(segment)
        box = np.ptp(imported.skin.vertices.reshape(24, -1, 3)[own], axis=0).max()
        assert np.linalg.norm(ends.mean(axis=0) - centres[own]) < 0.4 * box


def test_the_range_of_the_size_follows_from_the_modes(tmp_path):
    arrays = body_arrays(modes=1)
    arrays["shapedirs"] = 0.05 * arrays["v_template"][..., None]
    size = body_model_template(write_npz(tmp_path / "m.npz", arrays)).description.size
    height = np.ptp(arrays["v_template"][:, 1])
    assert size.name == "height"
    assert size.value == pytest.approx(height, abs=1e-4)
    # Three standard deviations of 5 % each way.
    assert size.range == pytest.approx((0.85 * height, 1.15 * height), abs=1e-4)


@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_modes_of_the_expression_are_left_out(tmp_path):
    arrays = body_arrays("SMPL-X", modes=20)
    path = write_npz(tmp_path / "m.npz", arrays)
    model = BodyModel.read(path, UPRIGHT, modes=15)
    assert (model.available, len(model.modes.names)) == (10, 10)
    assert model.modes.names[0] == "beta_1"
    assert BodyModel.read(path, UPRIGHT, modes=4).modes.vertices.shape == (4, 1100, 3)
    assert BodyModel.read(path, UPRIGHT, modes=0).modes is None
    body = BodyModel.read(write_npz(tmp_path / "b.npz", body_arrays("SMPL", modes=20)), UPRIGHT)
    assert body.available == 20


def test_what_is_not_used_is_told(tmp_path):
    arrays = {
        **body_arrays("SMPL-X", modes=20),
        "posedirs": np.zeros((1100, 3, 1)),
        "hands_componentsl": np.eye(45),
    }
    path = write_npz(tmp_path / "m.npz", arrays)
    with pytest.warns(RegkitWarning) as told:
        BodyModel.read(path, UPRIGHT)
    text = " ".join(str(one.message) for one in told)
    assert all(word in text for word in ("posedirs", "expression are left out: 10", "hands_comp"))


def damaged(**changes) -> dict:
    arrays = body_arrays()
    for name, change in changes.items():
        if change is None:
            del arrays[name]
        else:
            arrays[name] = change(arrays[name].copy())
    return arrays


def put(place, value):
    def change(array):
        array[place] = value
        return array

    return change


@pytest.mark.parametrize(
    ("arrays", "complaint"),
    [
        (damaged(weights=None), "no array 'weights'"),
        (damaged(shapedirs=None), "no array 'shapedirs'"),
        (damaged(v_template=put((3, 1), np.nan)), "v_template has NaN or infinite numbers"),
        (damaged(v_template=put((3, 1), 1e9)), "v_template holds 1e"),
        (damaged(v_template=lambda v: 0.0 * v), "v_template extends over 0, 0, 0 m"),
        (damaged(v_template=lambda v: v * [1, 1, 0]), "a body has a volume"),
        (damaged(v_template=lambda v: v.astype("U8")), "v_template has the shape"),
        (damaged(v_template=lambda v: v[:-1]), r"weights has the shape \(480, 24\)"),
        (damaged(f=put((0, 0), 999)), "f has .* in row 0"),
        (damaged(v_template=lambda v: v[:0]), "v_template has 0 vertices"),
        (damaged(v_template=lambda v: np.array(7.0)), "v_template has 0 vertices"),
        (damaged(f=lambda f: np.array(7)), "f has 0 triangles"),
        (damaged(f=lambda f: f[:, :2]), "f has the shape"),
        (damaged(f=lambda f: f[:0]), "f has 0 triangles of 480 vertices"),
        (damaged(f=lambda f: np.tile(f, (20, 1))), "f has .* triangles of 480 vertices"),
        (damaged(f=lambda f: f + 0.5), "f has .* in row 0"),
        (damaged(weights=put((2, 3), -1.0)), "weights must not be negative"),
        (damaged(weights=put(2, 0.0)), "each vertex needs one"),
        (damaged(weights=lambda w: w[:, :-1]), r"weights has the shape \(480, 23\)"),
        (damaged(J_regressor=lambda j: j.T), r"J_regressor has the shape \(480, 24\)"),
        (damaged(J_regressor=put((1, 1), np.inf)), "J_regressor has NaN or infinite"),
        (damaged(shapedirs=lambda s: s[..., 0]), r"shapedirs has the shape \(480, 3\)"),
        (damaged(shapedirs=put((0, 0, 0), np.nan)), "shapedirs has NaN or infinite"),
        (damaged(shapedirs=lambda s: np.zeros((480, 3, 1001))), "shapedirs has 1001 modes"),
        (damaged(kintree_table=put((0, 4), 77)), "the parent 77 for joint 4"),
        (damaged(kintree_table=put((1, 4), 3)), "a joint's number twice"),
        (damaged(kintree_table=put((0, 1), 4)), "left_hip|joint_1.* form a cycle"),
        (damaged(kintree_table=lambda k: k[0]), "kintree_table has the shape"),
        (damaged(kintree_table=lambda k: np.zeros((2, 1001))), "1001 joints"),
    ],
)
def test_damage_is_told_with_the_array(tmp_path, arrays, complaint):
    for path in (write_npz(tmp_path / "model.npz", arrays), tmp_path / "model.pkl"):
        if path.suffix == ".pkl":
            path.write_bytes(python3_pickle(arrays, 4))
        with pytest.raises(DataError) as raised:
            body_model_template(path)
        assert raised.value.place == str(path)
        # A pickle's text is refused before its shape.
        if arrays.get("v_template", np.zeros(1)).dtype.kind != "U":
            assert re.search(complaint, raised.value.message), raised.value.message


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (
            {"poses": np.zeros((9, 72)), "trans": np.zeros((9, 3))},
            "poses and the shape of a person",
        ),
        ({"rest_vertices": np.zeros(3), "skin_weights": np.zeros(3)}, "regkit fit"),
        ({"other": np.zeros(3)}, "no array 'v_template'"),
    ],
)
def test_other_archives_are_told_apart(tmp_path, content, complaint):
    with pytest.raises(DataError, match=complaint):
        BodyModel.read(write_npz(tmp_path / "m.npz", content), UPRIGHT)


def test_a_missing_file_and_a_text_are_refused(tmp_path):
    with pytest.raises(DataError, match="there is no such file"):
        BodyModel.read(tmp_path / "none.pkl", UPRIGHT)
    (tmp_path / "text.pkl").write_text("This is no pickle.")
    with pytest.raises(DataError, match="not a body model"):
        BodyModel.read(tmp_path / "text.pkl", UPRIGHT)


@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_joints_far_from_the_surface_are_refused(tmp_path):
    path = write_npz(tmp_path / "m.npz", damaged(J_regressor=lambda j: 1e5 * j))
    with pytest.raises(DataError, match=r"J_regressor places the joint '.*' .* m outside"):
        body_model_template(path)


def test_a_regressor_that_shifts_joints_is_told(tmp_path):
    path = write_npz(tmp_path / "m.npz", damaged(J_regressor=lambda j: 0.5 * j))
    with pytest.warns(RegkitWarning, match="J_regressor of 24 joints does not sum to 1"):
        BodyModel.read(Path(path), UPRIGHT)

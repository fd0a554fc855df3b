"""The shape of a template with modes: skin, joints and parts as functions of coefficients."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from regkit.body import BodyDescription, Scaling
from regkit.body.linear_shape import LinearShape
from regkit.body.modes import Modes
from regkit.body.reading import description_in
from regkit.body.shaped import shaped
from regkit.body.template_file import write_template
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface
from regkit.skeleton import Placement, Pose
from regkit.skeleton.compile import compiled
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

TEMPLATES = {"human": Human(), "right": Hand(), "left": Hand(side="left")}


@pytest.fixture(scope="module", params=TEMPLATES)
def shape(request) -> LinearShape:
    return LinearShape.of(TEMPLATES[request.param].description())


def drawn(shape: LinearShape, seed: int = 0) -> np.ndarray:
    factor = np.linalg.cholesky(np.linalg.inv(shape.information))
    random = np.random.default_rng(seed).normal(size=len(shape))
    return np.clip(shape.mean + factor @ random, *shape.bounds.T)


def bent(shape: LinearShape, x: np.ndarray) -> Placement:
    bones = shape.skeleton(x)
    step = 0.4 * np.random.default_rng(1).normal(size=bones.dofs)
    return Placement.of(bones, bones.limits.projected(bones.retract(bones.rest(), step)))


def test_modes_of_another_mesh_are_refused(tmp_path):
    template = TEMPLATES["right"].description()
    modes = Modes.read(template.modes)
    replace(modes, vertices=modes.vertices[:, 1:]).write(tmp_path / "short.npz")
    with pytest.raises(DataError, match="800") as caught:
        LinearShape.of(template.model_copy(update={"modes": tmp_path / "short.npz"}))
    assert "short.npz" in str(caught.value)


def test_template_without_modes_has_no_linear_shape():
    with pytest.raises(ConfigError, match="modes"):
        LinearShape.of(Human(build="small").description())


def test_zero_is_the_template_itself(shape):
    zero = np.zeros(len(shape))
    np.testing.assert_allclose(shape.skin(zero).vertices, shape.mesh.vertices, atol=1e-12)
    own = compiled(shape.template)
    np.testing.assert_allclose(shape.skeleton(zero).link_offsets, own.link_offsets, atol=1e-12)


def test_skin_in_the_segments_is_the_skin_in_the_body(shape):
    # Bones stretch alike in both, so a skin that is written is the one that was fitted.
    x = drawn(shape)
    placement = bent(shape, x)
    written = SkinnedSurface.of(shape.skin(x)).place(placement.transforms)
    np.testing.assert_allclose(shape.surface(x).place(placement.transforms), written, atol=1e-6)


def test_written_template_is_the_shaped_body(shape, tmp_path):
    x = drawn(shape, 2)
    write_template(tmp_path / "subject.yaml", shaped(shape, x), shape.skin(x), "A test.")
    again = description_in(tmp_path / "subject.yaml")
    body = again.body("subject", again.size.value)
    placement = bent(shape, x)
    pose = Pose(placement.pose.root, placement.pose.balls, placement.pose.hinges)
    read = body.surface.place(body.place(pose).transforms)
    fitted = shape.surface(x).place(placement.transforms)
    # Templates have four decimals.
    assert np.linalg.norm(read - fitted, axis=1).max() < 1.5e-3


def test_most_probable_shape_of_a_size_has_the_size(shape):
    for factor in (0.95, 1.0, 1.1):
        size = factor * shape.size(shape.mean)
        x = shape.at_size(size)
        assert shape.size(x) == pytest.approx(size, rel=1e-6)
        for nudge in np.random.default_rng(3).normal(size=(4, len(shape))):
            other = x + 0.05 * nudge
            assert shape.size(other) != pytest.approx(size, rel=1e-6) or shape.energy(
                other
            ) > shape.energy(x)


def scaling(shape: LinearShape) -> LinearShape:
    """A shape whose one mode enlarges everything by a tenth."""
    return replace(
        shape,
        names=("larger",),
        modes=1,
        joints=0.1 * shape.mesh.rest[None, :, :3, 3],
        vertices=0.1 * shape.mesh.vertices[None],
        mean=np.zeros(1),
        information=np.eye(1),
        bounds=np.array([[-5.0, 5.0]]),
    )


def test_mode_that_enlarges_everything_scales_the_template(shape):
    larger = shaped(scaling(shape), np.array([2.0]))
    template: BodyDescription = shape.template
    assert larger.size.value == pytest.approx(1.2 * template.size.value, rel=1e-4)
    for name, segment in template.segments.items():
        scaled = larger.segments[name]
        np.testing.assert_allclose(scaled.offset, 1.2 * np.array(segment.offset), atol=1e-4)
        for one, other in zip(segment.capsules, scaled.capsules, strict=True):
            np.testing.assert_allclose(other.start, 1.2 * np.array(one.start), atol=1e-3)
            np.testing.assert_allclose(other.radius, 1.2 * np.array(one.radius), rtol=5e-3)
        for marker, at in segment.markers.items():
            np.testing.assert_allclose(scaled.markers[marker], 1.2 * np.array(at), atol=1e-3)
    for name, several in template.shapes["gsog"].items():
        for one, other in zip(several, larger.shapes["gsog"][name], strict=True):
            like = one.deformed(Scaling(1.2))
            np.testing.assert_allclose(other.moments()[0], like.moments()[0], atol=1e-3)
            np.testing.assert_allclose(other.moments()[1], like.moments()[1], rtol=0.02, atol=1e-6)


def test_mirrored_hands_have_mirrored_modes():
    right, left = (LinearShape.of(TEMPLATES[side].description()) for side in ("right", "left"))
    x = drawn(right, 4)
    flip = np.array([-1.0, 1.0, 1.0])
    np.testing.assert_allclose(left.skin(x).vertices, right.skin(x).vertices * flip, atol=1e-5)


def test_bones_that_are_no_segments_are_refused(tmp_path):
    template = TEMPLATES["right"].description()
    mesh = SkinnedMesh.read(template.mesh)
    other = replace(mesh, labels=(*mesh.labels[:-1], "sixth_finger"))
    other.write(tmp_path / "mesh.npz")
    with pytest.raises(RegkitError, match="sixth_finger"):
        LinearShape.of(template.model_copy(update={"mesh": Path(tmp_path / "mesh.npz")}))

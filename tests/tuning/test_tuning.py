"""Tuning: wrong primitives become better on samples that it never sees, reproducibly."""

import os
from dataclasses import replace

import numpy as np
import pytest
from few_samples import make_few

import regkit
from regkit.body import BodyDescription, GaussianParameters
from regkit.body.template_file import write_template
from regkit.config.document import Document
from regkit.interfaces import Method, Template
from regkit.system.errors import ConfigError, DataError
from regkit.tuning import Sampler, one_per_capsule
from regkit.tuning.descent import Descent
from regkit.tuning.trials import Comparison

SPHERES = "spheres"
SOG = {"preset": "best", "shape": {"kind": "sog"}}
FEW = {"samples": 6, "seed": 2}

pytestmark = pytest.mark.usefixtures("few")


def read(path):
    return Document.read(path).validated(BodyDescription)


def made_wrong(path, kite, kind, change):
    """Writes a template whose primitives of a kind are changed."""
    description = read(kite)
    shapes = {
        segment: tuple(one.model_copy(update=change(one)) for one in several)
        for segment, several in description.shapes[kind].items()
    }
    changed = description.model_copy(update={"shapes": {kind: shapes}})
    write_template(path, changed, None, "Wrong on purpose.")
    return path


def thicker(one):
    return {"sigma": tuple(1.5 * np.array(one.sigma))}


def displaced(one):
    x, y, z = one.centre
    return {"centre": (x, y, z + 0.03)}


def improved(found):
    """Whether the error falls by a tenth in each trial of the template's own body."""
    own = [one for one in found.comparisons if "proportions" not in one.name]
    return found.better and all(one.after.mean < 0.9 * one.before.mean for one in own)


def listed(found):
    """All numbers of the tuned list."""
    several = [one for by in found.description.shapes[found.key].values() for one in by]
    return np.concatenate([np.ravel(part) for one in several for part in one.moments()])


@pytest.fixture(scope="module")
def displaced_kite(kite, tmp_path_factory):
    return made_wrong(tmp_path_factory.mktemp("kite") / "kite.yaml", kite, "gsog", displaced)


@pytest.fixture(scope="module")
def tuned(displaced_kite):
    """A wrong template, tuned once."""
    with pytest.MonkeyPatch.context() as patch:
        make_few(patch)
        return regkit.tune(displaced_kite, name="mine", **FEW)


@pytest.mark.long
def test_result_is_compared_with_what_the_template_had_whatever_tuning_starts_from(
    displaced_kite, tuned
):
    found = regkit.tune(displaced_kite, primitives=3, **FEW)
    assert [one.before for one in found.comparisons] == [one.before for one in tuned.comparisons]


def test_as_many_primitives_as_capsules_begin_as_one_for_each(kite, monkeypatch):
    monkeypatch.setattr(Descent, "found", lambda self, _: self.crew.tunable.start())
    found = regkit.tune(kite, primitives=3, **FEW)
    body = found.description.body("kite", found.description.size.value)
    begun = one_per_capsule(body, GaussianParameters)
    assert set(begun) == set(found.description.shapes["gsog"])
    for name, own in begun.items():
        for one, other in zip(own, found.description.shapes["gsog"][name], strict=True):
            for expected, got in zip(one.moments(), other.moments(), strict=True):
                np.testing.assert_allclose(got, expected, atol=1e-9)


def test_sample_that_cannot_be_rendered_is_replaced_and_told(kite, monkeypatch):
    rendered = Sampler.sample

    def failing(self, index):
        if index == 1:
            raise ConfigError("it intersects itself")
        return rendered(self, index)

    monkeypatch.setattr(Sampler, "sample", failing)
    monkeypatch.setattr(Descent, "found", lambda self, _: self.crew.tunable.start())
    found = regkit.tune(kite, **FEW)
    assert set(found.failures) == {"it intersects itself"}
    assert [one.samples for one in found.comparisons[:1]] == [8]


def test_samples_that_all_fail_end_tuning(kite, monkeypatch):
    def failing(self, index):
        raise DataError(f"nothing to see in {index}")

    monkeypatch.setattr(Sampler, "sample", failing)
    with pytest.raises(DataError, match="nothing to see"):
        regkit.tune(kite, **FEW)


def test_displaced_gaussians_become_better_on_samples_that_are_not_seen(tuned):
    assert improved(tuned)
    assert tuned.steps[-1].training < tuned.steps[0].training


@pytest.mark.long
@pytest.mark.parametrize(
    ("kind", "method", "change"),
    [
        ("gsog", "best", thicker),
        ("sog", SOG, lambda one: {"sigma": 1.5 * one.sigma}),
        ("sphere", SPHERES, lambda one: {"radius": tuple(1.4 * np.array(one.radius))}),
    ],
)
def test_thick_primitives_become_better(kite, tmp_path, monkeypatch, kind, method, change):
    monkeypatch.setattr("regkit.tuning.descent.SLIGHT", 1e-3)
    path = made_wrong(tmp_path / "thick.yaml", kite, kind, change)
    found = regkit.tune(path, method, **FEW)
    assert improved(found)
    assert found.key == kind


def same(one, other):
    return (
        np.array_equal(listed(one), listed(other))
        and one.comparisons == other.comparisons
        and one.steps == other.steps
    )


def test_tuned_twice_is_the_same_and_one_job_needs_no_process(displaced_kite, tuned, monkeypatch):
    def refuse(*_: object, **__: object) -> None:
        raise AssertionError("a process was started")

    monkeypatch.setattr(os, "fork", refuse)
    monkeypatch.setattr("regkit.tuning.workers.pool_of_one", refuse)
    assert same(regkit.tune(displaced_kite, name="mine", **FEW), tuned)


@pytest.mark.long
def test_processes_change_nothing(displaced_kite, tuned):
    assert same(regkit.tune(displaced_kite, name="mine", jobs=3, **FEW), tuned)


def test_named_list_stands_beside_the_one_before(displaced_kite, tuned):
    before = read(displaced_kite)
    assert tuned.key == "gsog/mine"
    assert tuned.description.shapes["gsog"] == before.shapes["gsog"]
    assert list(tuned.description.shapes["gsog/mine"]) == list(before.shapes["gsog"])
    assert tuned.shape == "{kind: gsog, tuned: mine}"


def test_better_template_is_written_with_its_figures_and_tracks(tuned, tmp_path):
    assert tuned.better
    path = tmp_path / "tuned.yaml"
    tuned.write(path)
    description = read(path)
    source = description.sources[-1]
    for part in ("gsog/mine", "regkit", "best", "sr4000", "6 samples", "seed 2"):
        assert part in source
    for one in tuned.comparisons:
        assert f"{one.name} {100.0 * one.before.mean:.2f} to {100.0 * one.after.mean:.2f}" in source
    body = description.body("tuned", description.size.value)
    method = {"preset": "best", "shape": {"kind": "gsog", "tuned": "mine"}}
    registrar = Method.parse(method, place="tests", field="method").bind(body)
    assert len(registrar.primitives) == 3


def test_summary_names_every_trial(tuned):
    rows = tuned.rows()
    assert list(rows) == [one.name for one in tuned.comparisons]
    assert all(name in repr(tuned) for name in rows)


def with_changes(tuned, *changes):
    """The result with other changes of its trials, each with a standard error of 1 mm."""
    pairs = zip(tuned.comparisons, (*changes, *[0.0] * 4), strict=False)
    comparisons = tuple(replace(one, change=change, doubt=1e-3) for one, change in pairs)
    return replace(tuned, comparisons=comparisons)


@pytest.mark.parametrize(
    ("changes", "told"),
    [((-0.01, 0.01), "harm.*motion"), ((0.0, 0.0), "no trial"), ((-0.001,), "no trial")],
)
def test_what_is_not_better_is_refused(tuned, tmp_path, changes, told):
    doubtful = with_changes(tuned, *changes)
    assert not doubtful.better
    with pytest.raises(regkit.RegkitError, match=told):
        doubtful.write(tmp_path / "tuned.yaml")
    assert not list(tmp_path.iterdir())


def test_only_templates_are_replaced(tuned, tmp_path):
    path = tmp_path / "other.yaml"
    path.write_text("kind: direct\n")
    with pytest.raises(regkit.RegkitError, match="not a template"):
        tuned.write(path)
    assert path.read_text() == "kind: direct\n"
    path.unlink()
    tuned.write(path)
    tuned.write(path)


def test_change_is_the_mean_of_the_samples_with_its_standard_error(random):
    before = random.normal(size=(400, 2, 3, 3))
    same = Comparison.of("same", before, before, 1.0)
    assert not same.better
    assert not same.worse
    nearer = Comparison.of("nearer", before, 0.9 * before, 1.0)
    assert nearer.better
    assert nearer.change == pytest.approx(-0.1 * nearer.before.mean)
    assert Comparison.of("farther", before, 1.1 * before, 1.0).worse
    distances = np.linalg.norm(before, axis=-1).mean(axis=(1, 2))
    assert nearer.doubt == pytest.approx(0.1 * distances.std(ddof=1) / np.sqrt(400))


@pytest.mark.parametrize(
    ("method", "told"),
    [
        ("small_gicp", "no shape model"),
        ("icp", "'mesh'.*lists"),
        ({"preset": "best", "shape": {"kind": "gsog", "tuned": "none"}}, "no list 'gsog/none'"),
    ],
)
def test_method_without_listed_primitives_is_refused(kite, tmp_path, method, told):
    bare = tmp_path / "bare.yaml"
    description = read(kite)
    shapes = {"gsog": description.shapes["gsog"]}
    write_template(bare, description.model_copy(update={"shapes": shapes}), None, "Gaussians only.")
    with pytest.raises(regkit.RegkitError, match=told):
        regkit.tune(bare, method)


def test_method_without_a_derivative_is_refused_before_samples_are_rendered(kite, monkeypatch):
    from regkit.interfaces import Registrar

    best = Method.parse("best", place="tests", field="method")
    bound = type(best.bind(Template.parse(kite, place="", field="template").body(0.6)))
    monkeypatch.setattr(bound, "gradient", Registrar.gradient)
    monkeypatch.setattr("regkit.tuning.crew.Crew.render", None)
    with pytest.raises(regkit.RegkitError, match="derivative"):
        regkit.tune(kite)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"camera": "sr400"}, "camera.*'sr400'.*sr4000"),
        ({"camera": {"width": 3}}, "camera.height"),
        ({"camera": regkit.Camera(32, 24, 900.0, 900.0, 15.5, 11.5), "noise": "sr40"}, "noise"),
        ({"camera": {"width": 8, "height": 6, "fx": 8}}, "pixels"),
        ({"noise": "loud"}, "noise.*loud"),
        ({"name": "a/b"}, "name"),
        ({"bodies": ["hand"]}, "joint by joint"),
        ({"bodies": ["none.yaml"]}, r"bodies\[0\].*no such file"),
        ({"proportions": 5.0}, "proportions"),
        ({"samples": 0}, "samples"),
        ({"seed": -1}, "seed"),
        ({"jobs": 0}, "jobs"),
    ],
)
def test_invalid_arguments_are_refused_by_name(kite, options, told):
    with pytest.raises(regkit.RegkitError, match=told):
        regkit.tune(kite, **options)


def test_other_bodies_and_proportions_are_trained_with_and_tried(kite, tmp_path):
    slim = read(kite)
    arm = slim.segments["left_arm"]
    assert arm.capsules
    path = tmp_path / "slim.yaml"
    write_template(path, slim, None, "The same.")
    found = regkit.tune(kite, bodies=[path], proportions=0.1, samples=4)
    assert [one.name for one in found.comparisons][-2:] == ["proportions 10 % off", "slim"]
    assert "kite, slim and proportions 10 % off" in found.description.sources[-1]

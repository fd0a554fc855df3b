"""Damaged files of results are found by resume, report and export, and never become a table."""

import io
import json
import shutil
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
from small_experiment import Files, small

from regkit.experiment import Experiment, found, run
from regkit.experiment.ledger import Ledger
from regkit.experiment.provenance.manifest import Manifest
from regkit.experiment.results import Results
from regkit.experiment.stated import read_config, read_environment
from regkit.experiment.tracked_motion import read_tracked_motion
from regkit.metrics import checked_measure
from regkit.system.errors import DataError, RegkitError
from regkit.system.notes import RegkitWarning

SETTINGS = ("dataset.frames=1",)


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Files:
    files = small(tmp_path_factory.mktemp("intact"))
    run(Experiment.read(files.experiment, SETTINGS), files.out, figures=False)
    return files


@pytest.fixture
def track(done, tmp_path) -> Path:
    """The folder of a finished track in a copy of the results, without the data."""
    shutil.copytree(done.out, tmp_path / "out")
    return tmp_path / "out" / "gsog" / "first"


def resumed(done: Files, out: Path) -> Ledger:
    experiment = Experiment.read(done.experiment, SETTINGS)
    recordings = {one.name: one for one in experiment.dataset.chosen()}
    ledger = Ledger(experiment, Results(out), ["gsog"], recordings)
    ledger.read(ledger.opening.check())
    return ledger


def edited(**values: object):
    def edit(content: bytes) -> bytes:
        return json.dumps(json.loads(content) | values).encode()

    return edit


def flipped(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


DAMAGE = {
    "missing": lambda content: None,
    "empty": lambda content: b"",
    "truncated": lambda content: content[: len(content) // 2],
    "garbage": lambda content: b"garbage",
    "a bit": flipped,
}
EDITS = {
    "fps": edited(fps=-1),
    "null": lambda content: json.dumps(dict.fromkeys(json.loads(content))).encode(),
    "frames": edited(frames=99),
    "list": lambda content: b"[1, 2]",
    "deep": lambda content: b"[" * 100_000,
}


@pytest.mark.parametrize(
    ("name", "damage"),
    [*((name, one) for name in ("measure.json", "poses.npz", "record.npz", "scene.npz")
       for one in DAMAGE),
     *(("measure.json", one) for one in EDITS)],
)  # fmt: skip
def test_damaged_file_of_a_track_is_found(done, track, name, damage):
    content = (DAMAGE | EDITS)[damage]((track / name).read_bytes())
    (track / name).unlink()
    if content is not None:
        (track / name).write_bytes(content)
    out = track.parents[1]
    with pytest.warns(RegkitWarning, match=rf"{name}: damaged.*made again"):
        ledger = resumed(done, out)
    assert set(ledger.outcome.measures["gsog"]) == {"second"}
    assert [task.recording for task, _ in ledger.tracks()] == ["first"]
    for read in (lambda: found(out), lambda: read_tracked_motion(track)):
        with pytest.raises(DataError) as caught:
            read()
        assert str(caught.value).startswith(f"{track / name}: damaged")


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_picture_is_drawn_again(done, track, damage):
    picture = track / "overlay.png"
    content = DAMAGE[damage](picture.read_bytes())
    picture.unlink()
    if content is not None:
        picture.write_bytes(content)
    read_tracked_motion(track)
    measures, _ = found(track.parents[1])
    assert set(measures["gsog"]) == {"first", "second"}
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert Manifest.read(track).damaged(track) == []


FOLDER = ("config.yaml", "environment.json", "setup.json", "metrics.json", "inputs/first.json",
          "gsog/first/checksums.json")  # fmt: skip


def errors_of_reading(done: Files, track: Path) -> list[str]:
    """The errors of resume, report and export; any that is not regkit's passes through."""
    out, told = track.parents[1], []
    reads = (lambda: resumed(done, out), lambda: found(out), lambda: read_tracked_motion(track),
             lambda: read_config(out), lambda: read_environment(out))  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RegkitWarning)
        for read in reads:
            try:
                read()
            except RegkitError as error:
                told.append(str(error))
    return told


@pytest.mark.parametrize("damage", [*DAMAGE, "list", "deep"])
def test_damaged_file_of_the_folder_is_no_foreign_error(done, track, damage):
    """Each command either does without it, or refuses it by its name."""
    out = track.parents[1]
    for name in FOLDER:
        if (damage, name) == ("deep", "config.yaml"):
            continue  # The reader of YAML has tests of its own.
        before = (out / name).read_bytes()
        content = (DAMAGE | EDITS)[damage](before)
        (out / name).unlink()
        if content is not None:
            (out / name).write_bytes(content)
        told = errors_of_reading(done, track)
        assert all(str(out) in one for one in told)
        (out / name).write_bytes(before)
    assert errors_of_reading(done, track) == []


def test_damaged_template_of_the_setup_is_refused_with_its_file(done, track):
    file = track.parents[1] / "setup.json"
    file.write_text(file.read_text().replace('"swing_deg"', '"swing_ddg"'))
    config, setup = errors_of_reading(done, track)
    assert "swing_ddg" in config
    assert "swing_ddg" in setup
    assert setup.startswith(str(file))


LIES = {
    "config.yaml": ("[]", '{"name": "x", "methods": [1]}', '{"name": "x", "methods": {"a": 1}}'),
    "environment.json": ("[]", '{"format": 3, "regkit": []}', '{"format": 3, "libraries": [1]}'),
    "setup.json": ("[]", '{"versions": 3}'),
    "metrics.json": ('{"methods": 3}', '{"methods": {"gsog": {"recordings": {"first": 3}}}}'),
    "inputs/first.json": ("{}", '{"recording": {}, "files": {"a": [1]}}'),
    "gsog/first/checksums.json": ("{}", '{"inputs": "", "files": {"../../x": ""}}'),
}


@pytest.mark.parametrize("name", LIES)
def test_json_that_lies_is_no_foreign_error(done, track, name):
    out = track.parents[1]
    for text in LIES[name]:
        (out / name).write_text(text)
        assert all(str(out) in one for one in errors_of_reading(done, track))


def test_finished_track_that_was_removed_is_told_by_the_report(track):
    shutil.rmtree(track)
    with pytest.warns(RegkitWarning, match="gsog on first was finished and is missing"):
        measures, _ = found(track.parents[1])
    assert set(measures["gsog"]) == {"second"}


@pytest.mark.parametrize(
    ("changed", "told"),
    [({"fps": -1.0}, "fps"), ({"fps": None}, "fps"), ({"pck_percent": 101}, "pck_percent"),
     ({"frames": 0}, "frames"), ({"frames": 1.5}, "frames"), ({"lost_frames": 2}, "lost_frames"),
     ({"frames": "1"}, "frames"), ({"frames": True}, "frames"), ({"speed": 1.0}, "speed"),
     ({"surface_distance_mm": float("nan")}, "surface_distance_mm")],
)  # fmt: skip
def test_metrics_that_no_track_can_have_are_refused(track, changed, told):
    data = json.loads((track / "measure.json").read_text())
    assert checked_measure(data, place="here").to_dict() == data
    with pytest.raises(DataError, match=rf"here: damaged: {told}"):
        checked_measure(data | changed, place="here")


def archive(**members: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as file:
        for name, content in members.items():
            file.writestr(f"{name}.npy", content)
    return stream.getvalue()


def header(shape: tuple[int, ...], content: bytes = b"") -> bytes:
    stream = io.BytesIO()
    described = {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, described)
    return stream.getvalue() + content


@pytest.mark.parametrize(
    "content",
    [archive(root=header((1 << 42, 4, 4))), archive(root=header((-1, 4))), archive(root=b"x"),
     archive(root=header((3,), b"12345678")), archive(), b"PK", b"", b"PK\x03\x04" + bytes(60)],
    ids=["terabytes", "negative", "no header", "too few", "no array", "zip", "empty", "zeros"],
)  # fmt: skip
def test_arrays_whose_headers_lie_are_refused(track, content):
    """Also where the checksums were forged with them."""
    for name in ("poses.npz", "record.npz"):
        (track / name).write_bytes(content)
        Manifest.of(track, Manifest.read(track).inputs).write(track)
        results = Results(track.parents[1])
        with pytest.raises(DataError, match=name):
            read_tracked_motion(track) if name == "poses.npz" else results.record("gsog", "first")


@pytest.mark.parametrize("shape", [(), (2, 2), (0,)])
@pytest.mark.parametrize("name", ["seconds", "raw", "fps", "drawing0_points", "drawing0_axes"])
def test_record_of_other_shapes_is_refused(track, name, shape):
    file = track / "record.npz"
    with np.load(file) as arrays:
        kept = dict(arrays)
    kept[name] = np.zeros(shape)
    np.savez(file, **kept)
    results, kept_shapes = Results(track.parents[1]), {"fps": (), "drawing0_points": (0,),
                                                        "drawing0_axes": (0,)}  # fmt: skip
    if kept_shapes.get(name) == shape:
        assert len(results.record("gsog", "first").seconds) == 1
    else:
        with pytest.raises(DataError, match=r"record\.npz"):
            results.record("gsog", "first")


@pytest.mark.parametrize("name", ["root", "balls", "hinges", "markers"])
def test_poses_of_other_shapes_are_refused(track, name):
    """Also where the checksums were forged with them."""
    file = track / "poses.npz"
    with np.load(file) as arrays:
        kept = dict(arrays)
    kept[name] = np.zeros(len(kept[name]))
    np.savez(file, **kept)
    Manifest.of(track, Manifest.read(track).inputs).write(track)
    with pytest.raises(DataError):
        read_tracked_motion(track)

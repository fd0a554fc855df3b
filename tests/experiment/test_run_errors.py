"""What goes wrong in a run is told, and stops nothing else."""

import re
from typing import Literal

from messages import tells
from small_experiment import QUICK, Stepping, add_method, counting, damage

from regkit.config.plugin import register
from regkit.interfaces import BoundTracker, Tracker
from regkit.system.errors import DataError


def test_out_that_is_a_file_is_refused(regkit, files):
    files.out.write_text("precious")
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 1
    assert "this is a file" in ended.err
    assert files.out.read_text() == "precious"


def test_bad_recording_does_not_stop_the_others(regkit, files):
    """What was finished is kept, the reason is told, and once mended the run is completed."""
    image = files.data / "first" / "depth" / "000001.png"
    content = damage(image)
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 1
    reason = f"{image}: "
    assert f"gsog on first failed: {reason}" in ended.err
    assert "Traceback" not in ended.out + ended.err
    figures = files.metrics()["gsog"]
    failed = dict(figures["recordings"]["first"])
    assert failed.pop("error").startswith(reason)
    assert set(failed.values()) == {None}
    assert figures["recordings"]["second"]["joint_error_raw_cm"] > 0.0
    second = figures["recordings"]["second"]
    assert figures["mean"].items() <= second.items()
    text = (files.out / "report.md").read_text()
    assert f"- **gsog** on first: {reason}" in text
    assert {name.split("/")[1] for name in files.written()} == {"second"}

    before = files.written()
    image.write_bytes(content)
    assert regkit("run", files.experiment, "--out", files.out, "--no-figures").code == 0
    after = files.written()
    assert {name: after[name] for name in before} == before
    assert len(after) == 2 * len(before)


def test_frame_that_holds_too_little_is_told(regkit, files):
    ended = regkit(
        "run",
        files.experiment,
        "--out",
        files.out,
        "--no-figures",
        "--set",
        "preprocessor.crop.far=1.0",
    )
    assert ended.code == 1
    assert "first/depth/000000.png: 0 of the frame's" in ended.err
    assert files.metrics()["gsog"]["mean"]["fps"] is None


def test_method_that_fails_does_not_stop_the_others(regkit, files):
    @register
    class Picky(Tracker):
        """Refuses Gaussians of three axes."""

        kind: Literal["picky"] = "picky"

        def bind(self, registrar) -> BoundTracker:
            def taste() -> None:
                if registrar.method.shape.kind == "gsog":
                    raise DataError("not to my taste")

            return Stepping(registrar, taste)

    add_method(files.experiment, "sog", "sog")
    ended = regkit("run", files.experiment, "--out", files.out, "--set", "tracker=picky", *QUICK)
    assert ended.code == 1
    place = files.data / "first" / "depth" / "000000.png"
    assert f"gsog on first failed: {place}: not to my taste" in ended.err
    assert {name.split("/")[0] for name in files.written()} == {"sog"}


def test_only_an_unknown_method_is_refused(regkit, files):
    add_method(files.experiment, "sog", "sog")
    ended = regkit("run", files.experiment, "--out", files.out, "--only", "gsg")
    assert ended.code == 1
    assert tells(ended.err, at="--only", of=("'gsg'", "gsog, sog", "did you mean 'gsog'?"))


def test_setting_that_is_wrong_is_told(regkit, files):
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--no-figures", "--set", "dataset.frames=none"
    )
    assert ended.code == 1
    assert ended.err.startswith("error: --set dataset.frames=none: dataset.frames: input should")
    assert not files.out.exists()


def test_joint_that_is_misspelt_is_told_before_anything_is_computed(regkit, files):
    steps = counting()
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--no-figures",
        "--set", "tracker=counting", "--set", "dataset.joints={head: haed}",
    )  # fmt: skip
    assert ended.code == 1
    assert "dataset.joints.head: " in ended.err
    assert "no marker 'haed'" in ended.err
    assert "did you mean 'head'?" in ended.err
    assert not steps


def test_missing_camera_stops_only_its_own_recording(regkit, files):
    (files.data / "first" / "camera.json").unlink()
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 1
    assert "camera.json: the file is missing" in ended.err
    recordings = files.metrics()["gsog"]["recordings"]
    assert "camera.json" in recordings["first"]["error"]
    assert recordings["second"]["frames"] is not None


def test_run_that_cannot_begin_leaves_no_folder(regkit, files):
    assert regkit("run", files.experiment, "--out", files.out, "--only", "nothing").code == 1
    assert not files.out.exists()


def test_folder_that_cannot_be_written_is_told(regkit, files):
    ended = regkit("run", files.experiment, "--out", "/proc/nowhere")
    assert ended.code == 1
    assert ended.err.startswith("error: /proc/nowhere")
    assert "cannot be written" in ended.err


def test_start_that_does_not_fit_the_template_is_told_before_the_run(regkit, files):
    text = files.experiment.read_text().replace(
        "rotation_deg: [180, 0, 0]}", "rotation_deg: [180, 0, 0]}, joints: {left_shinn: 3}"
    )
    files.experiment.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.err.startswith(f"error: {files.experiment}:5: start.joints.left_shinn: ")
    assert "'left_shinn'" in ended.err
    assert "did you mean 'left_shin'?" in ended.err
    assert not files.out.exists()


def test_damaged_recording_that_is_not_used_is_not_read(regkit, files):
    (files.data / "second" / "sequence.yaml").write_text("fsp: 3\n")
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_depth_in_another_unit_is_suspected(regkit, files):
    (files.data / "first" / "sequence.yaml").write_text("fps: 30\ndepth_scale: 1\n")
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 1
    assert re.search(r"spread over .* m.*depth_scale", ended.err)


def test_start_far_from_the_data_is_a_lost_body(regkit, files):
    text = files.experiment.read_text().replace("[-0.05, -0.05, 3.25]", "[0, 0, 900]")
    files.experiment.write_text(text)
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 3
    assert "gsog on first, lost: 0 % of the points lie on the body" in ended.err
    assert files.metrics()["gsog"]["recordings"]["first"]["verdict"] == "lost"

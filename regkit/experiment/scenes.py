"""The scenes of tracks in a run: what is stored of them, and the replay beside the report."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from regkit.experiment.results import Results
from regkit.metrics import JointErrors
from regkit.observation import Truth
from regkit.report import Record, Run
from regkit.system.errors import DataError
from regkit.system.files import write_text
from regkit.system.notes import note
from regkit.tracking import Track, TrackRecorder
from regkit.viewer.replay import replay
from regkit.viewer.run_scene import Stored, run_scene
from regkit.viewer.track_scene import TrackScene

REPLAY = "replay.html"
"""Name of the replay, beside the report."""


def recorded_scene(
    recorder: TrackRecorder,
    track: Track,
    record: Record,
    truth: Truth | None,
    errors: JointErrors | None,
) -> TrackScene:
    """Returns the scene of a recorded track, in which the worst frame is marked.

    Args:
        recorder: The recorder of the track.
        track: The track.
        record: Its record, which has the points of the worst frame.
        truth: Reference joints, if there are any.
        errors: Joint errors, if there are reference joints.
    """
    drawn = record.drawings
    return TrackScene.of(
        track,
        recorder.registrar,
        {**recorder.sample.points, **{drawing.frame: drawing.points for drawing in drawn}},
        fps=record.fps,
        camera=recorder.sample.camera,
        cameras=recorder.sample.cameras.values(),
        truth=truth,
        errors=None if errors is None else errors.of_frames(),
        marked={drawing.frame: "worst" for drawing in drawn if "worst" in drawing.why},
    )


def stored_scenes(run: Run, results: Results, methods: Sequence[str]) -> dict[str, Stored]:
    """Returns what reads the scenes of some methods, by recording."""
    return {
        name: {
            method: partial(results.scene, method, name)
            for method in methods
            if name in run.finished[method]
        }
        for name in run.recordings
        if any(name in run.finished[method] for method in methods)
    }


def write_replay(run: Run, results: Results) -> str | None:
    """Writes the replay of the methods that are drawn.

    Returns:
        Its name, or None if there is nothing to show.

    Raises:
        DataError: If a file is damaged or cannot be written.
    """
    file = results.folder / REPLAY
    stored = stored_scenes(run, results, run.drawn)
    colours = {method: run.style(method).colour for method in run.drawn}
    scene = run_scene(run.name, stored, colours)
    if scene is None:
        file.unlink(missing_ok=True)
        if stored:
            note("the results of an earlier version hold no scene, so there is no replay; a new "
                 "run writes one", place=results.folder)  # fmt: skip
        return None
    try:
        text = replay(scene)
    except DataError as error:
        # The report of a long run must not fail for it.
        note(f"no replay is written: {error.message}", place=results.folder)
        return None
    write_text(file, text)
    return REPLAY

"""What ``regkit view`` shows: results, a track, an alignment, a recording or a cloud."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from regkit.clouds import read_cloud
from regkit.clouds.reading import READABLE
from regkit.config.model import did_you_mean
from regkit.experiment.provenance import manifest
from regkit.experiment.reporting import found, run_in
from regkit.experiment.results import Results
from regkit.experiment.results_format import check_format
from regkit.experiment.scenes import stored_scenes
from regkit.experiment.stated import read_config
from regkit.geometry.rigid import checked_rigid, transformed
from regkit.interfaces import Dataset
from regkit.report import method_styles
from regkit.report.style import PALETTE
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.json_files import read_json
from regkit.system.links import check_links
from regkit.tracking.track_folder import ROWS
from regkit.viewer.alignment_scene import alignment_scene, clouds_scene
from regkit.viewer.run_scene import Stored, run_scene
from regkit.viewer.scene import Scene
from regkit.viewer.server import Answer
from regkit.viewer.sites import RecordingSite, SceneSite
from regkit.viewer.track_file import FILE, read_scene
from regkit.viewer.track_scene import TrackScene

FRAMES = 1200
"""Maximum number of frames of all recordings in a browser on this machine."""

KNOWN = (
    "the results of a run, RESULTS/METHOD/RECORDING in them, a folder of `regkit track` or "
    "`regkit register`, the JSON of `regkit align --json`, the folder or file of a recording, or a "
    "cloud; a camera is shown by `regkit track CAMERA --view`"
)
"""What can be shown, for messages."""

Site = Callable[[str], Answer | None]
"""What a server answers."""


@dataclass(frozen=True)
class StoredTrack:
    """A track in a folder.

    Attributes:
        recording: Name of the recording.
        method: Name of the method.
        colour: Colour of the method, #rrggbb.
        track: What is shown of it.
    """

    recording: str
    method: str
    colour: str
    track: TrackScene


def site_of(what: Path, recording: str | None = None, methods: Sequence[str] = ()) -> Site:
    """Returns what a server answers for something that can be shown.

    Args:
        what: Its folder or file.
        recording: Name of the recording, of several.
        methods: Names of the methods of a run; by default those of its report.

    Raises:
        RegkitError: If it is nothing that can be shown, or a file is damaged.
    """
    if not what.exists():
        raise ConfigError(f"there is no such file or folder; give {KNOWN}", place=str(what))
    if (what / "config.yaml").is_file() and (what / "environment.json").is_file():
        return SceneSite(_results(what, recording, methods))
    _check_ended(what)
    if methods:
        raise ConfigError("only the results of a run have methods", place="--method")
    if what.is_dir() and any((what / name).is_file() for name in (manifest.FILE, "result.json")):
        one = read_track(what)
        if recording not in (None, one.recording):
            raise ConfigError(
                f"no recording {recording!r} (there is: {one.recording})", place="--recording"
            )
        stored: Stored = {one.method: lambda: one.track}
        return SceneSite(
            _shown(one.recording, {one.recording: stored}, {one.method: one.colour}, what)
        )
    if what.suffix.lower() == ".json":
        return SceneSite(_alignment(what))
    if what.is_file() and what.suffix.lower() in READABLE:
        points = read_cloud(what)
        return SceneSite(clouds_scene(what.name, {"points": points}, {"points": PALETTE[0]}))
    return RecordingSite(_dataset(what).only(recording))


def _results(folder: Path, recording: str | None, methods: Sequence[str]) -> Scene:
    """Returns the scene of a run."""
    run = run_in(folder, *found(folder))
    for method in methods:
        if method not in run.finished:
            raise _unknown("method", method, list(run.finished), "--method")
    stored = stored_scenes(run, Results(folder), methods or run.drawn)
    if recording is not None:
        if recording not in stored:
            raise _unknown("recording", recording, list(stored), "--recording")
        stored = {recording: stored[recording]}
    colours = {method: run.style(method).colour for method in run.finished}
    return _shown(run.name, stored, colours, folder)


def read_track(folder: Path) -> StoredTrack:
    """Returns the track in a folder of ``regkit track``, or in ``RESULTS/METHOD/RECORDING``.

    Raises:
        ConfigError: If there is no finished track.
        DataError: If it is damaged, or was stored without a scene.
    """
    _check_ended(folder)
    if not (folder / manifest.FILE).is_file() and not (folder / "result.json").is_file():
        others = sorted(path.parent for path in folder.glob(f"**/{FILE}"))
        hint = f"; there are: {', '.join(map(str, others[:5]))}" if others else ""
        raise ConfigError(
            "no finished track is here; give RESULTS/METHOD/RECORDING, or a folder of "
            f"`regkit track`{hint}",
            place=str(folder),
        )
    place = Path(os.path.abspath(folder))  # noqa: PTH100 - links must remain.
    results, method, colour = place.parent.parent, place.parent.name, PALETTE[0]
    if (folder / manifest.FILE).is_file():
        check_links(results)
        check_format(results)
        Results(results).finished(method, place.name)
        colour = method_styles(read_config(results), [method])[method].colour
    else:
        method = str(read_json(folder / "result.json").get("method", "track"))
    if not (folder / FILE).is_file():
        raise DataError(
            f"the track has no {FILE}: an earlier version wrote it; run or track again",
            place=str(folder),
        )
    return StoredTrack(place.name, method, colour, read_scene(folder))


def _check_ended(folder: Path) -> None:
    """Refuses a track whose program was killed, before its scene was written."""
    if (folder / ROWS).is_file() and not (folder / FILE).is_file():
        raise ConfigError(
            "the track did not end, and has no scene; `regkit export` writes its motion, such as "
            "to .bvh",
            place=str(folder),
        )


def _shown(title: str, stored: dict[str, Stored], colours: dict[str, str], place: Path) -> Scene:
    """Returns the scene of what was stored.

    Raises:
        DataError: If nothing was.
    """
    scene = run_scene(title, stored, colours, FRAMES)
    if scene is None:
        raise DataError(
            f"no track has a {FILE}: none is finished, or an earlier version wrote them; run or "
            "track again",
            place=str(place),
        )
    return scene


def _alignment(file: Path) -> Scene:
    """Returns the scene of an alignment, whose clouds are read from where they were."""
    result = read_json(file)
    lacking = [name for name in ("T_target_source", "source", "target") if name not in result]
    if lacking:
        raise DataError(
            f"lacks {', '.join(lacking)}; a JSON file must be that of `regkit align --json`",
            place=str(file),
        )
    transform = checked_rigid(result["T_target_source"], place=f"{file}: T_target_source")
    source, target = (read_cloud(_beside(file, str(result[name]))) for name in ("source", "target"))
    return alignment_scene(file.stem, source, target, transformed(transform, source))


def _beside(file: Path, name: str) -> Path:
    """Returns the path as it was given to the command, or else from the result's own folder."""
    return Path(name) if Path(name).exists() else file.parent / name


def _dataset(folder: Path) -> Dataset:
    """Returns the recordings in a folder.

    Raises:
        ConfigError: If there is none.
    """
    try:
        dataset = Dataset.parse(Dataset.at(folder), place="WHAT", field="dataset")
        dataset.chosen()
    except RegkitError as error:
        others = sorted({path.parent for path in folder.glob(f"**/{FILE}")})[:5]
        hint = f"; there are: {', '.join(map(str, others))}" if others else ""
        raise ConfigError(
            f"this is nothing that can be shown ({error.message}); give {KNOWN}{hint}",
            place=str(folder),
        ) from None
    return dataset


def _unknown(what: str, name: str, known: list[str], place: str) -> ConfigError:
    there = ", ".join(known) or "none"
    return ConfigError(
        f"no {what} '{name}' is finished (there are: {there})" + did_you_mean(name, known),
        place=place,
    )

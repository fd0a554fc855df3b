"""Preview of a segmentation: what is removed from some frames, and what is left."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from regkit.api.choices import Choice, Choices, load_template, segmenters_of
from regkit.api.frame import Intrinsics
from regkit.api.recordings import Frames, recording_of
from regkit.api.tables import Summary
from regkit.interfaces import Chain, Segmenter, Template
from regkit.system.errors import ConfigError
from regkit.system.files import replacing
from regkit.tracking import check_unit
from regkit.tracking.preview import PreviewedFrame, previewed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 110


@dataclass(frozen=True, repr=False)
class Preview(Summary):
    """What segmenters remove from some frames of a recording.

    Attributes:
        name: Name of the recording.
        frames: The frames, with what is left of them.
    """

    name: str
    frames: tuple[PreviewedFrame, ...]

    @property
    def steps(self) -> tuple[str, ...]:
        """Names of the steps; none if the scene is no larger than the body."""
        return self.frames[0].steps

    @property
    def is_empty(self) -> bool:
        """Whether nothing is left in any frame."""
        return not any(frame.counts[-1] for frame in self.frames)

    def plot(self) -> Figure:
        """Returns a figure with what each step removes, and what is left."""
        from regkit.report.preview_figure import preview_figure

        return preview_figure(self.name, self.frames)

    def save(self, path: str | Path) -> None:
        """Writes the figure as PNG.

        Raises:
            RegkitError: If the suffix is not ``.png``, or the file cannot be written.
        """
        from regkit.report.png import png

        if Path(path).suffix.lower() != ".png":
            raise ConfigError(f"'{path}' must end with .png", place="path")
        picture = png(self.plot(), DPI)
        with replacing(Path(path)) as temporary:
            temporary.write_bytes(picture)

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: the points that each step removes and leaves, by frame."""
        rows = {}
        for frame in self.frames:
            removed = [
                f"{name} -{count}"
                for name, count in zip(frame.steps, frame.counts[:-1], strict=True)
            ]
            whole = f"{len(frame.whole.points)} points"
            rows[f"frame {frame.index}"] = ", ".join([whole, *removed, f"left {frame.counts[-1]}"])
        return rows


def preview(
    frames: Frames,
    template: Choice[Template],
    *,
    camera: Intrinsics | None = None,
    segmentation: Choices[Segmenter] | None = None,
    count: int = 4,
) -> Preview:
    """Shows what a segmentation removes from a recording, without registering the body.

    A segmenter that follows the body, such as a gate, removes nothing here.

    Args:
        frames: As in ``track``.
        template: As in ``track``.
        camera: As in ``track``.
        segmentation: As in ``track``.
        count: Number of frames, spread over the recording.

    Raises:
        RegkitError: If an argument is invalid, or a frame cannot be read.
    """
    if count < 1:
        raise ConfigError(f"must be at least 1; it is {count}", place="count")
    recording, loaded = recording_of(frames, camera, 1.0), load_template(template)
    segmenters = segmenters_of(segmentation, place="regkit.preview")
    recording.prepare()
    chain = Chain.of(segmenters, recording, loaded)
    found = tuple(previewed(recording, chain, count))
    for frame in found:
        if len(frame.whole.points):
            check_unit(frame.whole.points, loaded, place=frame.whole.place or recording.name)
    return Preview(recording.name, found)

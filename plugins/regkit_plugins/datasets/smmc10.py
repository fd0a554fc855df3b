"""SMMC-10: time-of-flight depth of a person with markers, in files of organized clouds."""

from __future__ import annotations

from typing import Literal

from regkit.config.quantities import Rate
from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern


class Smmc10(OrganizedClouds):
    """SMMC-10 (Ganapathi, Plagemann, Koller and Thrun, CVPR 2010).

    28 recordings of one person by a SwissRanger SR4000 (176x144 pixels, 25 frames per second); the
    reference is motion capture. No public description or loader of its files was found. The layout
    is *assumed* to be that of EVAL, by the same authors, at this camera's resolution; sizes
    (``record``), axes (``axes``), file pattern and frame rate are configurable. A file of another
    layout is refused because of its size and counts. Whether the images show the room is unknown;
    the preprocessor's ``crop`` can remove it.
    """

    kind: Literal["smmc10"] = "smmc10"

    files: str = "*.bin"
    """Pattern of the recordings' file names, with ``*`` as wildcard."""
    subjects: SubjectPattern | None = None
    """Regular expression whose only group is the subject in a file's name."""
    record: RecordLayout = RecordLayout(width=176, height=144)
    """Sizes of the parts of a record."""
    fps: Rate = 25.0
    """Frames per second."""

"""SMMC-10: time-of-flight depth of a person who was marked, in files of organized clouds."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern


class Smmc10(OrganizedClouds):
    """SMMC-10 (Ganapathi, Plagemann, Koller and Thrun, CVPR 2010).

    28 recordings of one person before a SwissRanger SR4000 (176x144 pixels, 25 frames per second);
    the reference is motion capture. No public description or loader of its files was found. The
    layout is *assumed* to be that of EVAL, by the same authors, at the size of this camera; its
    sizes (``record``), directions (``axes``), the pattern of the files and the rate can all be set.
    A file of another layout is refused by its size and counts, not misread. Whether the room is in
    the images is not known either; what is may be cut away with the preprocessor's ``crop``.
    """

    kind: Literal["smmc10"] = "smmc10"

    files: str = "*.bin"
    """Which files of the folder are recordings, as a pattern with ``*``."""
    subjects: SubjectPattern | None = None
    """A regular expression whose one group finds the subject in a file's name."""
    record: RecordLayout = RecordLayout(width=176, height=144)
    """How large the parts of a record are."""
    fps: Annotated[float, Field(gt=0.0)] = 25.0
    """Frames per second."""

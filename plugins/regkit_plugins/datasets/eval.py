"""EVAL: Kinect depth of people who were marked, in files of frame records."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit_plugins.datasets.formats.frame_records import FrameRecords
from regkit_plugins.datasets.formats.record import Record
from regkit_plugins.datasets.formats.subjects import SubjectPattern


class Eval(FrameRecords):
    """EVAL (Ganapathi, Plagemann, Koller and Thrun, ECCV 2012).

    Three people, eight recordings each, before a Kinect; the reference is motion capture.
    The records are as the loader of pyKinectTools reads them. That loader also says that the points
    are in metres and that the camera looks along their -z. Not verified are: that x points right
    (``axes``), that a file's name holds the person's letter (``subjects``), the rate (``fps``), and
    which joint has which number; the joints are therefore called ``joint_0``, ``joint_1``, ... and
    are matched to markers by ``joints``. The room behind people is in the images: cut it away with
    the preprocessor's ``crop``, or with ``foreground``.
    """

    kind: Literal["eval"] = "eval"

    files: str = "seq_*.bin"
    """Which files of the folder are recordings, as a pattern with ``*``."""
    subjects: SubjectPattern | None = "^seq_([A-Za-z]+)"
    """A regular expression whose one group finds the subject in a file's name."""
    record: Record = Record(width=320, height=240)
    """How large the parts of a record are."""
    fps: Annotated[float, Field(gt=0.0)] = 30.0
    """Frames per second."""

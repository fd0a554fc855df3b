"""EVAL: Kinect depth of people who were marked, in files of organized clouds."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern


class Eval(OrganizedClouds):
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
    record: RecordLayout = RecordLayout(width=320, height=240)
    """How large the parts of a record are."""
    fps: Annotated[float, Field(gt=0.0)] = 30.0
    """Frames per second."""

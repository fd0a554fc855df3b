"""EVAL: Kinect depth of people with motion-capture markers, in files of organized clouds."""

from __future__ import annotations

from typing import Literal

from regkit.config.quantities import Rate
from regkit_plugins.datasets.formats.organized_clouds.dataset import OrganizedClouds
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern


class Eval(OrganizedClouds):
    """EVAL (Ganapathi, Plagemann, Koller and Thrun, ECCV 2012).

    Three people with eight recordings each, seen by a Kinect; the reference is motion capture. The
    files are read like in the loader of pyKinectTools, which also states that points are in metres
    and that the camera looks along their -z. Not verified are: x pointing right (``axes``), the
    person's letter in a file's name (``subjects``), the frame rate (``fps``), and the meaning of
    the joint numbers; joints are therefore named ``joint_0``, ``joint_1``, ... and assigned to
    markers by ``joints``. The images show the room behind people: remove it with the preprocessor's
    ``crop``, or with ``foreground``.
    """

    kind: Literal["eval"] = "eval"

    files: str = "seq_*.bin"
    """Pattern of the recordings' file names, with ``*`` as wildcard."""
    subjects: SubjectPattern | None = "^seq_([A-Za-z]+)"
    """Regular expression whose only group is the subject in a file's name."""
    record: RecordLayout = RecordLayout(width=320, height=240)
    """Sizes of the parts of a record."""
    fps: Rate = 30.0
    """Frames per second."""

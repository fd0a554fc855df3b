"""The Python API: functions for scripts and notebooks, with arrays in and out."""

from regkit.api.aligning import CloudAlignment, align
from regkit.api.aligning_views import ViewsAlignment, align_all
from regkit.api.choices import load_template
from regkit.api.frame_files import load_frame
from regkit.api.keypoint_files import load_keypoints
from regkit.api.live import track_live
from regkit.api.live_pose import LivePose
from regkit.api.live_track import LiveTrack
from regkit.api.previewing import Preview, preview
from regkit.api.recordings import load_recording
from regkit.api.registering import register, track
from regkit.api.registration import Registration
from regkit.api.several import track_each
from regkit.api.shaped_body import ShapedBody
from regkit.api.shaping import fit_shape
from regkit.api.sources import open_source
from regkit.api.tracking import Tracking, TrackingError
from regkit.api.tuning import Tuned, tune
from regkit.api.views import frame_of_views
from regkit.geometry.camera import Camera
from regkit.observation import Keypoints, Landmarks, Truth
from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning
from regkit.system.shipped import examples_folder
from regkit.tracking import Verdict

__all__ = [
    "Camera",
    "CloudAlignment",
    "Keypoints",
    "Landmarks",
    "LivePose",
    "LiveTrack",
    "Preview",
    "Registration",
    "RegkitError",
    "RegkitWarning",
    "ShapedBody",
    "Tracking",
    "TrackingError",
    "Truth",
    "Tuned",
    "Verdict",
    "ViewsAlignment",
    "align",
    "align_all",
    "examples_folder",
    "fit_shape",
    "frame_of_views",
    "load_frame",
    "load_keypoints",
    "load_recording",
    "load_template",
    "open_source",
    "preview",
    "register",
    "track",
    "track_each",
    "track_live",
    "tune",
]

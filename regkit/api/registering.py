"""Registration of a body to one frame, and tracking through many."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from regkit.api.choices import Choice, Choices
from regkit.api.frame import Intrinsics, Measured, frame_of
from regkit.api.frame_files import load_frame
from regkit.api.keypoint_files import load_keypoints
from regkit.api.pipeline import Beginning, Pipeline
from regkit.api.recordings import Frames, recording_of
from regkit.api.registration import Registration
from regkit.api.running import tracked_through
from regkit.api.tracking import Tracking
from regkit.interfaces import KeypointRecording, Method, Preprocessor, Segmenter, Template, Tracker
from regkit.observation import Keypoints, Landmarks
from regkit.system.errors import ConfigError
from regkit.system.renamed import renamed_arguments
from regkit.tracking.given_frames import GivenFrames

OneFrame = Measured | str | Path
"""A depth image (H, W) [m], a cloud (N, 3) [m], a frame, or a file of one."""


@renamed_arguments(observer="preprocessor")
def register(
    cloud: OneFrame,
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    camera: Intrinsics | None = None,
    segmentation: Choices[Segmenter] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    start: Beginning | None = None,
    landmarks: Landmarks | None = None,
) -> Registration:
    """Estimates the pose of a body in one frame.

    Args:
        cloud: Points (N, 3) [m] in the camera's frame (x right, y down, z forward), or a depth
            image (H, W) [m] with 0 for pixels without a measurement; or a file, as ``load_frame``
            reads it: a cloud, a mesh, or a depth image with its ``camera.json``. It may show the
            body in a room; see ``segmentation``.
        template: The body: ``"human"``, ``"hand"``, a file, or a result of ``load_template``.
        method: A preset such as ``"best"``, ``"spheres"``, ``"icp"`` or ``"paper"``, a mapping as
            in an experiment's YAML, or a method; by default regkit's best.
        camera: Camera of a depth image: a ``Camera``, a ``camera.json``, or its matrix K (3, 3)
            [px]. With a ``Camera``, points are treated as the surface visible to it; without one,
            as the whole surface.
        segmentation: Segmenters that take the body out of the scene, in order: a name such as
            ``"background"``, a list such as ``["planes", {"kind": "pieces", "choose": 1}]``, or
            ``[]`` for none. By default a body alone is left as it is, and a room is removed.
        preprocessor: Preprocessing of points; by default they are downsampled to about 900.
        start: Search for pose and size, such as ``"stances"``, or a mapping as in an experiment's
            ``start``; or the pose itself, which requires the template's size. By default both are
            sought in all orientations.
        landmarks: Measured positions of the template's markers, in space or in the picture.

    Returns:
        The body with its pose, markers and quality of the fit.

    Raises:
        RegkitError: If an argument is invalid, or the body cannot be registered.
    """
    if isinstance(cloud, (str, Path)):
        if camera is not None:
            raise ConfigError("a file is seen by the camera.json beside it", place="camera")
        cloud = load_frame(cloud)
    frame = frame_of(cloud, camera, place="cloud")
    if landmarks is not None:
        frame = replace(frame, landmarks=landmarks)
    recording = GivenFrames(name=frame.place or "cloud", fps=1.0, length=1, given=(frame,))
    chosen = (template, method, segmentation, preprocessor, None, start)
    return tracked_through(recording, Pipeline.of(*chosen, place="regkit.register"))[0]


@renamed_arguments(observer="preprocessor")
def track(
    frames: Frames,
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    camera: Intrinsics | None = None,
    fps: float = 30.0,
    segmentation: Choices[Segmenter] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    tracker: Choice[Tracker] | None = None,
    start: Beginning | None = None,
    keypoints: Keypoints | str | Path | None = None,
) -> Tracking:
    """Tracks a body through a recording.

    Args:
        frames: Depth images (T, H, W) [m] with 0 for pixels without a measurement; a list of clouds
            (N, 3) [m] in the camera's frame (x right, y down, z forward); the folder of a
            recording; or a ``Recording`` or ``Dataset``.
        template: As in ``register``.
        method: As in ``register``.
        camera: Camera of depth images, as in ``register``.
        fps: Frames per second of arrays; recordings have their own.
        segmentation: As in ``register``.
        preprocessor: As in ``register``.
        tracker: Tracker from frame to frame, if the method has none of its own.
        start: As in ``register``, for the first frame.
        keypoints: Keypoints of the frames, by their numbers; or a file of them, as
            ``load_keypoints`` reads it.

    Returns:
        The body with its poses and markers in all frames.

    Raises:
        regkit.TrackingError: If a frame after the first cannot be read or registered; its
            ``tracked`` is what was tracked before.
        RegkitError: If an argument is invalid, or the first frame cannot be registered.
    """
    recording = recording_of(frames, camera, fps)
    if keypoints is not None:
        given = keypoints if isinstance(keypoints, Keypoints) else load_keypoints(keypoints)
        recording = KeypointRecording.of(recording, given)
    chosen = (template, method, segmentation, preprocessor, tracker, start)
    return tracked_through(recording, Pipeline.of(*chosen, place="regkit.track"))

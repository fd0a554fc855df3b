"""Registration of a body to one frame together with its shape."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from regkit.api.choices import Choice, Choices
from regkit.api.frame import Intrinsics, frame_of
from regkit.api.frame_files import load_frame
from regkit.api.pipeline import Beginning, Pipeline
from regkit.api.registering import OneFrame
from regkit.api.running import tracked_through
from regkit.api.shaped_body import ShapedBody
from regkit.calibration.scan_fit import ScanFit
from regkit.calibration.shared_shape import SOLVING
from regkit.interfaces import Expected, Method, Preprocessor, Segmenter, Solver, Template
from regkit.system.errors import ConfigError
from regkit.system.optional import one_thread
from regkit.system.progress import working
from regkit.tracking.given_frames import GivenFrames


def fit_shape(
    cloud: OneFrame,
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    camera: Intrinsics | None = None,
    segmentation: Choices[Segmenter] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    start: Beginning | None = None,
) -> ShapedBody:
    """Estimates pose and shape of a body in one frame, such as a full or partial scan.

    The body is registered as by ``register``; then modes, lengths, girths and pose are fitted
    together so that the template's skin lies on the data.

    Args:
        cloud: As in ``register``.
        template: The body, a template with shape modes: ``"human"``, ``"hand"``, or a file, such as
            a body model that ``regkit import`` has read.
        method: As in ``register``.
        camera: As in ``register``.
        segmentation: As in ``register``.
        preprocessor: As in ``register``.
        start: As in ``register``.

    Returns:
        The shaped and posed mesh with the template's vertices, and its distances to the data.

    Raises:
        RegkitError: If an argument is invalid, the template has no modes, or the body cannot be
            registered.
    """
    pipeline = Pipeline.of(
        template, method, segmentation, preprocessor, None, start, place="regkit.fit_shape"
    )
    pipeline = replace(pipeline, template=pipeline.template.plain())
    description = pipeline.template.description()
    if description.modes is None:
        raise ConfigError(
            f"the template '{pipeline.template.name()}' has no shape modes, so its shape cannot be "
            "fitted; `regkit calibrate` finds the lengths and girths of such a template",
            place="template",
        )
    if isinstance(cloud, (str, Path)):
        if camera is not None:
            raise ConfigError("a file is seen by the camera.json beside it", place="camera")
        cloud = load_frame(cloud)
    frame = frame_of(cloud, camera, place="cloud")
    recording = GivenFrames(name=frame.place or "cloud", fps=1.0, length=1, given=(frame,))
    found = tracked_through(recording, pipeline)[0]
    session = pipeline.session(recording)
    expected = Expected(body=found.body, pose=found.pose)
    solver = Solver.parse(
        Solver.default(**SOLVING),
        place="regkit",
        field="solver",
    )
    with one_thread(), working("fitting the shape"):
        fit = ScanFit.of(
            description,
            found.size,
            found.pose,
            session.observation(0, expected),
            frame.points,
            solver,
        )
    return ShapedBody(registration=found, fit=fit, template=pipeline.template.name())

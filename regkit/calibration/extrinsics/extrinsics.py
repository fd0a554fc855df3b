"""Extrinsics: where several cameras are, from the body that moves before them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.body import Body
from regkit.calibration.extrinsics.alignment import MotionAlignment, aligned
from regkit.calibration.extrinsics.found import FoundCameras, judged
from regkit.calibration.extrinsics.motions import Motion
from regkit.calibration.extrinsics.paired import FirstFrames, PairedRecording
from regkit.calibration.extrinsics.refinement import Refinement
from regkit.config.model import Model
from regkit.config.plugin import slot_default, slot_defaults
from regkit.config.quantities import Count, FrameCount
from regkit.geometry.rigid import inverse
from regkit.interfaces import (
    Method,
    Preprocessor,
    Recording,
    Registrar,
    Segmenter,
    StartSearch,
    Template,
    Tracker,
)
from regkit.recording.instants import matched
from regkit.system.arrays import Array
from regkit.system.errors import NotFoundError, RegkitError
from regkit.system.notes import note
from regkit.system.optional import one_blas_thread
from regkit.system.progress import steps, working
from regkit.tracking import Session, Track, TrackRecorder

FARTHEST = 0.12
"""Motions that are farther apart than this fraction of the body's size are those of two bodies, or
of one that was not found."""

CLOCK = 0.25
"""A difference of the clocks of less than this fraction of a period is none."""

VOXEL, SMALLEST_VOXEL = 0.018, 0.004
"""Voxel size as a fraction of the body's size, and its lower bound [m]."""


class Extrinsics(Model):
    """Settings of the estimation of cameras' poses."""

    template: Template
    """Template of the body, best with a known size."""
    preprocessor: Preprocessor | None = None
    """Preprocessor of the frames; by default voxels that suit the body's size."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the body out of the scene, in each camera."""
    start: StartSearch = slot_default(StartSearch)
    """Search for pose and size in the first frame."""
    frames: Count = 40
    """Number of frames in which the poses are refined, spread over the recording."""
    longest: FrameCount = 300
    """Maximum number of frames of each camera that are tracked, from the start."""
    method: Method = slot_default(Method)
    """Method that tracks the body."""
    refining: Method = slot_default(Method, "surface")
    """Method in whose energy the poses are refined: the exact surface shifts a camera less than
    Gaussians do. A body without a mesh is refined by ``method``."""
    tracker: Tracker = slot_default(Tracker)
    """Tracker, unless the method has one of its own."""

    def found(
        self,
        cameras: Mapping[str, Recording],
        times: Mapping[str, Array] | None = None,
        world: Array | None = None,
        *,
        place: str = "cameras",
    ) -> FoundCameras:
        """Returns the poses of several cameras.

        Args:
            cameras: The recording of each camera by its name, in its own frame.
            times: Times of each camera's frames [s], by its name; by default those of its rate.
            world: T_world_camera (4, 4) [m] of the first camera; by default it is the world.
            place: Name of the recording, for messages.

        Raises:
            NotFoundError: If a camera does not see the body, or not together with the others.
            RegkitError: If a frame cannot be read or registered.
        """
        with one_blas_thread():
            return self._found(cameras, times, np.eye(4) if world is None else world, place)

    def _found(
        self,
        cameras: Mapping[str, Recording],
        times: Mapping[str, Array] | None,
        world: Array,
        place: str,
    ) -> FoundCameras:
        each = {name: FirstFrames.of(one, self.longest) for name, one in cameras.items()}
        clocks = {
            name: (np.arange(one.length) / one.fps if times is None else times[name])[: one.length]
            for name, one in each.items()
        }
        fps = max(one.fps for one in each.values())
        first, *others = each
        tracks = {name: self._tracked(one) for name, one in each.items()}
        body, track = tracks[first]
        reference = Motion.of(track, body, clocks[first])
        found = {
            name: _aligned(name, reference, *tracks[name], clocks[name], fps) for name in others
        }
        poses = {first: np.eye(4)} | {name: one.transform for name, one in found.items()}
        offsets = {first: 0.0}
        for name, one in found.items():
            apart = abs(one.offset) > CLOCK / fps
            offsets[name] = round(one.offset, 3) if apart else 0.0
            if apart:
                way = "behind" if one.offset > 0.0 else "ahead"
                note(
                    f"the clock of camera '{name}' is about {1000.0 * abs(one.offset):.0f} ms "
                    f"{way}; its frames are matched accordingly",
                    place=place,
                )
        shifted = [clocks[name] + offsets[name] for name in each]
        instants = matched(shifted, 0.5 / fps)
        paired = PairedRecording(
            place, fps, len(instants), each=each, poses=poses, instants=instants
        )
        refinement = self._refined(paired)
        verdict, reason, distance = judged(refinement)
        final = {
            name: world @ inverse(T_camera_world)
            for name, T_camera_world in refinement.cameras.items()
        }
        rough = {name: one.distance for name, one in found.items()}
        count = len(refinement.frames)
        return FoundCameras(final, offsets, rough, count, distance, verdict, reason)

    def _session(self, recording: Recording) -> Session:
        voxel = max(VOXEL * float(np.median(self.template.candidate_sizes())), SMALLEST_VOXEL)
        preprocessor = self.preprocessor or Preprocessor.parse(
            Preprocessor.default(voxel=voxel, sigma=voxel / 3.0),
            place="extrinsics",
            field="preprocessor",
        )
        return Session(
            recording, self.template, preprocessor, self.start, segmentation=self.segmentation
        )

    def _tracked(self, recording: Recording) -> tuple[Body, Track]:
        """Returns the body and its track in one camera alone."""
        session = self._session(recording)
        with working("searching the start"):
            start = session.begin()
        registrar = self.method.bind(start.body)
        recorder = TrackRecorder(registrar, recording.fps)
        tracked = session.tracked(registrar, self.method.tracker or self.tracker, start.pose)
        for frame in steps(tracked, f"tracking in {recording.name}", recording.length):
            recorder.add(frame)
        return start.body, recorder.track()

    def _refined(self, paired: PairedRecording) -> Refinement:
        """Returns the refined cameras.

        Raises:
            NotFoundError: If no instant shows the body in several cameras.
        """
        session = self._session(paired)
        with working("searching the start in all cameras"):
            start = session.begin()
        registrar = self.method.bind(start.body)
        tracked = session.tracked(registrar, self.method.tracker or self.tracker, start.pose)
        kept = [
            (frame.observation, frame.registered.pose)
            for frame in steps(tracked, "tracking in all cameras", paired.length)
            if frame.observation is not None and len(frame.observation.views) > 1
        ]
        if not kept:
            raise NotFoundError("no two cameras see the body at the same time", place=paired.name)
        chosen = np.linspace(0, len(kept) - 1, min(self.frames, len(kept))).round().astype(int)
        refinement = Refinement(
            self._refiner(start.body, paired.name),
            [kept[at][0] for at in chosen],
            [kept[at][1] for at in chosen],
            {name: inverse(pose) for name, pose in paired.poses.items()},
        )
        with working("refining the cameras"):
            refinement.run()
        return refinement

    def _refiner(self, body: Body, place: str) -> Registrar:
        """Returns what refines the poses."""
        try:
            return self.refining.bind(body)
        except RegkitError as error:
            note(f"the cameras are refined by the tracking method: {error.message}", place=place)
            return self.method.bind(body)


def _aligned(
    name: str, reference: Motion, body: Body, track: Track, times: Array, fps: float
) -> MotionAlignment:
    """Returns the fit of a camera's motion to that of the first one.

    Raises:
        NotFoundError: If they do not show the same body at the same time.
    """
    motions = [Motion.of(track, body, times), Motion.mirrored(track, body, times)]
    fits = [aligned(reference, one, fps) for one in motions if one is not None]
    known = [one for one in fits if one is not None]
    if not known:
        raise NotFoundError(
            "it and the first camera do not surely see the body at the same times; walk where all "
            "cameras see you",
            place=f"camera '{name}'",
        )
    best = min(known, key=lambda one: one.distance)
    if best.distance > FARTHEST * body.size:
        raise NotFoundError(
            f"the body moves otherwise before it than before the first camera: the markers are "
            f"{100.0 * best.distance:.0f} cm apart at best. One of both tracks is wrong, or they "
            "show two bodies, or their clocks differ",
            place=f"camera '{name}'",
        )
    return best

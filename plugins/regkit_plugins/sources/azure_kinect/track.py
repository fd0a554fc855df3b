"""The depth track of a recording, with the calibration that is attached to it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.sources.azure_kinect import matroska
from regkit_plugins.sources.azure_kinect.matroska import Element

TRACK_NAME = "DEPTH"
CALIBRATION = "calibration.json"

PIXELS = b"b16g"
"""Code of pixels of 16 bits, the high byte first."""

USUAL_PERIOD = 33_333_333
"""Time between two frames where the file does not say it [ns]."""


@dataclass(frozen=True)
class DepthTrack:
    """The depth track of a recording.

    Attributes:
        clusters: Where its blocks are.
        number: Its number in them.
        width: Width of the images [px].
        height: Height of the images [px].
        period: Time between two frames [ns].
        scale: Unit of times [ns].
        calibration: The content of the attached ``calibration.json``.
        cut: Whether the file ends before the recording does.
    """

    clusters: tuple[Element, ...]
    number: int
    width: int
    height: int
    period: int
    scale: int
    calibration: bytes
    cut: bool

    @classmethod
    def read(cls, file: BinaryIO) -> DepthTrack:
        """Reads what stands beside the images.

        Raises:
            DataError: If the file is damaged, or has no depth track or calibration.
        """
        header, *segments = matroska.whole(file).inside(file)
        if header.id != matroska.EBML or not segments:
            raise DataError("this is no Matroska file")
        segment = segments[0]
        clusters, scale, depth, calibration = [], 1_000_000, None, None
        for element in segment.inside(file):
            if element.id == matroska.CLUSTER:
                clusters.append(element)
            elif element.id == matroska.INFO:
                given = _fields(element, file).get(matroska.TIMESTAMP_SCALE)
                scale = scale if given is None else given.number(file)
            elif element.id == matroska.TRACKS:
                depth = _depth_track(element, file)
            elif element.id == matroska.ATTACHMENTS:
                calibration = _calibration(element, file)
        if depth is None:
            raise DataError(f"there is no track {TRACK_NAME}, as Azure Kinect records it")
        if calibration is None:
            raise DataError(f"the camera's {CALIBRATION} is not attached")
        return cls(tuple(clusters), *depth, scale, calibration, segment.cut)

    def blocks(self, file: BinaryIO) -> Iterator[tuple[float, Element]]:
        """Yields the times [s] and the places of the images.

        Raises:
            DataError: If the file is damaged or cut short.
        """
        for cluster in self.clusters:
            start = 0
            for element in cluster.inside(file):
                if element.id == matroska.TIMESTAMP:
                    start = element.number(file)
                    continue
                block = element
                if element.id == matroska.BLOCK_GROUP:
                    block = _fields(element, file).get(matroska.BLOCK, element)
                if block.id not in (matroska.SIMPLE_BLOCK, matroska.BLOCK):
                    continue
                file.seek(block.start)
                if matroska.variable(file, marked=False) != self.number:
                    continue
                # A time relative to the cluster's, and a byte of flags.
                offset = int.from_bytes(matroska.exactly(file, 3)[:2], "big", signed=True)
                image = Element(block.id, file.tell(), block.end)
                yield 1e-9 * self.scale * (start + offset), image
        if self.cut:
            raise DataError("the file is cut short")

    def image(self, file: BinaryIO, block: Element) -> Array:
        """Returns the image (H, W) [mm] at a place.

        Raises:
            DataError: If it has another size.
        """
        content = block.content(file)
        if len(content) != 2 * self.width * self.height:
            raise DataError(
                f"the image has {len(content)} bytes; {self.width}x{self.height} pixels have "
                f"{2 * self.width * self.height}"
            )
        return np.frombuffer(content, ">u2").reshape(self.height, self.width).astype(np.float64)


def _fields(element: Element, file: BinaryIO) -> dict[int, Element]:
    """Returns the elements within another one by their identifiers; the last of several."""
    return {inner.id: inner for inner in element.inside(file)}


def _depth_track(tracks: Element, file: BinaryIO) -> tuple[int, int, int, int] | None:
    """Returns number, width, height and period [ns] of the depth track."""
    for track in tracks.inside(file):
        fields = _fields(track, file) if track.id == matroska.TRACK else {}
        name = fields.get(matroska.NAME)
        if name is None or name.text(file) != TRACK_NAME:
            continue
        private = fields.get(matroska.CODEC_PRIVATE)
        if private is None or PIXELS not in private.content(file):
            raise DataError("the depth images are compressed, which is not supported")
        video = _fields(fields[matroska.VIDEO], file)
        size = [video[one].number(file) for one in (matroska.WIDTH, matroska.HEIGHT)]
        period = fields.get(matroska.DURATION)
        nanoseconds = 0 if period is None else period.number(file)
        number = fields[matroska.NUMBER].number(file)
        return number, size[0], size[1], nanoseconds or USUAL_PERIOD
    return None


def _calibration(attachments: Element, file: BinaryIO) -> bytes | None:
    """Returns the content of the attached calibration."""
    for attached in attachments.inside(file):
        fields = _fields(attached, file) if attached.id == matroska.ATTACHED else {}
        name = fields.get(matroska.FILE_NAME)
        if name is not None and name.text(file) == CALIBRATION:
            return fields[matroska.FILE_DATA].content(file)
    return None

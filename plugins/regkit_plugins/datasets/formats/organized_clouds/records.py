"""Records of a file of organized clouds, read from disk on demand."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.system.errors import DataError

Size = Annotated[int, Field(ge=1, le=65_536)]
Slots = Annotated[int, Field(ge=0)]


class RecordLayout(Model):
    """Sizes of a record's parts, in the order of ``OrganizedClouds``."""

    width: Size
    """Columns of the grid of points."""
    height: Size
    """Rows of the grid of points."""
    marker_slots: Slots = 32
    """Number of slots for markers, used or not."""
    name_bytes: Size = 256
    """Number of bytes of a marker's name."""
    joint_slots: Slots = 32
    """Number of slots for joints, used or not."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """The NumPy data type of a record."""
        marker = [("name", f"S{self.name_bytes}"), ("position", "<f4", 3)]
        joint = [("number", "<i4"), ("position", "<f4", 3)]
        return np.dtype([
            ("magic", "<i4"),
            ("frame", "<i4"),
            ("points", "<f4", (self.height, self.width, 3)),
            ("marker_count", "<i4"),
            ("markers", marker, (self.marker_slots,)),
            ("joint_count", "<i4"),
            ("joints", joint, (self.joint_slots,)),
        ])  # fmt: skip


@dataclass(frozen=True)
class RecordFile:
    """One file.

    Attributes:
        path: Its path.
        record: Sizes of its records' parts.
        length: Number of records.
    """

    path: Path
    record: RecordLayout
    length: int

    @classmethod
    def of(cls, path: Path, record: RecordLayout) -> RecordFile:
        """Returns a file whose size is a multiple of the record's.

        Raises:
            DataError: If it is not.
        """
        size, one = path.stat().st_size, record.dtype.itemsize
        if size == 0 or size % one:
            raise DataError(
                f"the file's {size} bytes are not a multiple of the record's {one} bytes "
                f"({record.width}x{record.height} points, {record.marker_slots} markers, "
                f"{record.joint_slots} joints); it is truncated, or dataset.record is wrong",
                place=str(path),
            )
        return cls(path, record, size // one)

    def place(self, index: int) -> str:
        """Returns the place of a frame, for messages."""
        return f"{self.path}: frame {index}"

    def records(self) -> np.memmap[Any, Any]:
        """Returns all records (T,), memory-mapped.

        Raises:
            DataError: If the counts of a record are invalid.
        """
        records = np.memmap(self.path, self.record.dtype, mode="r")
        for part, slots in (
            ("marker", self.record.marker_slots),
            ("joint", self.record.joint_slots),
        ):
            counts = np.array(records[f"{part}_count"])
            wrong = np.flatnonzero((counts < 0) | (counts > slots))
            if len(wrong):
                raise DataError(
                    f"{part}_count is {counts[wrong[0]]}, for {slots} slots; "
                    "dataset.record is wrong, or the file is damaged",
                    place=self.place(int(wrong[0])),
                )
        return records

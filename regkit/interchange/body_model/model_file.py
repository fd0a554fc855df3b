"""The arrays of a body model's file: an ``.npz`` archive or a pickle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.interchange.body_model.pickles import loaded
from regkit.interchange.body_model.recorded_arrays import Numbers, array_of, content_of
from regkit.system.archives import array_names, object_pickle, read_arrays
from regkit.system.errors import DataError
from regkit.system.printable import shortened

SUFFIXES = (".npz", ".pkl", ".pickle")
"""Suffixes of body models, whose content tells which of both it is."""

MOST_BYTES = 4 << 30
"""Size of the largest pickle that is read [bytes]; the largest models have 0.5 GB."""

ZIP = b"PK\x03\x04"


@dataclass(frozen=True)
class ModelFile:
    """What a body model's file holds, by name.

    Attributes:
        path: The file.
        names: Names of all values.
        values: What its pickle describes; None for an archive, whose arrays are read when asked.
    """

    path: Path
    names: tuple[str, ...]
    values: Mapping[Any, Any] | None

    @classmethod
    def open(cls, path: Path) -> ModelFile:
        """Returns the content of an ``.npz`` archive or of a pickle, without executing anything.

        Raises:
            DataError: If the pickle is too large, no mapping, or asks to run something.
        """
        with path.open("rb") as stream:
            packed = stream.read(len(ZIP)) == ZIP
        if packed:
            return cls(path, tuple(array_names(path)), None)
        if path.stat().st_size > MOST_BYTES:
            raise DataError(f"is larger than {MOST_BYTES / 1e9:.2g} GB")
        values = loaded(path.read_bytes())
        if not isinstance(values, dict):
            raise DataError(f"the pickle holds a {type(values).__name__}; it needs a dictionary")
        return cls(path, tuple(key for key in values if isinstance(key, str)), values)

    def check_kind(self) -> None:
        """Refuses files that are no body models, and says what they are.

        Raises:
            DataError: If it is a mesh file, or the motion of a person.
        """
        names = set(self.names)
        if "v_template" in names:
            return
        if {"rest_vertices", "skin_weights"} <= names:
            raise DataError(
                "is a skinned mesh and no body model; `regkit fit` makes a template of it"
            )
        if {"poses", "trans"} <= names or {"body_pose", "global_orient"} & names:
            raise DataError(
                "holds the poses and the shape of a person; the body model is another file, such "
                "as SMPL_NEUTRAL.pkl or SMPLX_NEUTRAL.npz"
            )

    def array(self, name: str) -> Numbers:
        """Returns a dense array of numbers.

        Raises:
            DataError: If there is none of this name, or it is damaged.
        """
        self.require(name)
        value = self.value(name)
        try:
            return array_of(value)
        except DataError as error:
            raise DataError(f"{name} {error.message}") from None

    def value(self, name: str) -> Any:
        """Returns an array, or what a pickle describes in its place.

        Raises:
            DataError: If it is damaged.
        """
        if self.values is not None:
            return self.values[name]
        pickled = object_pickle(self.path, name)
        if pickled is None:
            return read_arrays(self.path, [name])[name]
        return content_of(loaded(pickled))

    def require(self, *names: str) -> None:
        """Checks that arrays exist.

        Raises:
            DataError: If one does not.
        """
        missing = [name for name in names if name not in self.names]
        if missing:
            found = shortened(", ".join(self.names), 200) or "nothing"
            raise DataError(
                f"there is no array '{missing[0]}'; a body model in the layout of SMPL has "
                f"{', '.join(names)} (there are: {found})"
            )

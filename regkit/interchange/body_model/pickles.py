"""Pickles read as data: what they ask to build is recorded, and nothing is imported or called.

A pickle is a program: it names any callable, and calls it. Here each name becomes a class that
keeps its arguments and its state, if body models need it; any other name ends the reading. Arrays
are made afterwards from what was recorded (``recorded_arrays``).
"""

from __future__ import annotations

import io
import pickle
from functools import cache
from typing import Any, ClassVar, Self

from regkit.system.errors import DataError
from regkit.system.printable import shortened

KNOWN = frozenset(
    {
        "numpy.dtype",
        "numpy.ndarray",
        "numpy.matrix",
        "numpy.matrixlib.defmatrix.matrix",
        "numpy.core.multiarray._reconstruct",
        "numpy.core.multiarray.scalar",
        "numpy.core.numeric._frombuffer",
        "_codecs.encode",
        "copyreg._reconstructor",
        "collections.OrderedDict",
        "collections.defaultdict",
        *(f"builtins.{name}" for name in ("object", "set", "frozenset", "list", "tuple", "dict")),
    }
)
"""What body models consist of, besides sparse matrices and the arrays of chumpy."""

SPARSE = frozenset(
    f"{layout}_{kind}" for layout in ("csc", "csr", "coo") for kind in ("matrix", "array")
)
"""Names of SciPy's sparse matrices, in a module of ``scipy.sparse``."""

RENAMED = {"__builtin__": "builtins", "copy_reg": "copyreg", "numpy._core": "numpy.core"}
"""Modules that have other names in Python 2, or in newer versions of NumPy."""


class Recorded:
    """An object as a pickle describes it.

    Attributes:
        origin: Module and name of its class, or of the function that was to make it.
        args: Arguments of the call.
        state: State that was to be set; None without one.
    """

    origin: ClassVar[str] = ""
    args: tuple[Any, ...]
    state: Any

    def __new__(cls, *args: Any, **_: Any) -> Self:
        """Keeps the arguments."""
        self = super().__new__(cls)
        self.args, self.state = args, None
        return self

    def __setstate__(self, state: Any) -> None:
        """Keeps the state."""
        self.state = state

    def __setitem__(self, key: Any, value: Any) -> None:
        """Passes over an item of a mapping."""


class _Recorder(pickle._Unpickler):
    """Unpickler whose every class is ``Recorded``.

    It is Python's own in Python: the one in C reserves as much memory as a pickle asks for.
    """

    def find_class(self, module: str, name: str) -> Any:
        """Returns the recording class of a name.

        Raises:
            DataError: If body models do not need it.
        """
        origin = f"{_module(module)}.{name}"
        if not _is_needed(origin):
            raise DataError(
                f"the pickle asks to run '{shortened(f'{module}.{name}')}', which no body model "
                "needs; nothing was run, and the file is not read"
            )
        return _recording(origin)


def loaded(content: bytes) -> Any:
    """Returns what a pickle describes, without executing anything in it.

    Strings of Python 2 are decoded as Latin-1, which keeps the bytes of arrays.

    Args:
        content: The pickle.

    Raises:
        DataError: If it names anything that no body model needs.
        Exception: Whatever a damaged pickle causes.
    """
    return _Recorder(io.BytesIO(content), encoding="latin1").load()


def _module(module: str) -> str:
    for old, new in RENAMED.items():
        if module == old or module.startswith(f"{old}."):
            return new + module.removeprefix(old)
    return module


def _is_needed(origin: str) -> bool:
    package, _, name = origin.rpartition(".")
    if package == "scipy.sparse" or package.startswith("scipy.sparse."):
        return name in SPARSE
    return origin in KNOWN or package == "chumpy" or package.startswith("chumpy.")


@cache
def _recording(origin: str) -> type[Recorded]:
    return type("Recorded", (Recorded,), {"origin": origin})

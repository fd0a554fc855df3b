"""Functions with loops over arrays, compiled by Numba on their first call."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cached_property, update_wrapper
from types import FunctionType
from typing import Any, Generic, ParamSpec, TypeVar, cast, overload

from regkit.system.calls import Pointer, external
from regkit.system.compilations import DISPATCHERS, listen
from regkit.system.compile_ahead import MODULES
from regkit.system.errors import PluginError
from regkit.system.machine_types import machine_signature
from regkit.system.optional import load_library

P = ParamSpec("P")
R = TypeVar("R")

_REORDERED = {"reassoc", "contract", "arcp", "nsz"}
"""Liberties of LLVM with sums and products; NaN and infinity keep their meaning."""


class Compiled(Generic[P, R]):
    """A function that Numba compiles when it is first needed and caches on disk.

    If its annotations fix the types (``regkit.system.machine_types``), it is compiled for these
    alone, once for all callers, and can be called by its address (``regkit.system.calls``).
    Otherwise it is compiled for the types of each call, and becomes a part of its compiled caller.
    Importing Numba takes half a second, which commands without a registration avoid.
    """

    def __init__(self, function: Callable[P, R], *, reordered: bool, python: bool) -> None:
        self.function = function
        self._reordered, self._python = reordered, python
        MODULES[function.__module__] = None
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Calls the compiled function."""
        return self.dispatcher(*args, **kwargs)

    @cached_property
    def signature(self) -> Any:
        """Numba's signature; None if the annotations do not fix the types."""
        return machine_signature(self.function)

    @cached_property
    def dispatcher(self) -> Callable[P, R]:
        """Numba's dispatcher of the function."""
        # Numba calls only its own functions: replace those among the globals of this one.
        names = dict(cast(Any, self.function).__globals__)
        for name in self.function.__code__.co_names:
            if isinstance(names.get(name), Compiled | Pointer):
                names[name] = names[name].callee
        own = cast(Any, self.function)
        function = FunctionType(own.__code__, names, own.__name__, own.__defaults__)
        update_wrapper(function, own)
        # Numba names the file on disk by it, and otherwise knows only the function's own file.
        function.__qualname__ = f"{own.__qualname__}_{self.digest}"
        listen()
        # All loops release Python's lock, so that threads can share a computation.
        options: dict[str, bool | str] = {"nogil": True}
        if self.signature is not None:
            # Division by zero gives inf or nan, as in NumPy, and its check does not end a loop.
            options |= {"error_model": "numpy", "no_cfunc_wrapper": True}
            if not self._python:
                options["no_cpython_wrapper"] = True
        compile_for = load_library("numba").njit(
            self.signature, cache=True, fastmath=_REORDERED if self._reordered else False, **options
        )
        dispatcher = cast(Callable[P, R], compile_for(function))
        DISPATCHERS.append(dispatcher)
        return dispatcher

    @cached_property
    def digest(self) -> str:
        """Digest of what the machine code depends on: the code, the types, and those of callees."""
        own = self.function
        parts = [own.__module__, own.__qualname__, own.__code__.co_code.hex()]
        parts += [repr(self.signature), str(self._reordered), str(self._python)]
        parts += [repr(each) for each in own.__code__.co_consts if isinstance(each, int | float)]
        for name in own.__code__.co_names:
            value = cast(Any, own).__globals__.get(name)
            if isinstance(value, Compiled):
                parts.append(own.__qualname__ if value is self else value.digest)
            elif isinstance(value, Pointer):
                parts.append(repr(value.signature))
            elif isinstance(value, int | float):
                parts.append(repr(value))
        return hashlib.blake2s("\n".join(parts).encode(), digest_size=5).hexdigest()

    @cached_property
    def callee(self) -> Any:
        """What compiled functions call."""
        if self.signature is None:
            return self.dispatcher
        return external(self.signature, f"{self._name}_{self.digest}", self.address)

    @property
    def _name(self) -> str:
        return f"{self.function.__module__}.{self.function.__qualname__}"

    @cached_property
    def address(self) -> int:
        """The address of the machine code.

        Raises:
            PluginError: If the annotations do not fix the types.
        """
        if self.signature is None:
            raise PluginError(
                f"the compiled function {self._name} needs annotations of "
                "regkit.system.machine_types"
            )
        result = cast(Any, self.dispatcher).get_compile_result(self.signature)
        return int(result.library.get_pointer_to_function(result.fndesc.llvm_func_name))


@overload
def compiled(function: Callable[P, R]) -> Compiled[P, R]: ...


@overload
def compiled(
    *, reordered: bool = False, python: bool = True
) -> Callable[[Callable[P, R]], Compiled[P, R]]: ...


def compiled(
    function: Callable[P, R] | None = None, *, reordered: bool = False, python: bool = True
) -> Compiled[P, R] | Callable[[Callable[P, R]], Compiled[P, R]]:
    """Decorator: compiles a function by Numba when it is first needed and caches it on disk.

    If Numba is missing, the first call raises DependencyError.

    Args:
        function: The function.
        reordered: Whether sums may be reordered, so that long loops use vector instructions.
        python: Whether Python calls it; one that only compiled functions call compiles faster.
    """
    if function is not None:
        return Compiled(function, reordered=reordered, python=python)
    return lambda decorated: Compiled(decorated, reordered=reordered, python=python)

"""Functions with loops over arrays, compiled by Numba on their first call."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from functools import update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar, cast, overload

from regkit.system.errors import PluginError
from regkit.system.machine_types import machine_signature
from regkit.system.optional import load_library
from regkit.system.pointers import Pointer

P = ParamSpec("P")
R = TypeVar("R")

_DISPATCHERS: list[Any] = []
"""Numba's dispatchers of all functions compiled so far."""

_CALLBACKS: list[Callable[[], None]] = []
"""Callbacks to run once before the first compilation."""


class Compiled(Generic[P, R]):
    """A function that Numba compiles when it is first needed and caches on disk.

    If its annotations fix the types (``regkit.system.machine_types``), it is compiled for these
    alone, and can be called by its address (``regkit.system.pointers``). Otherwise it is compiled
    for the types of each call. Importing Numba takes half a second, which commands without a
    registration avoid.
    """

    def __init__(self, function: Callable[P, R], *, reordered: bool) -> None:
        self.function = function
        self._reordered = reordered
        self._dispatcher: Callable[P, R] | None = None
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        """Calls the compiled function."""
        return (self._dispatcher or self.dispatcher())(*args, **kwargs)

    def dispatcher(self) -> Callable[P, R]:
        """Returns Numba's dispatcher of the function."""
        if self._dispatcher is None:
            names = cast(Any, self.function).__globals__
            # Numba calls only its own functions: replace those in the globals of this one.
            for name in self.function.__code__.co_names:
                if isinstance(names.get(name), Compiled | Pointer):
                    names[name] = names[name].dispatcher()
            _listen()
            signature = machine_signature(self.function)
            # Division by zero gives inf or nan, as in NumPy, and its check does not end a loop.
            options = {"error_model": "numpy"} if signature is not None else {}
            compile_for = load_library("numba").njit(
                signature, cache=True, fastmath=self._reordered, **options
            )
            self._dispatcher = cast(Callable[P, R], compile_for(self.function))
            _DISPATCHERS.append(self._dispatcher)
        return self._dispatcher

    def address(self) -> int:
        """Returns the address of the machine code.

        Raises:
            PluginError: If the annotations do not fix the types.
        """
        signature = machine_signature(self.function)
        if signature is None:
            name = f"{self.function.__module__}.{self.function.__qualname__}"
            raise PluginError(
                f"the compiled function {name} needs annotations of regkit.system.machine_types"
            )
        result = cast(Any, self.dispatcher()).get_compile_result(signature)
        return int(result.library.get_pointer_to_function(result.fndesc.llvm_func_name))


@overload
def compiled(function: Callable[P, R]) -> Compiled[P, R]: ...


@overload
def compiled(*, reordered: bool) -> Callable[[Callable[P, R]], Compiled[P, R]]: ...


def compiled(
    function: Callable[P, R] | None = None, *, reordered: bool = False
) -> Compiled[P, R] | Callable[[Callable[P, R]], Compiled[P, R]]:
    """Decorator: compiles a function by Numba when it is first needed and caches it on disk.

    If Numba is missing, the first call raises DependencyError.

    Args:
        function: The function.
        reordered: Whether sums may be reordered, so that long loops use vector instructions.
    """
    if function is not None:
        return Compiled(function, reordered=reordered)
    return lambda decorated: Compiled(decorated, reordered=reordered)


def loaded_loops() -> int:
    """Returns the number of loops compiled or loaded from disk so far, one per signature.

    A time measurement during which this number grows includes compilation.
    """
    return sum(len(dispatcher.overloads) for dispatcher in _DISPATCHERS)


def when_compiling(callback: Callable[[], None]) -> None:
    """Calls ``callback`` once, before the first compilation of a loop not cached on disk."""
    _CALLBACKS.append(callback)


def _listen() -> None:
    """Registers the callbacks with Numba before its first compilation."""
    if not _CALLBACKS or _DISPATCHERS:
        return
    load_library("numba")
    event = importlib.import_module("numba.core.event")

    class Listener(event.Listener):  # type: ignore[misc, name-defined]
        def on_start(self, _: Any) -> None:
            while _CALLBACKS:
                _CALLBACKS.pop()()

        def on_end(self, _: Any) -> None:
            """Ignored."""

    event.register("numba:compile", Listener())

"""Calls of compiled functions by their address."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from regkit.system.machine_types import machine_signature
from regkit.system.optional import load_library


class Pointer:
    """A call of any compiled function with the annotations of a prototype, by its address.

    In a compiled function, ``pointer(address, (argument, ...))`` calls it. So what is chosen at run
    time, as plug-ins are, needs no compilation of its caller.

    Args:
        prototype: A function with the types; its body is never run.
    """

    def __init__(self, prototype: Callable[..., Any]) -> None:
        self.prototype = prototype
        self._caller: Any = None

    def __call__(self, address: int, arguments: tuple[Any, ...]) -> Any:
        """Calls the function at an address, from a compiled function only."""
        raise TypeError("a pointer is called from compiled functions only")

    def accepts(self, function: Callable[..., Any]) -> bool:
        """Whether a function has the types of the prototype."""
        return bool(machine_signature(function) == machine_signature(self.prototype))

    def dispatcher(self) -> Any:
        """Returns what compiled functions call."""
        if self._caller is None:
            self._caller = _caller(machine_signature(self.prototype))
        return self._caller


def _caller(signature: Any) -> Any:
    """Returns Numba's intrinsic that calls a function of a signature by its address."""
    extending = load_library("numba.extending")
    cgutils = load_library("numba.core.cgutils")
    types = load_library("numba").types
    packed = types.BaseTuple.from_types(signature.args)

    def generated(context: Any, builder: Any, _: Any, given: Any) -> Any:
        address, arguments = given
        values = cgutils.unpack_tuple(builder, arguments, len(signature.args))
        convention, returned = context.call_conv, signature.return_type
        function = convention.get_function_type(returned, signature.args)
        pointer = builder.inttoptr(address, function.as_pointer())
        status, result = convention.call_function(
            builder, pointer, returned, signature.args, values
        )
        with cgutils.if_unlikely(builder, status.is_error):
            convention.return_status_propagate(builder, status)
        return result

    def call(_: Any, address: Any, arguments: Any) -> Any:
        return signature.return_type(types.int64, packed), generated

    return extending.intrinsic(call)

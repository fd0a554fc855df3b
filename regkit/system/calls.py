"""Calls between compiled functions that are compiled apart.

Numba makes a callee a part of every caller, and compiles it again with each. Here a call is by name
or by address, so that a function is compiled once.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from regkit.system.machine_types import machine_signature
from regkit.system.optional import load_library


def external(signature: Any, name: str, address: int) -> Any:
    """Returns what compiled functions call to reach a compiled function by its name.

    Args:
        signature: Its signature.
        name: Unique name by which machine code refers to it.
        address: Its address in this process.
    """
    load_library("llvmlite.binding").add_symbol(name, address)
    cgutils = load_library("numba.core.cgutils")

    types = load_library("numba").types
    packed = types.StarArgTuple.from_types(signature.args)

    def generated(context: Any, builder: Any, _: Any, given: Any) -> Any:
        kind = context.call_conv.get_function_type(signature.return_type, signature.args)
        function = cgutils.get_or_insert_function(builder.module, kind, name)
        return _called(signature, context, builder, function, given[0])

    def call(context: Any, *arguments: Any) -> Any:
        return signature.return_type(packed), generated

    return load_library("numba.extending").intrinsic(call)


class Pointer:
    """A call of any compiled function with the annotations of a prototype, by its address.

    In a compiled function, ``pointer(address, argument, ...)`` calls it. So what is chosen at run
    time, as plug-ins are, needs no compilation of its caller.

    Args:
        prototype: A function with the types; its body is never run.
    """

    def __init__(self, prototype: Callable[..., Any]) -> None:
        self.prototype = prototype

    def __call__(self, address: int, *arguments: Any) -> Any:
        """Calls the function at an address, from a compiled function only."""
        raise TypeError("a pointer is called from compiled functions only")

    def accepts(self, function: Callable[..., Any]) -> bool:
        """Whether a function has the types of the prototype."""
        return bool(machine_signature(function) == self.signature)

    @cached_property
    def signature(self) -> Any:
        """Numba's signature of the prototype."""
        return machine_signature(self.prototype)

    @cached_property
    def callee(self) -> Any:
        """What compiled functions call."""
        signature = self.signature
        types = load_library("numba").types
        packed = types.StarArgTuple.from_types(signature.args)

        def generated(context: Any, builder: Any, _: Any, given: Any) -> Any:
            kind = context.call_conv.get_function_type(signature.return_type, signature.args)
            function = builder.inttoptr(given[0], kind.as_pointer())
            return _called(signature, context, builder, function, given[1])

        def call(context: Any, address: Any, *arguments: Any) -> Any:
            return signature.return_type(types.int64, packed), generated

        return load_library("numba.extending").intrinsic(call)


def _called(signature: Any, context: Any, builder: Any, function: Any, packed: Any) -> Any:
    """Generates the call of a function with a tuple of arguments; its errors are the caller's."""
    cgutils = load_library("numba.core.cgutils")
    values = cgutils.unpack_tuple(builder, packed, len(signature.args))
    convention = context.call_conv
    status, result = convention.call_function(
        builder, function, signature.return_type, signature.args, values
    )
    with cgutils.if_unlikely(builder, status.is_error):
        convention.return_status_propagate(builder, status)
    return result

"""Compilation on a second core: a process that compiles loops before this one needs them.

Numba compiles one function at a time in a process, but keeps machine code on disk, where another
process finds it. The first compilation therefore starts a process that compiles the functions whose
types are fixed (``regkit.system.machine_types``), while this one goes on with what it needs first.
"""

from __future__ import annotations

import atexit
import importlib
import os
import subprocess
import sys
from collections.abc import Iterable

MODULES: dict[str, None] = {}
"""Names of the modules with compiled functions that are loaded, in the order of loading."""

_ASKED = "REGKIT_COMPILES_AHEAD"
"""Environment variable that is set where such a process runs already, or must not."""


def compile_ahead() -> None:
    """Starts the process, once, if there is a second core."""
    if _ASKED in os.environ or not sys.executable or (os.cpu_count() or 1) < 2:
        return
    os.environ[_ASKED] = "1"
    command = [sys.executable, "-m", __name__, *MODULES]
    silent = subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=silent, stdout=silent, stderr=silent)
    atexit.register(_end, process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """Ends the process with this one: what it has finished is kept."""
    process.terminate()
    process.wait()


def compile_all(modules: Iterable[str]) -> None:
    """Compiles the functions with fixed types of some modules, and keeps them on disk."""
    from regkit.system.compiled import Compiled

    for name in modules:
        try:
            found = vars(importlib.import_module(name)).values()
        except ImportError:
            continue  # A plug-in file has no module that can be imported.
        for function in found:
            if isinstance(function, Compiled) and function.signature is not None:
                _ = function.address


if __name__ == "__main__":
    compile_all(sys.argv[1:])

"""Processes that try cases one after the other; one that crashes or hangs is replaced."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import re
import resource
import signal
import tempfile
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from tests.fuzz.trial import PATIENCE, SECONDS, Outcome

Number = tuple[str, int]
"""Group and number of a case."""

HANGS = 2 * PATIENCE * SECONDS
"""A process that answers nothing for so long is in code that no alarm interrupts [s]."""
SPACE = 4 * 10**9
"""Address space that a process may take beyond what it has at its first case [bytes]."""
CASES = 3000
"""Number of cases after which a process is replaced, so that leaks do not add up."""


def outcomes(seed: int, numbers: Iterable[Number], jobs: int) -> Iterator[tuple[Number, Outcome]]:
    """Yields what comes of each case, in the order in which they end."""
    waiting = iter(numbers)
    workers = [Worker(seed) for _ in range(jobs)]
    try:
        busy = [worker for worker in workers if worker.begin(next(waiting, None))]
        while busy:
            wait([worker.connection for worker in busy], timeout=1.0)
            for worker in list(busy):
                outcome = worker.outcome()
                if outcome is None:
                    continue
                assert worker.case is not None
                yield worker.case, outcome
                if not worker.begin(next(waiting, None)):
                    busy.remove(worker)
    finally:
        for worker in workers:
            worker.end()


@dataclass
class Worker:
    """A process, and the case that it tries."""

    seed: int
    case: Number | None = None
    begun: float = 0.0
    done: int = 0
    connection: Connection = field(init=False)

    def __post_init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        handle, self._trace = tempfile.mkstemp(prefix="regkit-fuzz-trace-")
        os.close(handle)
        self.process = context.Process(
            target=_work, args=(theirs, self.seed, self._trace), daemon=True
        )
        self.process.start()
        theirs.close()

    def begin(self, case: Number | None) -> bool:
        """Start a case; false if there is none."""
        if case is None:
            return False
        if self.done >= CASES or not self.process.is_alive():
            self._restart()
        self.case, self.begun, self.done = case, time.monotonic(), self.done + 1
        self.connection.send(case)
        return True

    def outcome(self) -> Outcome | None:
        """What came of the case, if it has ended."""
        try:
            if self.connection.poll():
                return Outcome(**self.connection.recv())
        except (EOFError, ConnectionResetError):
            self.process.join()
            return self._crashed(self.process.exitcode or 0)
        if time.monotonic() - self.begun < HANGS:
            return None
        self.process.kill()
        self.process.join()
        return Outcome("slow", f"killed after {HANGS:g} s")

    def _crashed(self, code: int) -> Outcome:
        name = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        trace = Path(self._trace).read_text(errors="replace")
        own = re.findall(r'File "[^"]*?(regkit\w*/[^"]+)", line (\d+)', trace)
        return Outcome("crash", f"{name}\n{trace[:1500]}", ":".join(own[0]) if own else "")

    def _restart(self) -> None:
        self.end()
        self.done = 0
        self.__post_init__()

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.connection.close()
        Path(self._trace).unlink(missing_ok=True)


def _work(connection: Connection, seed: int, trace: str) -> None:
    """Answer with the outcome of each case, until the connection ends."""
    with open(trace, "w") as stream, open(os.devnull, "w") as nothing:  # noqa: PTH123
        faulthandler.enable(stream)
        # Libraries print from C++ as well.
        os.dup2(nothing.fileno(), 1)
        os.dup2(nothing.fileno(), 2)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        from tests.fuzz.case import Case
        from tests.fuzz.trial import tried

        _limit_space()
        while True:
            try:
                group, number = connection.recv()
            except EOFError:
                return
            outcome: dict[str, Any] = vars(tried(Case.of(group, seed, number)))
            connection.send(outcome)


def _limit_space() -> None:
    """Nothing that a file asks for brings the machine down."""
    text = Path("/proc/self/status").read_text()
    match = re.search(r"VmSize:\s+(\d+)", text)
    assert match is not None
    limit = 1024 * int(match[1]) + SPACE
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

"""One case, tried in this process: refused, accepted, or a failure of some kind."""

from __future__ import annotations

import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import FrameType

from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning
from tests.fuzz.case import Case
from tests.fuzz.seeds import GROUPS, seeds_of

SECONDS = 5.0
"""Longest time of a case [s] of the processor, as other programs may use the machine too."""
PATIENCE = 10.0
"""Longest time of a case on the clock, in multiples of ``SECONDS``."""
BYTES = 10**9
"""Most memory of a case, beyond what the process had before it."""
FINE = ("refused", "accepted")
"""Outcomes that are no failures."""


@dataclass(frozen=True)
class Outcome:
    """What came of a case.

    Attributes:
        result: ``refused``, ``accepted``, or a failure: ``foreign`` exception, ``nonsense``,
            ``slow``, ``memory``, ``crash``, ``warning``.
        reason: The message, or where the foreign exception comes from.
        where: The line of regkit's code nearest to a foreign exception, to sort failures by.
        seconds: Time of the processor that it took [s].
        bytes: Memory that it took at its peak.
    """

    result: str
    reason: str = ""
    where: str = ""
    seconds: float = 0.0
    bytes: int = 0

    @property
    def failed(self) -> bool:
        """Whether this must not happen."""
        return self.result not in FINE


@cache
def _import_readers(group: str, name: str) -> None:
    """Read a sound file of the kind, so that no case has to wait for imports."""
    (kind,) = (kind for kind in GROUPS[group] if kind.name == name)
    sound = seeds_of(group, name)[0]
    file = next(one for one in kind.forms if one in sound)
    case = Case(group, -1, kind, sound, file, sound[file], file, ())
    with tempfile.TemporaryDirectory(prefix="regkit-fuzz-") as scratch, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with suppress(RegkitError):
            kind.read(case.written(Path(scratch)))


class _TooLong(BaseException):
    """Not an Exception, so that no reader takes it for damage."""


def tried(case: Case, seconds: float = SECONDS) -> Outcome:
    """Read a case in a folder of its own."""
    _import_readers(case.group, case.kind.name)
    with tempfile.TemporaryDirectory(prefix="regkit-fuzz-") as scratch:
        path = case.written(Path(scratch))
        cost = _Cost()
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            result, reason, where = _result(case, path, told, cost, seconds)
        if result in FINE and cost.seconds > seconds:
            result, reason = "slow", f"{cost.seconds:.1f} s"
        elif result in FINE and cost.bytes > BYTES:
            result, reason = "memory", f"{cost.bytes / 1e9:.2f} GB"
        shown = reason.replace(scratch, "").replace(sys.prefix, "")[:2000]
        return Outcome(result, shown, where, cost.seconds, cost.bytes)


def _result(
    case: Case,
    path: Path,
    told: list[warnings.WarningMessage],
    cost: _Cost,
    seconds: float,
) -> tuple[str, str, str]:
    try:
        with _alarm(seconds), cost:
            value = case.kind.read(path)
    except RegkitError as error:
        return "refused", str(error), ""
    except _TooLong as error:
        return "slow", f"more than {seconds:g} s", _where(error)
    except BaseException as error:
        # An interruption of the whole run is no failure of the reader.
        if isinstance(error, KeyboardInterrupt):
            raise
        lines = traceback.format_exception(error)
        return "foreign", "".join(lines[-4:]).strip(), f"{type(error).__name__} {_where(error)}"
    foreign = [one for one in told if not issubclass(one.category, RegkitWarning)]
    if foreign:
        first = foreign[0]
        place = f"{_short(first.filename)}:{first.lineno}"
        return "warning", f"{first.category.__name__}: {first.message}", place
    noted = len(told) > len(foreign)
    try:
        complaints = list(case.kind.nonsense(value, case.damaged(noted=noted)))
    except (ValueError, TypeError, IndexError, ArithmeticError) as error:
        # A value that cannot even be looked at, such as one of an impossible shape.
        return "nonsense", f"{type(error).__name__}: {error}", _where(error)
    if complaints:
        return "nonsense", "; ".join(complaints[:4]), complaints[0].partition(":")[0]
    return "accepted", "", ""


class _Cost:
    """Context manager: what the reader takes, without the oracle that looks at its answer."""

    seconds: float = 0.0
    bytes: int = 0

    def __enter__(self) -> None:
        with suppress(OSError):
            # The kernel forgets the peak so far.
            Path("/proc/self/clear_refs").write_text("5")
        self._before, self._begun = _memory("VmRSS"), time.process_time()

    def __exit__(self, *_: object) -> None:
        self.seconds = time.process_time() - self._begun
        self.bytes = max(0, _memory("VmHWM") - self._before)


@contextmanager
def _alarm(seconds: float) -> Iterator[None]:
    def ring(signum: int, frame: FrameType | None) -> None:
        raise _TooLong

    before = [signal.signal(one, ring) for one in (signal.SIGPROF, signal.SIGALRM)]
    signal.setitimer(signal.ITIMER_PROF, seconds)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE * seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        for one, handler in zip((signal.SIGPROF, signal.SIGALRM), before, strict=True):
            signal.signal(one, handler)


def _where(error: BaseException) -> str:
    """The innermost line of regkit's code, which should have been guarded."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "regkit" in _short(frame.filename).partition("/")[0]]
    return f"{_short(own[-1].filename)}:{own[-1].lineno}" if own else ""


def _short(file: str) -> str:
    """A file of regkit by its module's path; others by their name."""
    parts = Path(file).parts
    rooms = [n for n, part in enumerate(parts) if part.startswith("regkit")]
    return "/".join(parts[rooms[-1] :]) if rooms else parts[-1]


def _memory(field: str) -> int:
    """A field of this process' status [bytes]; 0 where there is no such file."""
    with suppress(OSError):
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith(field):
                return 1024 * int(line.split()[1])
    return 0

"""Computations in chunks: the same chunks and order for any number of threads."""

import threading

import pytest

from regkit.system.errors import ConfigError
from regkit.system.threads import MOST, each, in_chunks, using_threads


@pytest.mark.parametrize("threads", [None, 1, 2, 5])
@pytest.mark.parametrize("count", [0, 1, 10, 11, 10 * MOST, 100 * MOST + 3])
def test_chunks_cover_all_items_in_order(threads, count):
    with using_threads(threads):
        parts = in_chunks(lambda begin, end: list(range(begin, end)), count, 10)
    assert [one for part in parts for one in part] == list(range(count))
    assert len(parts) <= MOST
    assert all(len(part) >= 10 for part in parts[:-1])


def test_two_threads_work_at_the_same_time():
    meeting = threading.Barrier(2, timeout=20.0)
    with using_threads(2):
        assert sorted(each(lambda _: meeting.wait(), (0, 1))) == [0, 1]


def test_a_task_of_a_pool_needs_no_other_thread():
    """A task that divides its own work would otherwise wait for itself."""
    with using_threads(2):
        assert each(lambda n: sum(each(lambda m: n * m, range(4))), range(6)) == [
            6 * n for n in range(6)
        ]


def test_error_of_a_task_is_raised():
    with using_threads(2), pytest.raises(ZeroDivisionError):
        each(lambda n: 1 // n, (1, 0))


def test_no_thread_at_all_is_refused():
    with pytest.raises(ConfigError, match="0 threads; at least one is needed"), using_threads(0):
        pass

"""Distribution of tasks to workers, and collection of their results."""

from __future__ import annotations

from regkit.experiment.ledger import Ledger
from regkit.experiment.progress import Progress
from regkit.experiment.task import Result, Task
from regkit.experiment.workers.schedule import Schedule
from regkit.experiment.workers.team import Team
from regkit.system.errors import RegkitError


def work(ledgers: list[Ledger], team: Team, progress: Progress) -> None:
    """Runs all unfinished tasks of some experiments.

    Raises:
        RegkitError: If all workers are lost.
    """
    progress.planned(
        sum(ledger.planned for ledger in ledgers), sum(ledger.finished for ledger in ledgers)
    )
    schedule = Schedule(pair for ledger in ledgers for pair in ledger.tracks())
    owners = {ledger.setting: ledger for ledger in ledgers}
    busy = 0
    while busy or not schedule.over:
        count = team.count()
        while busy < count and (task := schedule.next(count)):
            progress.begin(task.label, owners[task.setting].frames(task))
            team.begin(task)
            busy += 1
        task, result = team.ended(progress)
        busy -= 1
        ended = _taken_in(task, result, owners[task.setting], schedule)
        progress.end(task.label, ended, result if isinstance(result, RegkitError) else None)


def _taken_in(task: Task, result: Result, ledger: Ledger, schedule: Schedule) -> int:
    """Records a task's result, and returns the number of tracks that ended with it."""
    if result is None:
        schedule.opened(task)
        return 0
    tracks = schedule.closed(task) if task.method is None else [task]
    for track in tracks:
        ledger.ended(track, result)
    return len(tracks)

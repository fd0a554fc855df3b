"""A report with all its figures, which takes seconds to draw and which no test changes."""

from pathlib import Path

import pytest
from made_results import made_run

from regkit.report import write_report

REASON = "a | in <b>the</b> reason, with /a/very/long/path/" + "without/a/space/" * 12


@pytest.fixture(scope="session")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    write_report(made_run(failures={"icp": {"lost_take": REASON}}), folder)
    return folder

"""Compilation ahead, in a process of its own."""

import os
import subprocess
import sys


def test_what_is_compiled_ahead_is_found_on_disk(tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path), "REGKIT_COMPILES_AHEAD": "1"}
    modules = ["regkit.observation.compiled_arrays", "no_such_module"]
    program = [sys.executable, "-m", "regkit.system.compile_ahead", *modules]
    subprocess.run(program, env=environment, check=True, timeout=120)
    found = (
        "from regkit.observation.compiled_arrays import centred_points as f\n"
        "print(sum(f.dispatcher.stats.cache_hits.values()))"
    )
    ended = subprocess.run(
        [sys.executable, "-c", found], env=environment, check=True, timeout=120,
        capture_output=True, text=True,
    )  # fmt: skip
    assert ended.stdout == "1\n"

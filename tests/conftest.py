"""Fixtures that many tests share: a linkage with every type of joint, and the reference data."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.testing.samples import LINKAGE

ROOT = Path(__file__).parent.parent
REFERENCE_DATA = ROOT.parent / "shared" / "data"

# What runs in the background may be started with Ctrl-C ignored, and so would the processes be that
# tests start; they press it as a terminal does.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# A console keeps the width that it is told when it is made; without it, it asks each time.
os.environ.pop("COLUMNS", None)


@pytest.fixture(scope="session")
def linkage_text() -> str:
    return LINKAGE.read_text()


@pytest.fixture(scope="session")
def linkage() -> Body:
    return Document.read(LINKAGE).validated(BodyDescription).body("linkage", 1.2)


@pytest.fixture
def random() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.fixture(scope="session")
def reference_data() -> Path:
    """The reference data, which lie beside the project where it is developed."""
    if not REFERENCE_DATA.is_dir():
        pytest.skip(f"the reference data are not at {REFERENCE_DATA}")
    return REFERENCE_DATA


@pytest.fixture(scope="session")
def lump() -> np.ndarray:
    """1,500 points on a closed surface without symmetry, about 0.4 m long, away from the origin."""
    random = np.random.default_rng(3)
    directions = random.normal(size=(1500, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = directions.T
    radii = 1.0 + 0.3 * np.sin(3.0 * x + 1.0) * y + 0.35 * np.cos(2.0 * z) * x + 0.2 * y * z
    return 0.1 * radii[:, None] * directions * [1.6, 1.0, 0.7] + [0.5, -0.2, 1.0]


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads or leaves anything in the user's cache."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("REGKIT_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield

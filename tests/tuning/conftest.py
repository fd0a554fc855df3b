"""Bodies of the tests: a person, a hand, and a linkage with every type of joint."""

from __future__ import annotations

import pytest

from regkit.testing.samples import linkage
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human


@pytest.fixture(scope="session")
def human():
    return Human().body(1.75)


@pytest.fixture(scope="session")
def hand():
    return Hand().body(0.19)


@pytest.fixture(scope="session", params=["human", "hand", "linkage"])
def body(request):
    if request.param == "linkage":
        return linkage()
    return request.getfixturevalue(request.param)

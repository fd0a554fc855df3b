"""Bodies of the tests: a person, a hand, and a linkage with every type of joint."""

from __future__ import annotations

from pathlib import Path

import pytest
from few_samples import make_few

from regkit.interfaces import Template
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


KITE = Path(__file__).with_name("kite.yaml")
"""A trunk with two arms, and lists of Gaussians and capsules that are mirror images."""


@pytest.fixture(scope="session")
def kite():
    return KITE


@pytest.fixture(scope="session")
def kite_template():
    return Template.parse(KITE, place="tests", field="template")


@pytest.fixture
def few(monkeypatch):
    """Few steps, held-out samples and trials: a second of work, not a minute."""
    make_few(monkeypatch)

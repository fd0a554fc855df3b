"""Changes of nested data: settings, sweeps and presets change it in the same way."""

import copy
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regkit.config.changes import with_changes, with_value
from regkit.system.errors import ConfigError

KEYS = st.sampled_from("abc")
SINGLE = st.integers() | st.booleans() | st.floats(allow_nan=False)
PARTS = st.dictionaries(KEYS, SINGLE, max_size=2) | st.lists(SINGLE, max_size=2)
DATA = SINGLE | PARTS | st.dictionaries(KEYS, PARTS, max_size=2) | st.lists(PARTS, max_size=2)
MAPPINGS = st.dictionaries(KEYS, DATA, max_size=3)

seeded = settings(max_examples=50, deadline=None, derandomize=True)


def at(data: Any, location: tuple[str | int, ...]) -> Any:
    for part in location:
        data = data[part]
    return data


def paths(data: Any, way: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """The paths to all values, items of lists by their numbers."""
    parts = data.items() if isinstance(data, dict) else enumerate(data)
    found = []
    for key, part in parts:
        found.append((*way, str(key)))
        if isinstance(part, dict | list):
            found += paths(part, found[-1])
    return found


@seeded
@given(data=MAPPINGS, value=DATA, choice=st.data())
def test_value_stands_at_the_end_of_its_path_and_nothing_else_changes(data, value, choice):
    before = copy.deepcopy(data)
    keys = choice.draw(st.sampled_from([*paths(data), ("d",), ("d", "e")]))
    changed, location = with_value(data, keys, value)
    assert data == before
    assert tuple(map(str, location)) == keys
    assert at(changed, location) == value
    others = [way for way in paths(data) if way[: len(keys)] != keys and keys[: len(way)] != way]
    for way in others:
        _, there = with_value(data, way, None)
        assert at(changed, there) == at(data, there)


@seeded
@given(data=MAPPINGS, changes=MAPPINGS)
def test_changes_made_twice_are_those_made_once(data, changes):
    once = with_changes(data, changes)
    assert with_changes(once, changes) == once


@seeded
@given(data=MAPPINGS)
def test_data_do_not_change_by_what_they_hold(data):
    assert with_changes(data, data) == data
    assert with_changes(data, {}) == data


@seeded
@given(data=MAPPINGS, key=KEYS, value=SINGLE)
def test_one_change_is_one_value(data, key, value):
    assert with_changes(data, {key: value}) == with_value(data, (key,), value)[0]


def test_mapping_of_the_same_kind_is_changed_and_one_of_another_kind_replaced():
    data = {"solver": {"kind": "one", "steps": 3, "memory": 4}}
    assert with_changes(data, {"solver": {"steps": 5}})["solver"] == {
        "kind": "one", "steps": 5, "memory": 4
    }  # fmt: skip
    other = {"kind": "other", "steps": 5}
    assert with_changes(data, {"solver": other})["solver"] == other


def test_short_form_becomes_a_mapping():
    assert with_changes({"shape": "sog"}, {"shape": {"size": 1}}) == {
        "shape": {"kind": "sog", "size": 1}
    }
    assert with_value({"shape": "sog"}, ("shape", "size"), 1)[0] == {
        "shape": {"kind": "sog", "size": 1}
    }


def test_items_of_lists_are_named_by_numbers():
    data = {"terms": ["one", {"kind": "two", "weight": 1}]}
    assert with_changes(data, {"terms": {"1": {"weight": 2}}})["terms"] == [
        "one", {"kind": "two", "weight": 2}
    ]  # fmt: skip
    assert with_changes(data, {"terms": ["three"]})["terms"] == ["three"]
    for wrong in ("2", "-1", "one"):
        with pytest.raises(ConfigError, match=rf"terms is a list of 2.* no item '{wrong}'"):
            with_value(data, ("terms", wrong), 1)
    with pytest.raises(ConfigError, match=r"terms is a list of 2.* no item '2'"):
        with_changes(data, {"terms": {"2": {"weight": 2}}})


def test_path_through_a_single_value_is_refused():
    with pytest.raises(ConfigError, match=r"a\.b is 3"):
        with_value({"a": {"b": 3}}, ("a", "b", "c"), 1)

"""Addresses of sources: schemes, suffixes, files that several plug-ins may read."""

from pathlib import Path
from typing import ClassVar, Literal

import pytest
from places import DATA

import regkit
from regkit.config.plugin import register
from regkit.interfaces import Source
from regkit.system.errors import ConfigError, DataError, RegkitError

WALK = DATA / "human_walk"


def reader(name, begin, *, suffix=".odd", scheme=""):
    """Registers a source that accepts files of a suffix which begin with a text."""

    class Reader(Source):
        """Reads odd files."""

        kind: Literal[name] = name
        suffixes: ClassVar[tuple[str, ...]] = (suffix,)
        path: str = ""
        """The file."""
        port: int = 0
        """A number."""

        @classmethod
        def accepts(cls, path):
            return super().accepts(path) and path.read_text().startswith(begin)

        def open(self):
            raise NotImplementedError

    Reader.scheme = scheme
    return register(Reader)


def refusal(address, **fields):
    with pytest.raises(RegkitError) as caught:
        Source.at(address, **fields)
    return caught.value


def test_folder_of_a_recording_is_a_source():
    for address in (WALK, str(WALK)):
        source = Source.at(address)
        assert (source.kind, source.path) == ("folder", WALK)
    with regkit.open_source(WALK) as stream:
        assert len(list(stream)) == stream.length == 60


def test_source_looks_into_files_that_several_may_read(tmp_path):
    first, second = reader("first", "a"), reader("second", "b")
    file = tmp_path / "some.ODD"
    for text, kind in (("a", first), ("b", second)):
        file.write_text(text)
        assert type(Source.at(file)) is kind
    file.write_text("c")
    error = refusal(file)
    assert isinstance(error, DataError)
    assert all(name in str(error) for name in ("first", "second", str(file)))


def test_source_that_several_read_is_chosen_by_its_kind(tmp_path):
    reader("first", "a")
    second = reader("second", "a")
    file = tmp_path / "some.odd"
    file.write_text("a")
    error = refusal(file)
    assert isinstance(error, ConfigError)
    assert all(name in str(error) for name in ("first", "second", "'kind'"))
    assert type(Source.at(file, kind="second")) is second
    assert "did you mean 'second'" in str(refusal(file, kind="secnd"))


@pytest.mark.parametrize("kind", [3, ["folder"], {"a": 1}, ""])
def test_kind_that_is_no_name_is_refused(kind):
    assert isinstance(refusal(WALK, kind=kind), RegkitError)


def test_file_that_cannot_be_looked_into_matters_only_if_no_source_accepts_it(tmp_path):
    reader("first", "a")
    file = tmp_path / "some.odd"
    file.write_bytes(b"\xff\xfe\xff")
    error = refusal(file)
    assert isinstance(error, DataError)
    assert str(error).startswith(f"{file}: not a recording: ")
    second = reader("second", "a")
    second.accepts = classmethod(lambda cls, path: True)
    assert type(Source.at(file)) is second


def test_file_that_no_source_reads_is_told_with_those_that_are(tmp_path):
    reader("first", "a")
    (tmp_path / "some.png").write_text("a")
    (tmp_path / "none").write_text("a")
    told = str(refusal(tmp_path / "some.png"))
    assert all(word in told for word in ("'.png'", ".odd", ".mcap"))
    assert "no suffix" in str(refusal(tmp_path / "none"))
    assert "folder" in str(refusal(tmp_path))


@pytest.mark.parametrize(
    "address", ["nothing.mcap", "C:\\walk.mcap", "c:/walk.mcap", "C:walk.mcap", "", "~nobody/x"]
)
def test_path_that_is_not_there_is_no_scheme(tmp_path, monkeypatch, address):
    monkeypatch.chdir(tmp_path)
    told = str(refusal(address))
    assert "scheme" not in told


@pytest.mark.parametrize("address", [None, 3, [[[0.0]]], {"kind": "folder"}])
def test_what_is_no_address_is_refused(address):
    with pytest.raises(ConfigError, match=f"not {type(address).__name__};"):
        Source.at(address)


def test_scheme_names_a_camera(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    odd = reader("camera", "a", scheme="odd")
    source = Source.at("odd:12", port=3)
    assert type(source) is odd
    assert (source.path, source.port) == ("12", 3)
    error = refusal("od:12")
    assert isinstance(error, ConfigError)
    assert all(word in str(error) for word in ("'od:'", "odd:", "realsense:", "did you mean"))
    # A file may have a colon in its name.
    Path("odd:12.odd").write_text("a")
    assert Source.at("odd:12.odd").path == "odd:12.odd"


def test_field_that_is_wrong_is_told_with_the_address():
    told = str(refusal(WALK, paths=3))
    assert told.startswith(f"{WALK}: source.paths: no such field")


def test_yaml_file_is_a_source_with_its_fields(tmp_path):
    file = tmp_path / "walk.yaml"
    (tmp_path / "recorded").symlink_to(WALK)
    file.write_text("kind: folder\npath: recorded\n")
    assert Source.at(file).path == tmp_path / "recorded"
    file.write_text("kind: folder\npath: recorded\npaths: 3\n")
    assert f"{file}:3" in str(refusal(file))


def test_broken_plugin_matters_only_to_those_who_name_it(distribution):
    distribution("[regkit.sources]\nodd = no_such_module:Odd\n")
    assert Source.at(WALK).kind == "folder"
    assert "no_such_module" in str(refusal(WALK, kind="odd"))

"""XML elements that know on which line they stand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Element:
    """An element of an XML file.

    Attributes:
        tag: Its name.
        attributes: What is written in its tag.
        place: ``file:line``.
        children: The elements in it.
    """

    tag: str
    attributes: Mapping[str, str]
    place: str
    children: list[Element] = field(default_factory=list)

    @classmethod
    def read(cls, path: Path) -> Element:
        """The outermost element of a file; zeros after its end are overlooked.

        Raises:
            DataError: If the file is missing or is no XML.
        """
        try:
            content = path.read_bytes()
        except FileNotFoundError:
            raise DataError("the file is missing", place=str(path)) from None
        except OSError as error:
            raise DataError(f"cannot be read: {error.strerror}", place=str(path)) from None
        outermost = cls("", {}, str(path))
        around = [outermost]
        parser = expat.ParserCreate()

        def start(tag: str, attributes: dict[str, str]) -> None:
            element = cls(tag, attributes, f"{path}:{parser.CurrentLineNumber}")
            around[-1].children.append(element)
            around.append(element)

        def end(tag: str) -> None:
            around.pop()

        parser.StartElementHandler = start
        parser.EndElementHandler = end
        try:
            parser.Parse(content.rstrip(b"\0 \t\r\n"), True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise DataError(f"not XML: {reason}", place=f"{path}:{error.lineno}") from None
        return outermost.children[0]

    def all(self, tag: str) -> Iterator[Element]:
        """The children with a tag."""
        return (child for child in self.children if child.tag == tag)

    def find(self, tag: str) -> Element | None:
        """The first child with a tag, if there is one."""
        return next(self.all(tag), None)

    def need(self, tag: str) -> Element:
        """The first child with a tag.

        Raises:
            DataError: If there is none.
        """
        found = self.find(tag)
        if found is None:
            raise self.wrong(f"<{self.tag}> needs a <{tag}>")
        return found

    def text(self, attribute: str) -> str:
        """An attribute.

        Raises:
            DataError: If there is none.
        """
        if attribute not in self.attributes:
            raise self.wrong(f"<{self.tag}> needs the attribute {attribute}")
        return self.attributes[attribute].strip()

    def number(self, attribute: str, default: float | None = None) -> float:
        """A number in an attribute.

        Raises:
            DataError: If it is no number, or there is none and no default.
        """
        given = None if default is None else np.array([default])
        return float(self.numbers(attribute, 1, given)[0])

    def numbers(self, attribute: str, count: int, default: Array | None = None) -> Array:
        """The numbers in an attribute, (count,).

        Raises:
            DataError: If they are no finite numbers, others in number, or there are none and no
                default.
        """
        if attribute not in self.attributes and default is not None:
            return default
        words = self.text(attribute).split()
        try:
            values = np.array([float(word) for word in words])
        except ValueError:
            values = np.full(1, np.nan)
        if len(values) != count or not np.isfinite(values).all():
            wanted = "a number" if count == 1 else f"{count} numbers"
            raise self.wrong(f'{attribute}="{" ".join(words)}" of <{self.tag}> must be {wanted}')
        return values

    def wrong(self, message: str) -> DataError:
        """An error at this element."""
        return DataError(message, place=self.place)

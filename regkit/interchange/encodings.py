"""The encodings of text files whose formats name none."""

from __future__ import annotations

import codecs
from dataclasses import dataclass
from pathlib import Path

from regkit.system.notes import note


@dataclass(frozen=True)
class Decoded:
    """The text of a file.

    Attributes:
        text: The text, without a byte order mark and without null bytes at the end.
        guessed: Name of the encoding, if it is a guess.
    """

    text: str
    guessed: str | None

    @classmethod
    def of(cls, content: bytes, declared: str = "utf-8") -> Decoded:
        """Returns the text of a file's content.

        It is in UTF-16 or UTF-8 by its byte order mark, in the declared encoding, or in UTF-8. In
        Latin-1 text the bytes from 0x80 to 0x9f do not occur, and in Japanese Shift-JIS they do.

        Args:
            content: The content of the file.
            declared: The encoding that the file names.
        """
        if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            return cls(_trimmed(content.decode("utf-16", errors="replace")), None)
        for encoding in (declared, "utf-8"):
            try:
                return cls(_trimmed(content.decode(encoding)), None)
            except (LookupError, ValueError):
                continue
        if any(0x80 <= byte < 0xA0 for byte in content):
            try:
                return cls(_trimmed(content.decode("cp932")), "Shift-JIS")
            except UnicodeDecodeError:
                pass
        return cls(_trimmed(content.decode("latin-1")), "Latin-1")

    def tell(self, path: Path) -> None:
        """Notes the encoding if it is a guess."""
        if self.guessed is not None:
            note(
                f"is not UTF-8 text; it is read as {self.guessed}, and names may be wrong",
                place=path,
            )


def _trimmed(text: str) -> str:
    return text.lstrip("\ufeff").rstrip("\0\x1a \t\r\n")

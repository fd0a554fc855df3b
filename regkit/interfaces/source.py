"""Sources: cameras and recordings that yield frames with their time, finite or not."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import Any, ClassVar

from regkit.config.plugin import Plugin
from regkit.interfaces.stream import Stream
from regkit.system.errors import ConfigError


class Source(Plugin, ABC):
    """A camera or a recording, found by its address: a scheme, or the suffix of a file.

    ``realsense:0123`` is the camera of a serial number, as the plug-in with the scheme
    ``realsense`` opens it; ``walk.mcap`` is a file whose suffix a plug-in lists and which it
    accepts; ``camera.yaml`` is a file with the kind and the fields of a source.
    """

    group = "regkit.sources"

    scheme: ClassVar[str] = ""
    """Begin of an address without its colon; empty for files and folders."""
    suffixes: ClassVar[tuple[str, ...]] = ()
    """Suffixes of the files that the plug-in reads, in lower case with their dot."""

    @classmethod
    def at(cls, address: str | Path, **fields: Any) -> Source:
        """Returns the source of an address.

        Args:
            address: A camera, such as ``realsense:``, or the path of a file or folder.
            fields: Values of the plug-in's fields; ``kind`` names the plug-in itself, where
                several read the same files.

        Raises:
            RegkitError: If there is no such file, no plug-in reads it, or several do; or if a field
                is invalid.
        """
        data = cls.described(address, fields.get("kind"))
        return cls.parse({**data, **fields}, place=str(address), field="source")

    @classmethod
    def described(cls, address: str | Path, kind: str | None = None) -> dict[str, Any]:
        """Returns the data of the source of an address: its kind, and the fields in the address.

        Args:
            address: A camera, such as ``realsense:``, or the path of a file or folder.
            kind: Name of the plug-in; by default the one that the address names or that accepts
                the file.

        Raises:
            RegkitError: If there is no such file, or no plug-in reads it, or several do.
        """
        # The search loads the plug-ins of this group, and so imports this module.
        from regkit.interfaces.source_search import described

        if not isinstance(address, str | Path):
            raise ConfigError(
                f"an address or a path is needed, not {type(address).__name__}; arrays are tracked "
                "by regkit.track, and a source of your own is a plug-in",
                place="source",
            )
        return described(str(address), kind)

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether a file or folder is of this plug-in's format.

        Several plug-ins may list a suffix, so those whose format shares it look into the file. The
        default accepts every file with a suffix of the plug-in.
        """
        return path.is_file() and path.suffix.lower() in cls.suffixes

    @classmethod
    def fields_of(cls, address: str) -> dict[str, Any]:
        """Returns the fields that an address stands for; the default is its path.

        Args:
            address: The path of a file or folder, or what follows the scheme and its colon.
        """
        return {"path": address}

    @abstractmethod
    def open(self) -> Stream:
        """Opens the source at its first frame.

        Raises:
            RegkitError: If it does not exist, cannot be read, or needs a missing library.
        """

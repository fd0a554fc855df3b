"""A scene in a notebook, as a file, or in a browser."""

from __future__ import annotations

import tempfile
import webbrowser
from dataclasses import dataclass
from html import escape
from pathlib import Path

from regkit.system.errors import ConfigError
from regkit.system.files import write_text
from regkit.system.names import file_name
from regkit.viewer.replay import replay
from regkit.viewer.scene import Scene

HEIGHT = 560
"""Height of a frame in a notebook [px]."""


@dataclass(frozen=True, repr=False)
class SceneView:
    """A scene that a notebook shows inline; its page needs neither a server nor a network.

    Attributes:
        scene: The scene.
        height: Height in a notebook [px].
    """

    scene: Scene
    height: int = HEIGHT

    def __post_init__(self) -> None:
        """Raises ConfigError if the height is not positive."""
        if not self.height > 0:
            raise ConfigError(f"{self.height} pixels; it must be positive", place="height")

    def html(self) -> str:
        """Returns the page.

        Raises:
            DataError: If the scene is too large for a page.
        """
        return replay(self.scene)

    def save(self, path: str | Path) -> None:
        """Writes the page to a file that any browser opens.

        Raises:
            RegkitError: If the suffix is not ``.html``, or the file cannot be written.
        """
        if Path(path).suffix.lower() not in (".html", ".htm"):
            raise ConfigError(f"'{path}' must end with .html", place="path")
        write_text(Path(path), self.html())

    def open(self) -> Path:
        """Opens the page in a browser, and returns its file in a new temporary folder.

        Raises:
            DataError: If the file cannot be written.
        """
        file = Path(tempfile.mkdtemp(prefix="regkit-")) / f"{file_name(self.scene.title)}.html"
        self.save(file)
        webbrowser.open(file.as_uri())
        return file

    def __repr__(self) -> str:
        """Returns what the scene holds, in one line."""
        frames = sum(len(one.frames) for one in self.scene.recordings)
        return (
            f"<SceneView of '{self.scene.title}', {frames} frames; a notebook shows it, .open() a "
            'browser, and .save("scene.html") writes it>'
        )

    def _repr_html_(self) -> str:
        """Returns the page in a frame, for a notebook."""
        page, title = escape(self.html()), escape(self.scene.title)
        return (
            f'<iframe srcdoc="{page}" title="{title}" allow="fullscreen" '
            f'style="width: 100%; height: {self.height}px; border: 0"></iframe>'
        )

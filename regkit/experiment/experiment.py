"""What an experiment's YAML holds."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, ClassVar

from pydantic import AfterValidator, Field, ValidationInfo, WithJsonSchema, field_validator

from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.plugin import slot_default
from regkit.interfaces import Dataset, Method, Preprocessor, Recording, Template, Tracker
from regkit.skeleton import PoseDescription
from regkit.start import given_start
from regkit.system.errors import ConfigError
from regkit.tracking import Session

_FOLDER = r"^[A-Za-z0-9][A-Za-z0-9_.,=-]*$"


def _fit_for_a_folder(name: str) -> str:
    if not re.fullmatch(_FOLDER, name):
        raise ValueError(
            f"'{name}' names a folder: use letters, digits, '-', '_' and '.', and begin with a "
            "letter or digit"
        )
    return name


Name = Annotated[
    str,
    AfterValidator(_fit_for_a_folder),
    WithJsonSchema({"type": "string", "pattern": _FOLDER}),
]

RESERVED = (
    "config.yaml", "environment.json", "metrics.json", "report.html", "report.md",
    "starts", "figures", "tables",
)  # fmt: skip
"""What else is in a results folder, beside the methods' folders."""


def _not_reserved(name: str) -> str:
    # Some file systems do not tell capitals apart.
    if name.lower() in RESERVED:
        raise ValueError(f"'{name}' is what a run calls something else in its folder; take another")
    return name


class Experiment(Model):
    """Methods that register one template to the recordings of one dataset, on equal terms."""

    renamed: ClassVar[dict[str, str]] = {"observer": "preprocessor"}

    name: Name
    """What the results folder is called."""
    dataset: Dataset
    """Where the frames come from."""
    template: Template
    """What is seen in them."""
    subjects: dict[str, Template] = Field(default_factory=dict)
    """Templates of single people, by the dataset's names for them; all others get ``template``."""
    preprocessor: Preprocessor = slot_default(Preprocessor)
    """How frames become data."""
    tracker: Tracker = slot_default(Tracker)
    """How one frame's pose leads to the next."""
    start: PoseDescription | None = None
    """Pose in the first frame of every recording; found from the cloud without it. It needs the
    template's size."""
    methods: dict[Annotated[Name, AfterValidator(_not_reserved)], Method] = Field(min_length=1)
    """What is compared, by a name of your own."""

    @field_validator("start")
    @classmethod
    def _start_fits_template(
        cls, start: PoseDescription | None, others: ValidationInfo
    ) -> PoseDescription | None:
        templates = [others.data.get("template"), *others.data.get("subjects", {}).values()]
        for template in templates:
            if start is not None and isinstance(template, Template):
                try:
                    given_start(template, start)
                except ConfigError as error:
                    raise ValueError(error.message) from None
        return start

    @classmethod
    def read(
        cls, path: Path, settings: Iterable[str] = (), *, called: str = "setting"
    ) -> Experiment:
        """An experiment's YAML, after ``a.b.c=value`` settings; messages call each one ``called``.

        Raises:
            ConfigError: One line for each thing that is wrong, with its file, line and field; or
                the file holds a sweep, which is many experiments.
        """
        document = Document.read(path).overridden(settings, called=called)
        if document.data.get("sweep"):
            raise ConfigError(
                "a sweep makes many experiments, and one is needed here; remove it, as the setting "
                "sweep={} does",
                place=document.place(("sweep",)),
            )
        return document.without("sweep").validated(cls)

    def session(self, recording: Recording) -> Session:
        """A recording to be tracked, with the template of who is seen in it."""
        template = self.subjects.get(recording.subject or "", self.template)
        return Session(recording, template, self.preprocessor, self.start)

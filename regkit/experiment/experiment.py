"""The model of an experiment's YAML file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    WithJsonSchema,
    model_validator,
)

from regkit.config.document import Document
from regkit.config.model import Model, misplaced
from regkit.config.plugin import slot_default, slot_defaults
from regkit.interfaces import (
    Dataset,
    Method,
    Preprocessor,
    Recording,
    Segmenter,
    StartSearch,
    Template,
    Tracker,
    check_field,
)
from regkit.system.errors import ConfigError, FieldError, RegkitError
from regkit.system.names import LONGEST, file_name
from regkit.tracking import Session, Smoothing

_FOLDER = r"^[A-Za-z0-9][A-Za-z0-9_.,=-]*$"


def _fit_for_a_folder(name: str) -> str:
    if not re.fullmatch(_FOLDER, name):
        raise ValueError(
            f"'{name}' is used as a folder's name: use letters, digits, '-', '_' and '.', and "
            "begin with a letter or digit"
        )
    if file_name(name) != name:
        raise ValueError(
            f"'{name}' is used as a folder's name: it must not have more than {LONGEST} letters, "
            "end with '.', or be a device of Windows"
        )
    return name


Name = Annotated[
    str,
    AfterValidator(_fit_for_a_folder),
    WithJsonSchema({"type": "string", "pattern": _FOLDER}),
]

RESERVED = (
    "config.yaml", "environment.json", "setup.json", "metrics.json", "report.html", "report.md",
    "inputs", "starts", "figures", "tables",
)  # fmt: skip
"""Names in a results folder that are not available for methods."""


def _not_reserved(name: str) -> str:
    # Some file systems ignore the case of letters.
    if name.lower() in RESERVED:
        raise ValueError(f"'{name}' is reserved in results folders; choose another name")
    return name


def _smooth(value: Any) -> Any:
    if isinstance(value, str) and value != "smooth":
        raise ValueError(f"there is no refinement '{value}'; write smooth, or how the body moves")
    return {} if value == "smooth" else value


Refinement = Annotated[
    Smoothing | None,
    BeforeValidator(_smooth, json_schema_input_type=Literal["smooth"] | Smoothing | None),
]
"""A refinement by its name or its settings."""


class Experiment(Model):
    """Methods that register one template to the recordings of one dataset, on equal terms."""

    renamed: ClassVar[dict[str, str]] = {"observer": "preprocessor"}

    name: Name
    """Name of the results folder."""
    dataset: Dataset
    """The recordings."""
    template: Template
    """The body to register."""
    subjects: dict[str, Template] = Field(default_factory=dict)
    """Templates of individual subjects by the dataset's names; all others use ``template``."""
    segmentation: tuple[Segmenter, ...] = slot_defaults(Segmenter)
    """Segmenters that take the body out of the scene, applied in order before the preprocessor; an
    empty list takes the frames as they are."""
    preprocessor: Preprocessor = slot_default(Preprocessor)
    """Preprocessing of frames."""
    tracker: Tracker = slot_default(Tracker)
    """Tracker from frame to frame, for methods without one of their own."""
    start: StartSearch = slot_default(StartSearch)
    """Search for pose and size in the first frame of every recording, the same for all methods; or
    the pose itself (``kind: given``), which requires the template's size."""
    refine: Refinement = None
    """Refinement of each track when it has ended: `smooth`, or how the body moves, for the most
    likely poses given all frames. None by default."""
    methods: dict[Annotated[Name, AfterValidator(_not_reserved)], Method] = Field(min_length=1)
    """Methods to compare, by names of your choice."""

    @model_validator(mode="after")
    def _parts_fit_templates(self) -> Self:
        for template in (self.template, *self.subjects.values()):
            try:
                self.start.check(template)
            except FieldError as error:
                raise misplaced(type(self), error.message, "start", *error.location) from None
            except ConfigError as error:
                raise misplaced(type(self), error.message, "start") from None
            try:
                body = template.body(template.candidate_sizes()[0])
            except RegkitError:
                continue  # What is wrong with a template is told when it is used.
            try:
                check_field(self.tracker.check, body, "tracker")
                for name, method in self.methods.items():
                    check_field(method.check, body, "methods", name)
            except FieldError as error:
                raise misplaced(type(self), error.message, *error.location) from None
        return self

    @classmethod
    def read(
        cls, path: Path, settings: Iterable[str] = (), *, called: str = "setting"
    ) -> Experiment:
        """Reads an experiment's YAML, and applies ``a.b.c=value`` settings.

        Args:
            path: The file.
            settings: The settings, applied in order.
            called: Name of a setting in messages.

        Raises:
            ConfigError: One line for each mistake, with its file, line and field; or the file holds
                a sweep, which is several experiments.
        """
        document = Document.read(path).overridden(settings, called=called)
        if document.data.get("sweep"):
            raise ConfigError(
                "a sweep makes several experiments, but exactly one is needed here; remove it, for "
                "example with the setting sweep={}",
                place=document.place(("sweep",)),
            )
        return document.without("sweep").validated(cls)

    def session(self, recording: Recording) -> Session:
        """Returns a recording to track, with the template of its subject."""
        template = self.subjects.get(recording.subject or "", self.template)
        return Session(
            recording, template, self.preprocessor, self.start, segmentation=self.segmentation
        )

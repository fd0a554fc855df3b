"""The public conformance suite: a class of tests for the plug-ins of a distribution."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from regkit.config.plugin import Plugin
from regkit.interfaces import Kernel, Term
from regkit.testing.alignment_start_laws import AlignmentStartLaws
from regkit.testing.cases import Case, Examples, Pair, cases, pairs
from regkit.testing.dataset_laws import DatasetLaws
from regkit.testing.kernel_laws import KernelLaws
from regkit.testing.laws import Laws
from regkit.testing.method_laws import MethodLaws
from regkit.testing.parameter_laws import ParameterLaws
from regkit.testing.partner_laws import KernelPartnerLaws, ShapePartnerLaws
from regkit.testing.plugin_laws import PluginLaws
from regkit.testing.preprocessor_laws import PreprocessorLaws
from regkit.testing.segmenter_laws import SegmenterLaws
from regkit.testing.shape_laws import ShapeLaws
from regkit.testing.solver_laws import SolverLaws
from regkit.testing.source_laws import SourceLaws
from regkit.testing.start_laws import StartLaws
from regkit.testing.step_laws import StepLaws
from regkit.testing.template_laws import TemplateLaws
from regkit.testing.term_laws import TermLaws
from regkit.testing.tracker_laws import TrackerLaws

LAWS: Mapping[str, tuple[type[Laws], ...]] = {
    "plugin": (PluginLaws,),
    "dataset": (DatasetLaws,),
    "source": (SourceLaws,),
    "template": (TemplateLaws,),
    "segmenter": (SegmenterLaws,),
    "preprocessor": (PreprocessorLaws,),
    "shape": (ShapeLaws, ParameterLaws, StepLaws, ShapePartnerLaws),
    "kernel": (KernelPartnerLaws,),
    "pair": (KernelLaws,),
    "term_pair": (TermLaws,),
    "solver": (SolverLaws,),
    "start": (StartLaws,),
    "tracker": (TrackerLaws,),
    "alignment_start": (AlignmentStartLaws,),
    "method": (MethodLaws,),
}
"""Laws by the argument of their tests."""


class Conformance(Laws):
    """Base of the classes from ``conformance``."""


def conformance(
    *subjects: str | type[Plugin], examples: Examples | None = None
) -> type[Conformance]:
    """Returns a class with the laws of plug-ins as tests; assign it to a name like ``TestX``.

    Each law is tested once for each class, with its defaults or the first example. Kernels are
    paired with every shape that they accept, shapes with every kernel, and terms with one shape for
    each type of primitives that they accept. The laws of gradients and blocks are also tested with
    every other example, and with every value of each field that has a few named ones. A plug-in
    with required fields but no example is skipped, with the reason. Derive from the class to add
    laws of your own, or to override the fixtures ``body`` and ``rigid_body`` for shapes and
    methods.

    Args:
        subjects: Names of distributions, or classes decorated by ``@register``; all installed
            plug-ins if empty.
        examples: Options of plug-ins, as in YAML, by kind (or ``group.kind``): one mapping, or a
            list of them. ``{"my_dataset": {"root": "tests/data"}}``.

    Raises:
        PluginError: If no plug-in of that name is installed, or an example is invalid.
    """
    found = cases(subjects, examples or {})
    parameters: dict[str, list[Case | Pair]] = {
        "plugin": [case for case in found if case.own],
        "pair": [*pairs(found, Kernel)],
        "term_pair": [*pairs(found, Term)],
    }
    for case in found:
        argument = case.slot.group.removeprefix("regkit.").removesuffix("s")
        if case.own and not case.broken:
            parameters.setdefault(argument, []).append(case)
    bases = [law for argument, laws in LAWS.items() if parameters.get(argument) for law in laws]
    content: dict[str, Any] = {
        "parameters": parameters,
        "__doc__": f"The laws of the plug-ins of {', '.join(map(str, subjects)) or 'all'}.",
    }
    return type("Conformance", (Conformance, *bases), content)

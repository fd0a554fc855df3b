"""How Sphinx builds the documentation: ``make docs``, offline, warnings being errors."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

from regkit import __version__

project = "regkit"
author = "The regkit developers"
copyright = author
version = release = __version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "docstrings",
    "generated",
    "mathml",
    "notebook_cells",
]
exclude_patterns = ["_build", "examples"]
html_theme = "furo"
html_title = f"regkit {version}"
html_static_path = ["_static"]
html_css_files = ["regkit.css"]
html_show_sphinx = False
html_copy_source = False

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

autodoc_member_order = "bysource"
autodoc_default_options = {
    "members": True,
    "no-value": True,
    "exclude-members": "model_config",
}
autodoc_typehints = "signature"
autodoc_type_aliases = {
    name: name
    for name in (
        "Array",
        "ArrayLike",
        "Indices",
        "CameraChoice",
        "NoiseChoice",
        "Choice",
        "Choices",
        "Cloud",
        "Frames",
        "Intrinsics",
        "Measured",
        "OneFrame",
        "Reference",
    )
} | {"SceneView": "regkit.viewer.embedded.SceneView"}
napoleon_use_ivar = True
napoleon_use_rtype = False
python_use_unqualified_type_names = True
python_display_short_literal_types = True

nitpicky = True
nitpick_ignore_regex = [
    # Other libraries' names: the build has no network to look them up.
    (
        r"py:.*",
        r"(abc|annotated_types|collections|contextlib|importlib|matplotlib|np|numpy|pathlib)\..*",
    ),
    (r"py:.*", r"(pydantic|pydantic_core|rich|ruamel|scipy|types|typing)\..*"),
    # Names that stand for a type, for which there is nothing to link to.
    (
        r"py:class",
        r"TypeAliasForwardRef|ArrayLike|Beginning|Choices?|Cloud|Deviation|Frames|Intrinsics|Measured"
        r"|CameraChoice|ListName|NoiseChoice|OneFrame|Spread"
        r"|Reference|Weight|Vector|Position|Rotation|FrameCount|Length|Count|regkit\.body\.verdict\.Annotated",
    ),
    (r"py:class", r"Figure|Path|Field|FieldInfo|NoneType|Ge|Gt|Le|\d+\.\d|array|(dict|tuple)\[.*"),
    (
        r"py:class",
        r"(Integer|Single)?(Vector|Matrix)|float32|float64|int64|regkit\.system\.compiled\.R",
    ),
    # What starts and trackers share inside regkit is no part of its API.
    (r"py:class", r"regkit\.(body\.(distance|groups)|calibration\.base\.found|search)\..*"),
    # So is what tracks a stream, and keeps what was tracked.
    (r"py:class", r"regkit\.tracking\.(live|recorder|rows|clocks)\..*"),
    # Tables of fields describe the content of YAML files.
    (r"py:class", r"(regkit\.(body|skeleton)\..*\.)?\w+Description"),
    (r"py:class", r"regkit\.sensors\.noise\..*"),
    # Not part of the public interface.
    (r"py:class", r"regkit\.api\.tables\.Summary|regkit\.calibration\.\w+\.\w+"),
    (r"py:class", r"regkit\.body\.proportions\.Proportions"),
    (r"py:class", r"regkit\.registration\.constraints\._Rows"),
    (r"py:class", r"regkit\.config\.model\._from_its_folder"),
    (r"py:class", r"regkit\.testing\.conformance\.Conformance"),
    (r"py:(class|obj)", r"(.*\.)?(D|P|S|M|T|P_co|S_co)"),
]

# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx's settings; build.py calls it in a staged folder and sets the environment variables."""
import os

project = "libdelam"
author = "the authors of libdelam"
copyright = "the authors of libdelam; BSD-3-Clause"  # noqa: A001
release = version = os.environ["DELAM_SITE_VERSION"]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
root_doc = "index"
language = "en"
html_theme = "furo"
html_title = f"libdelam {release}"
html_static_path = [os.environ["DELAM_SITE_STATIC"]]
html_css_files = ["site.css"]
html_copy_source = html_show_sourcelink = False
html_theme_options = {"sidebar_hide_name": False}
highlight_language = "none"
pygments_style, pygments_dark_style = "friendly", "monokai"

myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = 6
# Documents of the tree may jump over a level of headings.
suppress_warnings = ["myst.header"]

# MathJax 2 of Debian, copied by build.py: formulas need no network.
myst_update_mathjax = False
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"messageStyle": "none", "SVG": {"font": "TeX", "scale": 95},
                   "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]]}}

breathe_projects = {"delam": os.environ["DELAM_SITE_XML"], "cpp": os.environ["DELAM_SITE_XML_CPP"]}
breathe_default_project = "delam"
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}
breathe_show_include = False

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
# Names of types that say more than what they stand for.
autodoc_type_aliases = {name: name for name in ("ArrayLike", "FloatArray", "IntArray", "Drive")}
autodoc_default_options = {"members": True, "undoc-members": False}


def plain(app, what, name, obj, options, lines):
    """Docstrings are written for help(), without markup: their words stand as they are, paragraph by paragraph."""
    if lines and lines[0].startswith("Alias for field number"):
        lines[:] = []
    paragraphs, inside = [], []
    for line in [*lines, ""]:
        if line.strip():
            inside.append(line)
            continue
        if inside:
            paragraphs.append(inside)
        inside = []
    lines[:] = []
    for paragraph in paragraphs:
        table = any(line.startswith("  ") or "  " in line.strip() for line in paragraph)
        if table:
            lines += ["::", "", *("    " + line for line in paragraph), ""]
        else:
            lines += [*(escaped(line.strip()) for line in paragraph), ""]


def escaped(line):
    return "".join("\\" + letter if letter in "\\*`|_" else letter for letter in line)


def setup(app):
    app.connect("autodoc-process-docstring", plain)

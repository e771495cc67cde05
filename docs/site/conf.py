"""Sphinx configuration of the documentation site, which `docs/site/build` calls with the staged sources."""

import pathlib
import re
import sys

from docutils import nodes
from matplotlib.figure import Figure
from pygments.lexers.special import TextLexer
from slipfront.plots import save
from sphinx_gallery.scrapers import figure_rst
from sphinx_gallery.sorting import FileNameSortKey

project = "slipfront"
copyright = "the authors of slipfront"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "breathe", "sphinx_copybutton",
              "sphinx_gallery.gen_gallery"]
if pathlib.Path(__file__).with_name("extra").exists():  # the explorer is part of the site
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    extensions.append("explorer_links")
    html_extra_path = ["extra"]
root_doc = "index"
# Sphinx-Gallery writes the pages of these folders to gallery/ and tutorials/, and a page with the times of their programs.
exclude_patterns = ["README.md", "docs/gallery", "docs/tutorials", "**/sg_execution_times.rst"]

html_theme = "furo"
html_title = "slipfront"
html_show_copyright = False
html_show_sphinx = False
html_copy_source = False
html_static_path = ["static"]
html_math_renderer = "katex"
html_css_files = ["site.css"]
html_theme_options = {"navigation_with_keys": True}
highlight_language = "none"

breathe_projects = {"slipfront": "doxygen/xml"}
breathe_default_project = "slipfront"

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4
copybutton_prompt_text = "$ "

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
SENTENCES = {"Returns": "Result", "Raises": "Errors"}
napoleon_custom_sections = list(SENTENCES.values())


def figures_of(block, block_vars, gallery_conf):
    """Saves the figures that a block of an example has made. They are not of pyplot, which Sphinx-Gallery looks for."""
    names = block_vars["example_globals"]
    saved = names.setdefault("_saved_figures", set())
    paths = []
    for figure in [value for value in names.values() if isinstance(value, Figure) and id(value) not in saved]:
        saved.add(id(figure))
        path = next(block_vars["image_path_iterator"])
        save(figure, path, bbox_inches="tight")
        paths.append(path)
    return figure_rst(paths, gallery_conf["src_dir"])


sphinx_gallery_conf = {
    "examples_dirs": ["docs/gallery", "docs/tutorials"],
    "gallery_dirs": ["gallery", "tutorials"],
    "within_subsection_order": FileNameSortKey,
    "image_scrapers": [figures_of],
    "min_reported_time": 1e9,
    "show_memory": False,
    "show_signature": False,
    "capture_repr": (),
    "remove_config_comments": True,
    "abort_on_example_error": True,
}


def as_sphinx_reads_it(app, what, name, obj, options, lines):
    """Adapts docstrings, which are written for a terminal. There |V| is a modulus and an indented block is a table.
    Sphinx would take the first for a substitution and the second for a quotation."""
    out = []
    for i, line in enumerate(lines):
        if what == "module" and line.startswith("    ") and not lines[i - 1]:
            out += ["::", ""]
        heading = i + 1 < len(lines) and lines[i + 1].startswith("---")
        out.append(SENTENCES.get(line, line) if heading else line.replace("|", r"\|"))
    lines[:] = out


def as_the_site_names_it(app, docname, source):
    """Leads links to scripts of the gallery and the tutorials, and to the list of them, to the pages made of them."""
    source[0] = re.sub(r"\]\((gallery|tutorials)/(\w+)\.(rst|py)\)", lambda link: f"](../{link[1]}/{link[2].replace('README', 'index')}.rst)", source[0])


def write_formula(translator, node):
    """Leaves a formula to KaTeX, which typesets it in the reader's browser."""
    tag, begin, end = ("div", r"\[", r"\]") if isinstance(node, nodes.math_block) else ("span", r"\(", r"\)")
    translator.body.append(translator.starttag(node, tag, "", CLASS="math notranslate nohighlight"))
    translator.body.append(f"{begin}{translator.encode(node.astext())}{end}</{tag}>")
    raise nodes.SkipNode


def load_katex(app, page, template, context, document):
    """Loads KaTeX on the pages that have formulas, and on no other."""
    if app.env.get_domain("math").has_equations(page):
        app.add_css_file("katex/katex.min.css")
        for script in ("katex/katex.min.js", "katex/auto-render.js", "formulas.js"):
            app.add_js_file(script, loading_method="defer")


def setup(app):
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", as_the_site_names_it)
    app.add_html_math_renderer("katex", (write_formula, None), (write_formula, None))
    app.connect("html-page-context", load_katex)
    app.connect("autodoc-process-docstring", as_sphinx_reads_it, priority=400)  # before napoleon

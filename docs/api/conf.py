# Sphinx: the reference of the Python package, from its docstrings. Built by the test `api_reference`, warnings as errors.
project = "slipfront"
copyright = "the authors of slipfront"
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "alabaster"
html_theme_options = {"nosidebar": True, "page_width": "68em", "font_size": "16px", "font_family": "sans-serif"}
html_show_copyright = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
SENTENCES = {"Returns": "Result", "Raises": "Errors"}
napoleon_custom_sections = list(SENTENCES.values())
highlight_language = "none"


def plain(app, what, name, obj, options, lines):
    """Docstrings are read in a terminal first. There |V| is a modulus, what is returned or raised is said in sentences, and an indented block
    is a table; Sphinx would take each for something else."""
    out = []
    for i, line in enumerate(lines):
        if what == "module" and line.startswith("    ") and not lines[i - 1]:
            out += ["::", ""]
        heading = i + 1 < len(lines) and lines[i + 1].startswith("---")
        out.append(SENTENCES.get(line, line) if heading else line.replace("|", r"\|"))
    lines[:] = out


def setup(app):
    app.connect("autodoc-process-docstring", plain, priority=400)  # before napoleon

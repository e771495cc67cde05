"""Writes report.html, a page with the whole reproduction that needs no other file."""

import html
import pathlib
import tomllib

from .report_figures import figure, heading_of, number, table

HERE = pathlib.Path(__file__).parent
TEXTS = tomllib.loads((HERE / "glossary.toml").read_text(encoding="utf-8"))
DOI = "https://doi.org/10.3390/lubricants3020311"
SECTIONS = (("result", "The main result"), ("symbols", "Symbols and words"), ("numbers", "Numbers"),
            ("statements", "Statements"), ("figures", "Figures"),
            ("formulas", "Misprinted formulas"), ("inputs", "Inputs of the paper"))


def contents(pictures) -> str:
    inner = "".join(f'<li><a href="#{picture.name}">{html.escape(heading_of(picture))}</a></li>'
                    for picture in pictures)
    items = "".join(
        f'<li><a href="#{name}">{title}</a>{f"<ul>{inner}</ul>" if name == "figures" else ""}</li>'
        for name, title in SECTIONS)
    return f'<nav aria-label="Contents"><h2>Contents</h2><ul>{items}</ul></nav>\n'


def main_result(levels) -> str:
    """Returns the comparison of the levels of theory, of levels.table."""
    heading = ("friction", "Γ = C t", "closed form", "pulse, consistent closure",
               f"chain, scale {levels['scale']}", "difference from the chain",
               "pulse, the paper's closure", "its difference from the chain")
    rows = [(f"C = {row['friction_coefficient']:g}", number(row["damping_number"]),
             number(row["closed_form"]), number(row["consistent"]), number(row["chain"]),
             f"{100 * row['consistent_off']:+.2f} %", number(row["paper"]),
             f"{100 * row['paper_off']:+.1f} %") for row in levels["rows"]]
    above = TEXTS["levels"]["above"].format(worst=100 * levels["worst"], scale=levels["scale"],
                                            paper=100 * levels["paper"])
    return (f"<p>{above}</p>\n{table(heading, rows, range(1, len(heading)))}"
            f"<p>{TEXTS['levels']['below']}</p>\n<pre>{html.escape(levels['command'])}</pre>\n")


def glossary() -> str:
    return "<dl>" + "".join(f"<dt>{html.escape(word['name'])}</dt><dd>"
                            f"{html.escape(word['meaning'])}</dd>\n"
                            for word in TEXTS["word"]) + "</dl>\n"


def numbers_section(rows) -> str:
    """Returns the section on the paper's numbers: how many have each verdict, and the table."""
    verdicts = list(dict.fromkeys(row["verdict"] for row in rows))
    counts = "; ".join(f"{verdict}: {sum(row['verdict'] == verdict for row in rows)}"
                       for verdict in sorted(verdicts, key=lambda text: text != "same"))
    heading = ("what", "where", "printed", "rounded as printed", "computed", "difference",
               "verdict", "remark")

    def difference(row):  # for a printed bound the difference has no meaning
        return f"{100 * row['difference']:+.1f} %" if row["printed"][:1].isdigit() else ""

    cells = [(row["what"] + ("" if row["unit"] == "1" or row["unit"] in row["what"] else ", "
                             f"{row['unit']}"), row["where"], row["printed"], row["printed_digits"],
              number(row["computed"]), difference(row), row["verdict"], row["remark"])
             for row in rows]
    return (f"<p>{len(rows)} printed numbers. {html.escape(counts.capitalize())}.</p>\n"
            + table(heading, cells, (2, 3, 4, 5), verdict=6, name="numbers"))


def statements_section(rows) -> str:
    cells = [(row["verdict"], row["statement"], row["where"], (row["found"], row["command"]),
              row["range"]) for row in rows]
    return table(("verdict", "statement of the paper", "where", "found here", "range"), cells,
                 verdict=0, name="statements")


def formulas_section(rows) -> str:
    heading = ("where", "printed", "corrected", "check", "from the printed formula",
               "from the corrected formula")
    return table(heading, [(row["where"], row["printed"], row["mended"], row["check"],
                            number(row["by_printed"]), number(row["by_mended"])) for row in rows],
                 (4, 5))


def page(folder, pictures, tables, about) -> str:
    """Returns the page as HTML.

    folder: that of the pictures. tables: {"numbers", "formulas", "statements", "inputs"}, rows of
    each. about: {"version", "seconds", "pulses", "levels"}, the last from levels.py.
    """
    parts = {"result": main_result(about["levels"]), "symbols": glossary(),
             "numbers": numbers_section(tables["numbers"]),
             "statements": statements_section(tables["statements"]),
             "formulas": formulas_section(tables["formulas"]),
             "inputs": table(("what", "where", "printed"),
                             [(row["what"], row["where"], row["printed"])
                              for row in tables["inputs"]], (2,)),
             "figures": "<p class=screen>Point at a figure to read its values; the button enlarges "
             "it.</p>\n" + "".join(figure(folder, picture) for picture in pictures)}
    style, script = ((HERE / name).read_text(encoding="utf-8")
                     for name in ("report.css", "report.js"))
    return "".join(
        ['<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport '
         'content="width=device-width, initial-scale=1">',
         '<title>The paper, reproduced</title><link rel=icon '
         f'href="data:,"><style>\n{style}</style></head><body><main>\n', "<h1>How does dissipation "
         "affect the transition from static to dynamic macroscopic friction?</h1>\n",
         '<p>Gershenzon, Bambakidis and Skinner, <i>Lubricants</i> 3(2):311-331, 2015, <a '
         f'href="{DOI}">doi 10.3390/lubricants3020311</a>: each figure, number and ',
         f"statement, computed by slipfront {html.escape(about['version'])} in one run "
         f"({about['pulses']} pulses, {about['seconds']:.0f} s). ",
         "This page is a single file and needs no network.</p>\n", contents(pictures),
         *(f'<section id="{name}"><h2>{title}</h2>\n{parts[name]}</section>\n'
           for name, title in SECTIONS), f"</main><script>\n{script}</script></body></html>\n",])

"""report.html: all of it on one page that needs nothing else."""

import base64
import html
import pathlib

STYLE = pathlib.Path(__file__).with_name("report.css")


def number(value) -> str:
    """A computed number, to four digits."""
    return "–" if value is None else f"{value:.4g}"


def table(heading, rows, numeric=()) -> str:
    """An HTML table; on a narrow page each row becomes a card (report.css), so cells carry their heading."""
    head = "".join(f'<th scope="col">{html.escape(text)}</th>' for text in heading)
    names = [("class=n " if i in numeric else "") + f'data-name="{html.escape(text)}"' for i, text in enumerate(heading)]
    body = "".join("<tr>" + "".join(f"<td {name}>{html.escape(str(cell))}</td>" for name, cell in zip(names, row)) + "</tr>\n" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table>\n"


def figure(folder, picture) -> str:
    """A figure with the picture inside the page and links to the files beside it."""
    picture_64 = base64.b64encode((folder / f"{picture.name}.svg").read_bytes()).decode()
    number_ = picture.name.replace("fig-0", "Fig. ").replace("fig-", "Fig. ")
    title = f"{number_}. {picture.title}" if picture.name.startswith("fig-") else picture.title
    links = " ".join(f'<a href="{picture.name}.{ending}">{ending.upper()}</a>' for ending in ("svg", "png", "csv", "nc"))
    image = f'<img alt="{html.escape(title)}" src="data:image/svg+xml;base64,{picture_64}">'
    return (f'<figure id="{picture.name}"><h3>{html.escape(title)}</h3>\n<div class=wide>{image}</div>\n'
            f"<figcaption>{html.escape(picture.caption)} <span class=files>{links}</span></figcaption></figure>\n")


def numbers_table(rows) -> str:
    """The table of the paper's numbers."""
    heading = ["what", "where", "unit", "printed", "computed", "to the digits printed", "verdict", "remark"]
    cells = [(r["what"], r["where"], r["unit"], r["printed"], number(r["computed"]), r["printed_digits"], r["verdict"], r["remark"]) for r in rows]
    return table(heading, cells, numeric=(3, 4, 5))


def page(folder, pictures, tables, about) -> str:
    """The page.

    folder: where the pictures are. tables: {"numbers", "formulas", "statements"}, rows of each. about: {"version", "seconds", "pulses"}.
    """
    numbers, formulas, statements = (tables[name] for name in ("numbers", "formulas", "statements"))
    agree = sum(row["verdict"] == "same" for row in numbers)
    parts = [
        "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport content='width=device-width, initial-scale=1'>",
        f"<title>The paper, reproduced</title><link rel=icon href='data:,'><style>\n{STYLE.read_text(encoding='utf-8')}</style></head><body><main>\n",
        "<h1>How does dissipation affect the transition from static to dynamic macroscopic friction?</h1>\n",
        "<p>Gershenzon, Bambakidis and Skinner, <i>Lubricants</i> 3(2):311-331, 2015, doi 10.3390/lubricants3020311: each figure and each ",
        f"number, computed again by slipfront {html.escape(about['version'])} in one run ({about['pulses']} pulses, {about['seconds']:.0f} s). ",
        "All is dimensionless: A contact ratio, b asperity spacing, c speed of strain waves, μ shear modulus. Closures: the paper averages ",
        "friction in a way that understates it (“paper”); the exact average is “consistent”.</p>\n",
        "<p>The paper does not state the width of the smooth initial profile of its Figs. 7-12, and its captions were not at hand: each figure ",
        "says what it took.</p>\n",
        f"<h2>Numbers</h2>\n<p>{agree} of {len(numbers)} printed numbers are the same to the digits printed.</p>\n", numbers_table(numbers),
        "<h2>Formulas printed with a slip</h2>\n",
        table(("where", "printed", "meant", "what tells", "by the printed", "by the meant"),
              [(r["where"], r["printed"], r["mended"], r["check"], number(r["by_printed"]), number(r["by_mended"])) for r in formulas], (4, 5)),
        "<h2>Statements</h2>\n",
        table(("the paper says", "where", "verdict", "found", "range", "command"), [tuple(r[key] for key in ("statement", "where", "verdict", "found", "range", "command")) for r in statements]),
        "<h2>Figures</h2>\n", *(figure(folder, picture) for picture in pictures), "</main></body></html>\n",
    ]
    return "".join(parts)

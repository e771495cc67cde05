"""Figures of report.html: picture, caption, readings, command, data."""

import base64
import html
import json
import re

from . import report_hover

#: The page contains tables of values up to this size. Larger tables are only in their files.
MOST_BYTES = 150_000

#: First words of the verdicts for and against the paper. All other verdicts are open.
VERDICTS = {"good": ("same", "confirmed", "exact"), "bad": ("refuted", "the paper is wrong")}


def number(value) -> str:
    """Formats a computed number with four digits. Returns a text unchanged, and a dash for None."""
    if value is None or value == "":
        return "–"
    return value if isinstance(value, str) else f"{value:.4g}"


def table(heading, rows, numeric=(), verdict=None, name="") -> str:
    """Returns an HTML table. On a narrow page each row becomes a card (report.css), so each cell
    contains its heading.

    rows: lists of cells. A cell is a text, or (text, command) for a text with a command below it.
    numeric: indices of the columns of numbers. verdict: index of the column of verdicts, which is
    coloured by VERDICTS. name: CSS class that gives the columns their widths.
    """
    head = "".join(f'<th scope="col">{html.escape(text)}</th>' for text in heading)

    def cell(i, content):
        content, command = content if isinstance(content, tuple) else (content, "")
        below = f"<code>{html.escape(command)}</code>" if command.strip("-") else ""
        kind = " class=n" if i in numeric else ""
        if i == verdict:
            first = content.lower().startswith
            known = [name for name, begins in VERDICTS.items() if first(begins)]
            kind = f" class={[*known, 'open'][0]}"
        name = html.escape(heading[i])
        return f'<td{kind} data-name="{name}">{html.escape(str(content))}{below}</td>'

    body = "".join("<tr>" + "".join(cell(i, content) for i, content in enumerate(row)) + "</tr>\n"
                   for row in rows)
    # A table of class small remains a table on a narrow page
    name = name or ("small" if len(heading) < 4 else "")
    css = f" class={name}" if name else ""
    return (f"<table{css}><thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table>\n")


def heading_of(picture) -> str:
    """Returns the heading: 'Fig. 4. Title' for a figure of the paper, the title for others."""
    number_ = picture.name.replace("fig-0", "Fig. ").replace("fig-", "Fig. ")
    return f"{number_}. {picture.title}" if picture.name.startswith("fig-") else picture.title


def inline(svg, name, title) -> str:
    """Returns an SVG as an element of the page, with unique ids."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    svg = re.sub(r'((?:xlink:)?href="#|url\(#)', rf"\g<1>{name}-", svg)
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    return re.sub(r"<svg ", f'<svg role="img" aria-label="{html.escape(title)}" ', svg, count=1)


def files(folder, picture) -> str:
    """Returns the note on the files of a figure, with a small table as a link."""
    csv = folder / f"{picture.name}.csv"
    names = ", ".join(f"{picture.name}.{ending}" for ending in ("nc", "csv", "svg", "png"))
    text = f"In the folder of this page: {names}."
    if csv.is_file() and csv.stat().st_size <= MOST_BYTES:
        link = f"data:text/csv;base64,{base64.b64encode(csv.read_bytes()).decode()}"
        text += f' <a class=screen download="{csv.name}" href="{link}">Save the values as CSV</a>.'
    return f"<p class=files>{text}</p>"


def figure(folder, picture) -> str:
    """Returns a figure of the page. The SVG of `picture` must be in `folder`."""
    title = heading_of(picture)
    svg = (folder / f"{picture.name}.svg").read_text(encoding="utf-8")
    told = json.dumps(report_hover.axes_of(picture.figure, svg), separators=(",", ":"),
                      ensure_ascii=False).replace("</", "<\\/")
    beside = table(("value read off by the paper", "printed", "computed"),
                   [(what, printed, number(value)) for what, printed, value in picture.printed],
                   (1, 2))
    return (f'<figure id="{picture.name}"><h3>{html.escape(title)}</h3>\n'
            "<button type=button>larger</button>\n<div class=wide><div class=picture>"
            f"{inline(svg, picture.name, title)}</div></div>\n"
            f'<script type="application/json">{told}</script>\n'
            f"<figcaption><p>{html.escape(picture.caption)}</p>\n"
            f"{beside if picture.printed else ''}<p>Draw it again:</p>\n"
            f"<pre>{html.escape(picture.command)}</pre>\n"
            f"{files(folder, picture)}</figcaption></figure>\n")

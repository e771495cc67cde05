"""Tables and lines that fit the terminal, as in apps/slipfront/terminal_table.hpp."""

import os
import sys
import textwrap

#: Largest number of characters in a line that goes to no terminal.
USUAL_WIDTH = 80

#: Blanks between columns, and the least number of them.
GAP, LEAST_GAP = 2, 1


class Lines:
    """Whether lines have their full width, whatever the terminal (--wide)."""

    whole = False


def width(stream=None):
    """Returns the largest number of characters in a line of stdout or another stream, or None if
    there is none."""
    stream = stream or sys.stdout
    if Lines.whole:
        return None
    if not stream.isatty():
        return USUAL_WIDTH
    wanted = os.environ.get("COLUMNS", "")
    if wanted.isascii() and wanted.isdigit() and int(wanted):
        return int(wanted)
    return os.get_terminal_size(stream.fileno()).columns or USUAL_WIDTH


def fitted_message(line):
    """Returns a message for stderr, broken to fit if that is a terminal, and otherwise as one line,
    for programs."""
    most = width(sys.stderr) if sys.stderr.isatty() else None
    return line if most is None else _broken(line, most, 2)


def _broken(line, most, indent):
    return textwrap.fill(line, most, subsequent_indent=" " * indent, break_long_words=False,
                         break_on_hyphens=False)


def fitted(line, indent=2):
    """Returns a line broken at blanks. A longer word stays whole, so that paths can be copied."""
    most = width()
    if most is None or len(line) <= most:
        return line
    return _broken(line, most, indent)


def blocks_of(widths, most, gap):
    """Yields the numbers of columns that fit next to each other, of which the first is always 0."""
    block, used = [0], widths[0]
    for i, needed in enumerate(widths[1:], 1):
        if len(block) > 1 and used + gap + needed > most:
            yield block
            block, used = [0], widths[0]
        block.append(i)
        used += gap + needed
    yield block


def table(columns, left=0):
    """Returns columns, `left` of them left-aligned, as a table in blocks as wide as a line."""
    widths = [max(map(len, column)) for column in columns]
    most = width() or float("inf")
    gap = GAP if sum(widths) + GAP * (len(widths) - 1) <= most else LEAST_GAP
    blocks = []
    for block in blocks_of(widths, most, gap):
        aligned = [[cell.ljust(widths[i]) if i < left else cell.rjust(widths[i])
                    for cell in columns[i]] for i in block]
        blocks.append("\n".join((" " * gap).join(cells).rstrip() for cells in zip(*aligned)))
    return "\n\n".join(blocks)

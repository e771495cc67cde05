"""Man pages of the program and of its commands, from their help."""

import re

from command_help import Argument, Command, Program


def escaped(text: str) -> str:
    """The text for roff. Its hyphens are those of the keyboard, so that commands can be copied from the page."""
    for plain, roff in (("\\", r"\(rs"), ("-", r"\-"), ("'", r"\(aq"), ("`", r"\(ga"), ("^", r"\(ha"), ("~", r"\(ti")):
        text = text.replace(plain, roff)
    return r"\&" + text if text.startswith(".") else text


def sentence(text: str) -> str:
    return text if text.endswith((".", "?", "!")) else text + "."


def capitalized(text: str) -> str:
    return text[:1].upper() + text[1:]


def header(argument: Argument) -> str:
    """The line that names an option or an argument."""
    value = rf"\fI{escaped(argument.value)}\fR" if argument.value else ""
    if not argument.names:
        return value + (" ..." if argument.repeats else "")
    return ", ".join(rf"\fB{escaped(name)}\fR" for name in argument.names) + (f" {value}" if value else "")


def tagged(rows: list[tuple[str, str]]) -> str:
    return "".join(f".TP\n{left}\n{escaped(sentence(capitalized(right)))}\n" for left, right in rows)


def short(summary: str) -> str:
    """The first sentence, which the command `whatis` prints."""
    return re.split(r"\. (?=[A-Z])", summary)[0].rstrip(".")


def section(title: str, body: str) -> str:
    return f".SH {title}\n{body}" if body else ""


def page(program: Program, command: Command, name: str, summary: str, middle: str, exit_codes: list[tuple[str, str]], date: str) -> str:
    others = ["slipfront", *(f"slipfront-{other.name}" for other in program.commands)]
    see_also = [other for other in others if other != name]
    usage = command.usage.removeprefix(command.title)
    return "".join([
        f'.TH {escaped(name.upper())} 1 {escaped(date)} "slipfront {program.version}" "User Commands"\n',
        section("NAME", rf"{escaped(name)} \- {escaped(summary)}" + "\n"),
        section("SYNOPSIS", rf"\fB{escaped(command.title)}\fR{escaped(usage)}" + "\n"),
        section("DESCRIPTION", escaped(sentence(capitalized(command.description.removeprefix("slipfront: ")))) + "\n"),
        section("ARGUMENTS", tagged([(header(argument), argument.meaning) for argument in command.positionals])),
        section("OPTIONS", tagged([(header(option), option.meaning) for option in command.options])),
        middle,
        section("EXIT STATUS", tagged([(rf"\fB{code}\fR", meaning) for code, meaning in exit_codes])),
        section("EXAMPLES", "".join(f".PP\n.nf\n.RS\n{escaped(example)}\n.RE\n.fi\n" for example in command.examples)),
        section("SEE ALSO", ",\n".join(rf"\fB\%{escaped(other)}\fR(1)" for other in see_also) + "\n"),
    ])


def man_pages(program: Program, exit_codes: list[tuple[str, str]], date: str) -> dict[str, str]:
    """Texts of the pages by the names of their files."""
    commands = tagged([(rf"\fBslipfront\-{escaped(command.name)}\fR(1)", command.summary) for command in program.commands])
    files = tagged([(r"\fIPREFIX\fR/share/slipfront/cases", "The scenarios and the catalogue that the examples use")])
    summary = program.overview.description.removeprefix("slipfront: ")
    pages = {"slipfront.1": page(program, program.overview, "slipfront", short(summary), section("COMMANDS", commands) + section("FILES", files), exit_codes, date)}
    for command in program.commands:
        name = f"slipfront-{command.name}"
        pages[f"{name}.1"] = page(program, command, name, short(command.summary), "", exit_codes, date)
    return pages

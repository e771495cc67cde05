"""slipfront plot: pictures of the files that slipfront writes."""

import json
import os
import pathlib

from ._arguments import Arguments, chosen_units, put
from ._optional import import_optional
from ._slipfront import require_other_file

FORMATS = ("png", "svg", "pdf", "jpg", "webp")


def sweep_variable(dataset, options) -> str:
    from .plots.sweep import variable_of

    try:
        return variable_of(dataset, options.variable or "")
    except ValueError as error:
        raise ValueError(f"--{error}") from error


def choices(options, kind, variable) -> dict:
    if kind == "loading":
        return {"until_failure": options.until_failure, "event": options.event}
    if kind in ("event", "fronts"):
        return {"event": options.event}
    return {"variable": variable or ""} if kind == "sweep" else {}


def draw(dataset, kind, chosen):
    """Returns the Figure of a kind of picture. A wrong --event is reported as that option."""
    from .plots import choose

    try:
        return choose.draw(dataset, kind, **chosen)
    except ValueError as error:
        raise ValueError(f"--{error}" if str(error).startswith("event ") else str(error)) from error


def main(argv) -> int:
    options = Arguments("plot").parse_args(argv)
    import_optional("xarray")
    import_optional("matplotlib")
    from .plots import choose, files, save

    output = (pathlib.Path(options.output) if options.output
              else pathlib.Path(options.file).with_suffix(".png"))
    if output.suffix.lower().lstrip(".") not in FORMATS:
        raise ValueError(f"-o {output}: '{output.suffix}' is no picture; allowed endings: "
                         f"{', '.join(FORMATS)}")
    dataset = files.read(options.file, chosen_units(options))
    kinds = choose.kinds_of(dataset)
    if not kinds:
        raise ValueError(f"{options.file}: nothing to draw in it; allowed: what pulse, chain, "
                         "compare, relations, event, fronts and laboratory write, or samples")
    if options.kind is not None:
        if options.kind not in kinds:
            raise ValueError(f"--kind {options.kind}: not for {options.file}; allowed: "
                             f"{', '.join(kinds)}")
        kinds = [options.kind]
    if options.output:
        kinds = kinds[:1]
    variable = sweep_variable(dataset, options) if kinds == ["sweep"] else None
    if options.variable and not variable:
        raise ValueError(f"--variable {options.variable}: not for {options.file}; allowed: with "
                         "the file of a sweep")
    drawings = {kind: choices(options, kind, variable) for kind in kinds}
    for option, given, takers in (("--event", options.event is not None,
                                   ("loading", "event", "fronts")),
                                  ("--until-failure", options.until_failure, ("loading",))):
        if given and not set(kinds) & set(takers):
            raise ValueError(f"{option}: not for {options.file}, of which {', '.join(kinds)} is "
                             f"drawn; allowed: with the kinds {', '.join(takers)} of a loaded "
                             "chain")
    written = []
    for kind in kinds:
        path = output if len(kinds) == 1 else output.with_stem(f"{output.stem}-{kind}")
        require_other_file(os.fsencode(path), [os.fsencode(options.file)])
        save(draw(dataset, kind, drawings[kind]), path)
        written.append(str(path))
        if not options.json and not options.quiet:
            put(f"written to {path}: {variable}" if variable else f"written to {path}")
    if options.json:
        print(json.dumps({"pictures": written, **({"variable": variable} if variable else {})}))
    return 0

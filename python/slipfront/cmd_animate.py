"""The command slipfront animate, which draws pulses and ruptures as moving pictures."""

import json
import pathlib
import tomllib

from . import _slipfront
from ._arguments import Arguments, chosen_units, progress, put
from ._optional import import_optional

FRAMES = 75

#: The rock for scales in SI units, as in the paper: P-wave speed in m/s, Poisson's ratio, shear
#: modulus in Pa.
ROCK = {"p_wave_speed": 6000.0, "poisson_ratio": 0.3, "shear_modulus": 30e9}


def content_of(scenario):
    """Returns the tables of a scenario file, or none if the run will report its error."""
    try:
        with open(scenario, "rb") as file:
            content = tomllib.load(file)
            return {name: table for name, table in content.items() if isinstance(table, dict)}
    except (OSError, tomllib.TOMLDecodeError, UnicodeDecodeError):
        return {}


def run(scenario, si, direct):
    """Runs a scenario with output times for a smooth animation, unless it has its own."""
    import slipfront

    content = content_of(scenario)
    on_plane = "plane" in content or _slipfront.is_fault_model(scenario)
    if direct and not on_plane:
        raise ValueError(f"{scenario}: --direct: not a scenario on a plane; allowed: with the "
                         "table [plane]")
    plan = slipfront.check(scenario, command="plane" if on_plane else "pulse", direct=direct)
    unit, every = plan["time_unit"], plan["end"] / (FRAMES - 1)
    settings = ({} if "times" in content.get("output", {})
                else {"output.every": f"{every * unit!r} s" if unit else every})
    if not on_plane:
        result = slipfront.pulse(scenario, set=settings, si=si)
    elif direct:
        result = slipfront.plane(scenario, set=settings | {"output.lines": True}, direct=True,
                                 si=si)
    else:
        result = slipfront.plane(scenario, set=settings | {"output.lines": True}, errors=False,
                                 si=si)
    # The title of the run names the output times that we have set
    return result.assign_attrs(title=plan["title"])


def content_to_show(source, si=None, direct=False):
    """Returns the pulse or rupture of a file, in SI units if `si`. Runs a scenario or model."""
    from .plots import files

    is_input = source.lower().endswith(".toml") or _slipfront.is_fault_model(source)
    shown = run(source, si, direct) if is_input else files.read(source, si)
    on_plane = is_plane(shown)
    is_pulse = {"W", "Sigma", "k",
                "x_bounds"} <= set(shown.variables) and set(shown["k"].dims) == {"time", "x"}
    if not (on_plane or is_pulse) or shown.sizes["time"] < 2:
        raise ValueError(f"{source}: contains no pulse with two or more output times; allowed: a "
                         "file of pulse, chain or plane, or a scenario")
    return shown


def is_plane(shown):
    return ({"slip_velocity", "moment_rate"} <= set(shown.variables)
            and shown["slip_velocity"].dims == ("time", "y", "x"))


def scene_of(shown, si):
    """Returns the scene of pulses, or of ruptures on a plane."""
    if len({source.attrs.get("unit_system") for source in shown}) > 1:
        raise ValueError("FILE: some are in SI units and others are not; allowed: --si or "
                         "--dimensionless for all")
    if si and any(source.attrs.get("unit_system") == "SI" for source in shown):
        raise ValueError("--contact-ratio: the pulse is in SI units already; allowed: with "
                         "--dimensionless")
    on_plane = {is_plane(source) for source in shown}
    if len(on_plane) > 1:
        raise ValueError("FILE: some are on a plane and others on a line; allowed: all of one kind")
    if not on_plane.pop():
        from .plots.animation import Scene

        return Scene(shown, si)
    from .plots.plane_animation import PlaneScene

    if si:
        raise ValueError("--contact-ratio: not for a rupture on a plane; allowed: [medium] in its "
                         "scenario, and --si")
    return PlaneScene(shown)


def si_units(options):
    """Returns SI values of the units by the options, or None if they are missing."""
    from . import medium

    if (options.contact_ratio is None) != (options.asperity_spacing is None):
        raise ValueError("--contact-ratio and --asperity-spacing: one is missing; scales in m, s, "
                         "m/s and MPa need both")
    if options.contact_ratio is None:
        return None
    speed = float(medium.speed_from_p_wave(ROCK["p_wave_speed"], ROCK["poisson_ratio"]))
    return medium.units(ROCK["shear_modulus"], speed, options.contact_ratio,
                        options.asperity_spacing)


def main(argv) -> int:
    options = Arguments("animate").parse_args(argv)
    for module in ("xarray", "matplotlib", "PIL"):
        import_optional(module)
    from .plots import movie

    output = pathlib.Path(options.output)
    if output.suffix.lower().lstrip(".") not in movie.FORMATS:
        raise ValueError(f"-o {output}: '{output.suffix}' is not a format of moving pictures; "
                         f"allowed endings: {', '.join(movie.FORMATS)}")
    shown = [content_to_show(source, chosen_units(options), options.direct)
             for source in options.sources]
    scene, frames = scene_of(shown, si_units(options)), []
    for row in range(scene.times.size):
        progress(options, f"frame {row + 1} of {scene.times.size}")
        frames.append(scene.show(row))
    movie.write(frames, output)
    progress(options, "")
    if options.json:
        print(json.dumps({"picture": str(output), "frames": len(frames),
                          "dislocations_scale": scene.scale, "bytes": output.stat().st_size}))
    elif not options.quiet:
        put(f"written to {output}: {len(frames)} frames, {output.stat().st_size / 1e6:.2f} MB")
    return 0

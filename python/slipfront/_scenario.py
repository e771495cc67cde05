"""Reads scenarios as users give them: a path, TOML text, or a dict nested like the TOML."""

import json
import os
import re
from collections.abc import Mapping

from ._numbers import np
from ._messages import shown
from ._slipfront import InputError, require_other_file


#: Largest depth of nested tables and lists. A scenario needs three.
_most_nested = 100


def _value(key, value, depth=0):
    """Returns a value as TOML. Raises InputError for a type that TOML does not have."""
    if depth > _most_nested:
        raise InputError(f"{shown(key)}: tables or lists are nested more than {_most_nested} deep "
                         "or contain themselves; allowed: a number, a text, a list or a dict of "
                         "them")
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(key, item, depth + 1) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_name(name)} = {_value(f'{key}.{name}', item, depth + 1)}"
                                for name, item in value.items()) + " }"
    raise InputError(f"{shown(key)} = '{shown(value)}': a {type(value).__name__}; allowed: a "
                     "number, a text, a list or a dict of them")


def to_toml(tables):
    """Returns the TOML text of a dict. Its items are values or dicts of values."""
    lines, later = [], []
    for name, table in tables.items():
        if isinstance(table, Mapping):
            later += [f"[{_name(name)}]"] + [f"{_name(key)} = {_value(f'{name}.{key}', value)}"
                                             for key, value in table.items()]
        else:
            lines.append(f"{_name(name)} = {_value(name, table)}")
    return "\n".join(lines + later) + "\n"


def _name(key):
    if not isinstance(key, str):
        raise InputError(f"'{shown(key)}': the key is a {type(key).__name__}; allowed: a text")
    return key if re.fullmatch("[A-Za-z0-9_-]+", key) else _value(key, key)


def is_path(source):
    """Returns whether `source` is the path of a file: a str without line breaks, or os.PathLike."""
    return isinstance(source, os.PathLike) or (isinstance(source, str) and "\n" not in source)


def overrides(settings):
    """Returns the texts "table.key=value" of a dict, as --set takes them."""
    if settings is None:
        return []
    if not isinstance(settings, Mapping):
        raise InputError(f"set = '{shown(settings)}': a {type(settings).__name__}; allowed: a dict "
                         f"such as {{'friction.coefficient': 0.5}}")
    return [f"{key}={value if isinstance(value, str) else _value(key, value)}"
            for key, value in settings.items()]


def path(name, value):
    """Returns a path as str, or "" for None. Raises InputError with the parameter's `name`."""
    if value is None:
        return ""
    try:
        text = os.fspath(value)
    except TypeError:
        text = None
    if not isinstance(text, str) or not text or "\0" in text:
        raise InputError(f"{name} = '{shown(value)}': not a path; allowed: a str or os.PathLike")
    return text


def output_path(output, *inputs):
    """Returns an output as `path` does. Raises InputError if it is one of the input files."""
    file = path("output", output)
    sources = [source for given in inputs for source in (given if isinstance(given, (list, tuple))
                                                         else [given]) if is_path(source)]
    require_other_file(os.fsencode(file), [os.fsencode(source) for source in sources])
    return file


def arguments(scenario, *, set=None, output=None, resume=None, progress=None, si=None):
    """Returns the arguments of a run as the bindings take them."""
    text = source = ""
    if isinstance(scenario, Mapping):
        text = to_toml(scenario)
    elif is_path(scenario):
        source = path("scenario", scenario)
    elif isinstance(scenario, str):
        text = scenario
    else:
        raise InputError(f"scenario: a {type(scenario).__name__}; allowed: the path of a TOML "
                         "file, TOML text or a dict")
    result = {"text": text, "path": source, "set": overrides(set), "output": path("output", output),
              "resume": path("resume", resume), "progress": progress,
              "si": None if si is None else bool(si)}
    for key in ("text", "path", "output", "resume"):
        _encodable(key, result[key])
    for override in result["set"]:
        _encodable("set", override)
    output_path(output, scenario)
    return result


def _encodable(key, text):
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{key}: contains half of a surrogate pair; allowed: text that UTF-8 can "
                         "encode") from None

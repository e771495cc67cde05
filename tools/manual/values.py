"""Finds what the value of an option or an argument can be: a file with one of some endings, a folder, or a word from a list."""

import json
import re
from dataclasses import dataclass

from command_help import Argument, output_of

ENDINGS = {"toml": "toml", "netcdf": "nc", "nc": "nc", "csv": "csv", "fsp": "fsp", "srf": "srf", "png": "png", "svg": "svg", "pdf": "pdf", "jpg": "jpg",
           "webp": "webp", "gif": "gif", "mp4": "mp4", "html": "html"}
FILES = ("FILE", "SCENARIO", "PICTURE", "OUT.nc")


@dataclass(frozen=True)
class Keys:
    """Keys of scenarios, each as `table.key`, with the words that it allows."""

    allowed: dict[str, tuple[str, ...]]

    @property
    def tables(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(key.partition(".")[0] for key in self.allowed if "." in key))


def read_keys(program: str) -> Keys:
    allowed = {}
    for key in json.loads(output_of(program, "keys", "--json"))["keys"]:
        name = f"{key['table']}.{key['key']}".lstrip(".")
        words = key["allowed"].split(", ") if key["type"] in ("word", "truth value") else []
        allowed[name] = tuple(word for word in words if re.fullmatch(r"[\w-]+", word))
    return Keys(allowed)


def words_for(argument: Argument, keys: Keys) -> tuple[str, ...]:
    return keys.tables if argument.value == "TABLE" else argument.choices


def takes_key(argument: Argument) -> bool:
    return argument.value == "KEY=VALUE"


def takes_folder(argument: Argument) -> bool:
    return argument.value == "DIR"


def endings_of(argument: Argument) -> tuple[str, ...]:
    """Endings of the files that the argument takes, as its name and its meaning mention them. Empty if it takes no file."""
    if argument.value not in FILES:
        return ()
    words = re.findall(r"[a-z0-9]+", f"{argument.value} {argument.meaning}".lower())
    return tuple(dict.fromkeys(ENDINGS[word] for word in words if word in ENDINGS))

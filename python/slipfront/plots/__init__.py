"""Pictures with matplotlib. Each function takes a Dataset and returns a matplotlib Figure; `save`
writes one.

The kinds of picture are those of `choose.KINDS`, each a function in a file of its name.
"""

import importlib

from .._optional import import_optional

import_optional("matplotlib")

from .choose import KINDS
from .style import save

__all__ = sorted([function for function, _ in KINDS.values()] + [save.__name__])
for _function, _ in KINDS.values():
    globals()[_function] = getattr(importlib.import_module(f".{_function}", __name__), _function)

"""Pictures with matplotlib. Each function takes a Dataset and returns a matplotlib Figure; `save` writes one."""

from .comparison import comparison
from .corner import corner
from .events import events
from .profiles import profiles
from .relations import relations
from .space_time import space_time
from .style import save

__all__ = ["comparison", "corner", "events", "profiles", "relations", "save", "space_time"]

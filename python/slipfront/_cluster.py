"""Points of a sweep: on this machine, and on the workers of a Dask cluster."""

import pickle

from . import _slipfront
from ._optional import import_optional
from ._slipfront import NumericsError

_most_points_a_task = 256
_tasks_a_thread = 4  # of what is left
_most_tasks_a_thread = 256
_tries = 3


def run_points(command, request, work, variables, threads, deliver):
    """Runs `work`, [(point, overrides), ...], on threads without the GIL; deliver([(point, numbers, reason), ...]) is
    called here, several times a second. Results come in any order."""
    numbers = [point for point, _ in work]
    _slipfront.sweep(command, request, [overrides for _, overrides in work], variables, min(threads, len(work)),
                     lambda rows: deliver([(numbers[i], values, reason) for i, values, reason in rows]))


def _task(packed):
    """Points and results travel as bytes: Dask would look into every text of them."""
    command, request, work, variables = pickle.loads(packed)
    rows: list[tuple] = []
    run_points(command, request, work, variables, 1, rows.extend)
    return pickle.dumps(rows)


def _parts(work, threads):
    """Tasks of many points, smaller and smaller: few messages, and workers that end together."""
    parts, begin, least = [], 0, max(1, len(work) // (_most_tasks_a_thread * threads))
    while begin < len(work):
        size = max(least, min(_most_points_a_task, (len(work) - begin) // (_tasks_a_thread * threads)))
        parts.append(work[begin:begin + size])
        begin += size
    return parts


def on_cluster(client, command, request, work, variables, deliver):
    """The same on a cluster, in tasks of many points. A task whose worker dies is tried again by Dask, then point by
    point, so that one deadly point costs none of its neighbours. Raises NumericsError if the cluster is gone."""
    distributed = import_optional("distributed")
    gone = (distributed.client.CancelledError, OSError, TimeoutError)
    threads = sum(client.nthreads().values()) or 1

    def submit(part):
        future = client.submit(_task, pickle.dumps((command, request, part, variables)), pure=False, retries=_tries)
        parts[future.key] = part
        return future

    parts: dict[str, list] = {}
    running = distributed.as_completed([submit(part) for part in _parts(work, threads)])
    try:
        for future in running:
            part = parts.pop(future.key)
            try:
                rows = pickle.loads(future.result())
            except gone as error:
                raise NumericsError(f"the Dask cluster is gone: {' '.join(str(error).split()) or type(error).__name__}") from error
            except Exception as error:
                if len(part) > 1:
                    for one in part:
                        running.add(submit([one]))
                    continue
                rows = [(part[0][0], [], f"{type(error).__name__}: {' '.join(str(error).split())}")]
            deliver(rows)
    except NumericsError:  # nobody is left to be told
        raise
    except BaseException:
        client.cancel(list(running.futures))
        raise

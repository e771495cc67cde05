"""Runs the points of a sweep on this machine or on the workers of a Dask cluster."""

import pickle

from . import _slipfront
from ._optional import import_optional
from ._slipfront import InputError, NumericsError

_most_points_a_task = 256
_tasks_a_thread = 4  # into which the remaining points are divided
_most_tasks_a_thread = 256
_tries = 3


def run_points(command, request, work, variables, threads, deliver):
    """Runs `work`, [(point, overrides), ...], on threads without the GIL.

    Calls deliver([(point, numbers, reason), ...]) in this thread several times a second. The
    results come in any order.
    """
    numbers = [point for point, _ in work]
    _slipfront.sweep(command, request, [overrides for _, overrides in work], variables,
                     min(threads, len(work)), lambda rows: deliver([(numbers[i], values, reason)
                                                                    for i, values, reason in rows]))


def _task(packed):
    """Runs points on a worker. It takes and returns bytes: Dask would search every text."""
    command, request, work, variables = pickle.loads(packed)
    rows: list[tuple] = []
    run_points(command, request, work, variables, 1, rows.extend)
    return pickle.dumps(rows)


def _parts(work, threads):
    """Divides `work` into tasks of decreasing size: few messages, and workers end together."""
    parts, begin, least = [], 0, max(1, len(work) // (_most_tasks_a_thread * threads))
    while begin < len(work):
        size = max(least,
                   min(_most_points_a_task, (len(work) - begin) // (_tasks_a_thread * threads)))
        parts.append(work[begin:begin + size])
        begin += size
    return parts


def on_cluster(client, command, request, work, variables, deliver):
    """Like run_points, but on a cluster, in tasks of many points.

    If the worker of a task dies, Dask tries the task again. Then we submit its points one by one,
    so that a point that crashes its worker does not affect the others. Raises NumericsError if the
    connection to the cluster is lost.
    """
    distributed = import_optional("distributed")
    if not isinstance(client, distributed.Client):
        raise InputError(f"client: a {type(client).__name__}; allowed: a distributed.Client")
    gone = (distributed.client.CancelledError, OSError, TimeoutError)
    threads = sum(client.nthreads().values()) or 1

    def submit(part):
        future = client.submit(_task, pickle.dumps((command, request, part, variables)), pure=False,
                               retries=_tries)
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
                raise NumericsError(
                    "the Dask cluster is gone: "
                    f"{' '.join(str(error).split()) or type(error).__name__}") from error
            except Exception as error:
                if len(part) > 1:
                    for one in part:
                        running.add(submit([one]))
                    continue
                rows = [(part[0][0], [], f"{type(error).__name__}: {' '.join(str(error).split())}")]
            deliver(rows)
    except NumericsError:  # there is no cluster to cancel the tasks
        raise
    except BaseException:
        client.cancel(list(running.futures))
        raise

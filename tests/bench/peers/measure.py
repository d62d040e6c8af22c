# SPDX-License-Identifier: BSD-3-Clause
"""Measures time and memory of a command in the same way for every tool.

The command is a child of a small separate process. Linux counts the memory of the process that
forks a child towards the child's peak, and this process contains SciPy and millions of nodes."""
import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

STARTER = r"""
import json, os, signal, sys, time
limit, report, *command = sys.argv[1:]
begin = time.monotonic()
child = os.fork()
if child == 0:
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.stderr.write(f"{command[0]}: {error}\n")
        os._exit(127)
def stop(*_):
    os.kill(child, signal.SIGKILL)
signal.signal(signal.SIGALRM, stop)
signal.signal(signal.SIGTERM, stop)
signal.setitimer(signal.ITIMER_REAL, float(limit))
_, status, used = os.wait4(child, 0)
seconds = time.monotonic() - begin
with open(report, "w") as file:
    json.dump({"seconds": seconds, "cpu_seconds": used.ru_utime + used.ru_stime,
               "peak_bytes": used.ru_maxrss * (1 if sys.platform == "darwin" else 1024),
               "status": os.waitstatus_to_exitcode(status)}, file)
"""

ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


class Failed(Exception):
    """The tool gave no nodes; the text says why."""


@dataclasses.dataclass
class Measured:
    seconds: float      # wall time, start and files included
    cpu_seconds: float  # CPU time, independent of other processes
    peak_bytes: int
    status: int
    stdout: str


def measure(command, folder, time_limit=3600, accepted=(0,)):
    """Runs a command in a folder with one thread. Raises Failed if its status is not accepted."""
    command = [str(part) for part in command]
    report, out, err = (Path(folder) / f"measured.{end}" for end in ("json", "out", "err"))
    report.unlink(missing_ok=True)
    starter = [sys.executable, "-I", "-S", "-c", STARTER, str(time_limit), str(report), *command]
    with open(out, "wb") as stdout, open(err, "wb") as stderr:
        subprocess.run(starter, cwd=folder, env={**os.environ, **ONE_THREAD}, stdout=stdout,
                       stderr=stderr, stdin=subprocess.DEVNULL, check=False)
    if not report.exists():
        raise Failed(f"{command[0]} could not be measured: {last_line(err)}")
    found = json.loads(report.read_text())
    status = found["status"]
    if status not in accepted:
        if found["seconds"] >= time_limit:
            raise Failed(f"not done after {time_limit:g} s")
        raise Failed(f"status {status}: {last_line(err) or last_line(out)}")
    return Measured(stdout=out.read_text(errors="replace"), **found)


def last_line(path):
    lines = path.read_text(errors="replace").strip().splitlines()
    return lines[-1].strip() if lines else ""

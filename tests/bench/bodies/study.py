#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Places nodes in bodies with the command and judges the tetrahedra without the library (judge.py).
  tests/bench/bodies/study.py [--program build/release/bin/pnpbs] [--nodes 6000] [--spacing 1]
                              [--set resolve=1] [--figures figures.json] FILE...
  tests/bench/bodies/study.py --random SEED --count 300     # random_bodies.py, from number 0 on
  tests/bench/bodies/study.py --random SEED:NUMBER          # one of these again, with equal --parts

Prints a line for each body with CPU seconds, and the numbers of whole bodies, torn bodies, and torn
bodies without a status that says so. The exit status is 1 if there are any of the last kind, if the
command crashed or ran out of time, or if it rejected a random body. The bodies of CGAL's demos are
in Debian's package libcgal-demo (data/meshes/*.off).
"""
import argparse
import json
import os
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "peers")]
from body_files import read_body  # noqa: E402
from judge import judged  # noqa: E402
from measure import Failed, measure  # noqa: E402
from progress import Progress  # noqa: E402

ROOT = HERE.parents[2]
NOT_CONFORMING = 6  # an exit code of the command


def read_tetrahedra(base):
    rows = {suffix: np.loadtxt(base.with_suffix(suffix), comments="#", skiprows=1, ndmin=2)
            for suffix in (".node", ".ele")}
    first = int(rows[".node"][0, 0])
    return rows[".node"][:, 1:4], rows[".ele"][:, 1:5].astype(int) - first


def file_of(body, folder):
    """Returns the file of a body. A body is a path, or the seed, the number and the maximum number
    of parts of a random body."""
    if isinstance(body, Path):
        return body
    from random_bodies import random_body, write_off  # manifold3d is needed for these bodies only
    path = folder / f"random_{'_'.join(map(str, body))}.off"
    write_off(path, *random_body(*body))
    return path


def name_of(body):
    return body.stem if isinstance(body, Path) else f"{body[0]}:{body[1]}"


def placed(body, arguments):
    """Returns the figures of one body, or why there are none."""
    with tempfile.TemporaryDirectory() as folder:
        path = file_of(body, Path(folder))
        found = judged_in(Path(folder) / "made", path, arguments)
        if arguments.keep and not found.get("whole"):
            arguments.keep.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, arguments.keep)
        return found


def judged_in(base, path, arguments):
    outputs = [word for suffix in (".node", ".ele") for word in ("--output", base.with_suffix(suffix))]
    options = [word for setting in arguments.set for word in ("--set", setting)]
    command = [arguments.program.resolve(), "--domain", path.resolve(), "--spacing", arguments.spacing, "--nodes",
               arguments.nodes, "--quiet", *outputs, *options]
    try:
        used = measure(command, base.parent, arguments.time_limit, accepted=range(256))
    except Failed as why:
        return {"failed": str(why)}
    said = (base.parent / "measured.err").read_text(errors="replace").strip().splitlines()
    if not base.with_suffix(".ele").exists():
        return {"exit_code": used.status, "refused" if used.status else "failed": (said or ["no message"])[0]}
    return {"exit_code": used.status, "seconds": used.seconds, "cpu_seconds": used.cpu_seconds, "warnings": said,
            **judged(read_body(path), *read_tetrahedra(base))}


def angle(value):
    return "-" if value is None else f"{value:.1f}"


def line_of(name, found):
    for outcome in ("refused", "failed"):
        if outcome in found:
            return f"{name:24} {outcome}: {found[outcome][:200]}"
    state = "whole" if found["whole"] else "torn"
    return (f"{name:24} {state:5} exit {found['exit_code']}  {found['nodes']:7} nodes  torn edges "
            f"{found['torn_edges']}, nodes {found['torn_nodes']}, isolated {found['isolated']}  pieces "
            f"{found['pieces']}/{found['pieces_of_body']}  Euler {found['euler']}/{found['euler_of_body']}"
            f"  off {found['from_body']:.2f} {found['to_body']:.2f}  angle "
            f"{angle(found['least_angle_elsewhere'])}, at sharp edges "
            f"{angle(found['least_angle_at_sharp_edges'])}, small {found['small_angles']}, flat {found['flat']}  "
            f"{found['cpu_seconds']:.1f} s")


def summary(found, most_torn, may_refuse):
    """Returns a summary and whether the study passes: Few enough bodies are torn. No body is torn
    or has tetrahedra of no volume without a status that says so. None failed, and none was rejected
    unless this is allowed."""
    bodies = [figures for figures in found.values() if "whole" in figures]
    torn = [figures for figures in bodies if not figures["whole"]]
    flat = [figures for figures in bodies if figures["flat"] > 0]
    silent = sum(figures["exit_code"] != NOT_CONFORMING for figures in bodies
                 if not figures["whole"] or figures["flat"] > 0)
    refused, failed = (sum(outcome in figures for figures in found.values()) for outcome in ("refused", "failed"))
    words = (f"{len(found)} bodies: {len(bodies) - len(torn)} whole, {len(torn)} torn, {len(flat)} with "
             f"tetrahedra of no volume, {silent} of both without exit code {NOT_CONFORMING}; {refused} "
             f"refused, {failed} failed")
    return words, len(torn) <= most_torn and silent + failed == 0 and (may_refuse or refused == 0)


def commands_again(found, arguments):
    """Returns a command line for each random body that is not whole."""
    settings = "".join(f" --set {setting}" for setting in arguments.set)
    return [f"again: {HERE.relative_to(ROOT) / 'study.py'} --random {name} --parts {arguments.parts} --nodes "
            f"{arguments.nodes} --spacing {arguments.spacing}{settings}"
            for name, figures in found.items() if not figures.get("whole")]


def random_bodies(text):
    seed, _, number = text.partition(":")
    return int(seed), int(number) if number else None


def bodies_of(arguments):
    if arguments.random is None:
        return arguments.files
    seed, number = arguments.random
    return [(seed, k, arguments.parts) for k in (range(arguments.count) if number is None else
                                range(number, number + arguments.count))]


def study(bodies, arguments):
    """Returns figures by name. Prints a line for each body in order, as soon as the previous ones
    are done."""
    found, progress = {}, Progress(len(bodies)) if sys.stderr.isatty() else None
    with ThreadPoolExecutor(arguments.jobs) as jobs:
        for body, figures in zip(bodies, jobs.map(lambda body: placed(body, arguments), bodies)):
            found[str(body) if isinstance(body, Path) else name_of(body)] = figures
            if progress:
                sys.stderr.write("\r\033[K")
            print(line_of(name_of(body), figures), flush=True)
            if progress:
                progress.end()
                progress.begin(name_of(body))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--random", type=random_bodies, metavar="SEED[:NUMBER]",
                        help="bodies of this seed instead of files, from this number on")
    parser.add_argument("--count", type=int, default=1, help="of random bodies")
    parser.add_argument("--parts", type=int, default=25, help="of a random body, at most about")
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "release" / "bin" / "pnpbs")
    parser.add_argument("--nodes", default="6000")
    parser.add_argument("--spacing", default="1")
    parser.add_argument("--set", action="append", default=[], metavar="OPTION=VALUE")
    parser.add_argument("--most-torn", type=int, default=sys.maxsize, metavar="N",
                        help="exit status 1 if more are torn, whatever the exit codes of the command")
    parser.add_argument("--figures", type=Path, help="write all figures there, as JSON")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="put bodies there that are not whole")
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for each body (3600)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="bodies at a time, of one thread each")
    arguments = parser.parse_args()
    if (arguments.random is None) == (not arguments.files):
        parser.error("give files or --random")
    found = study(bodies_of(arguments), arguments)
    if arguments.figures:
        arguments.figures.write_text(json.dumps(found, indent=1) + "\n")
    words, good = summary(found, arguments.most_torn, arguments.random is None)
    print("\n".join([words, *(commands_again(found, arguments) if arguments.random else [])]))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

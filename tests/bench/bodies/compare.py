#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares PNPBS and other tools on the same bodies at the same d; judge.py evaluates all results.
  tests/bench/bodies/compare.py [--nodes 3000] [--random SEED --count 50] [--output docs] FILE...

Writes comparison_bodies.md and comparison_bodies.json. With --from FILE.json... it combines the
figures of earlier runs. If two runs have the same body and tool, as after a run with --tools PNPBS,
the last one counts. Files without a closed surface are left out.
"""
import argparse
import dataclasses
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "peers")]
import bodies  # noqa: E402
import compare_page  # noqa: E402
import machine  # noqa: E402
from adapters import with_cgal_volume, with_gmsh_volume, with_pnpbs, with_tetgen  # noqa: E402
from adapters.tool import DoesNotStart, NotSupported, VolumeOutcome  # noqa: E402
from body_files import read_body  # noqa: E402
from command_line import shown_command  # noqa: E402
from judge import joined, judged  # noqa: E402
from measure import Failed  # noqa: E402
from progress import Progress  # noqa: E402
from sharp_edges import is_surface, outward  # noqa: E402
from solids import solids  # noqa: E402
from volume_cases import NODES_PER_CUBE, VolumeCase  # noqa: E402

NOT_CONFORMING = 6  # exit code of PNPBS; the tetrahedra are written nevertheless


class GmshBySolids(with_gmsh_volume.GmshInSpace):
    """gmsh with one volume per outer surface."""

    def run(self, case, folder, time_limit):
        outcomes = []
        for number, solid in enumerate(solids(case.body)):
            there = folder / str(number)
            there.mkdir()
            outcomes.append(super().run(dataclasses.replace(case, body=solid), there, time_limit))
        if not all(len(outcome.tetrahedra) for outcome in outcomes):
            raise Failed("no tetrahedra")
        return put_together(outcomes)


def put_together(outcomes):
    firsts = np.cumsum([0, *(len(outcome.points) for outcome in outcomes)])
    used = dataclasses.replace(outcomes[0].used, seconds=sum(o.used.seconds for o in outcomes),
                               cpu_seconds=sum(o.used.cpu_seconds for o in outcomes))
    return VolumeOutcome(np.concatenate([o.points for o in outcomes]),
                         np.concatenate([o.tetrahedra + first for o, first in zip(outcomes, firsts)]),
                         used, None)


def tools(pnpbs):
    found = [*with_pnpbs.volume_tools(pnpbs), GmshBySolids("HXT", "hxt"), *with_tetgen.tools(),
             *with_cgal_volume.tools()]
    for tool in found:
        if isinstance(tool, with_pnpbs.PnpbsInSpace):
            tool.accepted = (*tool.accepted, NOT_CONFORMING)
    return found


def chosen(found, words):
    """Returns the tools with one of these words in their names, or all if there are no words."""
    return [tool for tool in found if not words or any(word.lower() in tool.name.lower() for word in words)]


def those_there(wanted):
    """Returns the available tools with their versions, and the left-out tools with the reason."""
    there, left_out = [], []
    for tool in wanted:
        try:
            if tool.available():
                there.append((tool, tool.version()))
                continue
            why = f"not found; needs {tool.needs}"
        except (DoesNotStart, NotSupported) as error:
            why = str(error)
        left_out.append({"name": tool.name, "why": why})
    return there, left_out


def spacing_for(body, nodes):
    """Returns d for about this number of nodes: those of a lattice, plus half a node per d^2 of the
    surface."""
    a, b, c = body.vertices[body.triangles()].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    inner, boundary, d = NODES_PER_CUBE * body.volume(), area / 2, 1.0
    for _ in range(100):
        d *= ((inner / d ** 3 + boundary / d ** 2) / nodes) ** (1 / 3)
    return d


def case_of(name, x, triangles, nodes):
    body = bodies.Body("file", x, outward(x, triangles).tolist())
    return VolumeCase(name, name, body, float(spacing_for(body, nodes)))


def cases(arguments):
    """Yields one case after another, or the name of a file without a closed surface."""
    for path in arguments.files:
        x, triangles = joined(*read_body(path))
        yield (case_of(path.name, x, triangles, arguments.nodes) if is_surface(triangles)
               else path.name)
    for number in range(arguments.count if arguments.random is not None else 0):
        from random_bodies import random_body
        yield case_of(f"random {arguments.random}:{number}",
                      *random_body(arguments.random, number, arguments.parts), arguments.nodes)


def made(outcome, ours):
    """Returns nodes and tetrahedra with PNPBS's orientation. Nodes of other tools without a
    tetrahedron do not count."""
    x, tetrahedra = outcome.points, outcome.tetrahedra
    if not ours:
        used, corners = np.unique(tetrahedra, return_inverse=True)
        x, tetrahedra = x[used], corners.reshape(-1, 4)
    corners = x[tetrahedra]
    turned = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() < 0
    return x, tetrahedra[:, [1, 0, 2, 3]] if turned else tetrahedra


def run(tool, case, time_limit):
    body = case.body.vertices, case.body.triangles()
    with tempfile.TemporaryDirectory(prefix="pnpbs-compare-") as folder:
        try:
            outcome = tool.run(case, Path(folder), time_limit)
        except (Failed, OSError, ValueError) as error:
            return {"failed": str(error)}
    if not len(outcome.tetrahedra):
        return {"failed": "no tetrahedra"}
    ours = isinstance(tool, with_pnpbs.PnpbsInSpace)
    return {**judged(body, *made(outcome, ours), case.constant), "seconds": outcome.used.seconds,
            "cpu_seconds": outcome.used.cpu_seconds, "exit_code": outcome.used.status}


def run_all(arguments):
    there, left_out = those_there(chosen(tools(arguments.pnpbs), arguments.tools))
    results = {"machine": machine.describe(), "note": arguments.note, "asked": arguments.nodes, "no_bodies": [],
               "command": shown_command("tests/bench/bodies/compare.py", {"--pnpbs": "PROGRAM", "--output": "FOLDER"},
                                        arguments.files),
               "tools": [{"name": tool.name, "version": version, "setting": tool.setting}
                         for tool, version in there], "left_out": left_out, "runs": []}
    random = arguments.count if arguments.random is not None else 0
    progress = Progress(len(arguments.files) + random)
    for case in cases(arguments):
        if isinstance(case, str):
            results["no_bodies"].append(case)
        else:
            progress.begin(case.name)
            results["runs"] += [{"body": case.name, "d": case.constant, "tool": tool.name,
                                 **run(tool, case, arguments.time_limit)} for tool, _ in there]
            write(arguments.output, results)
        progress.end()
    return results


def write(folder, results):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "comparison_bodies.json").write_text(json.dumps(results, indent=1) + "\n")
    (folder / "comparison_bodies.md").write_text(compare_page.page(results))


def merged(parts):
    """Returns the first part with the runs of the others added. A later run replaces one of the
    same body and tool."""
    tools = {tool["name"]: tool for part in parts for tool in part["tools"]}
    if any(part["asked"] != parts[0]["asked"] or tool != tools[tool["name"]]
           for part in parts for tool in part["tools"]):
        sys.exit("compare.py: these are of other versions of a tool or another number of nodes")
    runs = {(run["body"], run["tool"]): run for part in parts for run in part["runs"]}
    no_bodies = dict.fromkeys(name for part in parts for name in part["no_bodies"])
    return {**parts[0], "tools": list(tools.values()), "runs": list(runs.values()),
            "no_bodies": list(no_bodies), "command": "\n".join(part["command"] for part in parts)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--random", type=int, metavar="SEED")
    parser.add_argument("--count", type=int, default=50, help="of random bodies")
    parser.add_argument("--parts", type=int, default=25, help="of a random body, at most about")
    parser.add_argument("--nodes", type=int, default=3000)
    parser.add_argument("--pnpbs", type=lambda path: str(Path(path).resolve()), help="the command")
    parser.add_argument("--tools", type=lambda text: text.split(","), default=[],
                        help="words of names, as PNPBS,TetGen")
    parser.add_argument("--time-limit", type=float, default=600, help="seconds for each body and tool")
    parser.add_argument("--output", type=Path, default=HERE.parents[2] / "build" / "comparison")
    parser.add_argument("--from", dest="sources", type=Path, nargs="+", metavar="FILE.json",
                        help="run nothing")
    parser.add_argument("--note", default="", help="a line for the page, such as what else the machine did")
    arguments = parser.parse_args()
    earlier = [json.loads(source.read_text()) for source in arguments.sources or []]
    results = merged(earlier) if earlier else run_all(arguments)
    write(arguments.output, {**results, "note": arguments.note or results["note"]})


if __name__ == "__main__":
    main()

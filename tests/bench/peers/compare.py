#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs our cases and those peers that are installed, judges all node sets with one evaluator that
is none of ours, prints the table, and writes it as Markdown, JSON and pictures. Builds nothing.
docs/benchmarks.md tells what to install."""
import argparse
import json
import os
import shlex
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import force_evaluation  # noqa: E402
import machine  # noqa: E402
import page  # noqa: E402
from adapters import with_cgal, with_gmsh, with_jigsaw, with_pnpbs, with_triangle  # noqa: E402
from adapters.tool import DoesNotStart, command  # noqa: E402
from cases import CASES  # noqa: E402
from evaluate import evaluate  # noqa: E402
from measure import Failed  # noqa: E402
from progress import Progress  # noqa: E402

ROOT = HERE.parents[2]

NOT_COMPARED = [
    {"name": "TetGen", "why": "makes tetrahedra in volumes; there is nothing in the plane to "
                              "compare"},
    {"name": "dmsh, optimesh", "why": "their packages do not start without a licence key"},
]


def arguments():
    def ours(text):
        name, colon, options = text.partition(":")
        if not colon or not name.strip() or any("=" not in o for o in options.split()):
            raise argparse.ArgumentTypeError("write it as 'name: key=value key=value'")
        return name.strip(), options.split()

    def integers(text):
        return [int(float(part)) for part in text.split(",")]

    def names(text):
        return [part.strip() for part in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nodes", default=[100000], type=integers,
                        help="about so many in every case; several with commas (default 100000)")
    parser.add_argument("--cases", default=list(CASES), type=names,
                        help=f"some of {','.join(CASES)}")
    parser.add_argument("--tools", type=names, default=[],
                        help="only those with one of these words in their names")
    parser.add_argument("--repeat", default=1, type=int, help="medians of so many runs")
    parser.add_argument("--ours", action="append", default=[], type=ours, metavar="'NAME: K=V ...'",
                        help="another setting of PNPBS beside the default; may be repeated")
    parser.add_argument("--pnpbs", type=os.path.abspath, help="the command, if not the built one")
    parser.add_argument("--path", action="append", default=[], type=os.path.abspath,
                        help="folder with commands of tools, before those on PATH")
    parser.add_argument("--time-limit", default=1800, type=float, help="seconds for one run")
    parser.add_argument("--no-forces", action="store_true", help="leave LAMMPS out")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "comparison",
                        help="folder for comparison.md, comparison.json and images/")
    parser.add_argument("--from", dest="source", type=Path,
                        help="run nothing, print and write what this JSON file holds")
    args = parser.parse_args()
    for name in args.cases:
        if name not in CASES:
            parser.error(f"unknown case {name}: choose from {', '.join(CASES)}")
    if args.repeat < 1 or min(args.nodes) < 100:
        parser.error("--repeat must be 1 or more, --nodes 100 or more")
    return args


def sort_out(args):
    """Tools that can run with their versions, and what is left out with the reason."""
    tools = [*with_pnpbs.tools(args.pnpbs, args.ours), *with_gmsh.tools(), *with_cgal.tools(),
             *with_triangle.tools(), *with_jigsaw.tools()]
    wanted = [t for t in tools
              if not args.tools or any(word.lower() in t.name.lower() for word in args.tools)]
    left_out = []
    versions = [version_or_why_not(t.name, t.available(), t.needs, t.version, left_out)
                for t in wanted]
    return [(t, version) for t, version in zip(wanted, versions) if version], left_out


def version_or_why_not(name, is_there, needs, ask_version, left_out):
    """The version of a tool that starts; of others None, and the reason in left_out."""
    try:
        if is_there:
            return ask_version()
        why = f"not found; needs {needs}"
    except DoesNotStart as error:
        why = f"found, but does not start: {error}"
    left_out.append({"name": name, "why": why})
    return None


def place(tool, case, args):
    """Medians over the repetitions, and the measures of the last node set."""
    outcomes = []
    with tempfile.TemporaryDirectory(prefix="pnpbs-compare-") as folder:
        for repetition in range(args.repeat):
            there = Path(folder) / str(repetition)
            there.mkdir()
            outcomes.append(tool.run(case, there, args.time_limit))
    inner = [o.inner_seconds for o in outcomes]
    return {"seconds": statistics.median(o.seconds for o in outcomes),
            "inner_seconds": None if None in inner else statistics.median(inner),
            "peak_bytes": statistics.median(o.peak_bytes for o in outcomes),
            "measures": evaluate(outcomes[-1].points, case.domain, case.spacing)}


def run_all(args):
    there, left_out = sort_out(args)
    if not there:
        sys.exit("no tool to run:\n" + "\n".join(f"  {t['name']}: {t['why']}" for t in left_out))
    forces = not args.no_forces
    lammps_version = forces and version_or_why_not(
        "LAMMPS", command("lmp"), "the command lmp (Debian's package lammps)",
        force_evaluation.lammps_version, left_out)
    results = {"machine": machine.describe(), "command": shown_command(), "repeat": args.repeat,
               "tools": [{"name": t.name, "version": version, "setting": t.setting}
                         for t, version in there],
               "left_out": left_out + NOT_COMPARED, "placements": [], "forces": []}
    jobs = [(nodes, name, tool) for nodes in args.nodes for name in args.cases
            for tool, _ in there]
    progress = Progress(len(jobs) + (len(args.nodes) if forces else 0))
    cases = {(n, name): CASES[name](n) for n in args.nodes for name in args.cases}
    for nodes, name, tool in jobs:
        case = cases[nodes, name]
        progress.begin(f"{name} {nodes}: {tool.name}")
        result = {"case": name, "case_title": case.title, "asked": nodes, "tool": tool.name}
        try:
            result.update(place(tool, case, args))
        except (Failed, ValueError, OSError) as error:
            result["failed"] = str(error)
        results["placements"].append(result)
        write_json(args, results)
        progress.end()
    for nodes in args.nodes if forces else []:
        progress.begin(f"force evaluation, {nodes}")
        try:
            results["forces"] += compare_forces(args, bool(lammps_version), nodes)
        except (Failed, OSError) as error:
            results["left_out"].append({"name": f"force evaluation, {nodes} nodes",
                                        "why": str(error)})
        progress.end()
    if any(r["tool"].startswith("LAMMPS") for r in results["forces"]):
        results["tools"].append({"name": "LAMMPS", "version": lammps_version,
                                 "setting": "force evaluation, at the end of this page"})
    return results


def compare_forces(args, with_lammps, nodes):
    """Medians over the repetitions, tool by tool."""
    runs = []
    with tempfile.TemporaryDirectory(prefix="pnpbs-compare-") as folder:
        for _ in range(args.repeat):
            runs.append(force_evaluation.compare(with_pnpbs.find(args.pnpbs), with_lammps, nodes,
                                                 Path(folder), args.time_limit))
    return [{**rows[0], "nanoseconds": statistics.median(r["nanoseconds"] for r in rows)}
            for rows in zip(*runs)]


def shown_command():
    """As it was given; folders of this machine say nothing to others."""
    shown, hidden = ["tests/bench/peers/compare.py"], {"--pnpbs": "PROGRAM", "--path": "FOLDER",
                                                       "--output": "FOLDER"}
    rest = iter(sys.argv[1:])
    for word in rest:
        option, equals, _ = word.partition("=")
        if option in hidden:
            shown += [option, hidden[option]]
            if not equals:
                next(rest, None)
        else:
            shown.append(shlex.quote(word))
    return " ".join(shown)


def write_json(args, results):
    args.output.mkdir(parents=True, exist_ok=True)
    (args.output / "comparison.json").write_text(json.dumps(results) + "\n")


def write(args, results):
    write_json(args, results)
    (args.output / "images").mkdir(exist_ok=True)
    try:
        from plots import draw
        pictures = draw(results, args.output / "images")
    except ImportError:
        sys.stderr.write("no pictures: matplotlib is not there\n")
        pictures = {}
    pictures = {what: f"images/{name}" for what, name in pictures.items()}
    (args.output / "comparison.md").write_text(page.markdown(results, pictures))


def main():
    args = arguments()
    os.environ["PATH"] = os.pathsep.join([*args.path, os.environ.get("PATH", "")])
    if args.source:
        results = json.loads(args.source.read_text())
    else:
        begin = time.monotonic()
        results = run_all(args)
        sys.stderr.write(f"done in {(time.monotonic() - begin) / 60:.1f} minutes\n")
    write(args, results)
    print(page.text_tables(results))
    print(f"\nwritten: comparison.md, comparison.json and images in {args.output}")
    return any(r.get("failed") for r in results["placements"])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.stderr.write("\ninterrupted; comparison.json holds what was done, for --from\n")
        sys.exit(130)

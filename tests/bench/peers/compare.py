#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs PNPBS and the installed peers on our cases and evaluates all node sets with an independent
evaluator. Prints the table and writes it as Markdown, JSON and pictures. Builds nothing.
docs/benchmarks.md says what to install."""
import argparse
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import cases  # noqa: E402
import evaluate  # noqa: E402
import evaluate_shape  # noqa: E402
import evaluate_volume  # noqa: E402
import force_evaluation  # noqa: E402
import machine  # noqa: E402
import page  # noqa: E402
import plane_table  # noqa: E402
import shape_cases  # noqa: E402
import shape_table  # noqa: E402
import volume_cases  # noqa: E402
import volume_table  # noqa: E402
from adapters import (with_cgal, with_gmsh, with_gmsh_shape, with_gmsh_volume,  # noqa: E402
                      with_jigsaw, with_jigsaw_shape, with_jigsaw_volume, with_netgen, with_pnpbs,
                      with_pnpbs_shape, with_tetgen, with_triangle)
from adapters.tool import DoesNotStart, NotSupported, command  # noqa: E402
from command_line import shown_command  # noqa: E402
from measure import Failed  # noqa: E402
from progress import Progress  # noqa: E402

ROOT = HERE.parents[2]
HIDDEN = {"--pnpbs": "PROGRAM", "--path": "FOLDER", "--output": "FOLDER"}


class Plane:
    """A kind of comparison: the cases, the tools, the evaluation and the table."""
    file = "comparison"
    cases = cases.CASES
    table = plane_table
    not_compared = [{"name": "dmsh, optimesh",
                     "why": "their packages do not start without a licence key"}]

    def tools(self, args):
        return [*with_pnpbs.tools(args.pnpbs, args.ours), *with_gmsh.tools(), *with_cgal.tools(),
                *with_triangle.tools(), *with_jigsaw.tools()]

    def measured(self, outcomes, case):
        """Returns medians over the repetitions, and the measures of the last node set."""
        return {"seconds": statistics.median(o.seconds for o in outcomes),
                "inner_seconds": median_or_none([o.inner_seconds for o in outcomes]),
                "peak_bytes": statistics.median(o.peak_bytes for o in outcomes),
                "measures": evaluate.evaluate(outcomes[-1].points, case.domain, case.spacing)}


class Space:
    file = "comparison_volumes"
    cases = volume_cases.CASES
    table = volume_table
    not_compared = []

    def tools(self, args):
        return [*with_pnpbs.volume_tools(args.pnpbs, args.ours), *with_gmsh_volume.tools(),
                *with_tetgen.tools(), *with_netgen.tools(), *with_jigsaw_volume.tools()]

    def measured(self, outcomes, case):
        last = outcomes[-1]
        measures = evaluate_volume.evaluate(last.points, last.tetrahedra, case.body, case.spacing)
        used = [o.used for o in outcomes]
        return {"seconds": statistics.median(u.seconds for u in used),
                "cpu_seconds": statistics.median(u.cpu_seconds for u in used),
                "inner_seconds": median_or_none([o.inner_seconds for o in outcomes]),
                "peak_bytes": statistics.median(u.peak_bytes for u in used), "measures": measures}


class Shape:
    """The comparison of spacings from the shape, in the plane and in space."""
    file = "comparison_shape"
    cases = shape_cases.CASES
    table = shape_table
    not_compared = []

    def tools(self, args):
        return [*with_pnpbs_shape.tools(args.pnpbs, args.ours), *with_gmsh_shape.tools(),
                *with_jigsaw_shape.tools()]

    def measured(self, outcomes, case):
        last = outcomes[-1]
        return {"seconds": statistics.median(sum(u.seconds for u in o.used) for o in outcomes),
                "cpu_seconds": statistics.median(sum(u.cpu_seconds for u in o.used)
                                                 for o in outcomes),
                "field_seconds": median_or_none([o.field_seconds for o in outcomes]),
                "even_seconds": statistics.median(o.even_seconds for o in outcomes),
                "even_points": last.even_points, "measures": evaluate_shape.evaluate(last.points, case)}


def median_or_none(values):
    return None if None in values else statistics.median(values)


KINDS = {"plane": Plane(), "space": Space(), "shape": Shape()}
UNLESS_TOLD = {"plane": 100000, "space": 70000, "shape": 20000}  # nodes


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
    parser.add_argument("--volumes", dest="kind", action="store_const", const="space",
                        default="plane", help="compare in space; 70000 nodes unless told")
    parser.add_argument("--shape", dest="kind", action="store_const", const="shape",
                        help="compare spacing from the shape; 20000 nodes unless told")
    parser.add_argument("--nodes", type=integers,
                        help="about so many in every case; several with commas (default 100000)")
    parser.add_argument("--cases", type=names,
                        help=f"some of {','.join(cases.CASES)}; with --volumes of "
                             f"{','.join(volume_cases.CASES)}; with --shape of "
                             f"{','.join(shape_cases.CASES)}")
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
                        help="folder for comparison.md, comparison.json and images/, with --volumes "
                             "comparison_volumes.md and .json, with --shape comparison_shape.md "
                             "and .json")
    parser.add_argument("--from", dest="source", type=Path,
                        help="run nothing, print and write what this JSON file holds")
    args = parser.parse_args()
    known = KINDS[args.kind].cases
    args.nodes = args.nodes or [UNLESS_TOLD[args.kind]]
    args.cases = args.cases or list(known)
    args.no_forces = args.no_forces or args.kind != "plane"
    for name in args.cases:
        if name not in known:
            parser.error(f"unknown case {name}: choose from {', '.join(known)}")
    if args.repeat < 1 or min(args.nodes) < 100:
        parser.error("--repeat must be 1 or more, --nodes 100 or more")
    return args


def sort_out(args):
    """Returns the tools that can run with their versions, and the left-out ones with the reason."""
    wanted = [t for t in KINDS[args.kind].tools(args)
              if not args.tools or any(word.lower() in t.name.lower() for word in args.tools)]
    left_out = []
    versions = [version_or_why_not(t.name, t.available(), t.needs, t.version, left_out)
                for t in wanted]
    return [(t, version) for t, version in zip(wanted, versions) if version], left_out


def version_or_why_not(name, is_there, needs, ask_version, left_out):
    """Returns the version of a tool that starts and is supported. Otherwise returns None and adds
    the reason to left_out."""
    try:
        if is_there:
            return ask_version()
        why = f"not found; needs {needs}"
    except DoesNotStart as error:
        why = f"found, but does not start: {error}"
    except NotSupported as error:
        why = f"found, but not supported: {error}"
    left_out.append({"name": name, "why": why})
    return None


def place(tool, case, args):
    outcomes = []
    with tempfile.TemporaryDirectory(prefix="pnpbs-compare-") as folder:
        for repetition in range(args.repeat):
            there = Path(folder) / str(repetition)
            there.mkdir()
            outcomes.append(tool.run(case, there, args.time_limit))
    return KINDS[args.kind].measured(outcomes, case)


def run_all(args):
    there, left_out = sort_out(args)
    if not there:
        sys.exit("no tool to run:\n" + "\n".join(f"  {t['name']}: {t['why']}" for t in left_out))
    forces = not args.no_forces
    lammps_version = forces and version_or_why_not(
        "LAMMPS", command("lmp"), "the command lmp (Debian's package lammps)",
        force_evaluation.lammps_version, left_out)
    kind = KINDS[args.kind]
    results = {"kind": args.kind, "machine": machine.describe(), "repeat": args.repeat,
               "command": shown_command("tests/bench/peers/compare.py", HIDDEN),
               "tools": [{"name": t.name, "version": version, "setting": t.setting}
                         for t, version in there],
               "left_out": left_out + kind.not_compared, "placements": [], "forces": []}
    jobs = [(nodes, name, tool) for nodes in args.nodes for name in args.cases
            for tool, _ in there]
    progress = Progress(len(jobs) + (len(args.nodes) if forces else 0))
    made = {(n, name): kind.cases[name](n) for n in args.nodes for name in args.cases}
    for nodes, name, tool in jobs:
        case = made[nodes, name]
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
    """Returns medians over the repetitions for each tool."""
    runs = []
    with tempfile.TemporaryDirectory(prefix="pnpbs-compare-") as folder:
        for _ in range(args.repeat):
            runs.append(force_evaluation.compare(with_pnpbs.find(args.pnpbs), with_lammps, nodes,
                                                 Path(folder), args.time_limit))
    return [{**rows[0], "nanoseconds": statistics.median(r["nanoseconds"] for r in rows)}
            for rows in zip(*runs)]


def write_json(args, results):
    args.output.mkdir(parents=True, exist_ok=True)
    name = KINDS[results["kind"]].file
    (args.output / f"{name}.json").write_text(json.dumps(results) + "\n")


def write(args, results):
    """Writes the JSON file, the page, and the pictures, which exist for the plane only."""
    write_json(args, results)
    kind, pictures = KINDS[results["kind"]], {}
    if results["kind"] == "plane":
        (args.output / "images").mkdir(exist_ok=True)
        try:
            from plots import draw
            pictures = draw(results, args.output / "images")
        except ImportError:
            sys.stderr.write("no pictures: matplotlib is not there\n")
    pictures = {what: f"images/{name}" for what, name in pictures.items()}
    (args.output / f"{kind.file}.md").write_text(page.markdown(results, pictures, kind.table))


def main():
    args = arguments()
    os.environ["PATH"] = os.pathsep.join([*args.path, os.environ.get("PATH", "")])
    if args.source:
        results = {"kind": "plane", **json.loads(args.source.read_text())}
    else:
        begin = time.monotonic()
        results = run_all(args)
        sys.stderr.write(f"done in {(time.monotonic() - begin) / 60:.1f} minutes\n")
    write(args, results)
    kind = KINDS[results["kind"]]
    print(page.text_tables(results, kind.table))
    images = " and images" if results["kind"] == "plane" else ""
    print(f"\nwritten: {kind.file}.md, {kind.file}.json{images} in {args.output}")
    return any(r.get("failed") for r in results["placements"])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.stderr.write("\ninterrupted; the JSON file holds what was done, for --from\n")
        sys.exit(130)

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the nodes are the same for any number of ranks and threads, exchange interval and
partition.

It runs the whole grid of these, uniform and graded. It writes a Markdown table with the hash, the
seconds and the most nodes that a rank holds (its ghosts included). The exit status is 1 if any hash
differs from that of one rank and thread, or if a run fails. docs/benchmarks.md explains the table.
"""
import argparse
import itertools
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from programs import Failed, line_of_ranks  # noqa: E402
from progress import Progress  # noqa: E402
from tables import table_head, table_row  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "examples" / "data"

# The cases by the name that place_on_ranks uses, with the number of nodes at scale 1.
CASES = {
    "graded-square": ("graded-square", 118468),
    "uniform-square": ("uniform-square", 100673),
    "lake-victoria": (str(DATA / "lake_victoria.poly"), 123000),
    "great-lakes": (str(DATA / "great_lakes_islands.poly"), 114500),
}


def arguments():
    def integers(text):
        return [int(part) for part in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=ROOT / "build/release/tests/parallel/place_on_ranks")
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--nodes", type=float, default=1e6, help="about so many in every case")
    parser.add_argument("--cases", default=",".join(CASES), type=lambda text: text.split(","))
    parser.add_argument("--ranks", default="1,2,3,4,5,7,8,16", type=integers)
    parser.add_argument("--threads", default="1,2", type=integers)
    parser.add_argument("--intervals", default="1,2,4,8", type=integers, help="exchange_interval")
    parser.add_argument("--seeds", default="1,2", type=integers, help="metis_seed")
    parser.add_argument("--set", default=[], action="append", metavar="KEY=VALUE", help="option")
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for one run")
    parser.add_argument("--output", type=Path, help="file for the table; else standard output")
    args = parser.parse_args()
    for name in args.cases:
        if name not in CASES:
            parser.error(f"unknown case {name}: choose from {', '.join(CASES)}")
    if not Path(args.program).exists():
        parser.error(f"{args.program} is not there: build it (cmake --build ... --target place_on_ranks)")
    return args


def place(args, case, ranks, threads, interval, seed):
    """Returns the fields of the line that place_on_ranks prints."""
    name, nodes_at_scale_1 = CASES[case]
    scale = (nodes_at_scale_1 / args.nodes) ** 0.5
    options = [f"exchange_interval={interval}", f"metis_seed={seed}", *args.set]
    line = line_of_ranks(args.mpiexec, ranks, threads, args.time_limit, args.program, name, scale,
                         *options)
    if "hash" not in line:
        raise Failed("it printed no hash")
    return line


class CaseResult:
    """The results of one case: the run on one rank and thread, and the rows of all other runs."""

    def __init__(self, case):
        self.case, self.reference, self.why_none = case, None, ""
        self.rows, self.differing, self.failed = [], 0, 0

    def add(self, setting, line):
        same = line["hash"] == self.reference["hash"]
        self.differing += not same
        told = [line["hash"], line["seconds"], line["held"], "" if same else "**differs**"]
        self.rows.append([self.case, *setting, *told])

    def add_failure(self, setting, why):
        self.failed += 1
        self.rows.append([self.case, *setting, "", "", "", f"**failed**: {why}"])

    def summary(self):
        if not self.reference:
            return [self.case, "", f"**failed**: {self.why_none}", "", 0, "", ""]
        return [self.case, self.reference["nodes"], self.reference["hash"],
                self.reference["seconds"], len(self.rows), self.differing, self.failed]

    def promise_kept(self):
        return self.reference is not None and self.differing == 0 and self.failed == 0


def run_case(args, case, grid, progress):
    result = CaseResult(case)
    progress.begin(f"{case} on 1 x 1")
    try:
        result.reference = place(args, case, 1, 1, 5, 1)
    except Failed as failed:  # the other runs have nothing to be compared with
        result.why_none = failed
        progress.end(1 + len(grid))
        return result
    progress.end()
    for setting in grid:
        progress.begin(f"{case} on {setting[0]} x {setting[1]}")
        try:
            result.add(setting, place(args, case, *setting))
        except Failed as failed:
            result.add_failure(setting, failed)
        progress.end()
    return result


def page(results):
    lines = table_head(["case", "nodes", "hash of 1 rank, 1 thread", "seconds", "other runs",
                        "differing", "failed"])
    lines += [table_row(result.summary()) for result in results]
    lines += ["", *table_head(["case", "ranks", "threads", "k", "seed", "hash", "seconds",
                               "most nodes held", ""])]
    lines += [table_row(row) for result in results for row in result.rows]
    return "\n".join([*lines, ""])


def main():
    args = arguments()
    # One rank has no partition and no exchange, but its nodes must not depend on these settings
    # either.
    grid = list(itertools.product(args.ranks, args.threads, args.intervals, args.seeds))
    progress = Progress(len(args.cases) * (len(grid) + 1))
    results = [run_case(args, case, grid, progress) for case in args.cases]
    if args.output:
        args.output.write_text(page(results))
    else:
        print(page(results))
    return 0 if all(result.promise_kept() for result in results) else 1


if __name__ == "__main__":
    sys.exit(main())

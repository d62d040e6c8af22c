#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the speedup of the command on the ranks and threads of one machine.
  tests/bench/speedup_study.py [--ways 2x1,1x2,8x1] [--scale 3] [--output speedup.md]

A way is RANKSxTHREADS. In each round a case runs on one rank with one thread, then as often side by
side as a way has workers, at most once per core, and then in each way. The runs side by side share
nothing but the machine, so their throughput is the limit of any speedup on it. A speedup is the
quotient of two times of the same round; the tables have medians over the rounds. The times are those
of the first rank. All runs of a case must place the same nodes. docs/scaling.md has results."""
import argparse
import json
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import mean, median

sys.dont_write_bytecode = True

import machine  # noqa: E402
from programs import Failed, on_ranks, text_of  # noqa: E402
from progress import Progress  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SQUARE = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
CUBE = "box(0,0,0, 1,1,1)"
# The domain and d of each case; nodes at scale 1: 1.2 million, 255 649 and 89 321.
CASES = {
    "graded-square": (SQUARE, ".000213+.00272*hypot(x-.5,y-.5)"),
    "even-cube": (CUBE, ".0185"),
    "graded-cube": (CUBE, ".01+.04*hypot(x-.5,y-.5,z-.5)"),
}
# Processes side by side would bind their threads to the same cores.
ENVIRONMENT = {"OMP_PROC_BIND": "false"}


def usable_cores():
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()


def ways_of(text):
    """Returns (ranks, threads) by the name of the way."""
    ways = {word: tuple(int(part) for part in word.split("x")) for word in text.split(",")}
    if any(len(way) != 2 or min(way) < 1 for way in ways.values()):
        raise argparse.ArgumentTypeError(f"expected RANKSxTHREADS,..., not {text}")
    return ways


def arguments():
    both = max(2, usable_cores())
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=ROOT / "build/release/bin/pnpbs")
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--cases", default=",".join(CASES), type=lambda text: text.split(","))
    parser.add_argument("--ways", default=f"{both}x1,1x{both}", type=ways_of,
                        help="RANKSxTHREADS,...; default: all cores, as ranks and as threads")
    parser.add_argument("--pairs", default=5, type=int, help="rounds, each with all runs")
    parser.add_argument("--scale", default=1.0, type=float, help="factor of d")
    parser.add_argument("--cores", default=usable_cores(), type=int, help="of this machine")
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for a run")
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    args = parser.parse_args()
    for case in args.cases:
        if case not in CASES:
            parser.error(f"unknown case {case}: choose from {', '.join(CASES)}")
    for option in "pairs", "scale", "cores":
        if not getattr(args, option) > 0:
            parser.error(f"--{option} must be positive")
    if not Path(args.program).exists():
        parser.error(f"{args.program} is not there: build it (cmake --build ... --target pnpbs-cli)")
    return args


def workers_of(args, way):
    ranks, threads = args.ways[way]
    return min(ranks * threads, args.cores)


class Runner:
    """Runs a case, with its files in a folder of its own."""

    def __init__(self, args, folder):
        self.args, self.folder = args, folder
        (folder / "square.poly").write_text(SQUARE)

    def report(self, case, ranks, threads, file):
        """Returns the report of one run."""
        domain, spacing = CASES[case]
        command = [self.args.program, "--domain",
                   self.folder / "square.poly" if domain == SQUARE else domain,
                   "--spacing", f"{self.args.scale:g}*({spacing})", "--report", file, "--quiet"]
        if ranks > 1:
            command = on_ranks(self.args.mpiexec, ranks, *command)
        text_of(command, threads, self.args.time_limit, ENVIRONMENT)
        report = json.loads(file.read_text())
        if (report["ranks"], report["threads"]) != (ranks, threads):
            raise Failed(f"the run had {report['ranks']} ranks with {report['threads']} threads: is "
                         f"{self.args.mpiexec} the one of the MPI library?")
        return report

    def side_by_side(self, case, count, ranks=1, threads=1):
        """Returns the reports of this number of runs at the same time."""
        files = [self.folder / f"report{index}.json" for index in range(count)]
        for file in files:
            file.unlink(missing_ok=True)
        with ThreadPoolExecutor(count) as pool:
            return list(pool.map(lambda file: self.report(case, ranks, threads, file), files))


def measured_round(args, runner, case, progress):
    """Returns the reports of a round: of the run alone, of those side by side by their number, and
    of each way by its name."""
    jobs = {"alone": (1, 1, 1)}
    jobs.update({workers_of(args, way): (workers_of(args, way), 1, 1) for way in args.ways})
    jobs.update({way: (1, *args.ways[way]) for way in args.ways})
    reports = {}
    for name, job in jobs.items():
        label = f"{name} side by side" if isinstance(name, int) else name
        progress.begin(f"{case}: {label}")
        try:
            reports[name] = runner.side_by_side(case, *job)
        except Failed as failed:
            raise Failed(f"{case}, {label}: {failed}") from None
        progress.end()
    return reports


def check_hashes(case, rounds):
    """Throws if the runs of a case differ, with the runs of each hash."""
    runs = {}
    for reports in rounds:
        for name, found in reports.items():
            label = f"{name} side by side" if isinstance(name, int) else name
            for report in found:
                runs.setdefault(report["hash"], set()).add(label)
    if len(runs) > 1:
        raise Failed(f"{case}: the nodes differ: " + "; ".join(
            f"hash {code} in {', '.join(sorted(labels))}" for code, labels in runs.items()))


def total(reports):
    return mean(report["seconds"]["total"] for report in reports)


def speedup_table(args, rounds):
    """Returns the table of a case with a row for each way."""
    rows = table_head(["way", "seconds", "speedup", "limit of the machine"])
    rows.append(table_row(["alone", f"{median(total(one['alone']) for one in rounds):.3f}", "1", "1"]))
    for way in args.ways:
        count = workers_of(args, way)
        speedup = median(total(one["alone"]) / total(one[way]) for one in rounds)
        limit = median(count * total(one["alone"]) / total(one[count]) for one in rounds)
        seconds = median(total(one[way]) for one in rounds)
        rows.append(table_row([way, f"{seconds:.3f}", f"{speedup:.2f}", f"{limit:.2f}"]))
    return rows


def phase_table(args, rounds):
    """Returns the table of the seconds of each phase that takes 1 % of a run or more."""
    def seconds(name, key, phase):
        return median(one[name][0][key][phase] for one in rounds)

    rows = table_head(["phase", "alone", *(f"{way}: seconds / waiting" for way in args.ways)])
    for phase in rounds[0]["alone"][0]["seconds"]:
        if any(seconds(name, "seconds", phase) >= 0.01 * seconds(name, "seconds", "total")
               for name in ("alone", *args.ways)):
            rows.append(table_row([phase, f"{seconds('alone', 'seconds', phase):.3f}",
                                   *(f"{seconds(way, 'seconds', phase):.3f} / "
                                     f"{seconds(way, 'waiting', phase):.3f}" for way in args.ways)]))
    return rows


def main():
    args = arguments()
    limits = {workers_of(args, way) for way in args.ways}
    progress = Progress(args.pairs * len(args.cases) * (1 + len(limits) + len(args.ways)))
    text = [f"{machine.processor()}, {args.cores} cores, {machine.system()}; load before "
            f"{machine.load()}. Medians of {args.pairs} rounds."]
    rounds = {case: [] for case in args.cases}
    try:
        with tempfile.TemporaryDirectory() as folder:
            runner = Runner(args, Path(folder))
            for _ in range(args.pairs):
                for case in args.cases:
                    rounds[case].append(measured_round(args, runner, case, progress))
                    check_hashes(case, rounds[case])
    except Failed as failed:
        sys.exit(f"\n{failed}")
    for case, found in rounds.items():
        text += ["", f"### {case}, {grouped(found[0]['alone'][0]['nodes'])} nodes", "",
                 *speedup_table(args, found), "", *phase_table(args, found)]
    give("\n".join(text), args.output)


if __name__ == "__main__":
    main()

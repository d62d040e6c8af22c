#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The promise, on the whole grid: one and the same nodes for any number of ranks and threads, any
exchange interval and any partition, uniform and graded. Writes a Markdown table with the hash,
the seconds and the most nodes that a rank holds (its ghosts included); exit status 1 if any hash
differs from that of one rank and thread. docs/benchmarks.md tells how to read it."""
import argparse
import itertools
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "examples" / "data"

# What place_on_ranks takes as its case, and the nodes it places there with its scale 1.
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
    """The fields of the line that place_on_ranks prints, or what went wrong as {"error": ...}."""
    name, nodes_at_scale_1 = CASES[case]
    scale = (nodes_at_scale_1 / args.nodes) ** 0.5
    command = [args.mpiexec, "--oversubscribe", "--bind-to", "none"]
    command += ["--mca", "mpi_yield_when_idle", "1", "-np", ranks, args.program, name, scale]
    command += [f"exchange_interval={interval}", f"metis_seed={seed}", *args.set]
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive")
    try:
        done = subprocess.run([str(part) for part in command], env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=args.time_limit)
    except subprocess.TimeoutExpired:
        return {"error": f"not done after {args.time_limit:.0f} s"}
    words = done.stdout.split()
    if done.returncode != 0 or "hash" not in words:
        return {"error": (done.stderr.strip().splitlines() or ["no output"])[0]}
    return dict(zip(words[0::2], words[1::2]))


def show_progress(done, total, started, what):
    if not sys.stderr.isatty():
        return
    width = 30
    filled = width * done // total
    left = (time.monotonic() - started) / done * (total - done) if done else 0
    sys.stderr.write(f"\r\033[K[{'#' * filled}{' ' * (width - filled)}] {done}/{total}, "
                     f"about {left / 60:.0f} min left, {what}")
    if done == total:
        sys.stderr.write("\n")
    sys.stderr.flush()


def main():
    args = arguments()
    # One rank has no partition and nothing to exchange, but must not care either.
    grid = list(itertools.product(args.ranks, args.threads, args.intervals, args.seeds))
    total, done, started = len(args.cases) * (len(grid) + 1), 0, time.monotonic()
    rows, summary, failed = [], [], 0
    for case in args.cases:
        reference = place(args, case, 1, 1, 5, 1)
        done += 1
        differing = 0
        for ranks, threads, interval, seed in grid:
            show_progress(done, total, started, f"{case} on {ranks} x {threads}")
            line = place(args, case, ranks, threads, interval, seed)
            done += 1
            same = "error" not in line and line["hash"] == reference.get("hash")
            differing += not same
            told = (f"{line['hash']} | {line['seconds']} | {line['held']}" if "error" not in line
                    else f"{line['error']} | |")
            rows.append(f"| {case} | {ranks} | {threads} | {interval} | {seed} | {told} |"
                        + ("" if same else " **differs**"))
        summary.append(f"| {case} | {reference.get('nodes', '')} | "
                       f"{reference.get('hash', reference.get('error'))} | "
                       f"{reference.get('seconds', '')} | {len(grid)} | {differing} |")
        failed += differing
    show_progress(done, total, started, "done")
    text = "\n".join(
        ["| case | nodes | hash of 1 rank, 1 thread | seconds | other runs | differing |",
         "| --- | --- | --- | --- | --- | --- |", *summary, "",
         "| case | ranks | threads | k | seed | hash | seconds | most nodes held |",
         "| --- | --- | --- | --- | --- | --- | --- | --- |", *rows, ""])
    if args.output:
        args.output.write_text(text)
    else:
        print(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

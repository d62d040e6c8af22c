#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Studies scaling without a big machine. It distributes placements over many oversubscribed ranks
and takes no step. It compares what each rank holds and sends with the prediction of a law of
surface to volume, and estimates the time per step on a cluster with a model. Small whole runs,
coarser levels included, give what a rank sends in total, and a second model the time of a large
run. Writes Markdown tables and, with --plot, a picture. docs/scaling.md explains the results."""
import argparse
import json
import math
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from programs import Failed, line_of_ranks, text_of  # noqa: E402
from progress import Progress  # noqa: E402
from tables import grouped  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "examples" / "data"

# The cases by the name that decomposition uses, with the number of nodes at scale 1 and the title.
CASES = {
    "graded-square": ("graded-square", 118468, "graded square"),
    "great-lakes": (str(DATA / "great_lakes_islands.poly"), 114500, "Great Lakes with islands"),
}

# The area per node of a hexagonal lattice in units of d^2.
AREA_PER_NODE = math.sqrt(3) / 2
BYTES_PER_GHOST = 32  # position and velocity
NEIGHBOURS_OF_A_SQUARE = 8

# Values of the default method's options and of src/level/ghosts.cpp.
REST_LENGTH, MAX_MOVE, LIST_RADIUS, GHOST_LIFE = 1.06, 0.03, 1.6, 20
MEAN_LEAF_SIDE = 3  # in spacings; leaves are 2 to 4 wide


def halo_depth(interval):
    """Returns the depth of the halo in spacings for an exchange every `interval` steps: whole hops,
    and half a leaf on average, because whole leaves are sent."""
    drift = 2 * MAX_MOVE * max(GHOST_LIFE, interval)
    hops = math.ceil((interval * (REST_LENGTH + 2 * MAX_MOVE) + drift) / LIST_RADIUS)
    return hops * LIST_RADIUS + 0.5 * MEAN_LEAF_SIDE


def ghosts_of_inner_part(nodes, ranks, interval):
    """Returns the ghosts around a square part that has neighbours on all sides."""
    owned = nodes / ranks
    side = math.sqrt(owned * AREA_PER_NODE)
    rim = (side + 2 * halo_depth(interval)) ** 2 / AREA_PER_NODE - owned
    return min(rim, nodes - owned)


def mean_ghosts(nodes, ranks, interval):
    """Returns the mean over sqrt(ranks) x sqrt(ranks) square parts of a square, which has no ghosts
    beyond its border."""
    per_row = math.sqrt(ranks)
    owned = nodes / ranks
    side = math.sqrt(owned * AREA_PER_NODE)
    span = side + 2 * halo_depth(interval) * (1 - 1 / per_row)
    return min(span ** 2 / AREA_PER_NODE - owned, nodes - owned)


class Cluster:
    def __init__(self, args, seconds_per_node):
        self.seconds_per_node = seconds_per_node
        self.latency, self.bandwidth = args.latency, args.bandwidth

    def step_seconds(self, held, messages, data, interval):
        """Returns the time of a step with messages and bytes of one exchange every interval-th
        step."""
        return (held * self.seconds_per_node + messages / interval * self.latency
                + data / interval / self.bandwidth)

    def run_seconds(self, alone, small, cut, nodes, ranks, interval):
        """Returns the time of a whole run by its parts. alone: a run on one rank. small: one on
        several ranks, which gives the number of messages; each is longer here. cut: the cost of the
        partition for a rank and for the first one."""
        owned = nodes / ranks
        held = 1 + ghosts_of_inner_part(nodes, ranks, interval) / owned
        per_node = alone["total.mean"] / alone["nodes"]
        wider = math.sqrt(owned / (small["nodes"] / small["ranks"]))
        stages = 2 * math.ceil(math.log2(ranks))
        return {
            "own nodes": per_node * owned,
            "ghosts": per_node * owned * (held - 1),
            "messages": small["messages.largest"] * self.latency
                        + wider * small["sent.largest"] / self.bandwidth,
            "collectives": small["collectives.largest"] * stages * self.latency,
            "gathered": small["gathered.largest"] / small["ranks"] * ranks / self.bandwidth,
            "table of cells": cut["table"],
            "cut on the first rank": cut["cut"],
        }

    def efficiency(self, nodes, ranks, held, messages, data, interval):
        alone = nodes * self.seconds_per_node
        return alone / (ranks * self.step_seconds(held, messages, data, interval))

    def efficiency_by_law(self, nodes, ranks, interval):
        ghosts = ghosts_of_inner_part(nodes, ranks, interval)
        return self.efficiency(nodes, ranks, nodes / ranks + ghosts, NEIGHBOURS_OF_A_SQUARE,
                               BYTES_PER_GHOST * ghosts, interval)

    def efficiency_of(self, line, interval):
        """Returns the efficiency of a measured decomposition, as if one rank had the maximum of all
        values."""
        return self.efficiency(line["nodes"], line["ranks"],
                               line["owned.largest"] + line["ghosts.largest"],
                               line["neighbours.largest"], line["bytes.largest"], interval)


def arguments():
    def integers(text):
        return [int(part) for part in text.split(",") if part != "none"]

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=ROOT / "build/release/tests/bench/decomposition")
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--nodes", type=float, default=1e6, help="about so many in every case")
    parser.add_argument("--cases", default=",".join(CASES), type=lambda text: text.split(","))
    parser.add_argument("--ranks", default="2,3,4,8,16,32,64,100,128,256", type=integers)
    parser.add_argument("--interval", default=5, type=int, help="exchange_interval")
    parser.add_argument("--latency", default=2e-6, type=float, help="of the model, seconds")
    parser.add_argument("--bandwidth", default=1e10, type=float, help="of the model, bytes/s")
    parser.add_argument("--cost-program", default=ROOT / "build/release/tests/bench/partition_cost")
    parser.add_argument("--run-ranks", default="2,4,8,16,32,64", type=integers,
                        help="of whole runs with coarser levels; none: leave them out")
    parser.add_argument("--run-nodes", type=float, default=5000, help="of these, for each rank")
    parser.add_argument("--large", default="1e8/256,1e9/1000,1e9/4096", help="NODES/RANKS,... to foresee",
                        type=lambda text: [tuple(float(n) for n in part.split("/"))
                                           for part in text.split(",")])
    parser.add_argument("--memory-ranks", default=8, type=int, help="compared with one rank")
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for one run")
    parser.add_argument("--figures", type=Path,
                        help="JSON file for what was measured; what is in it is not measured again")
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    parser.add_argument("--plot", type=Path, help="picture, .png or .svg; needs matplotlib")
    args = parser.parse_args()
    for name in args.cases:
        if name not in CASES:
            parser.error(f"unknown case {name}: choose from {', '.join(CASES)}")
    if min(args.ranks) < 2:
        parser.error("--ranks: one rank has nothing to exchange, give 2 or more")
    for program in (args.program, args.cost_program):
        if not Path(program).exists():
            parser.error(f"{program} is not there: build it (cmake --build ... --target "
                         f"{Path(program).name})")
    return args


def decompose(args, case, ranks, *more):
    """Returns the output of decomposition as numbers, or None with a message if it fails. With the
    word levels it makes a whole run with few nodes per rank. Otherwise it makes one level, as
    coarser ones would take steps with other numbers of nodes."""
    name, nodes_at_scale_1, _ = CASES[case]
    options = [f"exchange_interval={args.interval}"]
    if "levels" in more:
        nodes, more = args.run_nodes * ranks if ranks > 1 else args.nodes, ["run"]
    else:
        nodes = args.nodes
        options.append("levels=0")
    scale = (nodes_at_scale_1 / nodes) ** 0.5
    try:
        line = line_of_ranks(args.mpiexec, ranks, 1, args.time_limit, args.program, name, scale,
                             *more, *options)
    except Failed as failed:
        sys.stderr.write(f"\n{case} on {ranks} ranks: {failed}\n")
        return None
    return {key: float(value) for key, value in line.items()}


def partition_costs(args, ranks):
    """Returns the cost of the partition on this machine by number of ranks."""
    words = text_of([args.cost_program, *ranks], 1, args.time_limit).splitlines()
    lines = [dict(zip(line.split()[0::2], map(float, line.split()[1::2]))) for line in words]
    return {int(line["ranks"]): line for line in lines}


def run_all(args):
    """Makes whole runs on one and on several ranks, and the decompositions of each case. Returns
    the results by job."""
    first = args.cases[0]
    jobs = [(first, 1, "run"), (first, args.memory_ranks, "run")]
    jobs += [(case, ranks) for case in args.cases for ranks in args.ranks]
    jobs += [(first, ranks, "levels") for ranks in (1, *args.run_ranks) if args.run_ranks]
    kept = {}
    if args.figures and args.figures.exists():
        kept = json.loads(args.figures.read_text())
    progress, found = Progress(len(jobs)), {}
    for job in jobs:
        progress.begin(f"{job[0]} on {job[1]}")
        key = " ".join(str(part) for part in (*job, f"{args.nodes:g}", args.interval))
        key += f" {args.run_nodes:g}" if "levels" in job else ""
        found[job] = kept.get(key) or decompose(args, *job)
        if found[job] and args.figures:
            kept[key] = found[job]
            args.figures.write_text(json.dumps(kept, indent=1))
        progress.end()
    alone, shared = found.pop(jobs[0]), found.pop(jobs[1])
    if not alone or not shared:
        sys.exit("the whole runs failed, and without them there is no model")
    runs = [found.pop(job) for job in list(found) if "levels" in job]
    lines = {case: [line for job, line in found.items() if line and job[0] == case]
             for case in args.cases}
    return ({case: found for case, found in lines.items() if found}, alone, shared,
            [line for line in runs if line])


def decomposition_table(args, case, lines, cluster):
    k = args.interval
    rows = [f"### {CASES[case][2]}, {grouped(lines[0]['nodes'])} nodes", "",
            "| ranks | owned: mean / most | ghosts: mean / most | law: mean / inner | neighbours | "
            "messages per step | KiB per step | imbalance | "
            "partition, s | on a core, s | efficiency |",
            "| --- |" + " --- |" * 10]
    for line in lines:
        ranks = int(line["ranks"])
        def pair(key):
            return f"{grouped(line[key + '.mean'])} / {grouped(line[key + '.largest'])}"

        law = (f"{grouped(mean_ghosts(line['nodes'], ranks, k))} / "
               f"{grouped(ghosts_of_inner_part(line['nodes'], ranks, k))}")
        neighbours = f"{line['neighbours.mean']:.1f} / {line['neighbours.largest']:.0f}"
        messages = f"{line['neighbours.mean'] / k:.1f} / {line['neighbours.largest'] / k:.1f}"
        kib = f"{line['bytes.mean'] / k / 1024:.1f} / {line['bytes.largest'] / k / 1024:.1f}"
        rows.append(f"| {ranks} | {pair('owned')} | {pair('ghosts')} | {law} | {neighbours} | "
                    f"{messages} | {kib} | {line['owned.largest'] / line['owned.mean']:.3f} | "
                    f"{line['partition.largest']:.2f} | "
                    f"{line['on_a_core.mean']:.2f} / {line['on_a_core.largest']:.2f} | "
                    f"{cluster.efficiency_of(line, k):.2f} |")
    return rows


def model_table(args, cluster):
    intervals = (1, 2, args.interval, 10) if args.interval not in (1, 2, 10) else (1, 2, 5, 10)
    rows = ["### Parallel efficiency by the model", "",
            "| nodes | ranks | nodes per rank | " + " | ".join(f"k = {k}" for k in intervals) + " |",
            "| --- | --- | --- |" + " --- |" * len(intervals)]
    for nodes in (1e6, 1e7, 1e8):
        for ranks in (16, 64, 256, 1024, 4096, 16384):
            told = " | ".join(f"{cluster.efficiency_by_law(nodes, ranks, k):.2f}" for k in intervals)
            rows.append(f"| 10^{round(math.log10(nodes))} | {grouped(ranks)} | "
                        f"{grouped(nodes / ranks)} | {told} |")
    return rows


def runs_table(runs):
    """Returns a table of what a rank sends and receives in a whole run, coarser levels included."""
    rows = ["### A whole run, coarser levels included", "",
            "| ranks | nodes per rank | steps | messages: mean / most | MiB sent: mean / most | "
            "collective calls | MiB gathered |",
            "| --- |" + " --- |" * 6]
    mib = 2.0 ** 20
    for line in runs:
        rows.append(f"| {line['ranks']:.0f} | {grouped(line['nodes'] / line['ranks'])} | "
                    f"{line['steps']:.0f} | {grouped(line['messages.mean'])} / "
                    f"{grouped(line['messages.largest'])} | {line['sent.mean'] / mib:.1f} / "
                    f"{line['sent.largest'] / mib:.1f} | {grouped(line['collectives.largest'])} | "
                    f"{line['gathered.largest'] / mib:.2f} |")
    return rows


def large_table(args, cluster, runs, shared, costs):
    """Returns tables of larger runs by the model: seconds of each part, and memory."""
    alone, small = runs[0], runs[-1]
    mib = 2.0 ** 20
    per_node = (shared["memory.largest"] - shared["memory.empty.mean"]) / shared["owned.largest"]
    columns, rows = None, []
    for nodes, ranks in args.large:
        cost = costs[int(ranks)]
        parts = cluster.run_seconds(alone, small, cost, nodes, ranks, args.interval)
        if columns is None:
            columns = [*parts, "all"]
        held = nodes / ranks * per_node / mib + shared["memory.empty.mean"] / mib
        seconds = " | ".join(f"{value:.3f}" for value in (*parts.values(), sum(parts.values())))
        rows.append(f"| 10^{math.log10(nodes):.0f} | {grouped(ranks)} | {seconds} | "
                    f"{grouped(held + cost['table_mib'])} | {grouped(held + cost['cut_mib'])} |")
    return ["### Larger runs by the model, seconds", "",
            "| nodes | ranks | " + " | ".join(columns) + " | MiB per rank | MiB on the first |",
            "| --- |" + " --- |" * (len(columns) + 3), *rows]


def memory_table(alone, shared):
    mib = 2.0 ** 20
    ranks = shared["ranks"]
    bound = 1.3 * alone["memory.largest"] / ranks + shared["memory.empty.mean"]
    rows = ["### Memory of a whole run", "",
            "| ranks | nodes | peak per rank: mean / most, MiB | of which empty process, MiB | "
            "bytes per node of the rank that has most |",
            "| --- | --- | --- | --- | --- |"]
    for line in (alone, shared):
        per_node = (line["memory.largest"] - line["memory.empty.mean"]) / line["owned.largest"]
        rows.append(f"| {line['ranks']:.0f} | {grouped(line['nodes'])} | "
                    f"{line['memory.mean'] / mib:.1f} / {line['memory.largest'] / mib:.1f} | "
                    f"{line['memory.empty.mean'] / mib:.1f} | {per_node:.0f} |")
    share = f"1/{ranks:.0f}"
    rows += ["", f"1.3 times {share} of the memory of one rank, and an empty process: "
             f"{bound / mib:.1f} MiB; the most on {ranks:.0f} ranks is "
             f"{shared['memory.largest'] / bound:.2f} of that."]
    return rows


def draw(args, lines, cluster):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    k = args.interval
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4))
    nodes = next(iter(lines.values()))[0]["nodes"]
    grid = [2 ** (exponent / 8) for exponent in range(8, 8 * 8 + 1)]
    left.plot(grid, [nodes / p for p in grid], color="0.6", ls=":", label="owned, mean")
    left.plot(grid, [ghosts_of_inner_part(nodes, p, k) for p in grid], color="k",
              label="ghosts, law for an inner part")
    left.plot(grid, [mean_ghosts(nodes, p, k) for p in grid], color="k", ls="--",
              label="ghosts, law for the mean")
    for case, colour in zip(lines, ("tab:blue", "tab:orange")):
        ranks = [line["ranks"] for line in lines[case]]
        for what, marker, name in (("mean", "o", "mean"), ("largest", "^", "most")):
            left.plot(ranks, [line[f"ghosts.{what}"] for line in lines[case]], marker, ms=5,
                      color=colour, label=f"{CASES[case][2]}: ghosts, {name}")
        right.plot(ranks, [cluster.efficiency_of(line, k) for line in lines[case]], "^", ms=5,
                   color=colour, label=f"{CASES[case][2]}, decomposed")
    left.set_ylabel("nodes per rank")
    left.set_yscale("log")
    left.set_title(f"{nodes / 1e6:.2g} million nodes, exchange every {k} steps", fontsize=10)
    grid = [2 ** (exponent / 4) for exponent in range(4, 4 * 14 + 1)]
    for exponent, style in ((6, "-"), (7, "--"), (8, "-.")):
        right.plot(grid, [cluster.efficiency_by_law(10.0 ** exponent, p, k) for p in grid],
                   style, color="k", label=f"model, $10^{exponent}$ nodes")
    right.set_ylabel("parallel efficiency of a step")
    right.set_ylim(0, 1.05)
    right.set_title(f"model: {cluster.seconds_per_node * 1e9:.0f} ns per node and step, "
                    f"{cluster.latency * 1e6:g} µs, {cluster.bandwidth / 1e9:g} GB/s", fontsize=10)
    for axis in (left, right):
        axis.set_xscale("log", base=2)
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:.0f}"))
        axis.set_xlabel("ranks")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7.5)
    figure.tight_layout()
    figure.savefig(args.plot, dpi=110)


def main():
    args = arguments()
    lines, alone, shared, runs = run_all(args)
    per_node = 1e9 / (alone["nodes"] * alone["steps"])
    motion, lists = alone["motion.mean"] * per_node, alone["lists.mean"] * per_node
    cluster = Cluster(args, 1e-9 * (motion + lists))
    text = []
    for case in lines:
        text += [*decomposition_table(args, case, lines[case], cluster), ""]
    text += [f"One rank: {motion:.1f} ns per node and step for the motion, {lists:.1f} ns for the "
             f"lists; halo depth {halo_depth(args.interval):.1f} spacings.", "",
             *model_table(args, cluster), "", *memory_table(alone, shared), ""]
    if len(runs) > 1 and runs[0]["ranks"] == 1:
        costs = partition_costs(args, [int(ranks) for _, ranks in args.large])
        text += [*runs_table(runs), "", *large_table(args, cluster, runs, shared, costs), ""]
    if args.output:
        args.output.write_text("\n".join(text))
    else:
        print("\n".join(text))
    if args.plot:
        draw(args, lines, cluster)


if __name__ == "__main__":
    main()

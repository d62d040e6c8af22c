#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scaling in space without a big machine: places nodes in a cube on many ranks, oversubscribed.
  tests/bench/space_scaling_study.py --output space.md [--runs even/8/44000,...] [--figures FILE]

A run is CASE/RANKS/NODES with this number of nodes per rank. The same nodes are placed on one rank,
too. What ranks hold, send and compute for ghosts are counts, so the machine need not be idle. The
seconds are those of a core outside MPI. Laws are fitted to the even cubes and give the time of a
run on a cluster. docs/scaling.md explains the results.
"""

import argparse
import json
import sys
from pathlib import Path

sys.dont_write_bytecode = True

import space_law  # noqa: E402
from programs import Failed, line_of_ranks, text_of  # noqa: E402
from progress import Progress  # noqa: E402
from space_law import Laws, depth, ghosts, part, step_ghosts  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

BUILD = Path(__file__).resolve().parents[2] / "build" / "release" / "tests" / "bench"
NODES_AT_SCALE_1 = {"even": 255649, "graded": 243000}  # of the cases of decomposition
RUNS = ("even/2/44000,even/8/4000,even/8/44000,even/27/4000,even/27/12000,even/64/4000,"
        "graded/2/44000,graded/8/44000")
MIB = 2.0 ** 20
TARGET_GROWTH, TARGET_NODES, TARGET_MEMORY = 1.15, 44000, 1.3


def run_of(text):
    case, ranks, nodes = text.split("/")
    if case not in NODES_AT_SCALE_1 or int(ranks) < 2 or int(nodes) < 1:
        raise ValueError
    return case, int(ranks), int(nodes)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=BUILD / "decomposition")
    parser.add_argument("--cost-program", default=BUILD / "partition_cost")
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--runs", default=RUNS, help="CASE/RANKS/NODES of each rank,...")
    parser.add_argument("--nodes-per-rank", default="4000,44000,500000", help="of the model")
    parser.add_argument("--model-ranks", default="8,64,216,1000", help="of the model")
    parser.add_argument("--latency", default=2e-6, type=float, help="of the model, seconds")
    parser.add_argument("--bandwidth", default=1e10, type=float, help="of the model, bytes/s")
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for a run")
    parser.add_argument("--figures", type=Path,
                        help="JSON file for what was measured; what is in it is not measured again")
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    args = parser.parse_args()
    try:
        args.runs = [run_of(text) for text in args.runs.split(",")]
    except ValueError:
        parser.error(f"--runs: expected CASE/RANKS/NODES,... with {' or '.join(NODES_AT_SCALE_1)} "
                     "and 2 ranks or more")
    for program in args.program, args.cost_program:
        if not Path(program).exists():
            parser.error(f"{program} is not there: build it (cmake --build ... --target "
                         f"{Path(program).name})")
    return args


def kept_figures(args):
    return json.loads(args.figures.read_text()) if args.figures and args.figures.exists() else {}


def keep(args, kept, key, figures):
    kept[key] = figures
    if args.figures:
        args.figures.write_text(json.dumps(kept, indent=1))


def figures_of(args, case, ranks, nodes, kept):
    """Returns the output of decomposition as numbers."""
    key = f"{case}-cube {ranks} {nodes}"
    if key not in kept:
        scale = (NODES_AT_SCALE_1[case] / (ranks * nodes)) ** (1 / 3)
        line = line_of_ranks(args.mpiexec, ranks, 1, args.time_limit, args.program, f"{case}-cube",
                             scale, "run")
        keep(args, kept, key, {name: float(value) for name, value in line.items()})
    return kept[key]


def measured(args):
    """Returns by case pairs of the run on the ranks and the same on one, and a line for each failed
    run."""
    kept, pairs, failures = kept_figures(args), {}, []
    progress = Progress(len(args.runs))
    for case, ranks, nodes in args.runs:
        progress.begin(f"{case} cube on {ranks} ranks")
        try:
            alone = figures_of(args, case, 1, ranks * nodes, kept)
            line = figures_of(args, case, ranks, nodes, kept)
            if line["nodes"] != alone["nodes"]:
                raise Failed(f"{line['nodes']:.0f} nodes, but {alone['nodes']:.0f} on one rank")
            pairs.setdefault(case, []).append((line, alone))
        except Failed as failed:
            failures.append(f"{case} cube on {ranks} ranks: {failed}")
        progress.end()
    for case in pairs:
        pairs[case].sort(key=lambda pair: (pair[0]["ranks"], pair[0]["nodes"]))
    return pairs, failures


def partition_costs(args, ranks):
    """Returns the seconds of this machine by number of ranks."""
    kept, costs = kept_figures(args), {}
    for count in ranks:
        key = f"partition {count}"
        if key not in kept:
            words = text_of([args.cost_program, "space", count], 1, args.time_limit).split()
            keep(args, kept, key, dict(zip(words[0::2], map(float, words[1::2]))))
        costs[count] = kept[key]
    return costs


def most(line, of):
    return f"{grouped(line[of + '.mean'])} / {grouped(line[of + '.largest'])}"


def work_table(pairs, laws):
    rows = ["### What ranks compute for nodes of others", "",
            *table_head(["cube", "ranks", "nodes", "per rank", "motion",
                         *(f"{phase}: counted / law" for phase in Laws.COUNTED),
                         "core seconds over one rank's"])]
    for case, line, alone in cases(pairs):
        cells = [case, f"{line['ranks']:.0f}", grouped(line["nodes"]), grouped(line["owned.mean"]),
                 f"{line['redundancy.motion']:.3f}"]
        for phase in Laws.COUNTED:
            law = f" / {laws.by_law(phase, line):.3f}" if case == "even" else ""
            cells.append(f"{line[f'redundancy.{phase}']:.3f}{law}")
        times = line["computed.mean"] * line["ranks"] / alone["computed.mean"]
        rows.append(table_row([*cells, f"{times:.2f}"]))
    even = [line for line, _ in pairs["even"]]
    rows += ["", *table_head(["", "layer, spacings", "law is off by at most",
                              f"inner part of {grouped(TARGET_NODES)} nodes"])]
    for phase in Laws.COUNTED:
        rows.append(table_row([
            phase, f"{laws.layers[phase]:.2f}", f"{100 * laws.worst(phase, even):.0f} %",
            f"{space_law.growth(laws.layers[phase], TARGET_NODES, float('inf')):.2f}"]))
    return rows


def ghosts_table(pairs):
    rows = ["### What ranks hold and send", "",
            *table_head(["cube", "ranks", "owned: mean / most", "ghosts: mean / most", "law: mean",
                         "neighbours: mean / most", "steps", "messages: mean / most",
                         "for each neighbour", "MiB sent: mean / most", "exchanges' worth",
                         "collective calls", "MiB gathered"])]
    for case, line, _ in cases(pairs):
        law = ghosts(depth(space_law.STAR_HOPS), *part(line))
        worth = line["sent.mean"] / (space_law.BYTES_PER_GHOST * step_ghosts(line))
        rows.append(table_row([
            case, f"{line['ranks']:.0f}", most(line, "owned"), most(line, "ghosts"), grouped(law),
            f"{line['neighbours.mean']:.1f} / {line['neighbours.largest']:.0f}",
            f"{line['steps']:.0f}", most(line, "messages"),
            grouped(line["messages.mean"] / line["neighbours.mean"]),
            f"{line['sent.mean'] / MIB:.1f} / {line['sent.largest'] / MIB:.1f}", f"{worth:.0f}",
            grouped(line["collectives.largest"]), f"{line['gathered.largest'] / MIB:.2f}"]))
    return rows


def memory_table(pairs):
    rows = ["### Memory", "",
            *table_head(["cube", "ranks", "nodes", "peak of a rank: mean / most, MiB",
                         "without buffers of MPI on a node", "empty process, MiB",
                         "bytes per node of the rank that has most",
                         "on one rank", "most over 1.3 times its share"])]
    for case, line, alone in cases(pairs):
        empty = line["memory.empty.mean"]
        own = line["memory.own.largest"] - empty
        bound = TARGET_MEMORY * (alone["memory.own.largest"] - alone["memory.empty.mean"]) / line["ranks"]
        rows.append(table_row([
            case, f"{line['ranks']:.0f}", grouped(line["nodes"]),
            f"{line['memory.mean'] / MIB:.0f} / {line['memory.largest'] / MIB:.0f}",
            f"{line['memory.own.mean'] / MIB:.0f} / {line['memory.own.largest'] / MIB:.0f}",
            f"{empty / MIB:.0f}",
            grouped(own / line["owned.largest"]),
            grouped((alone["memory.own.largest"] - alone["memory.empty.mean"]) / alone["nodes"]),
            f"{own / bound:.2f}"]))
    return rows


def phases_table(laws):
    names = sorted(laws.phases, key=laws.phases.get, reverse=True)
    return ["### A node on one rank, microseconds of a core for a whole run", "",
            *table_head([*names, "all"]),
            table_row([f"{1e6 * laws.phases[name]:.2f}" for name in names]
                      + [f"{1e6 * laws.alone:.1f}"])]


def model_table(args, laws):
    ranks = [int(word) for word in args.model_ranks.split(",")]
    costs = partition_costs(args, ranks)
    rows, columns = [], ()
    for owned in (int(word) for word in args.nodes_per_rank.split(",")):
        for count in ranks:
            own = laws.alone * owned
            others = laws.others(owned, count, costs[count], args.latency, args.bandwidth)
            columns = list(others)
            seconds = [own, laws.counted(owned, count), *others.values()]
            rows.append(table_row([grouped(owned), grouped(count),
                                   *(f"{value:.3f}" for value in seconds),
                                   f"{own / sum(seconds):.2f}"]))
    head = table_head(["nodes per rank", "ranks", "own nodes", "ghosts", *columns, "efficiency"])
    return ["### Parallel efficiency in space by the model, seconds of a whole run", "", *head, *rows]


def cases(pairs):
    return [(case, *pair) for case, found in pairs.items() for pair in found]


def main():
    args = arguments()
    pairs, failures = measured(args)
    for line in failures:
        sys.stderr.write(line + "\n")
    if "even" not in pairs or len(pairs["even"]) < 2:
        sys.exit("the laws need two runs of the even cube, or more")
    laws = Laws(pairs["even"])
    tables = [work_table(pairs, laws), ghosts_table(pairs), memory_table(pairs), phases_table(laws),
              model_table(args, laws)]
    give("\n\n".join("\n".join(rows) for rows in tables), args.output)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

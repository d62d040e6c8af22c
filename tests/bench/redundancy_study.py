#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What ranks compute for nodes of others in a body: whole runs on several numbers of ranks.

  tests/bench/redundancy_study.py --output redundancy.md [--ranks 2,8,64] [--nodes-per-rank 44000]
                                  [--cases even,graded] [--program build/release/bin/pnpbs]

The figures are counts (statistics `redundancy.*` and `nodes_held`), so no machine has to be idle, and
ranks may be more than cores. The law for stars is that of a cube cut into cubes, see docs/scaling.md.
"""

import argparse
import json
import os
import tempfile

from programs import Failed, on_ranks, text_of
from progress import Progress
from tables import grouped, table_head, table_row

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CASES = {"even": "1", "graded": "0.2+hypot(x,hypot(y,z))"}
PHASES = ("lists", "motion", "stars", "sweeps")
VOLUME_OF_NODE = 0.62  # over d^3: 255 649 nodes in the unit cube at d = 0.0185
LAYER = 1.4  # spacings around a part in which stars are found, too


def law(ranks, nodes):
    """Stars found over nodes owned: the mean over parts, of which those outside lack some neighbours."""
    width = (VOLUME_OF_NODE * nodes / ranks) ** (1 / 3)
    return (1 + 2 * LAYER * (1 - ranks ** (-1 / 3)) / width) ** 3


def report_of(arguments, case, ranks, folder):
    file = os.path.join(folder, f"{case}-{ranks}.json")
    command = on_ranks(arguments.mpiexec, ranks, arguments.program, "--domain", "box(0,0,0,1,1,1)",
                       "--spacing", CASES[case], "--nodes", arguments.nodes_per_rank * ranks,
                       "--report", file, "--quiet")
    text_of(command, 1, arguments.time_limit)
    with open(file, encoding="utf-8") as opened:
        return json.load(opened)


def row(case, ranks, report):
    nodes = report["nodes"]
    shown = [case, ranks, grouped(nodes), grouped(nodes / ranks), grouped(report["nodes_held"])]
    shown += [f"{report['redundancy'][phase]:.3f}" for phase in PHASES]
    return table_row(shown + [f"{law(ranks, nodes):.3f}" if case == "even" else ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "bin", "pnpbs"))
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--ranks", default="2,8,64")
    parser.add_argument("--nodes-per-rank", type=int, default=44000)
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--time-limit", type=float, default=3600, help="seconds for a run")
    parser.add_argument("--output", required=True)
    arguments = parser.parse_args()
    cases, ranks = arguments.cases.split(","), [int(word) for word in arguments.ranks.split(",")]
    lines = table_head(["cube", "ranks", "nodes", "per rank", "held by a rank, most", *PHASES, "stars by the law"])
    progress = Progress(len(cases) * len(ranks))
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            for count in ranks:
                progress.begin(f"{case} cube on {count} ranks")
                try:
                    lines.append(row(case, count, report_of(arguments, case, count, folder)))
                except Failed as failed:
                    lines.append(table_row([case, count, str(failed)] + [""] * 7))
                progress.end()
    with open(arguments.output, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

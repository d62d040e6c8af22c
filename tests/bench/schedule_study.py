#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the effect of the schedule's options on speed and quality. One option at a time differs
from its default. The graded square is run at several scales, because least quality and smallest
angle depend on chance. Writes a page in Markdown; docs/benchmarks.md explains how to run it."""
import argparse
import json
import re
import shlex
import statistics
import sys
from pathlib import Path

sys.dont_write_bytecode = True

import machine  # noqa: E402
from programs import Failed, text_of  # noqa: E402
from progress import Progress  # noqa: E402
from tables import grouped, table_head, table_row  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
CASE, NODES_AT_SCALE_1 = "graded-square", 118069
SCALES = 0.95, 1.07  # the smallest and the largest
REPEAT_DEFAULT = 3  # all speeds are compared with the default's

# The values of each option besides its default, by preset.
GRIDS = {
    "default": {
        "levels": [0, 1, 2, 3, 4],
        "coarsest_steps": [50, 100, 200, 300, 600],
        "refined_steps": [20, 40, 60, 100, 200],
        "steps": [20, 40, 80, 300],
        "time_step": [0.4, 0.6, 0.8, 1.0],
        "damping": [0.05, 0.1, 0.2, 0.4, 0.8],
        "rest_length": [1.03, 1.05, 1.06, 1.08, 1.1],
        "max_move": [0.015, 0.02, 0.03, 0.05, 0.1],
        "event_interval": [10, 20, 40],
        "population_share": [0, 0.1, 0.3, 0.6],
        "population_tolerance": [0, 0.0002, 0.002],
        "insert_below": [4, 4.2, 4.4, 4.7, 5],
        "delete_above": [7.5, 8, 8.5, 9],
        "tolerance_mean": [0.003, 0.004, 0.006, 0.01, 0.015],
        "list_radius": [1.5, 1.6, 1.7, 1.8],
        "sweeps": [0, 2, 4, 6, 10],
        "sweep_weight": [0.5, 0.6, 0.7],
        "topology_repairs": [0, 1, 2],
        "smoothing_rounds": [0, 1, 10, 30],
        "smooth_below": [0.78, 0.82, 0.85, 0.87],
    },
    "best": {
        "levels": [2, 3, 4],
        "coarsest_steps": [300, 1000, 3000],
        "refined_steps": [200, 500, 1000],
        "steps": [100, 300, 600],
        "time_step": [0.6, 0.8, 1.0],
        "damping": [0.02, 0.05, 0.1, 0.2],
        "rest_length": [1.02, 1.03, 1.04, 1.06],
        "max_move": [0.02, 0.03, 0.05],
        "insert_below": [4, 4.4, 5],
        "tolerance_mean": [0.0005, 0.001, 0.002, 0.003, 0.004],
        "sweeps": [5, 8, 12],
        "topology_repairs": [0, 1, 2, 3],
        "smoothing_rounds": [0, 10],
        "smooth_below": [0.82, 0.85, 0.87],
    },
}

# The expressions match name, default, paper's and best's value in a row of the source's options
# table, and the text of the reference about an option.
OPTION_ROW = re.compile(r'\{"(\w+)", T::\w+, "([^"]*)", [^,]+, (?:nullptr|"([^"]*)"),')
OPTION_HELP = re.compile(r"^\| `(\w+)` \|.* \| (.*) \|$", re.MULTILINE)

# The expressions match the two lines that pnpbs-bench prints about a run.
RUN = re.compile(r": (?P<nodes>\d+) nodes, .* user (?P<user>\S+) s, (?P<steps>\d+) steps")
QUALITY = re.compile(
    r"^  wide .*mean (?P<mean>\S+)  1% (?P<one_percent>\S+)  least (?P<least>\S+) .* "
    r"angle (?P<angle>\S+)  edge/d (?P<edge>\S+) \+- (?P<deviation>\S+)$", re.MULTILINE)


def arguments():
    def words(text):
        return text.split(",")

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=ROOT / "build/release/tests/bench/pnpbs-bench")
    parser.add_argument("--nodes", type=float, default=1e5, help="about so many at scale 1")
    parser.add_argument("--scales", type=int, default=8,
                        help=f"so many from {SCALES[0]} to {SCALES[1]} times the spacing")
    parser.add_argument("--presets", default=list(GRIDS), type=words,
                        help=f"some of {','.join(GRIDS)}")
    parser.add_argument("--options", default=[], type=words, help="only these; default all")
    parser.add_argument("--time-limit", type=float, default=600, help="seconds for one run")
    parser.add_argument("--figures", type=Path,
                        help="JSON file for what was measured; what is in it is not measured again")
    parser.add_argument("--output", type=Path, help="file for the page; else standard output")
    args = parser.parse_args()
    for preset in args.presets:
        if preset not in GRIDS:
            parser.error(f"unknown preset {preset}: choose from {', '.join(GRIDS)}")
    known = {option for grid in GRIDS.values() for option in grid}
    for option in args.options:
        if option not in known:
            parser.error(f"unknown option {option}: choose from {', '.join(sorted(known))}")
    if args.scales < 1:
        parser.error("--scales must be 1 or more")
    if not Path(args.program).exists():
        parser.error(f"{args.program} is not there: build it (cmake --build ... --target pnpbs-bench)")
    return args


# ------------------------------------------------------------------ settings ----------------------


def option_table():
    """Returns for each option its value by preset, and its description."""
    source = (ROOT / "src" / "settings" / "options.cpp").read_text()
    told = dict(OPTION_HELP.findall((ROOT / "docs" / "reference" / "options.md").read_text()))
    return {name: {"default": default, "best": best or default, "does": told[name]}
            for name, default, best in OPTION_ROW.findall(source)}


def scale_factors(count):
    least, largest = SCALES
    if count == 1:
        return [1.0]
    return [round(least + (largest - least) * k / (count - 1), 4) for k in range(count)]


def options_of(args, preset):
    return [option for option in GRIDS[preset] if not args.options or option in args.options]


def values_of(option, preset, table):
    """Returns the grid's values, and the default if it is not among them."""
    return sorted({*GRIDS[preset][option], float(table[option][preset])})


def settings_of(args, preset, table):
    """Returns all settings to run, as the options set beside the preset. The first, empty one is
    the preset itself."""
    settings = [""]
    for option in options_of(args, preset):
        settings += [f"{option}={value:g}" for value in values_of(option, preset, table)
                     if value != float(table[option][preset])]
    return settings


# ------------------------------------------------------------------ runs --------------------------


def run(args, preset, setting, factor):
    scale = factor * (NODES_AT_SCALE_1 / args.nodes) ** 0.5
    command = [args.program, CASE, "--scale", f"{scale:.6g}", "--set", f"effort={preset}"]
    command += ["--set", setting] if setting else ["--repeat", REPEAT_DEFAULT]
    text = text_of(command, 1, args.time_limit)
    told, judged = RUN.search(text), QUALITY.search(text)
    if not told or not judged:
        raise Failed(f"not understood: {text.strip()[:100]}")
    return {key: float(value) for key, value in {**told.groupdict(), **judged.groupdict()}.items()}


def run_all(args, table):
    """Returns by preset and setting the figures of the runs, one for each scale, or why there are
    none."""
    factors = scale_factors(args.scales)
    kept = {}
    if args.figures and args.figures.exists():
        kept = json.loads(args.figures.read_text())
    # The order is by scale, so that disturbances of the machine are spread over the settings.
    jobs = [(preset, setting, factor) for factor in factors for preset in args.presets
            for setting in settings_of(args, preset, table)]
    progress, found = Progress(len(jobs)), {}
    for preset, setting, factor in jobs:
        progress.begin(f"effort={preset} {setting} at {factor}")
        key = f"{args.nodes:g} {factor} effort={preset} {setting}"
        try:
            if key not in kept:
                kept[key] = run(args, preset, setting, factor)
        except Failed as failed:
            found.setdefault((preset, setting), []).append({"failed": str(failed)})
        else:
            found.setdefault((preset, setting), []).append(kept[key])
            if args.figures:
                args.figures.write_text(json.dumps(kept, indent=1))
        progress.end()
    return found


# ------------------------------------------------------------------ the page ----------------------

TITLES = ["nodes/s", "of the default's speed", "steps", "mean quality", "99 % above",
          "least: mean / worst", "smallest angle: mean / worst", "edge/d"]

HOW = """The columns:

- One option at a time is moved away from its default under the preset. The default is the line in bold,
  the same in every table. Each setting is run at {scales} scales of d, from {least} to {largest} times that
  of the benchmark. Figures are means over them; "worst" is the lowest of them.
- nodes/s: nodes over the user time of a run, median over the scales, without reading and evaluation.
  Steps are those of all levels. Everything is compared with the default, so the default is timed
  {repeat} times at each scale.
- Quality is 2 r_in / R of the triangles, 1 for an equilateral one. Angles are in degrees. edge/d is the
  mean and deviation of the edges over the spacing at their ends. Evaluated by CGAL, as in the README.
"""

CHANCE = """- Chance: from one scale to the next the default's mean quality varies by {mean:.5f} (standard
  deviation), its 99 % by {one_percent:.4f}, its least by {least:.3f}, its smallest angle by {angle:.1f}
  degrees; means over all scales {share:.2f} times as much. Smaller differences in a table are not significant.
"""


def mean_of(runs, key):
    return statistics.fmean(line[key] for line in runs)


def worst_of(runs, key):
    return min(line[key] for line in runs)


def speed_of(runs):
    least = 1e-3  # resolution of pnpbs-bench
    return statistics.median(line["nodes"] / max(line["user"], least) for line in runs)


def cells_of(runs, default_runs):
    for line in runs:
        if "failed" in line:
            return [f"failed: {line['failed']}"] + [""] * (len(TITLES) - 1)
    speed = speed_of(runs)
    ratio = "" if "failed" in default_runs[0] else f"{speed / speed_of(default_runs):.2f}"
    return [grouped(round(speed, -3)), ratio, f"{mean_of(runs, 'steps'):.0f}",
            f"{mean_of(runs, 'mean'):.5f}", f"{mean_of(runs, 'one_percent'):.4f}",
            f"{mean_of(runs, 'least'):.3f} / {worst_of(runs, 'least'):.3f}",
            f"{mean_of(runs, 'angle'):.1f} / {worst_of(runs, 'angle'):.1f}",
            f"{mean_of(runs, 'edge'):.4f} ± {mean_of(runs, 'deviation'):.4f}"]


def table_of(preset, option, found, table):
    default_runs = found[preset, ""]
    lines = [f"### {option}", "", f"{table[option]['does'].strip(' .')}.", "",
             *table_head([f"`{option}`", *TITLES])]
    for value in values_of(option, preset, table):
        if value == float(table[option][preset]):
            cells = [f"{value:g}", *cells_of(default_runs, default_runs)]
            lines.append(table_row(f"**{cell}**" for cell in cells))
        else:
            runs = found[preset, f"{option}={value:g}"]
            lines.append(table_row([f"{value:g}", *cells_of(runs, default_runs)]))
    return lines + [""]


def how(args, runs):
    """Returns the explanation of the columns, with the random variation in the runs of a default.
    """
    text = HOW.format(scales=args.scales, least=SCALES[0], largest=SCALES[1],
                      repeat=REPEAT_DEFAULT)
    if len(runs) > 1 and not any("failed" in line for line in runs):
        spread = {key: statistics.stdev(line[key] for line in runs)
                  for key in ("mean", "one_percent", "least", "angle")}
        text += CHANCE.format(share=len(runs) ** -0.5, **spread)
    return text


def shown_command():
    """Returns the command without folders of this machine."""
    shown, hidden = ["tests/bench/schedule_study.py"], ("--program", "--figures", "--output")
    rest = iter(sys.argv[1:])
    for word in rest:
        name, equals, _ = word.partition("=")
        if name in hidden:
            shown.append(f"{name} FILE")
            if not equals:
                next(rest, None)
        else:
            shown.append(shlex.quote(word))
    return " ".join(shown)


def page(args, found, table):
    first = found[args.presets[0], ""]
    lines = ["# The schedule, by measurement", "",
             f"{machine.date.today().isoformat()}, one thread of an {machine.processor()}; "
             f"{machine.system()}; load at the end {machine.load()}. The graded square of "
             "[the benchmarks](benchmarks.md)" +
             ("" if "failed" in first[0] else f", some {grouped(round(mean_of(first, 'nodes'), -3))}"
              " nodes") + ". Made by", "", "```sh", shown_command(), "```", ""]
    lines.append(how(args, first))
    for preset in args.presets:
        lines += [f"## effort={preset}", ""]
        for option in options_of(args, preset):
            lines += table_of(preset, option, found, table)
    return "\n".join(lines)


def main():
    args = arguments()
    table = option_table()
    found = run_all(args, table)
    text = page(args, found, table)
    if args.output:
        args.output.write_text(text)
    else:
        print(text)
    return 1 if any("failed" in line for runs in found.values() for line in runs) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.stderr.write("\ninterrupted; --figures FILE keeps what is done\n")
        sys.exit(130)

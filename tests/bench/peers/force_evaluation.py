# SPDX-License-Identifier: BSD-3-Clause
"""The cost of a force evaluation by PNPBS and by LAMMPS. LAMMPS is a molecular dynamics code that
does not place nodes, but also evaluates short-range pair forces from adjacency lists."""
import json
import math
import re

from adapters import tool
from cases import make_uniform_square
from measure import measure

STEPS = 300
# In spacings: the default of PNPBS, and here the sum of LAMMPS's cutoff and skin.
LIST_RADIUS = 1.6

# A periodic hexagonal lattice of spacing 1 with small displacements. Without an integrator no atom
# moves, so the lists are made once.
LAMMPS_INPUT = """units lj
dimension 2
boundary p p p
atom_style atomic
lattice hex {density!r}
region box block 0 {columns} 0 {rows} -0.5 0.5
create_box 1 box
create_atoms 1 box
mass 1 1.0
displace_atoms all random 0.05 0.05 0 12345
pair_style lj/cut 1.5
pair_coeff 1 1 1.0 0.890898718140339
neighbor {skin!r} bin
neigh_modify every 1000000000 delay 0 check no
thermo {steps}
run {steps}
"""


def lammps_rows(nodes, folder, time_limit):
    # Each of the columns x rows cells has two atoms.
    columns = math.ceil(math.sqrt(nodes / 2 * math.sqrt(3)))
    rows = math.ceil(nodes / 2 / columns)
    (folder / "in.lammps").write_text(
        LAMMPS_INPUT.format(density=2 / math.sqrt(3), columns=columns, rows=rows, steps=STEPS,
                            skin=round(LIST_RADIUS - 1.5, 6)))
    rows = []
    styles = [("lj/cut", []), ("lj/cut/opt", ["-sf", "opt"])]
    known = tool.answer_of("lmp", "-h")
    for style, suffix in styles:
        if not re.search(rf"\s{style}\s", known):
            continue
        used = measure(["lmp", "-in", "in.lammps", "-log", "none", *suffix], folder, time_limit)
        rows.append(read_lammps(used.stdout, style))
    return rows


def read_lammps(text, style):
    atoms = int(re.search(r"Loop time of \S+ on 1 procs for \d+ steps with (\d+) atoms", text)[1])
    pair = float(re.search(r"^Pair\s*\|\s*\S+\s*\|\s*(\S+)", text, re.MULTILINE)[1])
    listed = int(re.search(r"Total # of neighbors = (\d+)", text)[1])
    # LAMMPS lists each pair once; we count it for both atoms.
    return {"tool": f"LAMMPS, {style}", "nodes": atoms, "listed": 2 * listed / atoms,
            "nanoseconds": 1e9 * pair / (atoms * STEPS), "what": "forces alone, each pair once"}


def pnpbs_row(program, nodes, folder, time_limit):
    """Runs exactly this number of steps. The list lengths are those at the end."""
    case = make_uniform_square(nodes)
    case.domain.write_poly(folder / "case.poly")
    command = [program, "--domain", "case.poly", "--spacing", case.formula(), "--report",
               "report.json", "--output", "nodes.csv", "--threads", 1, "--quiet"]
    for option in (f"steps={STEPS}", "tolerance_mean=0", "tolerance_max=0",
                   f"list_radius={LIST_RADIUS}"):
        command += ["--set", option]
    measure(command, folder, time_limit, accepted=(0, 3))
    report = json.loads((folder / "report.json").read_text())
    count, steps = report["nodes"], report["steps"]
    # The unit of work.owned is a listed pair, and each node counts as 8 more.
    return {"tool": "PNPBS", "nodes": count, "listed": report["work"]["owned"] / count - 8,
            "nanoseconds": 1e9 * report["seconds"]["motion"] / (count * steps),
            "what": "forces and time step, each pair from both sides"}


def lammps_version():
    """Returns the version of LAMMPS. Raises DoesNotStart."""
    said = tool.answer_of("lmp", "-h")
    told = re.search(r"Simulator - (.*)", said)
    if not told:
        raise tool.DoesNotStart(f"its help is not that of LAMMPS: {tool.last_line(said)}")
    return told[1]


def compare(program, with_lammps, nodes, folder, time_limit):
    rows = []
    if program:
        rows.append(pnpbs_row(program, nodes, folder, time_limit))
    if with_lammps:
        rows += lammps_rows(nodes, folder, time_limit)
    return rows

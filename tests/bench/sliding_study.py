#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Studies whether nodes on boundary curves should slide along them. It shows what the worst
triangles of a run are, and the effect of more rounds of sweeps and repairs with and without
sliding.

  tests/bench/sliding_study.py [--pnpbs build/release/bin/pnpbs] [--nodes 20000]
                               [--cases airfoil,gear] [--settings default,best] [--output FILE]

Writes two tables in Markdown. Needs NumPy and SciPy. Sweeps and repair are those of src/quality."""
import argparse
import copy
import math
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(1, str(Path(__file__).resolve().parent / "peers"))

import cases as peers  # noqa: E402
import machine  # noqa: E402
import numpy as np  # noqa: E402
from adapters import with_pnpbs  # noqa: E402
from command_line import shown_command  # noqa: E402
from domain import from_loops  # noqa: E402
from evaluate import Mesh, lower_quantile, mendable, shape  # noqa: E402
from progress import Progress  # noqa: E402
from scipy.sparse import coo_matrix, triu  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

# The values of the library (src/method/constants.hpp, src/settings/options.cpp).
SWEEP_WEIGHT, MAX_MOVE, GUARDS_BELOW, CLEARANCE = 0.6, 0.1, 0.75, 0.4
ANGLE_WEIGHT, WORST_BELOW, SMOOTH_BELOW = 1.365, 0.82, 0.87
# Distances of a repair in units of d.
SWEEPS_ON_STARS, REPAIR_ROUNDS, WAYS = 5, 10, (0.08, 0.04, 0.02, 0.01)
DIRECTIONS = np.array([(math.cos(a), math.sin(a)) for a in np.arange(8) * math.pi / 4])
ROUNDS = 4  # rounds of sweeps and new triangles
GAP = 0.3   # largest slide of a node at once, relative to the gap to its neighbour on the curve


# ------------------------------------------------------------------ cases -------------------------

def polar(radius, count=4800):
    angle = 2 * math.pi * np.arange(count) / count
    return (radius(angle) + 0 * angle)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def curved(loops, holes, slope):
    """Returns a case in which d grows from the first vertex."""
    return peers.Case("", "", from_loops(loops, holes), 0.1, slope, *loops[0][0].tolist()).with_nodes


# The function that returns a case of peers/cases.py for a number of nodes, and the angle of a
# corner. With 0 every vertex is a node.
CASES = {
    "airfoil": (peers.make_graded_airfoil, 0),
    "airfoil-corners": (peers.make_graded_airfoil, 20),
    "annulus": (peers.make_annulus, 0),
    "annulus-corners": (curved([polar(lambda a: 1), polar(lambda a: 0.4)], [(0, 0)], 0), 20),
    "lakes": (peers.make_lakes, 0),
    "lakes-corners": (peers.make_lakes, 45),
    # The gear has six round lobes with reentrant corners between them.
    "gear": (curved([polar(lambda a: 0.6 + 0.4 * abs(np.cos(3 * a)))], (), 2), 20),
}
SETTINGS = {"default": [], "best": ["effort=best"], "bubbles": ["first_row=0"],
            "repaired": ["first_row=0", "topology_repairs=2", "sweeps=8", "smooth_below=0.87"]}


# ------------------------------------------------------------------ curves ------------------------

def corners(vertices, angle):
    """Returns the vertices that must be nodes."""
    ahead = np.arctan2(*(np.roll(vertices, -1, 0) - vertices).T[::-1])
    turn = np.abs((ahead - np.roll(ahead, 1) + math.pi) % (2 * math.pi) - math.pi)
    return vertices[turn > math.radians(angle)] if angle else vertices


class Rim:
    """The positions of nodes on the closed curves by arc length, one curve after another; which of
    them may slide, and their neighbours on the curves."""

    def __init__(self, points, on_boundary, domain, corner_angle):
        loops = [domain.vertices[loop] for loop in domain.loops()]
        self.ends = np.concatenate([np.vstack([loop, loop[:1]]) for loop in loops])
        self.stations = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(self.ends, axis=0).T))])
        after = np.cumsum([len(loop) + 1 for loop in loops])
        begins = self.stations[np.concatenate([[0], after[:-1]])]
        self.joins = after[:-1] - 1  # from one curve to the next
        self.station = np.zeros(len(points))
        self.station[on_boundary] = self.nearest(points[on_boundary])
        loop = np.searchsorted(begins, self.station, "right") - 1
        self.begin, self.length = begins[loop], (self.stations[after - 1] - begins)[loop]
        self.first = self.station.copy()
        self.beside = np.full((len(points), 2), -1)
        for k in range(len(loops)):
            nodes = np.flatnonzero(on_boundary & (loop == k))
            nodes = nodes[np.argsort(self.station[nodes])]
            self.beside[nodes] = np.column_stack([np.roll(nodes, 1), np.roll(nodes, -1)])
        held = cKDTree(np.concatenate([corners(one, corner_angle) for one in loops])).query(points)[0]
        self.slides = on_boundary & (held > 1e-9 * np.ptp(points))

    def nearest(self, points):
        a, ahead, station = self.ends[:-1], np.diff(self.ends, axis=0), np.empty(len(points))
        for first in range(0, len(points), 500):  # limits the memory
            some = slice(first, first + 500)
            off = points[some, None] - a
            share = np.clip((off * ahead).sum(2) / (ahead ** 2).sum(1), 0, 1)
            way = np.hypot(*(off - share[..., None] * ahead).transpose(2, 0, 1))
            way[:, self.joins] = np.inf
            k = way.argmin(1)
            share = share[np.arange(len(k)), k]
            station[some] = self.stations[k] + share * np.diff(self.stations)[k]
        return station

    def wrapped(self, nodes, station):
        return self.begin[nodes] + (station - self.begin[nodes]) % self.length[nodes]

    def way(self, nodes, to):
        """Returns the signed distance along the curve to other stations."""
        half = self.length[nodes] / 2
        return (to - self.station[nodes] + half) % (2 * half) - half

    def gaps(self, nodes):  # back and ahead, to the neighbours
        return (self.way(nodes, self.station[other]) for other in self.beside[nodes].T)

    def places(self, nodes, ways):
        station = self.wrapped(nodes, self.station[nodes] + ways)
        return np.column_stack([np.interp(station, self.stations, part) for part in self.ends.T])


# ------------------------------------------------------------------ rounds ------------------------

def quality(a, b, c, angles=False):
    """Returns 2 r_in / R, negative for inverted triangles, or the library's shape measure."""
    ab, bc, ca = (np.hypot(*np.moveaxis(u - v, -1, 0)) for u, v in ((a, b), (b, c), (c, a)))
    twice = ((b - a)[..., 0] * (c - a)[..., 1] - (b - a)[..., 1] * (c - a)[..., 0])
    product = np.maximum(ab * bc * ca, 1e-300)
    found = 4 * twice * abs(twice) / (product * (ab + bc + ca))
    sine = twice * np.minimum(np.minimum(ab, bc), ca) / product
    return np.minimum(found, ANGLE_WEIGHT * sine) if angles else found


class Set:
    """The nodes and their triangles, which are counter-clockwise."""
    def __init__(self, points, on_boundary, case, corner_angle):
        self.points, self.inner, self.case = points, ~on_boundary, case
        self.rim = Rim(points, on_boundary, case.domain, corner_angle)
        self.triangulate()

    def triangulate(self):
        self.mesh = Mesh(self.points, self.case.domain)
        self.d = self.case.spacing(self.points)
        t = self.mesh.triangles
        turned = quality(*self.points[t].transpose(1, 0, 2)) < 0
        self.triangles = np.where(turned[:, None], t[:, ::-1], t)
        count, ends = len(self.points), self.mesh.edges()
        both = np.concatenate([ends, ends[:, ::-1]]).T
        self.adjacent = coo_matrix((np.ones(both.shape[1]), both), (count, count)).tocsr()
        self.adjacent.data[:] = 1
        self.degree = np.maximum(self.adjacent.getnnz(1), 1)[:, None]
        self.freeze()
        corner = self.triangles.ravel()
        self.star_corners = np.argsort(corner, kind="stable")
        self.star_starts = np.searchsorted(corner[self.star_corners], np.arange(count + 1))

    def freeze(self):
        """Freezes nodes near boundary edges that belong to no triangle, which exist in thin strips.
        """
        ends = np.column_stack([np.arange(len(self.points)), self.rim.beside[:, 1]])[~self.inner]
        missing = ends[np.asarray(self.adjacent[ends[:, 0], ends[:, 1]]).ravel() == 0]
        near = np.zeros(len(self.points))
        near[missing] = 1
        self.frozen = near + self.adjacent @ (near + self.adjacent @ near) > 0

    def star(self, i):
        """Returns the other two corners of each triangle around a node, in order."""
        t, k = np.divmod(self.star_corners[self.star_starts[i]:self.star_starts[i + 1]], 3)
        return np.column_stack([self.triangles[t, (k + 1) % 3], self.triangles[t, (k + 2) % 3]])

    def slid(self, move, share):
        """Returns the nodes that slide and their distances: as all nodes would move, along the
        curve, and partly (by `share`) to where both steps of ds/d are equal."""
        nodes = np.flatnonzero(self.rim.slides & ~self.frozen)
        back, ahead = self.rim.gaps(nodes)
        before, after = self.rim.beside[nodes].T
        along = self.points[after] - self.points[before]
        along /= np.hypot(*along.T)[:, None]
        left, right = 2 / (self.d[before] + self.d[nodes]), 2 / (self.d[after] + self.d[nodes])
        equal = (back * left + ahead * right) / (left + right)
        way = (1 - share) * (move[nodes] * along).sum(1) + share * SWEEP_WEIGHT * equal
        most = np.minimum(MAX_MOVE * self.d[nodes], GAP * np.minimum(-back, ahead))
        return nodes, np.clip(way, -most, most)

    def sweep(self, share):
        move = SWEEP_WEIGHT * (self.adjacent @ self.points / self.degree - self.points)
        nodes, ways = self.slid(move, share or 0)
        move *= np.minimum(1, MAX_MOVE * self.d / np.maximum(np.hypot(*move.T), 1e-300))[:, None]
        goal = self.points + np.where((self.inner & ~self.frozen)[:, None], move, 0)
        if share is not None:
            goal[nodes] = self.rim.places(nodes, ways)
        allowed = self.allowed(goal)
        self.points[allowed] = goal[allowed]
        self.rim.station[nodes] += np.where(allowed[nodes] & (share is not None), ways, 0)

    def allowed(self, goal):
        t, barred = self.triangles, np.zeros(len(goal), bool)
        now, then = self.points[t].transpose(1, 0, 2), goal[t].transpose(1, 0, 2)
        least = np.minimum(quality(*now), GUARDS_BELOW)
        spoilt = quality(*then) < least
        for k in range(3):
            a, b, c = np.roll(t, -k, 1).T
            alone = quality(goal[a], self.points[b], self.points[c])
            barred[a[spoilt | (alone < least)]] = True
            # Inner nodes must keep away from the boundary.
            facing = self.inner[a] & ~self.inner[b] & ~self.inner[c]
            a, b, c = a[facing], self.points[b[facing]], self.points[c[facing]]
            low = np.minimum(CLEARANCE * self.d[a], height(self.points[a], b, c))
            barred[a[height(goal[a], b, c) < low]] = True
        return ~barred

    def repair(self, bad_below, slide, descend=False):
        for _ in range(REPAIR_ROUNDS):
            t = self.triangles
            found = quality(*self.points[t].transpose(1, 0, 2), angles=True)
            bad = np.flatnonzero(found < bad_below)
            turns = t[bad[np.argsort(found[bad], kind="stable")]].ravel()
            turns = turns[np.sort(np.unique(turns, return_index=True)[1])]
            may = ~self.frozen & (self.inner | (self.rim.slides & slide))
            if sum(self.repair_node(i, bad_below, descend) for i in turns[may[turns]]) == 0:
                return

    def repair_node(self, i, bad_below, descend):
        others = self.star(i)
        a, b = self.points[others].transpose(1, 0, 2)
        places, ways = self.tried(i)
        before, *after = quality(np.vstack([self.points[i], places])[:, None], a, b, angles=True)
        after = np.array(after)
        if descend:
            score, now = -((1 - after) ** 4).sum(1), -((1 - before) ** 4).sum()
        else:
            score, now = after.min(1), min(before.min(), bad_below)
            score[(after < np.minimum(before, bad_below)).any(1)] = -1
        if self.inner[i]:
            walls = ~self.inner[others].any(1)
            low, least = (height(x, a[walls], b[walls]) for x in (places[:, None], self.points[i]))
            score[(low < np.minimum(CLEARANCE * self.d[i], least)).any(1)] = -np.inf
        best = score.argmax()
        if before.min() >= bad_below or score[best] <= now:
            return False
        self.points[i] = places[best]
        self.rim.station[i] += ways[best]
        return True

    def tried(self, i):
        if self.inner[i]:
            moves = np.concatenate([way * self.d[i] * DIRECTIONS for way in WAYS])
            return self.points[i] + moves, np.zeros(len(moves))
        back, ahead = (GAP * gap for gap in self.rim.gaps(i))
        ways = np.clip(np.outer(WAYS, (-1, 1)).ravel() * self.d[i], back, ahead)
        return self.rim.places(np.full(len(ways), i), ways), ways

    def over_d(self, a, b):  # length of edges over d
        return 2 * np.hypot(*(self.points[a] - self.points[b]).T) / (self.d[a] + self.d[b])


def height(a, b, c):
    """Returns the height of a over the line bc."""
    e, r = (np.moveaxis(u - b, -1, 0) for u in (c, a))
    return abs(e[0] * r[1] - e[1] * r[0]) / np.hypot(*e)


# For each variant: the share of equal steps in the slide of the sweeps (None for no slide), whether
# the repair slides, and whether it reduces the sum of (1 - quality)^4 instead of the worst value.
VARIANTS = {
    "fixed": (None, False, False),
    "a: sweeps slide, to the mean": (0, False, False),
    "b: half to equal steps": (0.5, False, False),
    "c: the repair slides": (None, True, False),
    "b and c": (0.5, True, False),
    "fixed, by descent": (None, False, True),
    "b and c, by descent": (0.5, True, True),
}


def improve(nodes, share, slide, descend):
    for _ in range(ROUNDS):
        for _ in range(SWEEPS_ON_STARS):
            nodes.sweep(share)
        nodes.triangulate()
    for below in (WORST_BELOW, SMOOTH_BELOW):
        nodes.repair(below, slide, descend)
        nodes.triangulate()


# ------------------------------------------------------------------ tables ------------------------

TITLES = ["case", "settings", "variant", "quality: mean / 99 % above / least", "least where wide",
          "at the boundary: mean / 99 % above", "edge over d, deviation", "on the boundary, deviation",
          "slid in d: mean / most"]
WORST_TITLES = ["case", "settings", "nodes", "on the boundary", "cannot slide", "of", "triangles",
                "touch the boundary", "have an edge on it", "none of their boundary nodes can slide",
                "a corner or vertex among them"]


def row(name, settings, variant, nodes):
    triangles, rim, on = nodes.mesh.triangles, nodes.rim, np.flatnonzero(~nodes.inner)
    found = shape(nodes.points, triangles)[0]
    wide = mendable(nodes.mesh, nodes.d) & ~nodes.frozen[triangles].any(1)
    beside = ~nodes.inner[triangles].all(1)
    slid = (np.abs(rim.way(on, rim.first[on])) / nodes.d[on])[rim.slides[on]]
    return table_row([
        name, settings, variant,
        f"{found.mean():.4f} / {lower_quantile(found, 0.01):.4f} / {found.min():.4f}",
        f"{found[wide].min():.4f}",
        f"{found[beside].mean():.4f} / {lower_quantile(found[beside], 0.01):.4f}",
        f"{nodes.over_d(*triu(nodes.adjacent).nonzero()).std():.4f}",
        f"{nodes.over_d(on, rim.beside[on, 1]).std():.4f}",
        f"{slid.mean():.3f} / {slid.max():.2f}" if slid.any() else "0"])


def worst_rows(name, settings, nodes):
    """Yields rows about the worst triangles."""
    triangles, rim = nodes.mesh.triangles, ~nodes.inner
    order = np.argsort(shape(nodes.points, triangles)[0], kind="stable")
    held = rim & ~nodes.rim.slides
    for label, count in ("worst 1 %", int(0.01 * len(order))), ("worst 50", 50):
        some = triangles[order[:count]]
        on = rim[some].sum(1)
        parts = on > 0, on > 1, (on > 0) & ~nodes.rim.slides[some].any(1), held[some].any(1)
        yield table_row([name, settings, *map(grouped, (len(rim), rim.sum(), held.sum())), label,
                         grouped(count), *(grouped(part.sum()) for part in parts)])


def placed(program, case, corner_angle, options):
    """Returns the nodes of the command, and which of them are on the boundary."""
    with tempfile.TemporaryDirectory() as folder:
        case.domain.write_poly(Path(folder) / "case.poly")
        command = [program.absolute(), "--domain", "case.poly", "--corner-angle", corner_angle,
                   *with_pnpbs.spacing(case, Path(folder)), "--output", "nodes.csv", "--threads", 1,
                   "--quiet"]
        command += [word for option in options for word in ("--set", option)]
        done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True,
                              stdin=subprocess.DEVNULL, text=True, check=False)
        if done.returncode not in (0, 3):  # 3: not at rest
            sys.exit(f"pnpbs: status {done.returncode}: {done.stderr.strip()}")
        rows = np.loadtxt(Path(folder) / "nodes.csv", delimiter=",", skiprows=1, usecols=(1, 2, 3))
    return rows[:, :2].copy(), rows[:, 2] != 0


def arguments(about=__doc__):
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("--pnpbs", type=Path, default=ROOT / "build/release/bin/pnpbs")
    parser.add_argument("--nodes", type=float, default=2e4, help="about so many in each case")
    known = {"cases": list(CASES), "settings": list(SETTINGS)}
    for option, default in (("cases", list(CASES)), ("settings", ["default", "bubbles"])):
        parser.add_argument("--" + option, default=default, type=lambda text: text.split(","),
                            help="of " + ",".join(known[option]))
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    args = parser.parse_args()
    for option, names in known.items():
        if not set(getattr(args, option)) <= set(names):
            parser.error(f"--{option}: of {', '.join(names)}, with commas between them")
    if not args.pnpbs.exists():
        parser.error(f"{args.pnpbs} is not there: build it")
    return args


def measured(args):
    lines, worst, progress = [], [], Progress(len(args.cases) * len(args.settings))
    for name in args.cases:
        for settings in args.settings:
            progress.begin(f"{name}, {settings}")
            make, angle = CASES[name]
            case = make(args.nodes)
            start = Set(*placed(args.pnpbs, case, angle, SETTINGS[settings]), case, angle)
            worst += worst_rows(name, settings, start)
            lines.append(row(name, settings, "as placed", start))
            for variant, rule in VARIANTS.items():
                nodes = copy.deepcopy(start)
                improve(nodes, *rule)
                lines.append(row(name, settings, variant, nodes))
            progress.end()
    return worst, lines


def main():
    args = arguments()
    worst, lines = measured(args)
    command = shown_command("tests/bench/sliding_study.py", {"--pnpbs": "FILE", "--output": "FILE"})
    text = "\n".join([f"{machine.date.today().isoformat()}, {machine.system()}. Made by", "", "```sh",
                      command, "```", "", *table_head(WORST_TITLES), *worst, "", *table_head(TITLES),
                      *lines])
    give(text, args.output)


if __name__ == "__main__":
    main()

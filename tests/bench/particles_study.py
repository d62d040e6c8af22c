#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures particles for SPH and peridynamics (docs/guide/particles.md).

The measures are their number, their volumes, their closest pairs and their kernel sums, on bodies
with constant and graded d. The same measures are given for a lattice that the body cuts.

  tests/bench/particles_study.py [--library build/release/lib/libpnpbs.so] [--cases square,cube]
                                 [--scale 2] [--output tables.md]

Writes two tables in Markdown. Needs NumPy, SciPy and meshio."""
import argparse
import dataclasses
import math
import os
import re
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path[1:1] = [str(Path(__file__).resolve().parent / folder) for folder in ("peers", "bodies")]
sys.path.append(str(ROOT / "bindings/python"))

import machine  # noqa: E402
import numpy as np  # noqa: E402
from bodies import Body  # noqa: E402
from body_files import read_body  # noqa: E402
from command_line import shown_command  # noqa: E402
from domain import Domain as Polygon  # noqa: E402
from progress import Progress  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

DATA = ROOT / "examples" / "data"
NEAR = 0.7  # in units of d; closer pairs are counted
TOLERANCE = 0.01  # of a kernel sum
SMOOTHING = 1.2, 1.5, 2.0  # values of h / d
NEIGHBOURS = 8  # number of neighbours in the search for closest pairs
FEWEST = 100  # least number of particles with full support in a row of kernel sums
AT_ONCE = 2000  # particles whose kernel sums are evaluated together, for memory


# ------------------------------------------------------------------ cases -------------------------

HOLES = (0.6, 0.5, 0.2), (1.45, 0.55, 0.12)  # centre and radius


def plate(domain):
    domain.add_polyline([(0, 0), (2, 0), (2, 1), (0, 1)])
    for x, y, radius in HOLES:
        domain.add_arc((x, y), radius)


def from_holes(x):
    return np.min([np.hypot(x[:, 0] - a, x[:, 1] - b) - radius for a, b, radius in HOLES], axis=0)


def from_corner(x):
    return np.linalg.norm(x, axis=1)


@dataclasses.dataclass
class Case:
    shown: str  # d as a reader would write it
    dim: int
    add: object  # a function that adds the body to an empty domain
    spacing: object  # a number, or a function of points (n, dim)
    contains: object = None  # only for a body in space that does not come from a file
    file: str = ""

    def d(self, points, scale):
        if callable(self.spacing):
            return scale * self.spacing(points)
        return np.full(len(points), scale * self.spacing)


def of_file(name, shown, spacing):
    return Case(shown, 3, lambda domain: domain.read_surface(DATA / name), spacing, file=name)


def cube(shown, spacing):
    return Case(shown, 3, lambda domain: domain.add_box((0, 0, 0), (1, 1, 1)), spacing,
                lambda x: np.all((x > 0) & (x < 1), axis=1))


CASES = {
    "square": Case("0.01", 2, lambda domain: domain.add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)]), 0.01),
    "plate": Case("0.01 to 0.05", 2, plate, lambda x: np.clip(0.01 + 0.1 * from_holes(x), 0.01, 0.05)),
    "lake": Case("2", 2, lambda domain: domain.read_poly(DATA / "lake_victoria.poly"), 2.0),
    "cube": cube("0.05", 0.05),
    "cube-finer": cube("0.04", 0.04),
    "cube-graded": cube("0.02 to 0.09", lambda x: 0.02 + 0.04 * from_corner(x)),
    "ball": Case("0.07", 3, lambda domain: domain.add_ball((0, 0, 0), 1), 0.07,
                 lambda x: from_corner(x) < 1),
    "islands": Case("4", 2, lambda domain: domain.read_poly(DATA / "great_lakes_islands.poly"), 4.0),
    "bracket": of_file("bracket.stl", "2", 2.0),
    "kleopatra": of_file("kleopatra.obj", "4", 4.0),
    "eros": of_file("eros.off", "0.03", 0.03),
    "eros-graded": of_file("eros.off", "0.02 to 0.06",
                           lambda x: np.clip(0.02 + 0.025 * (x[:, 0] + 0.76), 0.02, 0.06)),
}


# ------------------------------------------------------------------ particles ---------------------

@dataclasses.dataclass
class Particles:
    points: np.ndarray
    volumes: np.ndarray
    d: np.ndarray
    seconds: float = math.nan
    left_out: int = 0  # nodes that give no particle
    moved: int = 0


def constants(dim):
    """Returns the depth of the outermost particles and the distance of bubbles of `pnpbs --nodes-at
    centers`, in units of d."""
    source = (ROOT / "src" / "tool" / "centred_nodes.hpp").read_text()
    depth, bubbles = re.findall(r"CentredNodes\{([\d.]+), ([\d.]+)\}", source)[dim - 2]
    return float(depth), float(bubbles)


def placed(pnpbs, context, case, body, scale):
    depth, bubbles = constants(case.dim)
    spacing = (lambda x: case.d(x, scale)) if callable(case.spacing) else scale * case.spacing
    start = time.process_time()
    inset = pnpbs.Domain(context, case.dim).add_offset(body, -math.inf, -depth, spacing)
    placement = pnpbs.Placement(inset)
    placement.set_spacing((lambda x: bubbles * spacing(x)) if callable(spacing) else bubbles * spacing)
    placement.run()
    made = pnpbs.Particles(placement, body)
    seconds = time.process_time() - start
    return Particles(made.points, made.volumes, case.d(made.points, scale), seconds, made.left_out,
                     made.moved)


def contains(case, body, points):
    if case.dim == 2:
        ends = body.outline().segments.reshape(-1, 2)
        return Polygon(ends, np.arange(len(ends)).reshape(-1, 2), np.zeros((0, 2))).contains(points)
    if case.file:
        vertices, triangles = read_body(DATA / case.file)
        return Body("file", np.asarray(vertices, float), triangles.tolist()).contains(points)
    return case.contains(points)


def lattice(case, body, scale):
    """Returns a lattice that begins half a spacing from the low sides of the body's box, cut by the
    body."""
    d = scale * case.spacing
    low, high = body.bounds()
    axes = [np.arange(a + d / 2, b, d) for a, b in zip(low, high)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, case.dim)
    points = points[contains(case, body, points)]
    return Particles(points, np.full(len(points), d ** case.dim), np.full(len(points), d))


# ------------------------------------------------------------------ kernels -----------------------

# The functions psi_{3,1} and psi_{3,3} of r over the radius H of the support are from Wendland,
# Piecewise polynomial, positive definite and compactly supported radial functions of minimal
# degree, Adv. Comput. Math. 4 (1995) 389-396. The factors for an integral of 1 in the plane and in
# space are from Dehnen and Aly, Improving convergence in smoothed particle hydrodynamics
# simulations without pairing instability, MNRAS 425 (2012) 1068-1082, table 1. H is 2 h for both,
# as in PySPH and TrixiParticles.jl. Dehnen and Aly define h differently.
SUPPORT = 2  # H / h


@dataclasses.dataclass
class Kernel:
    factors: dict  # by dimension, times H^dim
    value: object  # function of s = r / H up to 1, without the factor
    slope: object  # its derivative

    def sums(self, dim, volumes, offsets, distances, support, rows, count):
        """Returns the sums of V W and V grad W. `rows` has the particle of each pair, `support` the
        radius of its kernel, and `offsets` the vector to the other particle."""
        s = distances / support
        weights = self.factors[dim] * volumes / support ** dim
        values = np.bincount(rows, weights * self.value(s), count)
        along = weights * self.slope(s) / support / np.where(distances > 0, distances, 1)
        gradients = [np.bincount(rows, along * offsets[:, k], count) for k in range(dim)]
        return values, np.linalg.norm(gradients, axis=0)


KERNELS = {
    "C2": Kernel({2: 7 / math.pi, 3: 21 / (2 * math.pi)},
                 lambda s: (1 - s) ** 4 * (1 + 4 * s),
                 lambda s: -20 * s * (1 - s) ** 3),
    "C6": Kernel({2: 78 / (7 * math.pi), 3: 1365 / (64 * math.pi)},
                 lambda s: (1 - s) ** 8 * (1 + 8 * s + 25 * s ** 2 + 32 * s ** 3),
                 lambda s: -22 * s * (1 - s) ** 7 * (1 + 7 * s + 16 * s ** 2)),
}


@dataclasses.dataclass
class Sums:
    values: np.ndarray
    gradients: np.ndarray  # times d


def kernel_sums(particles, wanted, ratio):
    """Returns the sums by kernel for the particles with these indices, with h = ratio d."""
    dim = particles.points.shape[1]
    tree, found = cKDTree(particles.points), {name: [] for name in KERNELS}
    for start in range(0, len(wanted), AT_ONCE):
        here = wanted[start:start + AT_ONCE]
        support = SUPPORT * ratio * particles.d[here]
        lists = tree.query_ball_point(particles.points[here], support)
        rows = np.repeat(np.arange(len(here)), [len(one) for one in lists])
        others = np.concatenate(lists).astype(int)
        offsets = particles.points[here[rows]] - particles.points[others]
        distances = np.minimum(np.linalg.norm(offsets, axis=1), support[rows])
        for name, kernel in KERNELS.items():
            values, gradients = kernel.sums(dim, particles.volumes[others], offsets, distances,
                                            support[rows], rows, len(here))
            found[name].append((values, gradients * particles.d[here]))
    return {name: Sums(*map(np.concatenate, zip(*parts))) for name, parts in found.items()}


def endless_lattice(dim):
    """Returns as much of a lattice as the kernel of its point 0 covers."""
    reach = math.ceil(SUPPORT * max(SMOOTHING))
    axes = [np.arange(-reach, reach + 1.0)] * dim
    points = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, dim)
    points = points[np.argsort(from_corner(points), kind="stable")]
    return Particles(points, np.ones(len(points)), np.ones(len(points)))


# ------------------------------------------------------------------ tables ------------------------

TITLES = ["case", "d", "particles", "d^dim over measure", "volumes over measure, less 1",
          "volume over d^dim", "least depth over d", "closest pair over d", f"pairs below {NEAR} d",
          "left out", "moved", "CPU s"]
SUM_TITLES = ["case", "h over d", "particles",
              *(f"{kernel} {title}" for kernel in KERNELS
                for title in ("mean", "largest error", "beyond 1 %", "gradient"))]


def pairs(particles):
    """Returns the distances of close pairs, each once, divided by the mean d of both."""
    distances, others = cKDTree(particles.points).query(particles.points, NEIGHBOURS + 1)
    here = np.arange(len(others))[:, None]
    once = (here < others) & (others < len(others))
    mean = 0.5 * (particles.d[:, None] + particles.d[np.where(once, others, 0)])
    # Both particles of a close pair are among the nearest neighbours of each other.
    return (distances / mean)[once]


def row(name, shown, particles, body):
    measure, depths = body.measure(), body.distance(particles.points)
    dim = particles.points.shape[1]
    ratios, close = particles.volumes / particles.d ** dim, pairs(particles)
    seconds = "" if math.isnan(particles.seconds) else f"{particles.seconds:.1f}"
    return table_row([
        name, shown, grouped(len(ratios)), f"{(particles.d ** dim).sum() / measure:.3f}",
        f"{particles.volumes.sum() / measure - 1:.1e}",
        f"{ratios.min():.2f} to {ratios.max():.2f}" if np.ptp(ratios) > 1e-9 else "1",
        f"{(depths / particles.d).min():.2f}",
        f"{close.min():.2f}", grouped((close < NEAR).sum()),
        *([""] * 2 if math.isnan(particles.seconds) else map(grouped, (particles.left_out, particles.moved))),
        seconds])


def sum_row(name, ratio, sums):
    count = len(next(iter(sums.values())).values)
    cells = [name, f"{ratio:g}", "" if "lattice" in name else grouped(count)]
    for one in sums.values():
        errors = abs(one.values - 1)
        cells += [f"{one.values.mean():.4f}", f"{errors.max():.4f}",
                  f"{100 * np.mean(errors > TOLERANCE):.1f} %", f"{one.gradients.mean():.4f}"]
    return table_row(cells)


def sum_rows(name, body, particles):
    depths = body.distance(particles.points)
    for ratio in SMOOTHING:
        full = np.flatnonzero(depths > SUPPORT * ratio * particles.d)
        if len(full) >= FEWEST:
            yield sum_row(name, ratio, kernel_sums(particles, full, ratio))


def lattice_rows(dim):
    for ratio in SMOOTHING:
        yield sum_row(f"{'square' if dim == 2 else 'cubic'} lattice", ratio,
                      kernel_sums(endless_lattice(dim), np.array([0]), ratio))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--library", type=Path, default=ROOT / "build/release/lib/libpnpbs.so")
    parser.add_argument("--cases", default=list(CASES), type=lambda text: text.split(","),
                        help=f"some of {','.join(CASES)}")
    parser.add_argument("--scale", type=float, default=1, help="times all d")
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    args = parser.parse_args()
    for name in args.cases:
        if name not in CASES:
            parser.error(f"unknown case {name}: choose from {', '.join(CASES)}")
    if not args.scale > 0:
        parser.error("--scale must be positive")
    if not args.library.exists():
        parser.error(f"{args.library} is not there: build it")
    return args


def measured(pnpbs, args):
    """Returns the lines of both tables."""
    lines, sums, progress = [], [], Progress(len(args.cases))
    with pnpbs.Context() as context:
        for name in args.cases:
            case = CASES[name]
            progress.begin(name)
            body = pnpbs.Domain(context, case.dim)
            case.add(body)
            particles = placed(pnpbs, context, case, body, args.scale)
            lines.append(row(name, case.shown, particles, body))
            if not callable(case.spacing):
                cut = lattice(case, body, args.scale)
                lines.append(row(f"{name}, lattice", case.shown, cut, body))
            sums += sum_rows(name, body, particles)
            progress.end()
    for dim in sorted({CASES[name].dim for name in args.cases}):
        sums += lattice_rows(dim)
    return lines, sums


def main():
    args = arguments()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ["PNPBS_LIBRARY"] = str(args.library)
    import pnpbs
    lines, sums = measured(pnpbs, args)
    command = shown_command("tests/bench/particles_study.py", {"--library": "FILE", "--output": "FILE"})
    scaled = "" if args.scale == 1 else f" All d are {args.scale:g} times those of the tables."
    text = "\n".join([
        f"{machine.date.today().isoformat()}, {os.environ['OMP_NUM_THREADS']} thread of an "
        f"{machine.processor()}; {machine.system()}; load at the end {machine.load()}.{scaled} Made by", "",
        "```sh", command, "```", "", *table_head(TITLES), *lines, "", *table_head(SUM_TITLES), *sums])
    give(text, args.output)


if __name__ == "__main__":
    main()

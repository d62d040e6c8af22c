#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole spheres by PNPBS and by JIGSAW, with the same d: time, memory and quality of the triangles.

  tests/bench/sphere_study.py [--pnpbs build/release/bin/pnpbs] [--jigsaw jigsaw] [--nodes 40000]
                              [--cases even,latitude,place] [--set NAME=VALUE ...] [--output FILE]

Writes a table in Markdown. Needs NumPy and SciPy, and the command jigsaw (1.1.0, github.com/dengwirda/jigsaw); without
it, the rows of PNPBS alone. Triangles are those of the convex hull of the nodes, which are Delaunay triangles of a
sphere, for both tools; lengths and angles are straight. Each run has one thread."""
import argparse
import math
import shutil
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(1, str(Path(__file__).resolve().parent / "peers"))

import machine  # noqa: E402
import numpy as np  # noqa: E402
from adapters.with_jigsaw import block  # noqa: E402
from command_line import shown_command  # noqa: E402
from measure import Failed, measure  # noqa: E402
from scipy.spatial import ConvexHull  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

PLACE = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
GROWTH = 0.15  # growth of d per length, from the point on
MOST = 10      # largest d over the least


class Case:
    """A case in which d on the unit sphere is `scale` times the value of `shape`."""

    def __init__(self, title, shape, formula):
        self.title, self.shape, self.formula = title, shape, formula

    def spacing(self, x, scale):
        return scale * self.shape(x)

    def scale_for(self, nodes):
        """Returns the scale for this number of nodes. The sphere has 2 / sqrt(3) / d^2 nodes per
        area."""
        points = lattice(20000)
        low, high = 1e-4, 1.0
        for _ in range(60):
            middle = math.sqrt(low * high)
            d = self.spacing(points, middle)
            low, high = (low, middle) if 4 * math.pi * 2 / math.sqrt(3) * np.mean(d**-2) < nodes else (middle, high)
        return low


class PlaceCase(Case):
    """A case whose formula contains lengths, so that it depends on the scale."""

    def spacing(self, x, scale):
        way = np.arccos(np.clip(x @ PLACE, -1, 1))
        return np.minimum(scale + GROWTH * np.maximum(way - 0.1, 0), MOST * scale)


def lattice(n):
    k = np.arange(n) + 0.5
    z, turn = 1 - 2 * k / n, math.pi * (1 + math.sqrt(5)) * k
    across = np.sqrt(1 - z**2)
    return np.column_stack([across * np.cos(turn), across * np.sin(turn), z])


CASES = {
    "even": Case("the same d everywhere", lambda x: np.ones(len(x)), lambda s: repr(s)),
    "latitude": Case("d by latitude, 1 : 3", lambda x: 1 + 2 * x[:, 2]**2, lambda s: f"{s!r}*(1 + 2*z^2)"),
    "place": PlaceCase("d from a place on, 1 : 10", None, lambda s: (
        f"min({s!r} + {GROWTH}*max(acos(max(-1, min(1, {PLACE[0]:.16g}*x + {PLACE[1]:.16g}*y + {PLACE[2]:.16g}*z))) - 0.1, 0), "
        f"{MOST * s!r})")),
}


# ------------------------------------------------------------------ tools -------------------------

def by_pnpbs(command, options, case, scale, folder):
    used = measure([command, "--sphere", "1,20,-30", "--spacing", case.formula(scale), "--output", "nodes.csv", "--quiet",
                    *options], folder)
    table = np.genfromtxt(folder / "nodes.csv", delimiter=",", names=True)
    return np.column_stack([table[k] for k in "xyz"]), used


def by_jigsaw(command, sweeps, case, scale, folder):
    (folder / "sphere.msh").write_text("mshid=3;ellipsoid-mesh\nradii=1.0;1.0;1.0\n")
    settings = {"GEOM_FILE": "sphere.msh", "MESH_FILE": "nodes.msh", "HFUN_SCAL": "absolute", "MESH_DIMS": 2,
                "MESH_KERN": "delfront", "OPTM_ITER": sweeps, "NUMTHREAD": 1, "VERBOSITY": 0,
                "HFUN_HMAX": repr(scale), "HFUN_HMIN": 0.0}
    if case is not CASES["even"]:
        (folder / "d.msh").write_text(spacing_grid(case, scale))
        settings |= {"HFUN_FILE": "d.msh", "HFUN_HMAX": 10.0}
    (folder / "case.jig").write_text("".join(f"{name} = {value}\n" for name, value in settings.items()))
    used = measure([command, "case.jig"], folder)
    x = block((folder / "nodes.msh").read_text(), "point")[:, :3]
    return x / np.linalg.norm(x, axis=1)[:, None], used


def spacing_grid(case, scale):
    """Returns the text of a grid with steps of half a degree. JIGSAW interpolates d linearly
    between its points."""
    lon, lat = np.linspace(-math.pi, math.pi, 721), np.linspace(-math.pi / 2, math.pi / 2, 361)
    a, b = np.meshgrid(lon, lat, indexing="ij")
    x = np.stack([np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)], axis=-1).reshape(-1, 3)
    lines = ["mshid=3;ellipsoid-grid", "ndims=2", "radii=1.0;1.0;1.0"]
    for axis, values in enumerate((lon, lat), 1):
        lines += [f"coord={axis};{len(values)}", *map(repr, values.tolist())]
    return "\n".join(lines + [f"value={a.size};1", *map(repr, case.spacing(x, scale).tolist())]) + "\n"


# ------------------------------------------------------------------ measures ----------------------

def measures(x, case, scale):
    corners = ConvexHull(x).simplices
    side = np.linalg.norm(x[corners] - x[np.roll(corners, -1, axis=1)], axis=2)
    a, b, c = side.T
    quality = (b + c - a) / a * ((c + a - b) / b) * ((a + b - c) / c)
    square = side**2
    cosine = (np.roll(square, -1, axis=1) + np.roll(square, 1, axis=1) - square) / (
        2 * np.roll(side, -1, axis=1) * np.roll(side, 1, axis=1))
    edges = np.unique(np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1), axis=0)
    d = case.spacing(x, scale)
    over = np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1) / d[edges].mean(axis=1)
    # d is divided into eight bands of equal ratio. The result is the error of the mean edge in the
    # worst band.
    band = np.minimum(8 * np.log(d[edges].mean(axis=1) / d.min()) // max(np.log(d.max() / d.min()), 1e-12), 7).astype(int)
    means = [over[band == k].mean() for k in range(8) if np.sum(band == k) >= 100] if d.max() > 1.1 * d.min() else [over.mean()]
    return {"quality": quality, "angle": np.degrees(np.arccos(np.clip(cosine, -1, 1)).min()), "edge": over,
            "obtuse": np.sum(cosine.min(axis=1) < 0), "band": max(means, key=lambda m: abs(m - 1))}


def row(name, x, used, case, scale):
    m = measures(x, case, scale)
    return table_row([name, grouped(len(x)), f"{used.cpu_seconds:.2f}", grouped(round(len(x) / used.cpu_seconds)),
                      f"{used.peak_bytes / len(x):.0f}",
                      f"{m['quality'].mean():.4f} / {np.quantile(m['quality'], 0.01):.3f} / {m['quality'].min():.3f}",
                      f"{m['angle']:.1f}", f"{m['edge'].mean():.3f} ± {m['edge'].std():.3f}", f"{m['band']:.3f}",
                      str(m["obtuse"])])


HIDDEN = {"--pnpbs": "build/release/bin/pnpbs", "--jigsaw": "jigsaw", "--output": "FILE"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pnpbs", default=str(ROOT / "build" / "release" / "bin" / "pnpbs"))
    parser.add_argument("--jigsaw", default=shutil.which("jigsaw"))
    parser.add_argument("--nodes", type=int, default=40000)
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--set", action="append", default=[], dest="options")
    parser.add_argument("--output", type=Path)
    arguments = parser.parse_args()
    lines = [f"`{shown_command('tests/bench/sphere_study.py', HIDDEN)}`; {machine.processor()}.", ""] + table_head(
        ["", "nodes", "CPU s", "nodes/s", "bytes per node", "quality: mean / 99 % above / least", "smallest angle", "edge over d",
         "worst band", "obtuse"])
    tools = [("PNPBS", lambda *a: by_pnpbs(arguments.pnpbs, [], *a))]
    if arguments.options:
        chosen = [word for option in arguments.options for word in ("--set", option)]
        tools.append(("PNPBS, " + ", ".join(arguments.options), lambda *a: by_pnpbs(arguments.pnpbs, chosen, *a)))
    if arguments.jigsaw:
        tools.append(("JIGSAW, OPTM_ITER 16", lambda *a: by_jigsaw(arguments.jigsaw, 16, *a)))
    for key in arguments.cases.split(","):
        case = CASES[key]
        scale = case.scale_for(arguments.nodes)
        for name, run in tools:
            with tempfile.TemporaryDirectory() as folder:
                try:
                    x, used = run(case, scale, Path(folder))
                    lines.append(row(f"{case.title}: {name}", x, used, case, scale))
                except Failed as failure:
                    lines.append(table_row([f"{case.title}: {name}", str(failure), *[""] * 8]))
    give("\n".join(lines) + "\n", arguments.output)


if __name__ == "__main__":
    main()

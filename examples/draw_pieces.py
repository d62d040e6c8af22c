#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pieces of a solution that the ranks of an example have written, in one picture.
usage: draw_pieces.py [--field NAME] [--wire] [--log] [--limits LOW HIGH] [--zoom X0 X1 Y0 Y1]
                      PIECES.vtk... PICTURE.png
  --field   the scalar field that is drawn, or "rank" (default: the first field of the pieces)
  --wire    also draw the edges of the triangles
  --log     scale the colours by the logarithm of the field
  --limits  the range of the colours (default: from the least to the greatest value of the field)
  --zoom    draw this part of the picture, enlarged, in a second panel
A piece is a file in VTK's legacy format (ASCII, unstructured grid, triangles, scalars at the
points). Its rank is the number at the end of its name. A .png picture has at most 256 colours,
which keeps the file small. Requires numpy and matplotlib (and Pillow, on which that depends)."""
import argparse
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from PIL import Image


class Piece:
    """The data of one file: points [n, 2], triangles [m, 3], fields {name: [n]}, and the rank."""

    def __init__(self, path):
        number = re.search(r"(\d+)\.vtk$", path)
        self.rank = int(number.group(1)) if number else 0
        with open(path) as file:
            lines = file.read().split("\n")
        if len(lines) < 4 or "ASCII" not in lines[2] or "UNSTRUCTURED_GRID" not in lines[3]:
            sys.exit(f"{path}: not an unstructured grid in VTK's legacy ASCII format")
        self.words = " ".join(lines[4:]).split()
        self.at = 0
        self.fields = {}
        self.points = np.zeros((0, 2))
        self.triangles = np.zeros((0, 3), int)
        while self.at < len(self.words):
            self.read_section(path, self.next())
        del self.words

    def next(self):
        self.at += 1
        return self.words[self.at - 1]

    def numbers(self, count, kind=float):
        self.at += count
        return np.array(self.words[self.at - count : self.at], kind)

    def read_section(self, path, keyword):
        if keyword == "POINTS":
            count, _ = int(self.next()), self.next()
            self.points = self.numbers(3 * count).reshape(-1, 3)[:, :2]
        elif keyword == "CELLS":
            count, size = int(self.next()), int(self.next())
            if size != 4 * count:
                sys.exit(f"{path}: cells that are no triangles")
            self.triangles = self.numbers(size, int).reshape(-1, 4)[:, 1:]
        elif keyword == "CELL_TYPES":
            self.numbers(int(self.next()))
        elif keyword == "POINT_DATA":
            self.next()
        elif keyword == "SCALARS":
            name, _ = self.next(), self.next()
            if self.next() != "LOOKUP_TABLE":  # an optional number of components precedes it
                self.next()
            self.next()
            self.fields[name] = self.numbers(len(self.points))
        else:
            sys.exit(f"{path}: '{keyword}' is not understood here")


def colours_of_ranks(pieces):
    """Returns a colour map with one colour per rank, and its norm."""
    ranks = max(piece.rank for piece in pieces) + 1
    colours = plt.get_cmap("tab10" if ranks <= 10 else "tab20")
    scale = ListedColormap([colours(r % colours.N) for r in range(ranks)])
    return scale, Normalize(-0.5, ranks - 0.5)


def colours_of_field(pieces, field, limits, log):
    values = np.concatenate([piece.fields[field][np.unique(piece.triangles)] for piece in pieces])
    low, high = limits or (values.min(), values.max())
    if log:
        low = max(low, 1e-4 * high)  # smaller values, also zero, are drawn with this one
        return plt.get_cmap("viridis"), LogNorm(low, high)
    return plt.get_cmap("viridis"), Normalize(low, high)


def draw_edges(axes, piece, width):
    sides = [piece.triangles[:, [i, (i + 1) % 3]] for i in range(3)]
    edges = np.unique(np.sort(np.concatenate(sides), axis=1), axis=0)
    axes.add_collection(LineCollection(piece.points[edges], linewidths=width, colors="black"))


def draw(axes, pieces, options, scale, norm):
    width = 0.25 if axes.get_label() == "whole" else 0.5
    for piece in pieces:
        if not len(piece.triangles):
            continue
        x, y = piece.points.T
        if options.field == "rank":
            # Edges in the face's colour close the hairlines between antialiased triangles.
            corners, colour = piece.points[piece.triangles], scale(norm(piece.rank))
            axes.add_collection(
                PolyCollection(corners, facecolor=colour, edgecolor=colour, linewidth=0.1)
            )
        else:
            values = np.clip(piece.fields[options.field], norm.vmin, norm.vmax)
            axes.tripcolor(x, y, piece.triangles, values, shading="gouraud", cmap=scale, norm=norm)
        if options.wire:
            draw_edges(axes, piece, width)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_axis_off()


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--field")
    parser.add_argument("--wire", action="store_true")
    parser.add_argument("--log", action="store_true")
    parser.add_argument("--limits", nargs=2, type=float)
    parser.add_argument("--zoom", nargs=4, type=float)
    parser.add_argument("pieces", nargs="+")
    parser.add_argument("picture")
    options = parser.parse_args()
    pieces = [Piece(path) for path in options.pieces]
    known = ["rank", *pieces[0].fields]
    options.field = options.field or known[-1 if len(known) == 1 else 1]
    if options.field not in known:
        sys.exit(f"no field '{options.field}'; there are: {', '.join(known)}")

    if options.field == "rank":
        scale, norm = colours_of_ranks(pieces)
    else:
        scale, norm = colours_of_field(pieces, options.field, options.limits, options.log)
    panels = 2 if options.zoom else 1
    size = (5.6 * panels + 0.6, 5)
    figure, axes = plt.subplots(1, panels, figsize=size, squeeze=False, layout="constrained")
    axes[0, 0].set_label("whole")
    for panel in axes[0]:
        draw(panel, pieces, options, scale, norm)
    if options.zoom:
        axes[0, 1].set_xlim(options.zoom[:2])
        axes[0, 1].set_ylim(options.zoom[2:])
    colours = plt.cm.ScalarMappable(norm, scale)
    bar = figure.colorbar(colours, ax=axes, shrink=0.8, label=options.field)
    if options.field == "rank":
        bar.set_ticks(range(scale.N))
        bar.minorticks_off()
    figure.savefig(options.picture, dpi=100)
    if options.picture.endswith(".png"):
        with Image.open(options.picture) as image:
            small = image.convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE)
        small.save(options.picture, optimize=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the frames that moving_spot has written, with nodes coloured by the rank that owns them.
usage: draw_frames.py FOLDER PICTURE.png
Requires numpy and matplotlib."""
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder, picture = Path(sys.argv[1]), sys.argv[2]
files = {}
for path in folder.glob("frame_*_rank_*.csv"):
    frame, rank = map(int, re.findall(r"\d+", path.name))
    files[frame, rank] = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
frames = sorted({frame for frame, _ in files})
ranks = sorted({rank for _, rank in files})
colours = plt.get_cmap("tab10" if len(ranks) <= 10 else "tab20")

columns = 4
rows = -(-len(frames) // columns)
figure, axes = plt.subplots(rows, columns, figsize=(2.6 * columns, 2.8 * rows), squeeze=False)
for axis in axes.flat:
    axis.set_axis_off()
for axis, frame in zip(axes.flat, frames):
    nodes = 0
    for rank in ranks:
        x = files[frame, rank]
        nodes += len(x)
        if len(x):
            axis.scatter(x[:, 0], x[:, 1], s=1.6, linewidths=0, color=colours(rank % colours.N))
    axis.set_aspect("equal")
    axis.set_title(f"frame {frame}, {nodes} nodes", fontsize=8, pad=2)
figure.tight_layout(pad=0.4)
figure.savefig(picture, dpi=110)

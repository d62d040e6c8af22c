# SPDX-License-Identifier: BSD-3-Clause
"""The results as pictures; needs matplotlib."""
import io

from evaluate import HISTOGRAM
from page import groups, speed, title


def draw(results, folder):
    """Writes all pictures that have data. Returns their names by content."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    done = {key: [r for r in group if not r.get("failed")]
            for key, group in groups(results).items()}
    done = {key: group for key, group in done.items() if group}
    if not done:
        return {}
    names = list(dict.fromkeys(r["tool"] for group in done.values() for r in group))
    # A tool has one colour, and its settings have different markers.
    makers = list(dict.fromkeys(name.split(",")[0] for name in names))
    style = {}
    for name in names:
        maker = name.split(",")[0]
        shape = [n for n in names if n.split(",")[0] == maker].index(name)
        style[name] = (f"C{makers.index(maker) % 10}", "osD^v<>pP*X"[shape % 11],
                       ("-", "--", ":", "-.")[shape % 4])
    pictures = {}
    for what, panel in (("quality_speed", speed_panel), ("histogram", histogram_panel)):
        columns = min(2, len(done))
        rows = (len(done) + columns - 1) // columns
        figure, axes = plt.subplots(rows, columns, figsize=(5.5 * columns, 3.7 * rows + 0.9),
                                    squeeze=False)
        for axis, group in zip(axes.flat, done.values()):
            panel(axis, group, style)
            axis.set_title(title(group[0]), fontsize=10)
            axis.grid(alpha=0.3, which="both")
        for axis in list(axes.flat)[len(done):]:
            axis.axis("off")
        handles = {}
        for axis in axes.flat:
            handles.update(zip(*reversed(axis.get_legend_handles_labels())))
        figure.legend(handles.values(), handles, loc="lower center", ncols=4, fontsize=8)
        figure.tight_layout(rect=(0, 0.9 / figure.get_figheight(), 1, 1))
        pictures[what] = f"comparison_{what}.png"
        save(figure, folder / pictures[what])
        plt.close(figure)
    return pictures


def save(figure, path):
    """Saves with 128 colours, which takes a quarter of the bytes. Pillow is installed with
    matplotlib."""
    from PIL import Image

    whole = io.BytesIO()
    figure.savefig(whole, dpi=90)
    Image.open(whole).convert("RGB").quantize(128).save(path, optimize=True)


def speed_panel(axis, group, style):
    """Plots 1 - quality, so that both axes can be logarithmic: lower is better, right is faster."""
    for r in group:
        colour, marker, _ = style[r["tool"]]
        axis.plot(speed(r), 1 - r["measures"]["quality_mean"], marker, color=colour, ms=7,
                  label=r["tool"])
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("nodes per second, one thread")
    axis.set_ylabel("1 - mean quality (lower is better)")


def histogram_panel(axis, group, style):
    for r in group:
        colour, _, line = style[r["tool"]]
        counts = r["measures"]["histogram"]
        middles = 0.5 * (HISTOGRAM[1:] + HISTOGRAM[:-1])
        axis.plot(middles, [100 * c / sum(counts) if c else float("nan") for c in counts],
                  color=colour, ls=line, lw=1.3, marker=".", ms=3, label=r["tool"])
    axis.set_yscale("log")
    axis.set_xlim(HISTOGRAM[0], 1)
    axis.set_xlabel("quality 2 r_in / R (lower ones are counted at the left end)")
    axis.set_ylabel("% of triangles in bins of 0.01")

# SPDX-License-Identifier: BSD-3-Clause
"""Meshing time at an equal error: interpolates between the sizes that were measured and compares
two meshers."""
import numpy as np


class Curve:
    """A positive quantity as a function of the error. Between measured errors both follow a power
    law; there is no extrapolation."""

    def __init__(self, errors, values):
        order = np.argsort(errors)
        self.x, self.y = np.log(np.asarray(errors, float)[order]), np.log(np.asarray(values, float)[order])

    def __call__(self, error):
        x = np.log(error)
        slack = 1e-9 * (self.x[-1] - self.x[0])
        if np.any(x < self.x[0] - slack) or np.any(x > self.x[-1] + slack):
            raise ValueError(f"no measurement at the error {error}: they are from "
                             f"{np.exp(self.x[0]):.3g} to {np.exp(self.x[-1]):.3g}")
        return np.exp(np.interp(x, self.x, self.y))


def common_errors(*curves):
    """Returns the smallest, the middle and the largest error of the range that all curves have. The
    middle is that of the logarithms."""
    low, high = max(curve.x[0] for curve in curves), min(curve.x[-1] for curve in curves)
    if low >= high:
        raise ValueError("the errors of the meshers have no common range")
    return np.exp([low, (low + high) / 2, high])


class Comparison:
    """Meshing seconds of a peer over those of PNPBS at an equal error, from rows with error, nodes
    and meshing seconds. Above 1 PNPBS is faster."""

    def __init__(self, ours, peer):
        self.seconds = [self.curve(rows, "meshing") for rows in (ours, peer)]
        self.nodes = [self.curve(rows, "nodes") for rows in (ours, peer)]
        self.fine, self.middle, self.coarse = common_errors(*self.seconds)

    @staticmethod
    def curve(rows, name):
        return Curve([row["error"] for row in rows], [row[name] for row in rows])

    def ratio(self, error):
        ours, peer = self.seconds
        return peer(error) / ours(error)


HEAD = ["body", "errors", "middle error", "nodes: PNPBS", "HXT", "meshing s: PNPBS", "HXT",
        "**HXT / PNPBS**", "at the largest error", "at the smallest error"]


def table_line(title, found):
    ours, peer = ([f"{nodes(found.middle):,.0f}".replace(",", " "), f"{seconds(found.middle):.2f}"]
                  for nodes, seconds in zip(found.nodes, found.seconds))
    cells = [title, f"{found.coarse:#.3g} to {found.fine:#.3g}", f"{found.middle:#.3g}",
             ours[0], peer[0], ours[1], peer[1], f"**{found.ratio(found.middle):.2f}**",
             f"{found.ratio(found.coarse):.2f}", f"{found.ratio(found.fine):.2f}"]
    return "| " + " | ".join(cells) + " |"


def table(comparisons):
    """Returns the table of comparisons, by the title of the body."""
    return "\n".join(["| " + " | ".join(HEAD) + " |", "|" + " --- |" * len(HEAD),
                      *(table_line(*one) for one in comparisons.items())]) + "\n"


def measured_table(comparisons_rows):
    """Returns a table with the measured sizes: error and meshing seconds of both meshers."""
    lines = ["| body | mesher | nodes: error, meshing s |", "| --- | --- | --- |"]
    for title, meshers in comparisons_rows.items():
        for mesher, rows in meshers.items():
            shown = ("{:,}: {:#.3g}, {:.2f}".format(row["nodes"], row["error"], row["meshing"])
                     .replace(",", " ", row["nodes"] >= 1000) for row in rows)
            lines.append(f"| {title} | {mesher} | {'; '.join(shown)} |")
    return "\n".join(lines) + "\n"

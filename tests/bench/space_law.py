# SPDX-License-Identifier: BSD-3-Clause
"""What ranks hold, send and compute in a cube cut into cubes, by surface and volume, and what a run on
a cluster would take; docs/scaling.md explains it. Lengths are spacings d."""
import math

VOLUME_OF_NODE = 0.62  # over d^3: 255 649 nodes in the unit cube at d = 0.0185
BYTES_PER_GHOST = 52  # position, velocity, and the facet that it may have moved to
# Of the default method: LIST_RADIUS for each hop, and half a leaf on average, because leaves come whole.
LIST_RADIUS, HALF_LEAF = 1.6, 1.5
STAR_HOPS, STEP_HOPS = 3, 2  # kStarHops, and step_hops for an exchange in every step


def depth(hops):
    return hops * LIST_RADIUS + HALF_LEAF


def width(owned):
    return (VOLUME_OF_NODE * owned) ** (1 / 3)


def growth(layer, owned, ranks):
    """Nodes of a part and a layer of that thickness, over those of the part: the mean over the parts, of
    which those outside lack some neighbours."""
    return (1 + 2 * layer * (1 - ranks ** (-1 / 3)) / width(owned)) ** 3


def ghosts(layer, owned, ranks):
    return min(owned * (growth(layer, owned, ranks) - 1), owned * (ranks - 1))


def fitted_layer(points):
    """The thickness by which growth() is closest to what was found, of (owned, ranks, found). Widths are
    compared, in which the law is linear."""
    slopes = [2 * (1 - ranks ** (-1 / 3)) / width(owned) for owned, ranks, _ in points]
    rises = [found ** (1 / 3) - 1 for _, _, found in points]
    return sum(map(lambda s, r: s * r, slopes, rises)) / sum(s * s for s in slopes)


def part(line):
    return line["owned.mean"], line["ranks"]


class Laws:
    """Of pairs of lines of decomposition: an even cube on several ranks, and the same on one. The last one
    has the messages and collective calls of a run."""

    COUNTED = ("lists", "stars", "sweeps")
    OTHERS = ("boundary", "tree", "fill", "spacing", "population", "conformity")

    def __init__(self, pairs):
        lines = [line for line, _ in pairs]
        self.layers = {phase: fitted_layer([(*part(line), line[f"redundancy.{phase}"]) for line in lines])
                       for phase in self.COUNTED}
        alone = max((alone for _, alone in pairs), key=lambda alone: alone["nodes"])
        self.alone = alone["computed.mean"] / alone["nodes"]  # seconds of a core per node
        # Exchanges of the finest level's ghosts that a run is worth.
        self.exchanges = mean(line["sent.mean"] / (BYTES_PER_GHOST * step_ghosts(line)) for line in lines)
        last = lines[-1]
        self.messages, self.collectives = last["messages.largest"], last["collectives.largest"]
        self.gathered_each = last["gathered.largest"] / last["ranks"]
        # By phase, of a core per node; the clock of the phases waits for other processes of the machine.
        share = self.alone / alone["total.mean"]
        self.phases = {phase: alone[f"{phase}.mean"] * share
                       for phase in ("motion", *self.COUNTED, *self.OTHERS)}
        self.phases["rest"] = self.alone - sum(self.phases.values())

    def by_law(self, phase, line):
        return growth(self.layers[phase], *part(line))

    def worst(self, phase, lines):
        """The largest difference of the law from what was counted, as a share of that."""
        return max(abs(self.by_law(phase, line) / line[f"redundancy.{phase}"] - 1) for line in lines)

    def counted(self, owned, ranks):
        """Seconds for ghosts, by the laws of what is counted. Forces and motion are of owned nodes alone;
        what is not counted is taken to grow like stars, the most."""
        layers = {phase: self.layers["stars"] for phase in self.phases}
        layers.update(motion=0, lists=self.layers["lists"], sweeps=self.layers["sweeps"])
        return owned * sum(seconds * (growth(layers[phase], owned, ranks) - 1)
                           for phase, seconds in self.phases.items())

    def others(self, owned, ranks, cost, latency, bandwidth):
        """Seconds of a run that are not work for nodes."""
        sent = self.exchanges * BYTES_PER_GHOST * ghosts(depth(STEP_HOPS), owned, ranks)
        stages = 2 * math.ceil(math.log2(ranks))
        return {
            "messages": self.messages * latency + sent / bandwidth,
            "collectives": self.collectives * stages * latency
                           + self.gathered_each * ranks / bandwidth,
            "table of cells": cost["table"],
            "cut on the first rank": cost["cut"],
        }


def step_ghosts(line):
    return ghosts(depth(STEP_HOPS), *part(line))


def mean(values):
    values = list(values)
    return sum(values) / len(values)

# SPDX-License-Identifier: BSD-3-Clause
"""Laws of surface and volume for what ranks hold, send and compute in a cube cut into cubes, and
the time of a run on a cluster; docs/scaling.md explains them. Lengths are in spacings d."""
import math

VOLUME_OF_NODE = 0.62  # in d^3: 255 649 nodes in the unit cube at d = 0.0185
BYTES_PER_GHOST = 52  # position, velocity, and the facet of a node on a surface
# The values of the default method: LIST_RADIUS for each hop, and half a leaf on average, because
# whole leaves are sent.
LIST_RADIUS, HALF_LEAF = 1.6, 1.5
STAR_HOPS, STEP_HOPS = 3, 2  # kStarHops, and step_hops with an exchange in every step


def depth(hops):
    return hops * LIST_RADIUS + HALF_LEAF


def width(owned):
    return (VOLUME_OF_NODE * owned) ** (1 / 3)


def growth(layer, owned, ranks):
    """Returns the nodes of a part with a layer of this thickness over those of the part, as the
    mean over the parts. Parts at the outside lack some neighbours."""
    return (1 + 2 * layer * (1 - ranks ** (-1 / 3)) / width(owned)) ** 3


def ghosts(layer, owned, ranks):
    return min(owned * (growth(layer, owned, ranks) - 1), owned * (ranks - 1))


def fitted_layer(points):
    """Returns the thickness for which growth() fits (owned, ranks, found) best. The fit compares
    widths, in which the law is linear."""
    slopes = [2 * (1 - ranks ** (-1 / 3)) / width(owned) for owned, ranks, _ in points]
    rises = [found ** (1 / 3) - 1 for _, _, found in points]
    return sum(map(lambda s, r: s * r, slopes, rises)) / sum(s * s for s in slopes)


def part(line):
    return line["owned.mean"], line["ranks"]


class Laws:
    """The laws fitted to pairs of lines of decomposition: an even cube on several ranks, and the
    same on one. The last one has the messages and collective calls of a run."""

    COUNTED = ("lists", "stars", "sweeps")
    OTHERS = ("boundary", "tree", "fill", "spacing", "population", "conformity")

    def __init__(self, pairs):
        lines = [line for line, _ in pairs]
        self.layers = {phase: fitted_layer([(*part(line), line[f"redundancy.{phase}"]) for line in lines])
                       for phase in self.COUNTED}
        alone = max((alone for _, alone in pairs), key=lambda alone: alone["nodes"])
        self.alone = alone["computed.mean"] / alone["nodes"]  # seconds of a core per node
        # The data sent in a run, in units of exchanges of the finest level's ghosts.
        self.exchanges = mean(line["sent.mean"] / (BYTES_PER_GHOST * step_ghosts(line)) for line in lines)
        last = lines[-1]
        self.messages, self.collectives = last["messages.largest"], last["collectives.largest"]
        self.gathered_each = last["gathered.largest"] / last["ranks"]
        # The seconds of a core per node by phase. The clock of the phases includes waiting for
        # other processes.
        share = self.alone / alone["total.mean"]
        self.phases = {phase: alone[f"{phase}.mean"] * share
                       for phase in ("motion", *self.COUNTED, *self.OTHERS)}
        self.phases["rest"] = self.alone - sum(self.phases.values())

    def by_law(self, phase, line):
        return growth(self.layers[phase], *part(line))

    def worst(self, phase, lines):
        """Returns the largest relative difference between the law and the counted values."""
        return max(abs(self.by_law(phase, line) / line[f"redundancy.{phase}"] - 1) for line in lines)

    def counted(self, owned, ranks):
        """Returns the seconds for ghosts by the laws of what is counted. Forces and motion involve
        owned nodes only. Phases that are not counted are assumed to grow like the counted phase
        that grows most."""
        layers = {phase: max(self.layers.values()) for phase in self.phases}
        layers.update(motion=0, **self.layers)
        return owned * sum(seconds * (growth(layers[phase], owned, ranks) - 1)
                           for phase, seconds in self.phases.items())

    def others(self, owned, ranks, cost, latency, bandwidth):
        """Returns the seconds of a run that are not work for nodes."""
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

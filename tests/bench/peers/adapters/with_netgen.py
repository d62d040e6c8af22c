# SPDX-License-Identifier: BSD-3-Clause
"""Netgen, by its Python package. Simple bodies use its own shapes."""
from adapters import tool
from adapters.place_in_space import write_job
from measure import measure

# The size over d for which about the wanted number of nodes results.
SIZE = 0.84


class Netgen(tool.Tool):
    name = "Netgen"
    needs = "the Python package netgen-mesher"
    setting = f"its defaults, sizes {SIZE} d"

    def available(self):
        return tool.module("netgen")

    def version(self):
        tool.require_import("netgen.csg")
        return tool.version_of_package("netgen-mesher")

    def run(self, case, folder, time_limit):
        write_job(case, folder / "job.npz", size=SIZE)
        case.body.write_stl(folder / "body.stl")
        used = measure(tool.python("place_by_netgen.py", "job.npz", "mesh.npz"), folder, time_limit)
        return tool.VolumeOutcome(*tool.read_npz(folder / "mesh.npz"), used,
                                  tool.told_seconds(used.stdout))


def tools():
    return [Netgen()]

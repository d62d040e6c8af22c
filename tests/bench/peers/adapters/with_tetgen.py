# SPDX-License-Identifier: BSD-3-Clause
"""TetGen, by the Python package meshpy. Where d varies, it gets volumes for all tetrahedra and
refines until nearly none is too large."""
from adapters import tool
from adapters.place_in_space import write_job
from measure import measure

# The largest volume over that of the regular tetrahedron with edge d for which about the wanted
# number of nodes results. Tighter shape bounds than the default of -q add nodes and do not remove
# slivers.
VOLUME_BOUND = 1.7


class TetGen(tool.Tool):
    name = "TetGen"
    needs = "the Python package meshpy"
    setting = f"-pqa, volumes up to {VOLUME_BOUND} sqrt(2)/12 d^3"

    def available(self):
        return tool.module("meshpy")

    def version(self):
        tool.require_import("meshpy.tet")
        return f"meshpy {tool.version_of_package('meshpy')}"

    def run(self, case, folder, time_limit):
        write_job(case, folder / "job.npz", bound=VOLUME_BOUND,
                  holes=case.body.cavities())
        used = measure(tool.python("place_by_tetgen.py", "job.npz", "mesh.npz"), folder, time_limit)
        return tool.VolumeOutcome(*tool.read_npz(folder / "mesh.npz"), used,
                                  tool.told_seconds(used.stdout))


def tools():
    return [TetGen()]

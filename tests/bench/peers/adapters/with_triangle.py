# SPDX-License-Identifier: BSD-3-Clause
"""Triangle, by its two Python packages. The package triangle gets areas for all triangles and
refines until none changes. meshpy calls a Python function for each triangle that Triangle creates.
"""
from adapters import tool
from measure import measure

# The largest area over that of the equilateral triangle with side d for which the mean edge is
# about d.
AREA_BOUND = 1.6
LEAST_ANGLE = 30


class Triangle(tool.Tool):
    def __init__(self, package):
        self.package = package
        self.name = f"Triangle, by {package}"
        self.needs = f"the Python package {package}"
        self.setting = f"angles of {LEAST_ANGLE} degrees, areas up to {AREA_BOUND} sqrt(3)/4 d^2"

    def available(self):
        return tool.module(self.package)

    def version(self):
        tool.require_import(self.package)
        return f"{self.package} {tool.version_of_package(self.package)}"

    def run(self, case, folder, time_limit):
        case.domain.write_poly(folder / "case.poly")
        script = tool.python(f"place_by_{self.package}.py", "case.poly", "nodes.node",
                             *tool.words_of_spacing(case, folder), AREA_BOUND, LEAST_ANGLE)
        used = measure(script, folder, time_limit)
        return tool.Outcome(tool.read_node(folder / "nodes.node"), used.seconds,
                            tool.told_seconds(used.stdout), used.peak_bytes)


def tools():
    return [Triangle("triangle"), Triangle("meshpy")]

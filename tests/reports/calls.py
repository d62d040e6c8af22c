# SPDX-License-Identifier: BSD-3-Clause
"""Calls of the Python package with arrays, functions and options as other programs got them."""

import ctypes
import dataclasses
import math
import os
import pathlib
import tempfile
import unittest
from typing import Any, Callable, Optional, Tuple

import meshio
import numpy as np
import pnpbs
from pnpbs import Domain, PNPBSError, Status

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
ENDS = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])


@dataclasses.dataclass
class Call:
    """A call with a new context. It returns `result`, to 9 digits, or raises `error` with `says` in
    its message."""

    name: str  # and the report, as repository#number
    call: Callable[[pnpbs.Context], Any]
    result: Any = None
    error: Optional[type] = None
    says: str = ""


def area(*arguments, **keywords):
    return lambda context: Domain(context).add_polyline(*arguments, **keywords).measure()


def placement(context, d=0.2, **options):
    square = Domain(context).add_polyline(SQUARE, tags=[1, 1, 2, 1]).add_region((0.5, 0.5), 7)
    return pnpbs.Placement(square.set_tag_name(1, 2, "inlet"), **options).set_spacing(d)


def ran(context, d=0.2, **options):
    made = placement(context, d, **options)
    assert made.run() == Status.OK
    return made


def nodes(d, **options):
    return lambda context: ran(context, d, **options).node_count


def written(name, read):
    """Returns a call that writes a file and reads it. If writing fails, no file may be left."""
    def call(context):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            try:
                ran(context).write(path, elements=True)
            except PNPBSError:
                assert not os.listdir(folder)
                raise
            return read(path)

    return call


def sets(path):
    return {name: sum(map(len, blocks)) for name, blocks in meshio.read(path).cell_sets.items()}


def counts(path):
    return {kind: len(cells) for kind, cells in meshio.read(path).cells_dict.items()}


def groups(path):
    mesh = meshio.read(path)
    return {name: sum(len(found) for found in blocks if found is not None)
            for name, blocks in mesh.cell_sets.items() if not name.startswith("gmsh:")}


def three_columns(context):
    return Domain(context).add_polyline(np.column_stack([SQUARE, np.zeros(4)]))


COMPLEX = SQUARE[:, 0] + 1j * SQUARE[:, 1]
NOT_A_NUMBER = [(0, 0), (1, math.nan), (1, 1)]
COARSE, N = 39, 56  # nodes and triangles of the square with d = 0.2, of 20 edges around it

CALLS = [
    # ------------------------------------------------ arrays
    Call("a list of lists, inducer/meshpy#45", area(SQUARE.tolist()), 1),
    Call("integers, menpo/menpo#732", area(SQUARE.astype(np.int32)), 1),
    Call("single precision, menpo/menpo#732", area(SQUARE.astype(np.float32)), 1),
    Call("Fortran's order, tucanos/tucanos#221", area(np.asfortranarray(SQUARE)), 1),
    Call("columns of a wider array, nschloe/meshio#106",
         area(np.column_stack([SQUARE, SQUARE])[:, :2]), 1),
    Call("parts of complex numbers, multiscale/muscle3#74",
         area(np.column_stack([COMPLEX.real, COMPLEX.imag])), 1),
    Call("a reversed view", area(SQUARE[::-1]), 1),
    Call("points in columns", area(SQUARE[:3].T), error=ValueError, says="(n, 2) was expected"),
    Call("points in one row, d3/d3-delaunay#116", area(SQUARE.ravel()), error=ValueError,
         says="coordinates has shape (8,); (n, 2) was expected"),
    Call("points with z, inducer/meshpy#45", three_columns, error=ValueError,
         says="coordinates has shape (4, 3); (n, 2) was expected"),
    Call("an array of three dimensions, scipy/scipy#20623", area(np.zeros((4, 10, 2))),
         error=ValueError, says="coordinates has shape (4, 10, 2)"),
    Call("not a number, scipy/scipy#5450", area(NOT_A_NUMBER), error=PNPBSError,
         says="coordinates[1][1] is nan"),
    Call("no points", area([]), error=PNPBSError, says="n is 0, expected at least 3"),
    Call("the first point again, benbovy/spherely#42", area([*SQUARE, SQUARE[0]]), error=PNPBSError,
         says="vertex 4 (0, 0): leave it out"),
    Call("corners in Fortran's order, tucanos/tucanos#221",
         lambda context: Domain(context, dim=3).add_surface(TETRAHEDRON, FACES[:, [1, 0, 2]]).measure(),
         1 / 6),
    Call("corners as floats, menpo/menpo#732",
         lambda context: Domain(context, dim=3).add_surface(TETRAHEDRON, FACES.astype(float)),
         error=ValueError, says="corners is of type float64; integers were expected"),
    Call("one triangle, inducer/meshpy#26",
         lambda context: Domain(context, dim=3).add_surface(TETRAHEDRON[:3], [(0, 1, 2)]).check(),
         error=PNPBSError, says="the boundary is not closed"),
    Call("segments that count from 1", lambda context: Domain(context).add_pslg(SQUARE, ENDS + 1),
         error=PNPBSError, says="segment_ends[2][1] is 4, expected a vertex from 0 to 3"),
    Call("unsigned segments",
         lambda context: Domain(context).add_pslg(SQUARE, ENDS.astype(np.uint8)).measure(), 1),
    Call("tags as floats", area(SQUARE, tags=[1.0, 2.0, 3.0, 4.0]), error=ValueError,
         says="tags is of type float64; integers were expected"),
    Call("ids as floats",
         lambda context: placement(context).set_nodes([(0.5, 0.5)], ids=[1.5]), error=ValueError,
         says="ids has shape (1,) and type float64; 1 integers were expected"),

    # ------------------------------------------------ arguments in a wrong place
    Call("a role in the place of closed", area(SQUARE, "inner"), error=ctypes.ArgumentError,
         says="closed is 'inner'; an integer was expected"),
    Call("a radius as a text", lambda context: Domain(context).add_arc((0, 0), "1"),
         error=ctypes.ArgumentError, says="radius is '1'; a real number was expected"),
    Call("degrees", lambda context: Domain(context).add_arc((0, 0), 1, 0, 360), error=PNPBSError,
         says="more than a full turn of 2 pi"),
    Call("the name of a region",
         lambda context: Domain(context).add_polyline(SQUARE).add_region((0.5, 0.5), "steel"),
         error=ctypes.ArgumentError, says="tag is 'steel'; an integer was expected"),

    # ------------------------------------------------ functions
    Call("d of x and y, nschloe/pygmsh#548", nodes(lambda x, y: 0.2), error=TypeError,
         says="missing 1 required positional argument: 'y'"),
    Call("d without return", nodes(lambda x: None), error=TypeError,
         says="the spacing function returned None"),
    Call("d in a column", nodes(lambda x: 0.2 + 0 * x[:, :1]), error=ValueError,
         says="the spacing function returned an array of shape (36, 1); (36,) was expected"),
    Call("d as a list", nodes(lambda x: [0.2] * len(x)), COARSE),
    Call("d in single precision", nodes(lambda x: np.full(len(x), 0.2, np.float32)), COARSE),
    Call("d that is not a number somewhere, qrohlf/trianglify#28",
         nodes(lambda x: np.where(x[:, 0] > 0.5, math.nan, 0.2)), error=PNPBSError,
         says="spacing d = nan at (0.625, 0) is not finite"),
    Call("a norm over all points",
         lambda context: Domain(context, dim=3).add_level_set(
             lambda x: np.linalg.norm(x) - 1, (-2, -2, -2), (2, 2, 2), 0.2), error=ValueError,
         says="the level set function returned an array of shape (); (10648,) was expected"),

    # ------------------------------------------------ numbers and options
    Call("d of NumPy's type", nodes(np.float32(0.2)), COARSE),
    Call("d of 0, qrohlf/trianglify#28", nodes(0), error=PNPBSError, says="argument d = 0"),
    Call("d as a text", nodes("0.2"), error=TypeError, says="d is '0.2': a number"),
    Call("d on a grid, sliced and transposed, tucanos/tucanos#221",
         lambda context: placement(context, 1).set_spacing(
             np.full((4, 6), 0.2).T[::2], origin=(0, 0), step=(1, 1)).run(), Status.OK),
    Call("an unknown option, NGSolve/netgen#224", nodes(0.2, growht_limit=0.2), error=PNPBSError,
         says='the nearest known one is "growth_limit"'),
    Call("steps as a fraction, firedrakeproject/firedrake#794", nodes(0.2, steps=10.5),
         error=PNPBSError, says="expected an integer"),
    Call("steps as a float", nodes(0.2, steps=200.0), COARSE),

    # ------------------------------------------------ other formats
    Call("groups as sets for Abaqus, nschloe/meshio#501", written("a.inp", sets),
         {"tag_1": 15, "inlet": 5, "region_7": N}),
    Call("Medit", written("a.mesh", counts), {"triangle": N, "line": 20}),
    Call("Exodus, nschloe/meshio#1492", written("a.e", counts), {"triangle": N, "line": 20}),
    Call("Gmsh's groups by name, nschloe/meshio#524", written("a.msh", groups),
         {"tag_1": 15, "inlet": 5, "region_7": N}),
    Call("what meshio cannot write, nschloe/meshio#1419", written("a.su2", counts), error=PNPBSError,
         says="a.su2' (TypeError: cannot unpack non-iterable CellBlock object); write a .msh file"),
    Call("a missing folder", lambda context: ran(context).write("/nonexistent/a.inp"),
         error=PNPBSError, says="meshio cannot write '/nonexistent/a.inp'"),
]


class Calls(unittest.TestCase):
    def setUp(self):
        self.context = pnpbs.Context()
        self.addCleanup(self.context.close)

    def run_call(self, call):
        if call.error is None:
            result = call.call(self.context)
            (self.assertAlmostEqual if isinstance(call.result, float) else self.assertEqual)(
                result, call.result)
            return
        with self.assertRaises(call.error) as caught:
            call.call(self.context)
        self.assertIn(call.says, str(caught.exception))


for number, each in enumerate(CALLS):
    def test(self, each=each):
        self.run_call(each)

    test.__doc__ = each.name
    setattr(Calls, f"test_{number:03}", test)
assert len({each.name for each in CALLS}) == len(CALLS)

if __name__ == "__main__":
    unittest.main(verbosity=2)

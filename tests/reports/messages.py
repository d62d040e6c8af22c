# SPDX-License-Identifier: BSD-3-Clause
"""Messages must name what is wrong, where it is, and what helps for this kind of input."""

import json
import math

from cases import Case, run
from command import BAD_INPUT

SQUARE = [[0, 0], [1000, 0], [1000, 1000], [0, 1000]]


def features(*shapes):
    """A layer of features, each a kind of geometry, its coordinates and a name."""
    return json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"name": name},
         "geometry": {"type": kind, "coordinates": coordinates}}
        for kind, coordinates, name in shapes]})


def polygon(name, *rings):
    return "Polygon", [[*ring, ring[0]] for ring in rings], name


def ring(corners, radius, x, y):
    return [[x + radius * math.cos(2 * math.pi * k / corners),
             y + radius * math.sin(2 * math.pi * k / corners)] for k in range(corners)]


def poly(*more_vertices, segments=()):
    """The unit square as a .poly file, with more vertices and segments between vertices."""
    vertices = [(0, 0), (1, 0), (1, 1), (0, 1), *more_vertices]
    sides = [(1, 2), (2, 3), (3, 4), (4, 1), *segments]
    return (f"{len(vertices)} 2 0 0\n"
            + "".join(f"{k + 1} {x!r} {y!r}\n" for k, (x, y) in enumerate(vertices))
            + f"{len(sides)} 0\n" + "".join(f"{k + 1} {a} {b}\n" for k, (a, b) in enumerate(sides))
            + "0\n")


def solids(form):
    """Three tetrahedra that overlap, as the solids of an STL or the groups of an OBJ."""
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    text, first = "", 1
    for name, (x, y, z) in {"housing": (0, 0, 0), "shaft": (0.1, 0.1, 0.1),
                              "bolt": (0.2, 0.1, 0.15)}.items():
        corners = [(x, y, z), (x + 1, y, z), (x, y + 1, z), (x, y, z + 1)]
        if form == "stl":
            text += f"solid {name}\n" + "".join(
                "facet normal 0 0 0\nouter loop\n"
                + "".join("vertex {} {} {}\n".format(*corners[i]) for i in face)
                + "endloop\nendfacet\n" for face in faces) + f"endsolid {name}\n"
        else:
            text += "".join("v {} {} {}\n".format(*corner) for corner in corners) + f"g {name}\n"
            text += "".join(f"f {a + first} {b + first} {c + first}\n" for a, b, c in faces)
            first += 4
    return text


def blocks(**corners):
    """Blocks between two corners as the groups of an OBJ."""
    text = ""
    for k, (name, ends) in enumerate(corners.items()):
        text += "".join("v {} {} {}\n".format(*(ends[(v >> axis) & 1][axis] for axis in range(3)))
                        for v in range(8)) + f"g {name}\n"
        text += "".join("f {} {} {} {}\n".format(*(8 * k + 1 + v for v in side)) for side in (
            (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)))
    return text


GRID = """\
ncols 4
nrows 3
xllcenter 0
yllcenter 0
cellsize 0.5
nodata_value -9999
0.1 0.1 {} 0.1
0.1 0.1 0.1 0.1
0.1 0.1 0.1 0.1
"""
IN_PLANE = "--projection none --spacing 100"
GEO = {"code": BAD_INPUT, "needs_gdal": True}
SOUND = {"quality.min_angle": (25, 60)}
MOVED = ("warning: moved onto curves that they miss by less than 1e-07: ",)

CASES = [
    # ------------------------------------------------ curves that cross
    Case("lines that cross",
         {"a.geojson": features(polygon("block", SQUARE),
                                ("LineString", [[100, 100], [900, 900]], "fault A"),
                                ("LineString", [[100, 900], [900, 100]], "fault B"))},
         "--domain a.geojson " + IN_PLANE, **GEO,
         says=("cross at (500, 500) (feature 1, feature 2)\n", "Let --fragment (pnpbs_domain_set_fragment) split lines"),
         omits=("Unite",)),
    Case("the names of lines that cross",
         {"a.geojson": features(polygon("block", SQUARE),
                                ("LineString", [[100, 100], [900, 900]], "fault A"),
                                ("LineString", [[100, 900], [900, 100]], "fault B"))},
         "--domain a.geojson --tag-field name " + IN_PLANE, **GEO,
         says=("(feature 1 'fault A', feature 2 'fault B')\n",)),
    Case("a line that crosses the outline of a polygon",
         {"a.geojson": features(polygon("block", SQUARE),
                                ("LineString", [[500, 500], [1500, 500]], "fault"))},
         "--domain a.geojson " + IN_PLANE, **GEO, says=("Let --fragment (pnpbs_domain_set_fragment) split lines",),
         omits=("Unite",)),
    Case("neighbouring polygons whose common edge differs",
         {"a.geojson": features(
             polygon("field", [[0, 0], [500, 0], [510, 400], [490, 600], [500, 1000], [0, 1000]]),
             polygon("wood", [[500, 0], [1000, 0], [1000, 1000], [500, 1000], [510, 600],
                              [490, 400]]))},
         "--domain a.geojson " + IN_PLANE, **GEO, says=("Give neighbouring polygons the same vertices",),
         omits=("Unite", "lines")),
    Case("polygons that cross",
         {"a.geojson": features(polygon("land", SQUARE),
                                polygon("land", [[x + 500, y + 300] for x, y in SQUARE]))},
         "--domain a.geojson " + IN_PLANE, **GEO, says=("Unite crossing polygons",)),

    # ------------------------------------------------ missing values
    Case("a value of a grid that is no number", {"a.poly": poly(), "d.asc": GRID.format("nan")},
         "--domain a.poly --spacing-grid d.asc", code=BAD_INPUT,
         says=("d.asc: the value in row 1, column 3, at (1, 1) is nan: ",), omits=("argument",)),
    Case("the same in a formula", {"a.poly": poly(), "d.asc": GRID.format("nan")},
         "--domain a.poly --spacing 'min(grid, 1)' --spacing-grid d.asc", code=BAD_INPUT,
         says=("d.asc: the value in row 1, column 3, at (1, 1) is nan: ",)),
    Case("a value of a grid that is no spacing", {"a.poly": poly(), "d.asc": GRID.format("0")},
         "--domain a.poly --spacing-grid d.asc", code=BAD_INPUT,
         says=("d.asc: the value in row 1, column 3, at (1, 1) is 0: ",), omits=("argument",)),
    Case("such a value in a layer",
         {"d.asc": "ncols 1\nnrows 2\nnlayers 2\nxllcenter 0\nyllcenter 0\nzllcenter 0\ncellsize 1\n"
                   "0.5 0.5 0.5 -1\n"},
         "--domain 'box(0,0,0, 1,1,1)' --spacing-grid d.asc", code=BAD_INPUT,
         says=("row 2, column 1, layer 2, at (0, 0, 1) is -1: ",)),

    # ------------------------------------------------ names of curves and locations
    Case("a hole beside a finely sampled outline",
         {"a.geojson": features(polygon("basin", ring(1231, 1000, 0, 0), ring(24, 60, 930, 0)))},
         "--domain a.geojson --corner-angle 45 --tag-field name --projection none --spacing 200",
         needs_gdal=True,
         says=("beside curve 0, segments 1191 to 1230 of 'basin' (", ", at (987.9",
               "curve 1, segments 15 to 23 of 'basin'"), omits=("segments 0 to",)),

    # ------------------------------------------------ points that miss a curve by a little
    Case("a fixed node beside a corner", {"a.poly": poly((2e-12, 0))},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND,
         says=("vertex 5 (2e-12, 0) to vertex 1",), omits=("finer",)),
    Case("a fixed node inside beside a corner", {"a.poly": poly((1e-9, 1e-9))},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND, says=MOVED),
    Case("a fixed node beside a side", {"a.poly": poly((0.5, 3e-8))},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND, says=MOVED),
    Case("a boundary finer than the spacing", {"a.poly": poly((0.5, 0), (0.5 + 2e-7, 0))},
         "--domain a.poly --spacing 1000", code=BAD_INPUT,
         says=("the boundary is far finer than the spacing", "such as segment 1 at (0.5, 0)")),

    # ------------------------------------------------ triangles that cross
    *[Case(f"solids that overlap, {form}", {f"a.{form}": solids(form)},
           f"--domain a.{form} --spacing 0.3", code=BAD_INPUT,
           says=(" of surface 0 'housing' and triangle ", " of surface 0 'shaft' cross at (",
                 "\ntriangle ", "\nand 7 more such pairs"), omits=("; triangle",))
      for form in ("stl", "obj")],
    Case("inner surfaces that cross the boundary", {"a.obj": solids("obj")},
         "--domain a.obj --spacing 0.3 --inner shaft --inner bolt", code=BAD_INPUT,
         says=(" of surface 0 'housing' and triangle ", "\nInner surfaces may meet other triangles only "
               "in common edges and vertices: pnpbs_domain_set_fragment (in the command --fragment) divides"),
         omits=("--repair",)),
    Case("the same with the advice", {"a.obj": solids("obj")},
         "--domain a.obj --spacing 0.3 --inner shaft --inner bolt --fragment", omits=("cross",)),
    Case("surfaces alone that cross", {"a.obj": solids("obj")},
         "--domain a.obj --spacing 0.3 --surfaces-only", code=BAD_INPUT,
         says=("\nSurfaces alone may meet only in common edges and vertices: divide the triangles",),
         omits=("--repair", "--fragment", "Inner")),

    # ------------------------------------------------ regions
    *[Case(f"a block as large as {times} d in a box",
           {"a.obj": blocks(box=((0, 0, 0), (1, 1, 1)), block=((0.1, 0.2, 0.2), (0.4, 0.8, 0.8)))},
           f"--domain a.obj --inner block --region 0.2,0.5,0.5:7 --spacing {0.3 / times}", **outcome)
      for times, outcome in ((1, {"says": ("d is reduced around them",), "omits": ("inner surfaces",)}),
                             (3, {"omits": ("inner surfaces", "d is reduced")}))],

    # ------------------------------------------------ counts
    Case("vertices that are left out",
         {"a.geojson": features(polygon("lake", ring(200, 1000, 0, 0)))},
         "--domain a.geojson --simplify 0.25,2 --corner-angle 45 " + IN_PLANE, needs_gdal=True,
         says=("vertices were left out\n",), omits=("closed curves",)),
]

# A fracture that ends just short of a side, or just beyond it.
for gap in (1e-9, 5e-8, -1e-9):
    CASES.append(Case(f"a fracture that ends {gap} before a side",
                      {"a.poly": poly((0.3, 0.4), (1 - gap, 0.5), segments=[(5, 6)])},
                      "--domain a.poly --spacing 0.1 --check", figures=SOUND,
                      says=(*MOVED, "to segment 2"), omits=("larger than features",)))
CASES += [
    Case("a fracture that ends a millionth before a side",
         {"a.poly": poly((0.3, 0.4), (1 - 1e-6, 0.5), segments=[(5, 6)])},
         "--domain a.poly --spacing 0.1", says=("larger than features", "at (0.999999, 0.5)")),
    Case("a fracture that ends before another one",
         {"a.poly": poly((0.3, 0.2), (0.3, 0.8), (0.3 + 1e-8, 0.5), (0.7, 0.5),
                         segments=[(5, 6), (7, 8)])},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND, says=(*MOVED, "to segment 5")),
    Case("fractures that end beside each other and a side",
         {"a.poly": poly((0.3, 0.2), (1 - 1e-8, 0.5), (0.3, 0.8), (1 - 2e-8, 0.5 + 3e-8),
                         segments=[(5, 6), (7, 8)])},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND, says=MOVED),
    Case("a fracture that ends beside a corner",
         {"a.poly": poly((0.3, 0.4), (1 - 1e-8, 1 - 1e-8), segments=[(5, 6)])},
         "--domain a.poly --spacing 0.1 --check", figures=SOUND, says=(*MOVED, "to vertex 3")),
    Case("lines that end before the outline of a polygon",
         {"a.geojson": features(polygon("block", SQUARE),
                                ("LineString", [[1e-5, 300], [500, 400], [1000 - 2e-5, 700]], "fault"))},
         "--domain a.geojson --check " + IN_PLANE, needs_gdal=True, figures=SOUND,
         says=("warning: moved onto curves that they miss by less than 0.0001: ",)),
]

# The distance can be set, or nothing be moved.
WIDE_GAP = {"a.poly": poly((0.3, 0.4), (1 - 1e-3, 0.5), segments=[(5, 6)])}
CASES += [
    Case("a wide gap that is closed", WIDE_GAP, "--domain a.poly --spacing 0.1 --check --snap 0.002",
         figures=SOUND, says=("that they miss by less than 0.002: vertex 6",)),
    Case("a wide gap that stays", WIDE_GAP, "--domain a.poly --spacing 0.1 --check --snap 1e-4",
         says=("larger than features",), omits=("moved",)),
    Case("nothing is moved", {"a.poly": poly((0.3, 0.4), (1 - 1e-9, 0.5), segments=[(5, 6)])},
         "--domain a.poly --spacing 0.1 --snap 0", says=("larger than features",), omits=("moved",)),
    Case("a length that is none", WIDE_GAP, "--domain a.poly --spacing 0.1 --snap -1", code=BAD_INPUT,
         says=("--snap: expected a length or 0, found '-1'",)),
    Case("bodies have no such length", {}, "--domain 'box(0,0,0, 1,1,1)' --spacing 0.5 --snap 1e-3",
         code=BAD_INPUT, says=("--snap is for domains in the plane",)),
]

if __name__ == "__main__":
    run(CASES)

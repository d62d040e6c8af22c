# SPDX-License-Identifier: BSD-3-Clause
"""Domains in the plane as users of other programs gave them. A report is named by its repository
and number on GitHub. Areas are those of the polygons, by hand."""

import json

from cases import Case, run
from command import BAD_INPUT, LEFT_OUT

UNIT = [(0, 0), (1, 0), (1, 1), (0, 1)]
TEN = [(10 * x, 10 * y) for x, y in UNIT]


def loop(*vertices):
    return list(zip(vertices, [*vertices[1:], vertices[0]]))


def poly(vertices, segments, holes=()):
    rows = [*vertices], [*segments], [*holes]
    text = [f"{len(table)} {end}\n" + "".join(f"{k + 1} {a!r} {b!r}\n" for k, (a, b) in
                                              enumerate(table))
            for table, end in zip(rows, ("2 0 0", "0", ""))]
    return {"a.poly": "".join(text)}


def area(expected, tolerance=1e-9, **figures):
    return {"volumes.total": (expected * (1 - tolerance), expected * (1 + tolerance)),
            "quality.min_angle": (25, 60), **figures}


def features(*geometries):
    return {"a.geojson": json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": geometry} for geometry in geometries]})}


def closed(ring):
    return [*ring, ring[0]]


def polygon(*rings):
    return {"type": "Polygon", "coordinates": list(rings)}


FIELD = [(1000 * x, 1000 * y) for x, y in UNIT]
POND = [(400 + 200 * x, 400 + 200 * y) for x, y in UNIT]
POLY = "--domain a.poly --check --volumes --spacing "
PLANE = "--domain a.geojson --projection none --check --volumes --spacing 100"
DEGREES = "--domain a.geojson --unit km --check --volumes --spacing 20"
WHOLE, WITH_POND = area(1e6), area(0.96e6)
REFUSED = {"code": BAD_INPUT}

# Coordinates that were rounded, as those of a rotated profile.
ROUNDED = [(19.218989151578803, 1.7763568394002505e-15), (19.218989151578803, 6.0000000000000018),
           (4.7961634663806763e-14, 6.0000000000000018),
           (4.7961634663806763e-14, 1.7763568394002505e-15),
           (8.8594945757893644, 2.2204460492503131e-15), (8.8594945757893644, 2.0000000000000018),
           (10.359494575789364, 2.0000000000000018), (10.359494575789364, 2.2204460492503131e-15)]

CASES = [
    # ------------------------------------------------ vertices that come twice
    Case("a vertex twice in a loop, drufat/triangle#4",
         poly([(5, -5), (5, 0), (0, 0), (0, -2), (0, -2)], loop(1, 2, 3, 4, 5)), POLY + "0.5",
         **REFUSED, says=("vertex 4 and vertex 5 are both at (0, -2); let all segments use one",)),
    Case("two polygons that share a vertex, given twice, wo80/Triangle#10",
         poly([*TEN, *[(10 + 0.5 * x, 10 + 0.5 * y) for x, y in TEN]],
              loop(1, 2, 3, 4) + loop(5, 6, 7, 8)), POLY + "1", **REFUSED,
         says=("vertex 3 and vertex 5 are both at (10, 10); let all segments use one",)),
    Case("two polygons that share a vertex, wo80/Triangle#10",
         poly([*TEN, (15, 10), (15, 15), (10, 15)], loop(1, 2, 3, 4) + loop(3, 5, 6, 7)), POLY + "1",
         figures=area(125)),
    Case("holes that share a vertex, greenm01/poly2tri#90",
         poly([*TEN, (2, 1), (3, 3), (1, 2), (6, 4), (4, 7)],
              loop(1, 2, 3, 4) + loop(5, 6, 7) + loop(6, 8, 9), [(2, 2), (4.3, 4.6)]), POLY + "0.5",
         figures=area(100 - 1.5 - 5.5)),
    Case("a hole that touches a side, mapbox/earcut#39",
         poly([*TEN, (5, 0), (7, 4), (3, 4)],
              [(1, 5), (5, 2), (2, 3), (3, 4), (4, 1), *loop(5, 6, 7)], [(5, 2)]), POLY + "0.5",
         figures=area(92)),
    Case("the first vertex again, artem-ogre/CDT#2",
         poly([*UNIT, (0, 0)], [(1, 2), (2, 3), (3, 4), (4, 5)]), POLY + "0.1", **REFUSED,
         says=("vertex 1 and vertex 5 are both at (0, 0)",)),

    # ------------------------------------------------ segments
    Case("a segment in both directions", poly(UNIT, loop(1, 2, 3, 4) + [(2, 1)]), POLY + "0.1",
         **REFUSED, says=("segment 1 and segment 5 overlap at (1, 0)",)),
    Case("segments that overlap, artem-ogre/CDT#77",
         poly([*UNIT, (0.2, 0.5), (0.8, 0.5), (0.4, 0.5), (0.9, 0.5)],
              loop(1, 2, 3, 4) + [(5, 6), (7, 8)]), POLY + "0.1", **REFUSED,
         says=("segment 5 and segment 6 overlap at (0.4, 0.5)",)),
    Case("corners in the order of a loop over x and y, nschloe/pygmsh#106",
         poly([(-1, -1), (-1, 1), (1, -1), (1, 1)], loop(1, 2, 3, 4)), POLY + "0.1", **REFUSED,
         says=("segment 2 and segment 4 cross at (0, 0)",)),
    Case("a loop that is open, gdsfactory/gplugins#361", poly(UNIT, [(1, 2), (2, 3), (3, 4)]),
         POLY + "0.1", **REFUSED, says=("the segments enclose nothing: they end at vertex 1 (0, 0)",)),
    Case("a loop without area, pmgbergen/porepy#34", poly([(0, 0), (1, 0), (2, 0)], loop(1, 2, 3)),
         POLY + "0.1", **REFUSED, says=("segment 1 and segment 3 overlap",)),
    Case("a hole point outside, drufat/triangle#2", poly(UNIT, loop(1, 2, 3, 4), [(2, 2)]),
         POLY + "0.1", **REFUSED, says=("hole 1 at (2, 2) lies outside the domain",)),

    # ------------------------------------------------ coordinates
    Case("rounded coordinates, greenm01/poly2tri#27", poly(ROUNDED, loop(*range(1, 9))),
         POLY + "0.5", figures=area(19.218989151578803 * 6 - 1.5 * 2)),
    Case("eastings and northings, Deltares/pandamesh#19",
         poly([(441871.603292 + x, 6329700.71863 + y) for x, y in UNIT], loop(1, 2, 3, 4)),
         POLY + "0.1", figures=area(1, nodes=(130, 145))),
    Case("nanometres in metres, idaholab/moose#5249",
         poly([(25e-9 * x, 25e-9 * y) for x, y in UNIT], loop(1, 2, 3, 4)), POLY + "2.5e-9",
         figures=area(625e-18, nodes=(130, 145))),
    Case("d larger than the domain, mkofler96/KoFEM#425", poly(UNIT, loop(1, 2, 3, 4)), POLY + "10",
         figures=area(1, nodes=4), says=("the spacing is larger than features of the boundary",)),
    Case("a decimal comma", {"a.poly": poly(UNIT, loop(1, 2, 3, 4))["a.poly"].replace("2 1 0", "2 1,0 0")},
         POLY + "0.1", **REFUSED, says=("a.poly:3: found '1,0', expected x",)),
    Case("Fortran's exponent", {"a.poly": poly(UNIT, loop(1, 2, 3, 4))["a.poly"].replace("2 1 0", "2 1D0 0")},
         POLY + "0.1", **REFUSED, says=("a.poly:3: found '1D0', expected x",)),
    Case("not a number, paralab/Finch#16",
         {"a.poly": poly(UNIT, loop(1, 2, 3, 4))["a.poly"].replace("2 1 0", "2 NaN 0")}, POLY + "0.1",
         **REFUSED, says=("a.poly:3: found 'NaN', expected x",)),
    Case("no hole section", {"a.poly": poly(UNIT, loop(1, 2, 3, 4))["a.poly"][:-3]}, POLY + "0.1",
         **REFUSED, says=("a.poly:10: the file ends, expected the number of holes",)),
]

# GeoJSON.
GEO = [
    Case("holes clockwise or not, mapbox/geojson.io#782", features(polygon(closed(FIELD), closed(POND))),
         PLANE, figures=WITH_POND),
    Case("all the other way around, mapbox/geojson.io#782",
         features(polygon(closed(FIELD[::-1]), closed(POND[::-1]))), PLANE, figures=WITH_POND),
    Case("several polygons in one, koopjs/koop#378",
         features({"type": "MultiPolygon", "coordinates": [
             [closed(FIELD), closed(POND)], [closed([(x + 2000, y) for x, y in FIELD])]]}), PLANE,
         figures=area(1.96e6)),
    Case("a spike, gkjohnson/three-geojson#31",
         features(polygon(closed([*FIELD, (0, 500), (-300, 500), (0, 500)]))), PLANE, figures=WHOLE,
         says=("note: 2 segments were left out",)),
    Case("a ring of two vertices, thinkingmachines/geowrangler#88",
         features(polygon(closed(FIELD)), polygon([(200, 200), (300, 300), (200, 200)])), PLANE,
         figures=WHOLE, says=("note: 2 segments were left out",)),
    Case("repeated vertices, horizon-eda/horizon#391",
         features(polygon(closed([FIELD[0], *FIELD, FIELD[3], FIELD[3]]))), PLANE, figures=WHOLE),
    Case("an open ring", features(polygon(FIELD)), PLANE, figures=WHOLE),
    Case("a feature without geometry, openlayers/openlayers#1703",
         features(polygon(closed(FIELD)), None), PLANE, figures=WHOLE,
         says=("note: 1 of 2 features have no geometry and were left out",)),
    Case("features without geometry alone, mapbox/geojson-cpp#38", features(None), PLANE, **REFUSED,
         says=("none of its 1 features has a geometry",)),
    Case("a point without coordinates, SymbolixAU/geojsonsf#91",
         features(polygon(closed(FIELD)), {"type": "Point", "coordinates": []}), PLANE, figures=WHOLE),
    Case("a collection with nulls, mapbox/geojson.io#561",
         {"a.geojson": json.dumps({"type": "GeometryCollection", "geometries": [
             {"type": "Point", "coordinates": [500, 500]}, None, polygon(closed(FIELD)), None]})},
         PLANE, figures=WHOLE),
    Case("heights, duckdb/duckdb#9912", features(polygon([(*x, 12.5) for x in closed(FIELD)])), PLANE,
         figures=WHOLE, says=("note: heights in the file are left out",)),
    Case("a polygon twice", features(polygon(closed(FIELD)), polygon(closed(FIELD))), PLANE, **REFUSED,
         says=("features 0 and 1 overlap",)),
    Case("a fracture within another one, pmgbergen/porepy#1694",
         features(polygon(closed(FIELD)), {"type": "LineString", "coordinates": [(100, 100), (900, 900)]},
                  {"type": "LineString", "coordinates": [(500, 500), (150, 150)]}), PLANE,
         figures=WHOLE, says=("note: 1 segments were left out that repeat others",)),
    Case("a fracture that ends on another one, pmgbergen/porepy#54",
         features(polygon(closed(FIELD)), {"type": "LineString", "coordinates": [(200, 500), (800, 500)]},
                  {"type": "LineString", "coordinates": [(500, 500), (500, 800)]}), PLANE,
         figures=WHOLE, omits=("warning",)),
    Case("a fracture outside, pmgbergen/porepy#1478",
         features(polygon(closed(FIELD)), {"type": "LineString", "coordinates": [(2000, 0), (2500, 9)]}),
         PLANE, code=LEFT_OUT, figures=WHOLE, says=("outside the domain and left out: curve 1",)),
    Case("a byte order mark", {"a.geojson": "\ufeff" + features(polygon(closed(FIELD)))["a.geojson"]},
         PLANE, figures=WHOLE),
    Case("latitude before longitude",
         features(polygon(closed([(54, 118), (55, 118), (55, 119), (54, 119)]))), DEGREES, **REFUSED,
         says=("none of the coordinates is a longitude and latitude",)),
    # A degree of latitude is 110.7 km at 17.5 S, and one of longitude 106.2 km.
    *[Case(f"across 180 degrees, {how}, noaa-ocs-modeling/OCSMesh#81",
           features(polygon(closed([(179, -18), (east, -18), (east, -17), (179, -17)]))), DEGREES,
           figures=area(2 * 106.2 * 110.7, 0.002))
      for how, east in (("from 179 to -179", -179), ("from 179 to 181", 181))],
]
for case in GEO:
    case.needs_gdal = True

if __name__ == "__main__":
    run(CASES + GEO)

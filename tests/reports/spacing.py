# SPDX-License-Identifier: BSD-3-Clause
"""Spacings and options as users of other programs gave them: formulas, grids, tables, numbers. A
report is named by its repository and number on GitHub."""

from cases import Case, run
from command import BAD_INPUT

SQUARE = {"a.poly": "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"}
FINE = {"nodes": (125, 145)}  # d = 0.1: 115 inside, and half of the 40 on the boundary
REFUSED = {"code": BAD_INPUT}


def formula(text, name, **outcome):
    return Case(f"{name}: {text}", SQUARE, f'--domain a.poly --check --spacing "{text}"', **outcome)


FORMULAS = [
    formula("1/10", "integers", figures=FINE),
    formula("1e-1", "an exponent", figures=FINE),
    formula(".1", "no digit before the point", figures=FINE),
    formula("0", "zero, qrohlf/trianglify#28", **REFUSED, says=("argument d = 0: the spacing must be",)),
    formula("nan", "not a number, qrohlf/trianglify#28", **REFUSED, says=("unknown name 'nan'",)),
    formula("0.1*x/0", "a division by zero", **REFUSED, says=("is not finite; d must be a finite",)),
    formula("0,1", "a decimal comma", **REFUSED, says=("decimals come after a point", "\n   ^")),
    formula("0.1*x**2", "a power of Python's", **REFUSED,
            says=("unexpected operator '*'; powers are written x^y",)),
    formula("0.1 + X", "a capital", **REFUSED, says=("unknown name 'X'; did you mean x?",)),
    formula("0.1e", "an exponent without digits", **REFUSED, says=("'0.1e' is no number",)),
    *[Case(f"a formula in quotes twice: {text}", SQUARE, f"--domain a.poly --spacing {text}", **REFUSED,
           says=("quotes are for names of groups, as in dist('open sea')",))
      for text in (""" "'0.1 + 0.1*x'" """, """ '"0.1 + 0.1*x"' """)],
    formula("0.1 m", "a unit", **REFUSED, says=("unknown name 'm'",)),
    formula("1e-5", "too fine", **REFUSED, says=("the option max_nodes allows 100000000",)),
]

ASC = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n0.1 0.1\n0.1 0.1\n"


def grid(name, text, **outcome):
    return Case(f"a grid, {name}", {**SQUARE, "d.asc": text},
                "--domain a.poly --check --spacing-grid d.asc", **(outcome or {"figures": FINE}))


GAP = {"figures": FINE, "says": ("of 1", " 1 lie where it has no data, one of them at (1, 1)")}
NO_DATA = ASC.replace("cellsize 1", "cellsize 1\nNODATA_value {0}").replace("0.1 0.1\n0.1 0.1", "0.1 {0}\n0.1 0.1")
GRIDS = [
    grid("with dx and dy, gama-platform/gama.old#3754", ASC.replace("cellsize 1", "dx 1\ndy 1")),
    grid("a header in capitals", ASC.replace("ncols", "NCOLS").replace("cellsize", "CELLSIZE")),
    grid("another order of the header, OpenNHM/AvaFrame#425",
         "nrows 2\nncols 2\ncellsize 1\nyllcenter 0\nxllcenter 0\n0.1 0.1\n0.1 0.1\n"),
    grid("exponents, NetLogo/GIS-Extension#20", ASC.replace("0.1", "1.0E-01")),
    grid("a blank before each row, OSGeo/gdal#8344", ASC.replace("\n0.1", "\n 0.1")),
    grid("a value in each line", ASC.replace(" 0.1", "\n0.1")),
    grid("a byte order mark", "\ufeff" + ASC),
    grid("no data as nan, OpenNHM/AvaFrame#1291", NO_DATA.format("nan"), **GAP),
    grid("no data as a real number, smwesten-usgs/swb#3",
         NO_DATA.format("-9999").replace("value -9999", "value -9999.0"), **GAP),
    grid("no data as the least single number", NO_DATA.format("-3.40282346638529e+38"), **GAP),
    grid("no data as null, OSGeo/gdal#5095", NO_DATA.format("null"), **REFUSED,
         says=("d.asc:6: expected a number, found 'null'",)),
    grid("nan beside another value for no data, OSGeo/gdal#3195",
         NO_DATA.format("nan").replace("value nan", "value -9999"), **REFUSED,
         says=("the value in row 1, column 2, at (1, 1) is nan",)),
    grid("decimal commas", ASC.replace("0.1", "0,1"), **REFUSED,
         says=("d.asc:6: expected a spacing, found '0,1'",)),
    grid("a value too few, OSGeo/gdal#5095", ASC[:-4], **REFUSED,
         says=("d.asc:7: expected 4 values, found only 3",)),
    grid("elsewhere, CHLNDDEV/OceanMesh2D#155", ASC.replace("xllcenter 0", "xllcenter 100"), **REFUSED,
         says=("from (99.5, -0.5) to (101.5, 1.5)",)),
]

CSV = "x,y,spacing\n0,0,0.1\n1,0,0.1\n0,1,0.1\n1,1,0.1\n"


def table(name, text, **outcome):
    return Case(f"a table, {name}", {**SQUARE, "d.csv": text},
                "--domain a.poly --check --spacing d.csv", **(outcome or {"figures": FINE}))


TABLES = [
    table("a byte order mark", "\ufeff" + CSV),
    table("blanks after commas", CSV.replace(",", ", ")),
    table("semicolons, Dokuly-PLM/dokuly#149", CSV.replace(",", ";")),
    table("tabs, votca/csg#695", CSV.replace(",", "\t")),
    table("names in quotes", CSV.replace("x,y,spacing", '"x","y","spacing"')),
    table("names in capitals", CSV.replace("x,y", "X,Y")),
    table("a comma at the end", CSV.replace("\n", ",\n")),
    table("a point twice, tudelft3d/3dfier#12", CSV + "1,1,0.1\n"),
    table("a point with two values", CSV + "1,1,0.2\n", **REFUSED, says=("are both at (1, 1)",)),
    table("semicolons and decimal commas", CSV.replace(",", ";").replace(".", ","), **REFUSED,
          says=("d.csv:2: found '0,1', expected spacing, a number",)),
    table("no header, rajgandhi1/threecrate#18", CSV.split("\n", 1)[1], **REFUSED,
          says=("d.csv:1: found '0', expected a header with columns x and y",)),
    table("an empty cell", CSV.replace("0,1,0.1", "0,1,"), **REFUSED,
          says=("d.csv:4: found '', expected spacing, a number",)),
]

# A sea of 1 km, 10 m deep in the west and 50 m in the east.
SEA = SQUARE["a.poly"].replace(" 1 1\n", " 1000 1000\n").replace("2 1 0\n", "2 1000 0\n").replace(
    "4 0 1\n", "4 0 1000\n")
BOTTOM = "ncols 2\nnrows 1\nxllcenter 0\nyllcenter 500\ncellsize 1000\n{} {}\n"
RULE = "--domain a.poly --unit m --max-spacing 200 --check --depth-rule d.asc,wave=20000"


def depths(name, west, east, words, **outcome):
    return Case(f"depths, {name}", {"a.poly": SEA, "d.asc": BOTTOM.format(west, east)}, RULE + words,
                **outcome)


# d = sqrt(9.81 h) 44712 / 20000: 22 m at h = 10 m, so that 2 400 nodes would be everywhere.
BY_DEPTH = {"figures": {"nodes": (500, 1100)}, "omits": ("no water",)}
DRY = {"figures": {"nodes": (2300, 2600)}}
DEPTHS = [
    depths("positive down, CHLNDDEV/oceanmesh#30", 10, 50, "", **BY_DEPTH),
    depths("positive up, CHLNDDEV/oceanmesh#30", -10, -50, ",up", **BY_DEPTH),
    depths("elevations without a word, OpenDrift/opendrift#637", -10, -50, "", **DRY,
           says=("has no water at any of 2", "Then add the word 'up'")),
    depths("depths taken for elevations, Parcels-code/Parcels#1105", 10, 50, ",up", **DRY,
           says=("has no water at any of 2", "Then leave out the word 'up'")),
    Case("a root of elevations", {"a.poly": SEA, "d.asc": BOTTOM.format(-10, -50)},
         "--domain a.poly --spacing-grid depth=d.asc --spacing '10*sqrt(depth)'", **REFUSED,
         says=("is not finite; d must be a finite number greater than 0",)),
]


NAMED = '--domain a.poly --name "1=open sea" --check --spacing "0.1 + 0*dist({})"'
DEPTHS += [
    Case("the name of a group in quotes", SQUARE, NAMED.format("'open sea'"), figures=FINE),
    Case("the name of a group without quotes", SQUARE, NAMED.format("open sea"), **REFUSED,
         says=("unknown name 'open': a name of a group with blanks or signs is in quotes",)),
    # Locations in metres are whole numbers.
    Case("eastings and northings in a warning, autowarefoundation/autoware_universe#3090",
         {"a.poly": SQUARE["a.poly"].replace("1 0 0", "1 441000 6329000").replace(
             "2 1 0", "2 442000 6329000").replace("3 1 1", "3 442000 6330000").replace(
                 "4 0 1", "4 441000 6330000")},
         "--domain a.poly --spacing 'x > 441500 ? 20 : 100'", says=(" near (4415", ", 63"),
         omits=("e+0",)),
]


def options(text, **outcome):
    return Case(f"options: {text}", SQUARE, "--domain a.poly --spacing 0.1 " + text, **outcome)


OPTIONS = [
    options("--steps 1e-5", **REFUSED, says=('option steps = "1e-5": expected an integer',)),
    options("--set growht_limit=0.2", **REFUSED, says=('the nearest known one is "growth_limit"',)),
    options("--growth-limit nan", **REFUSED, says=("expected a number in 0 ..",)),
    options("--nodes 1e3 --check", figures={"nodes": (985, 1015)}),
    options("--order 2 --output a.csv", **REFUSED, says=("--order: there is no file with elements",)),
    options("--order 2 --output a.msh --output a.csv", figures=FINE),
    options("--output a.xyz", **REFUSED, says=("'a.xyz' has no recognised extension",)),
    options("--output /nonexistent/a.vtu", **REFUSED, says=("No such file or directory",)),
    options("--region 5,5:7", **REFUSED, says=("region 0 at (5, 5) lies outside the domain",)),
    options("--simplify 0.25,2 --check", figures=FINE, omits=("simplified",)),
]

if __name__ == "__main__":
    run(FORMULAS + GRIDS + TABLES + DEPTHS + OPTIONS)

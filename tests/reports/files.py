# SPDX-License-Identifier: BSD-3-Clause
"""Input files in forms that other programs write."""

import struct

from cases import Case, run

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
NUMBERED = "".join(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(VERTICES))
XYZ = "".join(f"{x} {y} {z}\n" for x, y, z in VERTICES)
CORNERS = "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
PLY_VERTICES = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
PLY_FACES = "element face 4\nproperty list uchar int vertex_indices\n"


def ply_header(encoding, *elements):
    return f"ply\nformat {encoding} 1.0\n" + "".join(elements) + "end_header\n"


def stl_facet(corners):
    lines = "".join("vertex {} {} {}\n".format(*VERTICES[i]) for i in corners)
    return f"facet normal 0 0 0\nouter loop\n{lines}endloop\nendfacet\n"


BINARY_STL = b"".join([
    b"binary".ljust(80), struct.pack("<I", 4),
    *(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in VERTICES[i]), 0) for face in FACES)])
BINARY_VERTICES = b"".join(struct.pack("<3f", *vertex) for vertex in VERTICES)
BINARY_FACES = b"".join(struct.pack("<B3i", 3, *face) for face in FACES)

SQUARE_SEGMENTS = "4 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n0\n"
SQUARE_VERTICES = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n"

TETRAHEDRA = {
    "tet.off": "OFF\n4 4 0\n" + XYZ + CORNERS,
    "tet.obj": "# a comment\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in VERTICES)
               + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES),
    "tet.ply": ply_header("ascii", PLY_VERTICES, PLY_FACES) + XYZ + CORNERS,
    "tet.stl": "solid a\n" + "".join(map(stl_facet, FACES)) + "endsolid a\n",
    "tet.smesh": "# a comment\n4 3 0 0\n" + NUMBERED + "4 0\n" + CORNERS + "0\n0\n",
    "tet.poly": "# a comment\n4 3 0 0\n" + NUMBERED + "4 0\n"
                + "".join(f"1\n3 {a} {b} {c}\n" for a, b, c in FACES) + "0\n0\n",
}
SQUARES = {
    "square.poly": "# a comment\n" + SQUARE_VERTICES + SQUARE_SEGMENTS,
    "square.msh": """\
$MeshFormat
2.2 0 8
$EndMeshFormat
$Comments
a comment
$EndComments
$PhysicalNames
1
1 1 "wall"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
4
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 1 1 3 4
4 1 2 1 1 4 1
$EndElements
""",
}
SPACINGS = {
    "d.csv": "# a comment\nx,y,spacing\n0,0,0.1\n1,0,0.1\n0,1,0.1\n1,1,0.1\n",
    "d.asc": "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n0.1 0.1\n0.1 0.1\n",
}
PIT = "x,y\n0.37,0.61\n"  # where d is small in a disc of radius 0.002

COARSE, FINE = {"nodes": (32, 42)}, {"nodes": (110, 140)}  # of the square
VOLUME = {"volume.elements": (1 / 6 - 1e-12, 1 / 6 + 1e-12)}


def line_ends(text, end):
    return text.replace("\n", end).encode()


CASES = []
# Lines that end as on old Macs or on Windows.
for kind, end in (("LF", "\n"), ("CR LF", "\r\n"), ("CR", "\r")):
    for name, text in TETRAHEDRA.items():
        CASES.append(Case(f"{name}, lines end in {kind}", {name: line_ends(text, end)},
                          f"--domain {name} --spacing 0.3", figures=VOLUME))
    for name, text in SQUARES.items():
        CASES.append(Case(f"{name}, lines end in {kind}", {name: line_ends(text, end)},
                          f"--domain {name} --spacing 0.2 --check", figures=COARSE))
    CASES.append(Case(f"vertices in a .node file, lines end in {kind}",
                      {"a.poly": line_ends("0 2 0 0\n" + SQUARE_SEGMENTS, end),
                       "a.node": line_ends(SQUARE_VERTICES, end)},
                      "--domain a.poly --spacing 0.2 --check", figures=COARSE))
    for name, text in SPACINGS.items():
        option = "--spacing" if name.endswith("csv") else "--spacing-grid"
        CASES.append(Case(f"{name}, lines end in {kind}",
                          {"a.poly": SQUARES["square.poly"], name: line_ends(text, end)},
                          f"--domain a.poly {option} {name} --check", figures=FINE))
    CASES.append(Case(f"points at which d is sampled, lines end in {kind}",
                      {"a.poly": SQUARES["square.poly"], "pit.csv": line_ends(PIT, end)},
                      "--domain a.poly --spacing 'hypot(x-0.37,y-0.61)<0.002 ? 0.002 : 0.1'"
                      " --spacing-hints pit.csv", figures={"nodes": (300, 400)}))
    for length in (254, 255, 256, 600):
        text = "#" * length + "\n" + SQUARES["square.poly"]
        CASES.append(Case(f"a line of {length} characters, lines end in {kind}",
                          {"a.poly": line_ends(text, end)}, "--domain a.poly --spacing 0.2",
                          figures=COARSE))
    CASES.append(Case(f"the line of an error, lines end in {kind}",
                      {"a.msh": line_ends(SQUARES["square.msh"].replace("4 0 1 0", "4 0 y 0"), end),
                       }, "--domain a.msh --spacing 0.2", code=2, says=("a.msh:16: found 'y'",)))
    CASES.append(Case(f"the line of an error in a grid, lines end in {kind}",
                      {"a.poly": SQUARES["square.poly"],
                       "d.asc": line_ends(SPACINGS["d.asc"] + "0.1\n", end)},
                      "--domain a.poly --spacing-grid d.asc", code=2, says=("d.asc:8: ",)))

CASES += [
    # Elements of a PLY file may be in any order.
    Case("faces before vertices in a text file",
         {"a.ply": ply_header("ascii", PLY_FACES, PLY_VERTICES) + CORNERS + XYZ},
         "--domain a.ply --spacing 0.3", figures=VOLUME),
    Case("faces before vertices in a binary file",
         {"a.ply": ply_header("binary_little_endian", PLY_FACES, PLY_VERTICES).encode()
                   + BINARY_FACES + BINARY_VERTICES},
         "--domain a.ply --spacing 0.3", figures=VOLUME),
    Case("a wrong corner before the vertices",
         {"a.ply": ply_header("ascii", PLY_FACES, PLY_VERTICES)
                   + CORNERS.replace("3 0 1 3", "3 0 1 4") + XYZ},
         "--domain a.ply --spacing 0.3", code=2,
         says=("a.ply:11: there is no vertex 4, expected 0 to 3",)),
    # Some programs pad files, or append data of their own.
    Case("bytes behind the triangles of a binary STL", {"a.stl": BINARY_STL + bytes(120)},
         "--domain a.stl --spacing 0.3", figures=VOLUME,
         says=("warning: a.stl: 120 bytes behind the 4 triangles",)),
]

if __name__ == "__main__":
    run(CASES)

# SPDX-License-Identifier: BSD-3-Clause
"""Readers of the command's files. They are programs of others, or follow the definitions of the
formats."""

import csv

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def read_with_vtk(path, kind=vtk.vtkXMLUnstructuredGridReader):
    reader = kind()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("error"))
    reader.SetFileName(str(path))
    reader.Update()
    assert not errors, f"VTK does not like {path}"
    return reader.GetOutputDataObject(0)


def point_array(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def grid_arrays(grid):
    """Returns all arrays of a VTK grid by name."""
    cells = range(grid.GetNumberOfCells())
    arrays = {"points": vtk_to_numpy(grid.GetPoints().GetData()),
              "corners": vtk_to_numpy(grid.GetCells().GetConnectivityArray()),
              "offsets": vtk_to_numpy(grid.GetCells().GetOffsetsArray()),
              "types": numpy.array([grid.GetCellType(cell) for cell in cells])}
    for place, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for k in range(data.GetNumberOfArrays()):
            arrays[place, data.GetArrayName(k)] = vtk_to_numpy(data.GetArray(k))
    return arrays


def read_msh(path, points):
    """Reads a Gmsh file by meshio. The points of the file must be `points` in any order. Returns
    the corners, as indices into `points`, and the physical groups for each kind of cells, and the
    names of the groups."""
    mesh = meshio.read(path, file_format="gmsh")
    theirs, ours = numpy.lexsort(mesh.points.T), numpy.lexsort(points.T)
    numpy.testing.assert_array_equal(mesh.points[theirs], points[ours])
    number = numpy.empty(len(points), int)
    number[theirs] = ours
    kinds = dict.fromkeys(block.type for block in mesh.cells)
    for kind in kinds:
        mine = [i for i, block in enumerate(mesh.cells) if block.type == kind]
        kinds[kind] = (numpy.concatenate([number[mesh.cells[i].data] for i in mine]),
                       numpy.concatenate([mesh.cell_data["gmsh:physical"][i] for i in mine]))
    return kinds, {name: tuple(map(int, group)) for name, group in mesh.field_data.items()}


def read_rows(path):
    """Returns the numbers in the first line and the numbered lines of a file of Triangle or TetGen.
    # begins a comment."""
    lines = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    head, *rows = [line for line in lines if line]
    assert [int(row[0]) for row in rows] == list(range(1, int(head[0]) + 1))
    return list(map(int, head[1:])), [row[1:] for row in rows]


def read_node(path, dimension=2):
    """Reads a .node file by the definition of Triangle and TetGen. Returns points and markers."""
    (written, attributes, markers), rows = read_rows(path)
    assert (written, attributes, markers) == (dimension, 0, 1)
    assert all(len(row) == dimension + 1 for row in rows)
    points = numpy.array([[float(word) for word in row[:-1]] for row in rows])
    return points, numpy.array([int(row[-1]) for row in rows])


def read_ele(path, corners=3):
    """Reads an .ele file by the same definition. Returns the corners, numbered from 0."""
    (written, attributes), rows = read_rows(path)
    assert (written, attributes) == (corners, 0) and all(len(row) == corners for row in rows)
    return numpy.array([[int(word) for word in row] for row in rows]) - 1


def read_face(path):
    """Reads a .face file by TetGen's definition. Returns the corners, numbered from 0, and markers.
    """
    (markers,), rows = read_rows(path)
    assert markers == 1 and all(len(row) == 4 for row in rows)
    numbers = numpy.array([[int(word) for word in row] for row in rows])
    return numbers[:, :3] - 1, numbers[:, 3]


def read_csv(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}

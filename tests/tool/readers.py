# SPDX-License-Identifier: BSD-3-Clause
"""Readers of the files, other people's or by the formats' definitions."""

import csv

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
    return reader.GetOutput()


def point_array(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def read_node(path):
    """By Triangle's definition; # begins a comment. Returns points and markers."""
    lines = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line]
    count, dimension, attributes, markers = map(int, lines[0])
    assert dimension == 2 and markers == 1 and len(lines) == 1 + count
    assert [int(line[0]) for line in lines[1:]] == list(range(1, count + 1))
    assert all(len(line) == 1 + dimension + attributes + markers for line in lines[1:])
    points = numpy.array([[float(word) for word in line[1:3]] for line in lines[1:]])
    return points, numpy.array([int(line[-1]) for line in lines[1:]])


def read_ele(path):
    """By Triangle's definition. Returns the corners, numbered from 0."""
    lines = [line.split("#")[0].split() for line in path.read_text().splitlines()]
    lines = [line for line in lines if line]
    count, corners, attributes = map(int, lines[0])
    assert corners == 3 and attributes == 0 and len(lines) == 1 + count
    assert [int(line[0]) for line in lines[1:]] == list(range(1, count + 1))
    return numpy.array([[int(word) for word in line[1:]] for line in lines[1:]]) - 1


def read_csv(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}

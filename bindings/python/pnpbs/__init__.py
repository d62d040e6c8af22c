# SPDX-License-Identifier: BSD-3-Clause
"""Parallel node placement by bubble simulation. Given a domain and a spacing d(x), the library
places nodes whose mutual distances follow d, and computes their adjacency lists, boundary tags and
Delaunay stars. Results are identical for any number of threads and MPI ranks.

    import pnpbs

    with pnpbs.Context() as context:
        domain = pnpbs.Domain(context)
        domain.add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)])
        placement = pnpbs.Placement(domain)
        placement.set_spacing(0.05)
        placement.run()
        points = placement.nodes().points

Conventions:

- Points are the rows of arrays of shape (n, dim), where dim is 2 in the plane and 3 in space and on
  a sphere. Lengths, spacings and coordinates have one common unit, which the caller chooses.
- Indices, ids and ranks count from 0.
- "Collective" functions must be called by all ranks of the context in the same order. If one rank
  raises an exception, all ranks raise one. "Local" functions may be called by any rank.
- Arrays that are passed are copied or only read during the call. Arrays that are returned belong to
  the caller.
- Errors of the library raise `PNPBSError`. Arrays of a wrong shape or type raise `ValueError`.
- One thread at a time may use a context."""

from ._library import library_path
from ._warnings import (DomainWarning, ElementsWarning, PNPBSWarning, SpacingWarning, WarningCode,
                        WarningData)
from .context import Context
from .domain import Domain, LeftOut, Outline, sphere_degrees, sphere_points
from .errors import ErrorReason, OutcomeError, PNPBSError, Status
from .fields import Transfer
from .mesh import DistributedMesh
from .mesh_arrays import MeshArrays
from .particles import Particles
from .placement import Estimate, Placement, PopulationChange
from .results import (CellBands, CrackFacets, CrackNodes, EdgeBands, Edges, ExchangePattern,
                      Facets, Ghosts, Nodes, Numbering, Regions, Stars)
from .rows import CompressedRows
from .shapes import (GeoGrid, NoteCode, NoteData, Projection, ShapeCounts, Shapes, depth_spacing,
                     geo_build_info)
from .tables import (FormatRow, OptionRow, StatisticRow, build_info, discard_unfinished_files,
                     file_dimension, format_table, library_version, mpi_library, option_table,
                     shutdown, statistic_table)
from .voronoi import VoronoiCells

__all__ = [
    "CellBands", "CompressedRows", "Context", "CrackFacets", "CrackNodes", "DistributedMesh",
    "Domain", "DomainWarning",
    "EdgeBands", "Edges", "ElementsWarning", "ErrorReason", "Estimate", "ExchangePattern",
    "Facets", "FormatRow", "GeoGrid", "Ghosts", "LeftOut", "MeshArrays", "Nodes", "NoteCode",
    "NoteData", "Numbering", "OptionRow", "Outline", "PNPBSError", "PNPBSWarning", "Particles", "Placement",
    "PopulationChange", "Projection", "Regions", "ShapeCounts", "Shapes", "SpacingWarning", "Stars",
    "StatisticRow", "Status", "Transfer", "VoronoiCells", "WarningCode", "WarningData",
    "build_info", "depth_spacing", "discard_unfinished_files", "file_dimension", "format_table",
    "geo_build_info", "library_path", "library_version", "mpi_library", "option_table",
    "shutdown", "sphere_degrees", "sphere_points", "statistic_table",
]

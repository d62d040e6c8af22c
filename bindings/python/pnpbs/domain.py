# SPDX-License-Identifier: BSD-3-Clause
"""Domains: the regions to be filled with nodes."""

from __future__ import annotations

import ctypes
import math
import os
from typing import Any, Dict, List, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _interface
from ._arrays import as_indices, as_point, as_points, as_tags
from ._callbacks import curve_callback, level_set_callback, no_spacing, spacing_callback
from ._interface import library
from ._summaries import summary
from ._types import ArrayFunction, Doubles, Int32s, Path, Role
from .context import Context, Handle
from .errors import check_without_context

_ROLES = {"boundary": _interface.BOUNDARY, "inner": _interface.INNER}


class LeftOut(NamedTuple):
    vertices: int
    curves: int


class Outline(NamedTuple):
    segments: Doubles
    tags: Int32s

    def __repr__(self) -> str:
        return summary(self)


def _role_number(role: str) -> int:
    if role not in _ROLES:
        raise ValueError(f"role is {role!r}; 'boundary' or 'inner' was expected")
    return _ROLES[role]


def _as_function(d: Union[float, ArrayFunction]) -> ArrayFunction:
    if callable(d):
        return d
    value = float(d)
    return lambda x: np.full(len(x), value)


class Domain(Handle):
    """An empty domain in the plane, or with `dim=3` in space, to which curves, surfaces, holes and
    fixed nodes are added. A point is inside if it lies behind an odd number of boundary curves, or
    surfaces in space; holes and islands nest to any depth. Every method is local and returns the
    domain; points are the rows of (n, dim) arrays, indices count from 0. Methods for domains "in
    the plane" or "in space" reject others.

    The `role` of a curve or surface is "boundary", which separates inside from outside, or "inner",
    which lies in the domain and which the nodes follow; curves in space are always inner. Its `tag`
    is a nonzero integer that marks the nodes on it."""

    def __init__(self, context: Context, dim: int = 2) -> None:
        super().__init__()
        self.context = context
        handle = ctypes.c_void_p()
        context._check(library().pnpbs_domain_create(context._live(), dim, ctypes.byref(handle)))
        self._own(handle)

    @classmethod
    def on_sphere(cls, context: Context, radius: float, outside: ArrayLike) -> Domain:
        """Creates an empty domain on a sphere about the origin. Its nodes lie on the sphere,
        spacings are lengths along it, and points are the rows of (n, 3) arrays. Boundary curves
        (`add_polyline`) follow great circles from vertex to vertex; the domain is what lies behind
        an odd number of them, seen from a point in the direction `outside`, three numbers of any
        length except 0. Nodes are placed in the stereographic projection from that point, which
        should be ten spacings or more away from the domain. Without a boundary curve the domain is
        the whole sphere, on which nodes around that point are laid first. Placements have `triangles` and
        `boundary_edges`, as in the plane. Not on a sphere yet: particles, arcs,
        parametric curves, files of curves other than those of `Shapes`, and spacing given on grids,
        meshes or points.

            ring = pnpbs.sphere_points(1, [(lon, -70) for lon in range(0, 360, 2)])
            sea = pnpbs.Domain.on_sphere(context, 1, (0, 0, -1))
            sea.add_polyline(ring, corner_angle=30)"""
        direction = as_point(outside, 3, "outside")
        self = cls.__new__(cls)
        Handle.__init__(self)
        self.context = context
        handle = ctypes.c_void_p()
        context._check(library().pnpbs_domain_create_sphere(context._live(), radius, direction,
                                                            ctypes.byref(handle)))
        self._own(handle)
        return self

    def _own(self, handle: ctypes.c_void_p) -> None:
        self._handle = handle.value
        self._callbacks: List[Any] = []
        self.context._children.append(self)

    def close(self) -> None:
        """Releases the resources of the library. A placement keeps what it needs of its domain.
        Closing twice is allowed."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_domain_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        return f"<pnpbs.Domain, {f'{self.dim}D' if self.is_open else 'closed'}>"

    def _call(self, name: str, *arguments: Any) -> Domain:
        self.context._check(getattr(library(), f"pnpbs_domain_{name}")(self._live(), *arguments))
        return self

    @property
    def dim(self) -> int:
        """2 in the plane, 3 in space and on a sphere."""
        dim = ctypes.c_int32()
        self._call("dimension", ctypes.byref(dim))
        return dim.value

    # ------------------------------------------------------------ curves -----------------------

    def add_polyline(self, coordinates: ArrayLike, closed: bool = True, role: Role = "boundary",
                     tags: Optional[ArrayLike] = None, corner_angle: float = 0.0) -> Domain:
        """Adds straight segments through the rows of `coordinates`; with `closed`, a segment joins
        the last to the first. `tags` is one for all segments or one for each. With `corner_angle=0`
        every vertex becomes a node; otherwise only those where the direction turns by more than
        this many degrees, and between them the polyline represents a smooth curve. In space the
        role is "inner", and the `feature_angle` of the surfaces replaces the `corner_angle`."""
        points = as_points(coordinates, self.dim, "coordinates")
        n = len(points)
        segments = n if closed else max(n - 1, 0)
        return self._call("add_polyline", _role_number(role), closed, n, points,
                          as_tags(tags, segments, "tags"), corner_angle)

    def add_arc(self, centre: ArrayLike, radius: float, begin: float = 0.0, end: float = 2 * math.pi,
                role: Role = "boundary", tag: int = 1) -> Domain:
        """Adds a circular arc between two angles in radians, a full circle by default, to a domain
        in the plane. Its ends join curves that end at the same point."""
        return self._call("add_arc", _role_number(role), as_point(centre, 2, "centre"), radius,
                          begin, end, tag)

    def add_curve(self, curve: ArrayFunction, begin: float, end: float, role: Role = "boundary",
                  tag: int = 1) -> Domain:
        """Adds the curve of a function to a domain in the plane: `curve(t)` gets an array of n
        parameters between `begin` and `end` and returns the points, (n, 2). It must always return
        the same point for the same parameter, be continuous, and not cross itself. Corners exist
        only where curves meet."""
        callback = curve_callback(curve, self.context)
        self._call("add_curve", _role_number(role), callback, None, begin, end, tag)
        self._callbacks.append(callback)
        return self

    def add_pslg(self, coordinates: ArrayLike, segments: ArrayLike,
                 vertex_tags: Optional[ArrayLike] = None, segment_tags: Optional[ArrayLike] = None,
                 holes: ArrayLike = ()) -> Domain:
        """Adds a planar straight-line graph, as Triangle defines it, to a domain in the plane. The
        domain is what the segments enclose, except the regions that contain a hole point.
        `segments` is (m, 2), indices of rows of `coordinates`; `holes` is (h, 2). Every vertex
        becomes a node."""
        points = as_points(coordinates, 2, "coordinates")
        ends = as_indices(segments, 2, "segments")
        hole_points = as_points(holes, 2, "holes")
        return self._call("add_pslg", len(points), points,
                          as_tags(vertex_tags, len(points), "vertex_tags"), len(ends), ends,
                          as_tags(segment_tags, len(ends), "segment_tags"), len(hole_points),
                          hole_points)

    def read_poly(self, path: Path) -> Domain:
        """Reads a file in Triangle's .poly format and adds its content to a domain in the plane."""
        return self._call("read_poly", os.fsencode(path))

    def parse_poly(self, text: str, name: str = "text") -> Domain:
        """Adds the content of a text in Triangle's .poly format to a domain in the plane; `name` is
        the name of the text in messages."""
        content = text.encode()
        return self._call("parse_poly", content, len(content), name.encode())

    # ------------------------------------------------------------ surfaces ---------------------

    def add_surface(self, coordinates: ArrayLike, corners: ArrayLike, role: Role = "boundary",
                    tags: Optional[ArrayLike] = None, feature_angle: float = 40.0) -> Domain:
        """Adds a triangulated surface to a domain in space: `corners` is (m, 3), indices of rows of
        `coordinates`. Closed surfaces with the role "boundary" bound the domain; nodes follow
        "inner" ones, closed or open. Coincident vertices are merged; the orientation is determined
        by what the triangles enclose. `tags` is one for all triangles or one for each. Nodes lie on
        the edge between two triangles if their normals differ by more than `feature_angle` degrees,
        or if their tags differ. Between such edges the triangles only define the shape, whatever
        their size."""
        points = as_points(coordinates, 3, "coordinates")
        triangles = as_indices(corners, 3, "corners")
        return self._call("add_surface", _role_number(role), len(points), points, len(triangles),
                          triangles, as_tags(tags, len(triangles), "tags"), feature_angle)

    def read_surface(self, path: Path, role: Role = "boundary",
                     feature_angle: float = 40.0) -> Domain:
        """Reads a surface from a file into a domain in space, in one of the formats that the header
        lists at `pnpbs_domain_read_surface`. Groups, materials and facet markers become tags, hole
        points become holes of the domain. Otherwise as `add_surface`."""
        return self._call("read_surface", _role_number(role), os.fsencode(path), feature_angle)

    def add_box(self, low: ArrayLike, high: ArrayLike, tag: int = 1) -> Domain:
        """Adds a box to a domain in space; its sides bound the domain."""
        return self._call("add_box", as_point(low, 3, "low"), as_point(high, 3, "high"), tag)

    def add_ball(self, centre: ArrayLike, radius: float, tag: int = 1) -> Domain:
        """Adds a ball to a domain in space, as triangles within 1e-4 of the radius."""
        return self._call("add_ball", as_point(centre, 3, "centre"), radius, tag)

    def add_cylinder(self, begin: ArrayLike, end: ArrayLike, radius: float, tag: int = 1) -> Domain:
        """Adds a circular cylinder to a domain in space, as triangles within 1e-4 of the radius;
        `begin` and `end` are the centres of its two circles."""
        return self._call("add_cylinder", as_point(begin, 3, "begin"), as_point(end, 3, "end"),
                          radius, tag)

    def add_level_set(self, level_set: ArrayFunction, low: ArrayLike, high: ArrayLike,
                      resolution: float, tag: int = 1) -> Domain:
        """Adds the body where a function is negative to a domain in space: `level_set(x)` gets the
        points, (n, 3), and returns n values. It must always return the same value for the same
        point, be continuous, and be finite everywhere in the box between `low` and `high`, where
        the body must lie; it need not be a distance. Its surface is found on an octree refined near
        its zeros down to cells of side `resolution`: thinner features can be lost."""
        callback = level_set_callback(level_set, self.context)
        self._call("add_level_set", callback, None, as_point(low, 3, "low"),
                   as_point(high, 3, "high"), resolution, tag)
        self._callbacks.append(callback)
        return self

    def add_offset(self, body: Domain, low: float, high: float,
                   d: Union[None, float, ArrayFunction] = None, resolution: float = 0.0,
                   tag: int = 1) -> Domain:
        """Adds the body between two distances from the boundary of another: points whose signed
        distance to it, negative inside, lies between `low` and `high` times d. Particles that each
        stand for d^dim of matter lie half a spacing inside the wall: they are placed between `low`
        = -math.inf and `high` = -0.42 in the plane, -0.46 in space, as nodes with a spacing of
        1.076 d or 1.147 d. Their number is then nearly the integral of 1 / d^dim over the body. n
        layers of wall particles lie outside, between 0.42 and n - 0.58 or, in space, 0.46 and n -
        0.54. `d` is a number or a function as in `Placement.set_spacing`, which is evaluated in the
        body's bounding box, and as far around it as the new body reaches, and a little farther;
        with None, `low` and `high` are lengths. The boundary, with the tag, is found as that of a
        level set (`add_level_set`) with this resolution, 0 for an eighth (in space half) of the
        least d at the body's boundary, without `d` of the lesser of abs(low) and abs(high); what is
        thinner is lost. Must be called identically on all ranks."""
        callback = no_spacing() if d is None else spacing_callback(_as_function(d), self.context)
        self._call("add_offset", body._live(), low, high, callback, None, resolution, tag)
        self._callbacks.append(callback)
        return self

    def set_corner_angle(self, corner_angle: float) -> Domain:
        """Sets the corner angle of the graphs of a domain in the plane (`add_pslg`, `read_poly`,
        `parse_poly`), both those already added and later ones. Corners are vertices where the
        direction turns by more than this many degrees, where segments of different tags or other
        than two of them end, and vertices with a tag of their own. Nodes lie on corners; between
        them a graph represents a smooth curve, with nodes spaced by d. With 0, the default, every
        vertex becomes a node."""
        return self._call("set_corner_angle", corner_angle)

    def simplify(self, d: Union[float, ArrayFunction], tolerance: float = 0.25,
                 smallest: float = 0.0) -> LeftOut:
        """Removes features finer than d, such as those of coastlines, from a domain in the plane.
        From the graphs and polylines added so far, it removes vertices next to segments shorter
        than d, as long as the curve then passes them within `tolerance` times d, and closed curves,
        islands and lakes, whose extent (the longer side of their bounding box) is less than
        `smallest` times d. `d` is a number or a function as in `Placement.set_spacing`. No other
        vertex, fixed node or hole point changes to another side of a curve. Vertices are kept where
        curves meet or end, where tags change or a vertex has its own, and at fixed nodes. Returns
        the numbers of removed vertices, including those of the curves, and of removed curves. Must
        be called identically on all ranks."""
        vertices, curves = ctypes.c_int64(), ctypes.c_int64()
        self._call("simplify", spacing_callback(_as_function(d), self.context), None, tolerance,
                   smallest, ctypes.byref(vertices), ctypes.byref(curves))
        return LeftOut(vertices.value, curves.value)

    def simplify_by_file(self, path: Path, field: Optional[str] = None, tolerance: float = 0.25,
                         smallest: float = 0.0) -> LeftOut:
        """Does the same as `simplify` with a spacing from a file with values at points, as in
        `Placement.set_spacing_file`."""
        vertices, curves = ctypes.c_int64(), ctypes.c_int64()
        self._call("simplify_by_file", os.fsencode(path), None if field is None else field.encode(),
                   tolerance, smallest, ctypes.byref(vertices), ctypes.byref(curves))
        return LeftOut(vertices.value, curves.value)

    def set_filled(self, filled: bool) -> Domain:
        """Sets whether a domain in space is the volume enclosed by its surfaces (the default) or,
        with False, the surfaces alone: nodes on them, triangles between these nodes, and no
        interior."""
        return self._call("set_filled", bool(filled))

    def set_repair(self, resolution: float = 0.0) -> Domain:
        """Repairs the triangulated boundary surfaces of a domain in space that enclose one body
        imperfectly: open, crossing, folded or inconsistently oriented. Sound surfaces are
        unchanged, and a warning reports that nothing is repaired. The body is where they wind
        around a point more than half a time, in either orientation. Holes are closed, overlapping
        bodies are joined, and surfaces that enclose nothing are dropped. The surface of the body is
        extracted as that of a level set, with its sharp edges; all of it has the tag of the first
        triangle. A warning reports its distance from the given triangles. Features thinner than the
        resolution can be lost: it should be no more than the spacing at the surface; 0 is 1/64 of
        the longest side of the bounding box of the triangles."""
        return self._call("set_repair", float(resolution))

    def set_resurfaced(self, resolution: float = 0.0) -> Domain:
        """Replaces the triangulated boundary surfaces of a domain in space as set_repair() does,
        even if they need no repair: this removes what is finer than the resolution from a body."""
        return self._call("set_resurfaced", float(resolution))

    # ------------------------------------------------------------ files and tags ---------------

    def read_msh(self, path: Path, feature_angle: float = 40.0) -> Domain:
        """Reads a mesh in Gmsh's MSH format and adds its boundary: in the plane lines and edges, in
        space triangles, with their physical groups as tags. Sheets and lines inside are inner
        surfaces and curves, points are fixed nodes. `feature_angle` in degrees is as in
        `add_surface`, in the plane as the `corner_angle` of `add_polyline`."""
        return self._call("read_msh", os.fsencode(path), feature_angle)

    def set_role(self, tag: int, role: Role) -> Domain:
        """Sets the role of all triangles with a tag in a domain in space. It overrides the role
        they are added with."""
        return self._call("set_role", tag, _role_number(role))

    def set_tag_name(self, dim: int, tag: int, name: str) -> Domain:
        """Sets the name of a tag of points (`dim` 0), curves (1), surfaces (2) or bodies (3), for
        files with physical groups."""
        return self._call("set_tag_name", dim, tag, name.encode())

    def tag_names(self) -> Dict[Tuple[int, int], str]:
        """Returns the names of tags, set or from files: {(dim, tag): name}."""
        count = ctypes.c_int32()
        self._call("tag_name_count", ctypes.byref(count))
        names = {}
        for index in range(count.value):
            dim, tag, name = ctypes.c_int32(), ctypes.c_int32(), ctypes.c_char_p()
            self._call("get_tag_name", index, ctypes.byref(dim), ctypes.byref(tag),
                       ctypes.byref(name))
            names[dim.value, tag.value] = (name.value or b"").decode()
        return names

    # ------------------------------------------------------------ points -----------------------

    def add_hole(self, point: ArrayLike) -> Domain:
        """Removes the region around a point from the domain, up to the next curves or surfaces."""
        return self._call("add_hole", as_point(point, self.dim, "point"))

    def add_region(self, point: ArrayLike, tag: int) -> Domain:
        """Gives a tag, not 0, to the region around a point, up to the next curves or surfaces:
        elements that lie in it have this tag (`Placement.element_tags`, `Placement.mesh`), in files
        too. So inner curves and surfaces divide a domain into materials. Elements of regions
        without a point have the tag 0. `check` raises `Status.ERROR_DOMAIN` if the point lies
        outside the domain, on a curve or surface, or in a region with another tag."""
        return self._call("add_region", as_point(point, self.dim, "point"), tag)

    def add_fixed_nodes(self, coordinates: ArrayLike, tags: Optional[ArrayLike] = None) -> Domain:
        """Adds fixed nodes, which keep their exact coordinates, inside the domain or on a vertex of
        its curves or surfaces."""
        points = as_points(coordinates, self.dim, "coordinates")
        return self._call("add_fixed_nodes", len(points), points,
                          as_tags(tags, len(points), "tags"))

    # ------------------------------------------------------------ what it is -------------------

    def check(self) -> Domain:
        """Checks the whole geometry: duplicate vertices, crossings, open boundaries, hole points
        outside. A `PNPBSError` with `Status.ERROR_DOMAIN` names the vertex, segment or triangle.
        Placements check it, too; checking early adds no cost."""
        return self._call("check")

    def bounds(self) -> Tuple[Doubles, Doubles]:
        """Returns the corners (low, high) of the bounding box of the curves or surfaces."""
        low, high = np.zeros(self.dim), np.zeros(self.dim)
        self._call("bounds", low, high)
        return low, high

    def measure(self) -> float:
        """Returns the area of the inside, in space its volume; of surfaces alone their area."""
        inside = ctypes.c_double()
        self._call("measure", ctypes.byref(inside))
        return inside.value

    def distance(self, coordinates: ArrayLike, tag: int = 0) -> Doubles:
        """Evaluates the distances of points to the boundary of the domain, or to the curves,
        surfaces or nodes with a tag."""
        points = as_points(coordinates, self.dim, "coordinates")
        distances = np.zeros(len(points))
        self._call("distance", tag, len(points), points, distances)
        return distances

    def shape_spacing(self, coordinates: ArrayLike, nodes_per_turn: float = 0.0,
                      nodes_across: float = 0.0, nodes_per_edge: float = 0.0,
                      growth: float = 0.0) -> Doubles:
        """Evaluates the spacing that `Placement.set_spacing_from_shape` would set at points,
        without its bounds. The first query takes longest: make one before querying from inside a
        callback."""
        points = as_points(coordinates, self.dim, "coordinates")
        d = np.zeros(len(points))
        self._call("shape_spacing", nodes_per_turn, nodes_across, nodes_per_edge, growth,
                   len(points), points, d)
        return d

    def outline(self) -> Outline:
        """Returns straight segments, (n, 2, dim), that approximate the curves of a domain in the
        plane or on a sphere, finely sampled, for pictures: `segments[k, 0]` and `segments[k, 1]` are the ends of one; and
        their tags."""
        count = ctypes.c_int64()
        self._call("get_segments", 0, ctypes.byref(count), None, None)
        segments = np.zeros((count.value, 2, self.dim))
        tags = np.zeros(count.value, dtype=np.int32)
        self._call("get_segments", count.value, ctypes.byref(count), segments, tags)
        return Outline(segments, tags)


def sphere_points(radius: float, degrees: ArrayLike) -> Doubles:
    """Computes points on a sphere about the origin, (n, 3), from longitude and latitude: `degrees`
    is (n, 2), with longitudes that may exceed a full turn and latitudes from -90 to 90."""
    places = as_points(degrees, 2, "degrees")
    points = np.zeros((len(places), 3))
    check_without_context(library().pnpbs_sphere_points(radius, len(places), places, points))
    return points


def sphere_degrees(coordinates: ArrayLike) -> Doubles:
    """Computes longitude, from -180 to 180, and latitude, from -90 to 90, of the directions of
    points: (n, 2) for the rows of `coordinates`, (n, 3), none of them 0."""
    points = as_points(coordinates, 3, "coordinates")
    degrees = np.zeros((len(points), 2))
    check_without_context(library().pnpbs_sphere_degrees(len(points), points, degrees))
    return degrees

# SPDX-License-Identifier: BSD-3-Clause
"""Domains: the regions that are filled with nodes."""

from __future__ import annotations

import ctypes
import math
import operator
import os
from collections import Counter
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

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
    """Numbers of removed vertices, including those of removed curves, and of removed curves."""

    vertices: int
    curves: int


class Outline(NamedTuple):
    """Segments that approximate curves, of shape (n, 2, dim), and the tag of each."""

    segments: Doubles
    tags: Int32s

    def __repr__(self) -> str:
        return summary(self)


def _role_number(role: str) -> int:
    """Returns the library's number of a role. Raises ValueError for another text."""
    if role not in _ROLES:
        raise ValueError(f"role is {role!r}; 'boundary' or 'inner' was expected")
    return _ROLES[role]


def _tags_or_tag(tags: Optional[ArrayLike], tag: Optional[ArrayLike]) -> Optional[ArrayLike]:
    """Returns the one that is given. Raises TypeError if both are."""
    if tags is not None and tag is not None:
        raise TypeError("tag and tags are both given; one of them was expected")
    return tag if tags is None else tags


def _one_tag(tag: Optional[int], tags: Optional[int]) -> int:
    """Returns the tag of a curve or surface that has only one, 1 by default."""
    given = _tags_or_tag(tags, tag)
    if given is None:
        return 1
    if np.ndim(given) != 0:
        raise ValueError(f"tags is {given!r}; one tag was expected")
    return operator.index(given)  # type: ignore[arg-type]


def _as_function(d: Union[float, ArrayFunction]) -> ArrayFunction:
    """Returns d if it is a function, or else the constant function with this value."""
    if callable(d):
        return d
    value = float(d)
    return lambda x: np.full(len(x), value)


class Domain(Handle):
    """An empty domain in the plane, or with `dim=3` in space. Curves, surfaces, holes and fixed
    nodes are added to it.

    - `context`: the context of the domain.
    - `dim`: 2 for a domain in the plane, 3 for one in space.

    A point is inside the domain if it lies behind an odd number of boundary curves, or of boundary
    surfaces in space. Holes and islands nest to any depth. All methods are local. Methods that
    change the domain return it. Points are the rows of arrays of shape (n, dim), which are copied,
    and indices count from 0. Methods for domains "in the plane" or "in space" raise
    `Status.ERROR_ARGUMENT` for others.

    Common arguments:

    - `role`: "boundary" for a curve or surface that separates inside from outside; "inner" for one
      inside the domain that nodes follow. Curves in space are always inner.
    - `tag`: a nonzero integer that marks the nodes on a curve or surface. `tags` is one number for
      all segments or triangles, or one for each; None stands for 1. Each is accepted where the
      other is; a curve or surface of one piece has one tag."""

    def __init__(self, context: Context, dim: int = 2) -> None:
        super().__init__()
        self.context = context
        handle = ctypes.c_void_p()
        context._check(library().pnpbs_domain_create(context._live(), dim, ctypes.byref(handle)))
        self._own(handle)

    @classmethod
    def on_sphere(cls, context: Context, radius: float, outside: ArrayLike) -> Domain:
        """Creates an empty domain on a sphere about the origin. Its nodes lie on the sphere,
        spacings are lengths along it, and points are the rows of arrays of shape (n, 3). Boundary
        curves (`add_polyline`) follow great circles from vertex to vertex. The domain lies behind
        an odd number of them, as seen from a point outside. Placements have `triangles` and
        `boundary_edges`, as in the plane.

        - `radius`: greater than 0.
        - `outside`: the direction of a point outside the domain, three numbers that are not all 0.
          Nodes are placed in the stereographic projection from that point, which should be at least
          ten spacings away from the domain.

        Without a boundary curve the domain is the whole sphere. Nodes around the point are laid
        first and stay fixed then.

        The following are not available on a sphere: particles and offsets, arcs, parametric curves,
        graphs, holes of a whole sphere, and files of curves other than those of `Shapes`.

            ring = pnpbs.sphere_points(1, [(lon, -70) for lon in range(0, 360, 2)])
            sea = pnpbs.Domain.on_sphere(context, 1, (0, 0, -1))
            sea.add_polyline(ring, corner_angle=30)
        """
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
        """Takes over a new handle and registers the domain at its context."""
        self._handle = handle.value
        self._callbacks: List[Any] = []
        self._added: Counter[str] = Counter()  # of calls that add to the domain, in their order
        self.context._children.append(self)

    def close(self) -> None:
        """Releases the resources of the library. Placements keep what they need of the domain.
        Repeated calls have no effect."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_domain_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        if not self.is_open:
            return "<pnpbs.Domain, closed>"
        parts = [name if count == 1 else f"{count} {name}" for name, count in self._added.items()]
        return f"<pnpbs.Domain, {self.dim}D: {', '.join(parts) or 'empty'}>"

    def _call(self, name: str, *arguments: Any) -> Domain:
        """Calls the function pnpbs_domain_<name> and returns the domain."""
        self.context._check(getattr(library(), f"pnpbs_domain_{name}")(self._live(), *arguments))
        verb, _, what = name.partition("_")
        if verb in ("add", "read", "parse"):
            self._added[what.replace("_surface", "")] += 1
        return self

    @property
    def dim(self) -> int:
        """The dimension of points: 2 in the plane, 3 in space and on a sphere."""
        dim = ctypes.c_int32()
        self._call("dimension", ctypes.byref(dim))
        return dim.value

    # ------------------------------------------------------------ curves -----------------------

    def add_polyline(self, coordinates: ArrayLike, closed: bool = True, role: Role = "boundary",
                     tags: Optional[ArrayLike] = None, corner_angle: float = 0.0, *,
                     tag: Optional[int] = None) -> Domain:
        """Adds straight segments through vertices. On a sphere the segments are parts of great
        circles.

        - `coordinates`: the vertices, of shape (n, dim).
        - `closed`: whether a segment joins the last vertex to the first one.
        - `role`: "boundary" or "inner"; in space "inner".
        - `tags`: one for all segments or one for each; `tag` is another name for one.
        - `corner_angle`: in degrees. With 0 every vertex becomes a node. Otherwise only vertices
          where the direction turns by more than this angle become nodes, and ends of open polylines
          and vertices where curves meet. Between them the polyline represents a smooth curve. In
          space the `feature_angle` of the surfaces is used instead."""
        points = as_points(coordinates, self.dim, "coordinates")
        n = len(points)
        segments = n if closed else max(n - 1, 0)
        return self._call("add_polyline", _role_number(role), closed, n, points,
                          as_tags(_tags_or_tag(tags, tag), segments, "tags"), corner_angle)

    def add_arc(self, centre: ArrayLike, radius: float, begin: float = 0.0, end: float = 2 * math.pi,
                role: Role = "boundary", tag: Optional[int] = None, *,
                tags: Optional[int] = None) -> Domain:
        """Adds a circular arc, by default a full circle, to a domain in the plane. Its ends join
        curves that end at the same point, to within 1e-9 of the size of the domain.

        - `centre`: two numbers.
        - `radius`: greater than 0.
        - `begin`, `end`: angles in radians."""
        return self._call("add_arc", _role_number(role), as_point(centre, 2, "centre"), radius,
                          begin, end, _one_tag(tag, tags))

    def add_curve(self, curve: ArrayFunction, begin: float, end: float, role: Role = "boundary",
                  tag: Optional[int] = None, *, tags: Optional[int] = None) -> Domain:
        """Adds a curve that a function defines to a domain in the plane. Corners exist only where
        curves meet. A curve whose ends coincide is closed.

        - `curve`: a function `curve(t)` that receives n parameters between `begin` and `end` and
          returns points of shape (n, 2). It must be pure and continuous, and the curve must not
          cross itself. It is called now and whenever a placement is initialised, so the domain
          keeps it. An exception that it raises is raised by the call in progress.
        - `begin`, `end`: the range of the parameter."""
        callback = curve_callback(curve, self.context)
        self._call("add_curve", _role_number(role), callback, None, begin, end,
                   _one_tag(tag, tags))
        self._callbacks.append(callback)
        return self

    def add_pslg(self, coordinates: ArrayLike, segments: ArrayLike,
                 vertex_tags: Optional[ArrayLike] = None, segment_tags: Optional[ArrayLike] = None,
                 holes: ArrayLike = (), *, tags: Optional[ArrayLike] = None,
                 tag: Optional[int] = None) -> Domain:
        """Adds a planar straight-line graph, as Triangle defines it, to a domain in the plane. The
        segments enclose the domain, except for regions that contain a hole point. Every vertex
        becomes a node, unless `set_corner_angle` is called. This rule then holds for all curves of
        the domain.

        - `coordinates`: the vertices, of shape (n, 2).
        - `segments`: indices of vertices, of shape (m, 2).
        - `vertex_tags`: tags of vertices; 0 stands for the tag of the segment.
        - `segment_tags`: tags of segments; `tags`, or `tag` for one, are other names.
        - `holes`: a point in each hole, of shape (h, 2)."""
        points = as_points(coordinates, 2, "coordinates")
        ends = as_indices(segments, 2, "segments")
        segment_tags = _tags_or_tag(segment_tags, _tags_or_tag(tags, tag))
        hole_points = as_points(holes, 2, "holes")
        return self._call("add_pslg", len(points), points,
                          as_tags(vertex_tags, len(points), "vertex_tags"), len(ends), ends,
                          as_tags(segment_tags, len(ends), "segment_tags"), len(hole_points),
                          hole_points)

    def read_poly(self, path: Path) -> Domain:
        """Adds the content of a file in Triangle's .poly format to a domain in the plane, as
        `add_pslg` does. Raises `Status.ERROR_FILE` with file, line and what was expected."""
        return self._call("read_poly", os.fsencode(path))

    def parse_poly(self, text: str, name: str = "text") -> Domain:
        """Adds the content of a text in Triangle's .poly format to a domain in the plane, as
        `read_poly` does. `name` is the name of the text in messages."""
        content = text.encode()
        return self._call("parse_poly", content, len(content), name.encode())

    # ------------------------------------------------------------ surfaces ---------------------

    def add_surface(self, coordinates: ArrayLike, corners: ArrayLike, role: Role = "boundary",
                    tags: Optional[ArrayLike] = None, feature_angle: float = 40.0, *,
                    tag: Optional[int] = None) -> Domain:
        """Adds a triangulated surface to a domain in space. Closed surfaces with the role
        "boundary" bound the domain. Nodes follow "inner" surfaces, which may be open. Coincident
        vertices are merged. The triangles may have any orientation, because the enclosed volume
        determines it.

        - `coordinates`: the vertices, of shape (n, 3).
        - `corners`: indices of vertices, of shape (m, 3).
        - `tags`: one for all triangles or one for each; `tag` is another name for one.
        - `feature_angle`: in degrees. Nodes lie on an edge between two triangles if their normals
          differ by more than this angle, or if their tags differ. Between such edges the triangles
          only define the shape, whatever their size is."""
        points = as_points(coordinates, 3, "coordinates")
        triangles = as_indices(corners, 3, "corners")
        return self._call("add_surface", _role_number(role), len(points), points, len(triangles),
                          triangles, as_tags(_tags_or_tag(tags, tag), len(triangles), "tags"),
                          feature_angle)

    def read_surface(self, path: Path, role: Role = "boundary",
                     feature_angle: float = 40.0) -> Domain:
        """Adds a surface from a file to a domain in space, as `add_surface` does. The header lists
        the formats at `pnpbs_domain_read_surface`. Groups, materials and facet markers become tags,
        and hole points become holes of the domain. Raises `Status.ERROR_FILE` with file, line and
        what was expected."""
        return self._call("read_surface", _role_number(role), os.fsencode(path), feature_angle)

    def add_box(self, low: ArrayLike, high: ArrayLike, tag: Optional[int] = None,
                role: Role = "boundary", *, tags: Optional[int] = None) -> Domain:
        """Adds a box to a domain in space. Its sides bound the domain, or with the role "inner" lie
        in it and nodes follow them. `low` and `high` are opposite corners."""
        return self._call("add_box_surface", _role_number(role), as_point(low, 3, "low"),
                          as_point(high, 3, "high"), _one_tag(tag, tags))

    def add_ball(self, centre: ArrayLike, radius: float, tag: Optional[int] = None,
                 role: Role = "boundary", *, tags: Optional[int] = None) -> Domain:
        """Adds a ball to a domain in space, as triangles within 1e-4 of the radius. Its surface
        bounds the domain, or with the role "inner" lies in it and nodes follow it."""
        return self._call("add_ball_surface", _role_number(role), as_point(centre, 3, "centre"),
                          radius, _one_tag(tag, tags))

    def add_cylinder(self, begin: ArrayLike, end: ArrayLike, radius: float,
                     tag: Optional[int] = None, role: Role = "boundary", *,
                     tags: Optional[int] = None) -> Domain:
        """Adds a circular cylinder to a domain in space, as triangles within 1e-4 of the radius.
        Its surface bounds the domain, or with the role "inner" lies in it and nodes follow it.
        `begin` and `end` are the centres of its two circles."""
        return self._call("add_cylinder_surface", _role_number(role), as_point(begin, 3, "begin"),
                          as_point(end, 3, "end"), radius, _one_tag(tag, tags))

    def add_level_set(self, level_set: ArrayFunction, low: ArrayLike, high: ArrayLike,
                      resolution: float, tag: Optional[int] = None, *,
                      tags: Optional[int] = None) -> Domain:
        """Adds the body where a function is negative to a domain in space. Its surface is found on
        an octree that is refined near the zeros of the function. Thinner features can be lost.

        - `level_set`: a function `level_set(x)` that receives points of shape (n, 3) and returns n
          values. It must be pure, continuous and finite in the whole box; it need not be a
          distance. It is called now and while placements compute, so the domain keeps it.
        - `low`, `high`: opposite corners of a box that contains the body.
        - `resolution`: side of the smallest cells of the octree.

        Raises `Status.ERROR_DOMAIN` if the function is not finite, or negative on the border of the
        box, with the point, or if it is negative nowhere."""
        callback = level_set_callback(level_set, self.context)
        self._call("add_level_set", callback, None, as_point(low, 3, "low"),
                   as_point(high, 3, "high"), resolution, _one_tag(tag, tags))
        self._callbacks.append(callback)
        return self

    def add_offset(self, body: Domain, low: float, high: float,
                   d: Union[None, float, ArrayFunction] = None, resolution: float = 0.0,
                   tag: Optional[int] = None, *, tags: Optional[int] = None) -> Domain:
        """Adds the body between two distances from the boundary of another body. A point belongs to
        it if its signed distance from that boundary, negative inside, lies between `low` and `high`
        times d. All ranks must make the same call.

        Particles that each represent d^dim of matter lie half a spacing inside the wall. To place
        them, use `low` = -math.inf and `high` = -0.42 in the plane or -0.46 in space, with nodes of
        the spacing 1.076 d or 1.147 d. Their number is then nearly the integral of 1 / d^dim over
        the body. n layers of wall particles lie outside, between 0.42 and n - 0.58, or in space
        between 0.46 and n - 0.54.

        - `body`: a domain on the same context and of the same dimension. It is checked, and is not
          needed afterwards.
        - `low`, `high`: factors of d; `high` is finite.
        - `d`: a number, or a function as in `Placement.set_spacing`. It is evaluated in the
          bounding box of the body and around it, a little farther than the new body reaches. With
          None, `low` and `high` are lengths.
        - `resolution`: the boundary is found as that of a level set (`add_level_set`) with this
          resolution; thinner parts are lost. 0 stands for an eighth, in space half, of the least d
          at the boundary of the body, or without `d` of the lesser of abs(low) and abs(high).
        - `tag`: tag of the new boundary.

        Raises `Status.ERROR_DOMAIN` if the body is invalid or nothing lies between these distances,
        and `Status.ERROR_SPACING` for values of d that are zero, negative or not finite."""
        callback = no_spacing() if d is None else spacing_callback(_as_function(d), self.context)
        self._call("add_offset", body._live(), low, high, callback, None, resolution,
                   _one_tag(tag, tags))
        self._callbacks.append(callback)
        return self

    def set_corner_angle(self, corner_angle: float) -> Domain:
        """Sets the corner angle of the graphs of a domain in the plane (`add_pslg`, `read_poly`,
        `parse_poly`), both of those added already and of later ones. Corners are vertices where the
        direction turns by more than this angle in degrees, where segments of different tags or
        other than two segments end, and vertices with a tag of their own. Nodes lie on corners.
        Between corners a graph represents a smooth curve, with nodes spaced by d. With 0, the
        default, every vertex becomes a node."""
        return self._call("set_corner_angle", corner_angle)

    def set_snap(self, length: float) -> Domain:
        """In the plane, sets the largest distance over which loose points are moved onto a curve
        or vertex that they miss: ends of open curves, ends of segments that join no other one,
        and fixed nodes. By default it is 1e-7 of the size of the domain, the longest side of its
        bounding box. `check` moves them, with a warning; set it before. With 0, none are moved.
        On a sphere none are moved. In space, with `set_fragment`, surfaces become one where they
        are no farther from each other, with the same warning: gaps between solids and thin
        overlaps are closed. Vertices within 16 times the length are then merged, and what is
        thinner is lost. By default no gaps are closed."""
        return self._call("set_snap", length)

    def simplify(self, d: Union[float, ArrayFunction], tolerance: float = 0.25,
                 smallest: float = 0.0) -> LeftOut:
        """Removes features smaller than d, such as those of coastlines, from the graphs and
        polylines of a domain in the plane. It removes vertices next to segments shorter than d, as
        long as the curve then passes them within `tolerance` times d. It also removes closed
        curves, such as islands and lakes, whose extent is less than `smallest` times d, where the
        extent is the longer side of the bounding box. No other vertex, fixed node or hole point
        changes to another side of a curve. Vertices are kept where curves meet or end, where tags
        change, where a vertex has a tag of its own, and at fixed nodes. All ranks must make the
        same call. If the call raises, the domain is unchanged.

        - `d`: a number, or a function as in `Placement.set_spacing`.
        - `tolerance`: at least 0.
        - `smallest`: at least 0; 0 removes no curve.

        Returns the numbers of removed vertices and curves as `LeftOut`."""
        vertices, curves = ctypes.c_int64(), ctypes.c_int64()
        self._call("simplify", spacing_callback(_as_function(d), self.context), None, tolerance,
                   smallest, ctypes.byref(vertices), ctypes.byref(curves))
        return LeftOut(vertices.value, curves.value)

    def simplify_by_file(self, path: Path, field: Optional[str] = None, tolerance: float = 0.25,
                         smallest: float = 0.0) -> LeftOut:
        """Removes features as `simplify` does, with a spacing from a file with values at points,
        as in `Placement.set_spacing_file`. Returns a `LeftOut`. Raises `Status.ERROR_FILE` if
        the file cannot be read, and `Status.ERROR_SPACING` for values that are zero, negative or
        not finite."""
        vertices, curves = ctypes.c_int64(), ctypes.c_int64()
        self._call("simplify_by_file", os.fsencode(path), None if field is None else field.encode(),
                   tolerance, smallest, ctypes.byref(vertices), ctypes.byref(curves))
        return LeftOut(vertices.value, curves.value)

    def tag_outline(self, where: ArrayFunction, tag: int) -> int:
        """Gives a tag to those parts of the boundary around a domain in the plane or on a sphere
        that a function selects, such as the open boundary of a sea where it is deep. Boundaries
        around holes, such as islands, keep their tags. Segments are selected by their middles, arcs
        and general curves as wholes. Nodes are placed where the tag changes. All ranks must make the
        same call.

        - `where`: a function `where(x)` that receives points of shape (n, 2), on a sphere (n, 3),
          and returns n truth values. It is called only now.

        Returns the number of segments and curves that it selects. Raises `Status.ERROR_DOMAIN` if
        `check` does."""
        count = ctypes.c_int64()
        callback = level_set_callback(
            lambda x: np.where(np.asarray(where(x), dtype=bool), -1.0, 1.0), self.context)
        self._call("tag_outline", callback, None, tag, ctypes.byref(count))
        return count.value

    def set_filled(self, filled: bool) -> Domain:
        """Sets whether a domain in space is the volume enclosed by its surfaces, which is the
        default. With False it is the surfaces alone: nodes lie on them, triangles join these nodes,
        and there is no interior."""
        return self._call("set_filled", bool(filled))

    def set_repair(self, resolution: float = 0.0) -> Domain:
        """Repairs the triangulated boundary surfaces of a domain in space that enclose one body
        imperfectly: open, crossing, folded or inconsistently oriented. Sound surfaces do not
        change, and a warning reports that nothing is repaired. The body is the set of points around
        which the surfaces wind more than half a time, in either orientation. Holes are closed,
        overlapping bodies are joined, and surfaces that enclose nothing are removed. The surface of
        the body is extracted as that of a level set, with its sharp edges. All of it has the tag of
        the first triangle. A warning reports its distance from the given triangles. Features
        thinner than the resolution can be lost.

        - `resolution`: at least 0, and no more than the spacing at the surface. 0 stands for 1/64
          of the longest side of the bounding box of the triangles.

        `check` raises `Status.ERROR_DOMAIN` if the triangles enclose nothing."""
        return self._call("set_repair", float(resolution))

    def set_resurfaced(self, resolution: float = 0.0) -> Domain:
        """Replaces the triangulated boundary surfaces of a domain in space as `set_repair` does,
        even if they need no repair. This removes features of the body that are smaller than the
        resolution. The last call of `set_repair` or `set_resurfaced` is effective.

        - `resolution`: at least 0, and no more than the spacing at the surface. 0 stands for 1/64
          of the longest side of the bounding box of the triangles."""
        return self._call("set_resurfaced", float(resolution))

    def set_fragment(self, overlap: str = "last") -> Domain:
        """Splits the curves or surfaces of a domain where they cross, touch or lie on each other,
        so that several solids, sheets and curves become regions of one domain with common nodes and
        facets. The domain is what any solid contains. Curves and surfaces that enclose nothing lie
        inside of it, and their parts outside are left out. The first of several curves or triangles
        that lie on each other gives the tag. The k-th solid, counted from 1 in the order in which
        they are added (groups by tag), gives its elements the region tag k. `add_region` sets other
        tags, and `add_hole` removes regions.

        In space each box, ball, cylinder and level set is a solid, and so is each closed group of
        an added surface, which are its triangles with one tag: a solid contains the points around
        which it winds, so triangles of a cavity are oriented into it. The other triangles of a
        surface enclose a further solid. Surfaces with the role "inner" are no solids. Without this
        call, surfaces that touch are accepted if no solids overlap and each surface ends on others,
        as for stacked boxes and for a sheet from side to side of a box. Gaps up to the length of
        `set_snap` are closed.

        In the plane each closed boundary curve is a solid, and so are boundary curves that are
        joined at their ends to a closed one. It is a cavity if the solid before it encloses it and
        runs around in the other direction. Each closed group of a graph, which are its segments
        with one tag, is a solid, and the rest of what the graph encloses is a further one. Without
        this call, curves that touch, also along common edges, are accepted if no solids overlap.
        Excludes `set_repair`. Not on a sphere.

        - `overlap`: the region tag where solids overlap: "last" or "first", that of the solid added
          last or first, or "own", one for each combination of solids, following those of the
          solids."""
        if overlap not in _interface.OVERLAPS:
            raise ValueError(f'overlap is {overlap!r}, expected "last", "first" or "own"')
        return self._call("set_fragment", _interface.OVERLAPS[overlap])

    def set_periodic(self, low: ArrayLike, high: ArrayLike,
                     periodic: Union[bool, Sequence[bool]] = True,
                     tags: Optional[ArrayLike] = None,
                     flat: Union[bool, Sequence[bool]] = False) -> Domain:
        """Makes the domain a box that repeats itself along some axes. It has no boundary across
        these axes: bubbles on both sides of a seam act on each other. The other sides of the box
        are boundaries. Closed curves and surfaces are holes and cavities or, with the role "inner"
        or as fragments, inclusions. They are given once, stand for all their copies, and may extend
        beyond a periodic side. The spacing is evaluated at points of the box only, and continued
        with its periods.

        Nodes lie in the box, low <= x < high along a periodic axis. Results have the images of
        nodes near the box as ghosts, on a single rank as well: an image has the id of its node, and
        its coordinates differ from those of the node by whole periods. Adjacency lists and elements
        refer to images, so an element at a seam has its true shape, and no element occurs twice.

        Coordinates along a periodic axis, and the period, are rounded to multiples of 2**-50 times
        the largest coordinate of an image. Not on a sphere, nor for surfaces alone, level sets and
        inner curves in space. Not yet for a periodic domain, but `Status.ERROR_UNSUPPORTED`: files with
        elements of second order, distributed meshes, Voronoi cells, particles and cracks.

        - `periodic`: True for all axes, or a value for each axis.
        - `tags`: those of the sides that are not periodic or are flat, low x, high x, low y and so
          on; one for all sides or one for each. The default is 1.
        - `flat`: True, or a value for each axis: no element crosses the sides across a periodic
          axis, nodes lie on them, and opposite sides have the same facets, as solvers need that
          work on a box. In the plane curves may cross such sides, and each part of a region that
          they divide needs a point of its own. In space surfaces must not cross them, and all
          periodic axes or none are flat.

        `Placement.run` raises `Status.ERROR_SPACING` if a period is shorter than four spacings."""
        axes = np.broadcast_to(np.asarray(periodic, dtype=bool), self.dim)
        axes = axes * np.where(flat, _interface.FLAT, _interface.PERIODIC).astype(np.int32)
        return self._call("set_periodic", as_point(low, self.dim, "low"),
                          as_point(high, self.dim, "high"), np.ascontiguousarray(axes),
                          as_tags(tags, 2 * self.dim, "tags"))

    # ------------------------------------------------------------ files and tags ---------------

    def read_msh(self, path: Path, feature_angle: float = 40.0) -> Domain:
        """Reads a mesh in Gmsh's MSH format and adds its boundary. In the plane the boundary
        consists of lines and edges, in space of triangles; physical groups become tags. Sheets and
        lines inside become inner surfaces and curves, and points become fixed nodes.
        `feature_angle` in degrees is that of `add_surface`, in the plane the `corner_angle` of
        `add_polyline`. Raises `Status.ERROR_FILE` with file, line or byte, and what was expected.
        """
        return self._call("read_msh", os.fsencode(path), feature_angle)

    def set_role(self, tag: int, role: Role) -> Domain:
        """Sets the role of all triangles with a tag in a domain in space. It overrides the role
        with which they are added, before or after this call. Checking the domain fails if no
        triangle has the tag."""
        return self._call("set_role", tag, _role_number(role))

    def set_tag_name(self, dim: int, tag: int, name: str) -> Domain:
        """Sets the name of a tag, for files with physical groups. `dim` is the dimension of the
        entity with the tag: 0 for points, 1 for curves, 2 for surfaces, 3 for bodies."""
        return self._call("set_tag_name", dim, tag, name.encode())

    def tag_names(self) -> Dict[Tuple[int, int], str]:
        """Returns the names of tags, set or from files, as {(dim, tag): name}."""
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
        """Removes the region around a point from the domain, up to the next curves or surfaces of
        either role."""
        return self._call("add_hole", as_point(point, self.dim, "point"))

    def add_region(self, point: ArrayLike, tag: int) -> Domain:
        """Gives a tag to the region around a point, up to the next curves or surfaces of either
        role. Elements in the region have this tag (`Placement.element_tags`, `Placement.mesh`),
        also in files. Inner curves and surfaces thus divide a domain into materials. Elements of
        regions without a point have the tag 0.

        `check` raises `Status.ERROR_DOMAIN` if the point lies outside the domain, on a curve or
        surface, or in a region with another tag."""
        return self._call("add_region", as_point(point, self.dim, "point"), tag)

    def add_fixed_nodes(self, coordinates: ArrayLike, tags: Optional[ArrayLike] = None, *,
                        tag: Optional[int] = None) -> Domain:
        """Adds fixed nodes, which keep their exact coordinates. They must lie inside the domain or
        on a vertex of its curves or surfaces. `coordinates` has the shape (n, dim), and `tags` is
        one for all nodes or one for each; `tag` is another name for one."""
        points = as_points(coordinates, self.dim, "coordinates")
        return self._call("add_fixed_nodes", len(points), points,
                          as_tags(_tags_or_tag(tags, tag), len(points), "tags"))

    # ------------------------------------------------------------ queries ----------------------

    def check(self) -> Domain:
        """Checks the whole geometry: duplicate vertices, crossings, boundaries that do not close,
        hole points outside, fixed nodes outside or too close. Placements check it, too; an early
        check adds no cost. Raises `Status.ERROR_DOMAIN` with the vertex, segment or triangle."""
        return self._call("check")

    def bounds(self) -> Tuple[Doubles, Doubles]:
        """Returns the corners (low, high) of the bounding box of the curves or surfaces."""
        low, high = np.zeros(self.dim), np.zeros(self.dim)
        self._call("bounds", low, high)
        return low, high

    def measure(self) -> float:
        """Returns the area of the inside, in space its volume, or the area of surfaces alone.
        Checks the domain first."""
        inside = ctypes.c_double()
        self._call("measure", ctypes.byref(inside))
        return inside.value

    def distance(self, coordinates: ArrayLike, tag: int = 0) -> Doubles:
        """Evaluates the distances of points from the boundary of the domain, or from the curves,
        surfaces or nodes with a tag. The first query after a change of the domain builds a search
        tree. If a callback queries distances, query one before the run.

        - `coordinates`: the points, of shape (n, dim).
        - `tag`: 0 stands for the boundary of the domain.

        Returns n distances. Raises `Status.ERROR_ARGUMENT` if nothing has the tag."""
        points = as_points(coordinates, self.dim, "coordinates")
        distances = np.zeros(len(points))
        self._call("distance", tag, len(points), points, distances)
        return distances

    def regions_at(self, coordinates: ArrayLike, columns: int = 1) -> Int32s:
        """Returns the region tags at points of shape (n, dim) (`add_region`, `set_fragment`), for
        use in a spacing callback: 0 where a region has no tag, and outside of the domain the tag of
        the region behind the nearest point of the boundary. A point within 1e-6 of the size of the
        domain from interfaces lies in the regions on both sides: use the least d of these, because
        nodes on interfaces lie on one side or the other by rounding. If a callback queries regions,
        query them once before the run. Raises `Status.ERROR_ARGUMENT` if no region of the domain
        has a tag.

        - `columns`: tags at each point.

        Returns tags of shape (n, columns), for one column of shape (n,): first of the region that
        contains the point, then of others at interfaces, and the first one again where there are
        fewer."""
        points = as_points(coordinates, self.dim, "coordinates")
        tags = np.zeros((len(points), max(columns, 1)), np.int32)
        self._call("regions_at", len(points), points, columns, tags)
        return tags[:, 0] if columns == 1 else tags

    def shape_spacing(self, coordinates: ArrayLike, nodes_per_turn: float = 0.0,
                      nodes_across: float = 0.0, nodes_per_edge: float = 0.0,
                      growth: float = 0.0) -> Doubles:
        """Evaluates the spacing that `Placement.set_spacing_from_shape` sets, without its bounds,
        at points of shape (n, dim), and returns n values. The other arguments are those of that
        method. The first query computes what the shape requires. If a callback queries this
        spacing, query it once before the run."""
        points = as_points(coordinates, self.dim, "coordinates")
        d = np.zeros(len(points))
        self._call("shape_spacing", nodes_per_turn, nodes_across, nodes_per_edge, growth,
                   len(points), points, d)
        return d

    def outline(self) -> Outline:
        """Returns an `Outline` of the curves of a domain in the plane or on a sphere, for pictures.
        `segments` has the shape (n, 2, dim) and holds the ends of straight segments that
        approximate the curves; `tags` are the tags of the curves."""
        count = ctypes.c_int64()
        self._call("get_segments", 0, ctypes.byref(count), None, None)
        segments = np.zeros((count.value, 2, self.dim))
        tags = np.zeros(count.value, dtype=np.int32)
        self._call("get_segments", count.value, ctypes.byref(count), segments, tags)
        return Outline(segments, tags)


def sphere_points(radius: float, degrees: ArrayLike) -> Doubles:
    """Computes points on a sphere about the origin, of shape (n, 3), from longitude and latitude.
    Local.

    - `radius`: greater than 0.
    - `degrees`: longitudes, which may exceed a full turn, and latitudes from -90 to 90, of shape
      (n, 2)."""
    places = as_points(degrees, 2, "degrees")
    points = np.zeros((len(places), 3))
    check_without_context(library().pnpbs_sphere_points(radius, len(places), places, points))
    return points


def sphere_degrees(coordinates: ArrayLike) -> Doubles:
    """Computes longitudes, from -180 to 180, and latitudes, from -90 to 90, of the directions of
    points. `coordinates` has the shape (n, 3), without points at 0. Returns an array of shape (n,
    2). Local."""
    points = as_points(coordinates, 3, "coordinates")
    degrees = np.zeros((len(points), 2))
    check_without_context(library().pnpbs_sphere_degrees(len(points), points, degrees))
    return degrees

# SPDX-License-Identifier: BSD-3-Clause
"""Placements: the nodes in a domain, and how they are computed."""

from __future__ import annotations

import contextlib
import ctypes
import os
import warnings
from typing import Any, Iterator, List, NamedTuple, Optional, Set, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import as_indices, as_point, as_points
from ._callbacks import monitor_callback, spacing_callback
from ._interface import library
from ._progress import ProgressBar
from ._summaries import counted
from ._types import ArrayFunction, Doubles, Monitor, OptionValue, Path
from ._warnings import warning_class
from .context import _set_option
from .domain import Domain
from .errors import Status
from .fields import Fields
from .mesh import Meshes
from .results import Results
from .voronoi import Tessellation


class Estimate(NamedTuple):
    nodes: int
    bytes: int
    seconds: float


class PopulationChange(NamedTuple):
    inserted: int
    deleted: int


def _keep_going(fraction: float, step: int, nodes: int, max_speed: float) -> bool:
    return False


class Placement(Results, Fields, Meshes, Tessellation):
    """A placement of nodes in a domain, on the domain's context. Keywords are options, as in `set`;
    the others are those of the context. Set a spacing (`set_spacing`), then `run`. Collective.

    Ctrl-C ends a computation within a second or two with a `KeyboardInterrupt`; the nodes are then
    as if a monitor had stopped the run, which is what it returns on the other ranks.

    `initialise`, `run` and `step` issue the library's warnings as Python's, each once: classes
    derived from `PNPBSWarning`, such as `SpacingWarning`. On several ranks all issue them."""

    def __init__(self, domain: Domain, **options: OptionValue) -> None:
        super().__init__()
        self.context = domain.context
        self.domain = domain
        handle = ctypes.c_void_p()
        self.context._check(library().pnpbs_placement_create(
            self.context._live(), domain._live(), ctypes.byref(handle)))
        self._handle = handle.value
        self.context._children.append(self)
        self._warned: Set[str] = set()
        # Kept alive: the library holds their addresses. The nodes there are remember the spacing
        # that they were placed with, so one that is replaced is needed until the next run.
        self._spacing: Any = None
        self._spacings_before: List[Any] = []
        self._monitor: Any = None
        self._monitor_function: Optional[Monitor] = None
        try:
            self.set_monitor(None)
            self.set(**options)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Releases the resources of the library. Closing twice is allowed. Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_placement_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        if not self.is_open:
            return "<pnpbs.Placement, closed>"
        return f"<pnpbs.Placement, {self.dim}D, {counted(self.node_count, 'node')} on this rank>"

    # ------------------------------------------------------------ what is wanted ---------------

    def set(self, **options: OptionValue) -> Placement:
        """Sets options by name, as in `placement.set(steps=60, method="paper")`. Local. Unknown names
        and values out of range raise a `PNPBSError` that names the nearest option or the range.
        `pnpbs.option_table()` lists them."""
        for key, value in options.items():
            self.context._check(_set_option("placement", self._live(), key, value))
        return self

    def set_spacing(self, d: Union[ArrayFunction, ArrayLike], origin: Optional[ArrayLike] = None,
                    step: Optional[ArrayLike] = None) -> Placement:
        """Sets the node spacing d(x), the requested distance between neighbouring nodes near x. On
        a placement that has nodes it replaces the spacing: the nodes are kept, and the next run
        starts from them. Collective.

        - A number: constant spacing.
        - A function: `d(x)` gets points, (n, dim), and returns n values. It must always return the
          same value for the same point. It is called with different points on different ranks, so
          it must do nothing collective. An exception that it raises is raised by the call in
          progress.
        - An array of `dim` dimensions with `origin` and `step`: values on a rectangular grid whose
          first point is `origin`, with distances `step`; the first index goes along x. Linear
          between grid points, constant beyond the grid's edge. On a sphere the grid has two
          dimensions, longitude and latitude in degrees; columns all around are joined.
        - An array of one dimension: values at the nodes of this rank, in the order of `nodes`;
          linear on each triangle or tetrahedron of their triangulation."""
        callback = None
        if callable(d):
            callback = spacing_callback(d, self.context)
            self._call("set_spacing_callback", callback, None)
        elif np.asarray(d).dtype.kind not in "fiu":
            raise TypeError(f"d is {d!r}: a number, a function or an array of real numbers was "
                            "expected; for a spacing from the shape use set_spacing_from_shape")
        elif np.ndim(d) == 0:
            self._call("set_spacing_constant", d)
        elif origin is not None or step is not None:
            self._set_spacing_grid(d, origin, step)
        elif np.ndim(d) > 1:
            raise ValueError(f"d has shape {np.shape(d)}: values at nodes have one dimension, and "
                             "values on a grid come with origin and step")
        else:
            # A wrong length is the library's to find: it tells all ranks.
            values = np.ascontiguousarray(d, np.float64).reshape(-1)
            self._call("set_spacing_at_nodes", len(values), values)
        return self._keep_spacing(callback)

    def _keep_spacing(self, callback: Any) -> Placement:
        if self._spacing is not None:
            self._spacings_before.append(self._spacing)
        self._spacing = callback
        return self

    def set_spacing_mesh(self, points: ArrayLike, d: ArrayLike, corners: ArrayLike) -> Placement:
        """Sets the spacing to values `d` at the nodes of a background mesh, the rows of `points`.
        It is linear on each element, and beyond the mesh equal to the value at the nearest point of
        the mesh. `corners` is (m, dim + 1), on a sphere (m, 3), indices of rows: triangles, in
        space tetrahedra. Collective; every rank passes the same arrays, and holds a copy."""
        coordinates, values = self._field(points, d)
        elements = as_indices(corners, self._extent_of_elements + 1, "corners")
        self._call("set_spacing_mesh", len(values), coordinates, values, len(elements), elements)
        return self._keep_spacing(None)

    def set_spacing_points(self, points: ArrayLike, d: ArrayLike) -> Placement:
        """Sets the spacing to values `d` at scattered points, the rows of `points`. It equals the
        given value at each point and elsewhere a weighted mean of the values of the 8 (in space 16)
        nearest points, of which those behind others count less or not at all; on a sphere, with
        ways along it. Collective; every rank passes the same arrays, and holds a copy."""
        coordinates, values = self._field(points, d)
        self._call("set_spacing_points", len(values), coordinates, values)
        return self._keep_spacing(None)

    def set_spacing_file(self, path: Path, field: Optional[str] = None) -> Placement:
        """Sets the spacing to values at points from a file: VTK's unstructured grid (.vtu), Gmsh's
        mesh with values at nodes (.msh), or a table with columns x, y, (z) and others (.csv).
        Triangles and quadrangles, in space tetrahedra, form a mesh as in `set_spacing_mesh`;
        without any, the points are used as in `set_spacing_points`. In the plane z is ignored; on a
        sphere elements are as in the plane.
        `field` is the name of the values in the file; the default is the only ones, or those called
        "spacing". Collective; every rank reads the file."""
        self._call("set_spacing_file", os.fsencode(path),
                   None if field is None else field.encode())
        return self._keep_spacing(None)

    @property
    def _extent_of_elements(self) -> int:
        """2 for triangles, also on a sphere."""
        return 2 if self.sphere_radius > 0 else self.dim

    def _field(self, points: ArrayLike, d: ArrayLike) -> Tuple[Doubles, Doubles]:
        coordinates = as_points(points, self.dim, "points")
        values = np.ascontiguousarray(d, np.float64)
        if values.shape != (len(coordinates),):
            raise ValueError(f"d has shape {values.shape}; ({len(coordinates)},) was expected")
        return coordinates, values

    def set_spacing_from_shape(self, nodes_per_turn: float = 0.0, nodes_across: float = 0.0,
                               nodes_per_edge: float = 0.0, growth: float = 0.0,
                               min_spacing: float = 0.0, max_spacing: float = 0.0) -> Placement:
        """Sets the spacing from the shape of the domain: the minimum of what its curves and
        surfaces require, each value growing with the distance from them by `growth` (0: 0.15),
        between `min_spacing` and `max_spacing` (0: no bound). Collective.

        - `nodes_per_turn`, by curvature: nodes on a full circle of the radius of curvature.
        - `nodes_across`, by width: d at a boundary point is the diameter of the largest ball that
          touches the boundary there and meets nothing ahead, divided by this.
        - `nodes_per_edge`, by the input: d is the length of a segment, or the mean edge length of a
          triangle, divided by this.

        Zero arguments are not used."""
        self._call("set_spacing_from_shape", nodes_per_turn, nodes_across, nodes_per_edge, growth,
                   min_spacing, max_spacing)
        return self._keep_spacing(None)

    def _set_spacing_grid(self, d: ArrayLike, origin: Optional[ArrayLike],
                          step: Optional[ArrayLike]) -> None:
        directions = self._extent_of_elements
        if np.ndim(d) != directions:
            raise ValueError(f"d has shape {np.shape(d)}; an array of {directions} dimensions was "
                             "expected")
        if origin is None or step is None:
            raise ValueError("values on a grid take both an origin and a step")
        # The library's first index runs fastest.
        values = np.ascontiguousarray(np.asarray(d, np.float64).T)
        self._call("set_spacing_grid", np.array(np.shape(d), np.int64),
                   as_point(origin, directions, "origin"), as_point(step, directions, "step"),
                   values)

    def set_monitor(self, monitor: Optional[Monitor]) -> Placement:
        """Calls `monitor(fraction, step, nodes, max_speed)` from time to time during a run. While
        the first nodes are laid, or the growth of the spacing is limited, `fraction` is 0 and each
        rank calls it by its own clock: do nothing collective then. When it returns True, the run
        ends early with valid nodes and `Status.STOPPED`. None removes the monitor. Local."""
        # The library's monitor stays: it is where Ctrl-C acts.
        callback = monitor_callback(_keep_going if monitor is None else monitor, self.context)
        self._call("set_monitor", callback, None)
        self._monitor, self._monitor_function = callback, monitor
        return self

    @contextlib.contextmanager
    def _progress_shown(self) -> Iterator[None]:
        """Shows a progress bar in the block, beside the monitor that is set."""
        before = self._monitor_function
        with ProgressBar() as bar:

            def monitor(*state: Any) -> object:
                bar(*state)
                return before(*state) if before is not None else False

            self.set_monitor(monitor)
            try:
                yield
            finally:
                self.set_monitor(before)

    def set_nodes(self, coordinates: ArrayLike, ids: Optional[ArrayLike] = None) -> Placement:
        """Sets inner nodes to start from instead of the initial fill: the rows of `coordinates`, on
        any ranks, with distinct global ids from 0 if `ids` are given. The library places the
        boundary nodes. Clears the current nodes. Collective."""
        points = as_points(coordinates, self.dim, "coordinates")
        given = None if ids is None else np.ascontiguousarray(ids, np.int64)
        wrong = None if given is None or given.shape == (len(points),) else given.shape
        # Where the ids are too many or too few on one rank, the library hears of it, and so do the
        # other ranks, which would wait otherwise.
        code = library().pnpbs_placement_set_nodes(self._live(), len(points) if wrong is None else -1,
                                                   points, given)
        if wrong is not None:
            raise ValueError(f"ids has shape {wrong}; ({len(points)},) was expected")
        self.context._check(code)
        return self

    # ------------------------------------------------------------ running ----------------------

    def estimate(self) -> Estimate:
        """Estimates a run from scratch, from domain, spacing and options alone: the number of nodes
        on all ranks, mostly within a few percent, the memory of each process for the run alone, and
        roughly the time in seconds. Collective."""
        nodes, size, seconds = ctypes.c_int64(), ctypes.c_int64(), ctypes.c_double()
        self._call("estimate", ctypes.byref(nodes), ctypes.byref(size), ctypes.byref(seconds))
        return Estimate(nodes.value, size.value, seconds.value)

    def initialise(self) -> Placement:
        """Checks domain and spacing and lays the nodes that the simulation starts from. `run` and
        `step` do this if necessary. Collective."""
        self._call("initialise")
        self._warned.clear()
        self._warn()
        return self

    def run(self, progress: bool = False) -> Status:
        """Runs the whole placement. A later run, for example after another spacing, starts from the
        current nodes. See `Status` for the outcomes. Collective.

        With `progress` a bar shows how far it is: tqdm's, if that is installed, otherwise one of
        text, on standard error. On several ranks, give it on one: `progress=comm.rank == 0`."""
        with self._progress_shown() if progress else contextlib.nullcontext():
            outcome = self._call("run")
        self._spacings_before.clear()
        self._warn()
        return outcome

    def step(self, n: int = 1) -> Status:
        """Advances the simulation by n steps. The outcome is as in `run`, `Status.OK` if the
        bubbles are at rest. Collective."""
        outcome = self._call("step", n)
        self._warn()
        return outcome

    def _warn(self) -> None:
        """Issues the warnings that have not been issued since `initialise`."""
        for data in self.warning_data():
            if data.text not in self._warned:
                self._warned.add(data.text)
                warnings.warn(warning_class(data.code)(data), stacklevel=3)

    def adjust_population(self) -> PopulationChange:
        """Performs one population adjustment: deletes nodes where they are too dense and inserts
        nodes where they are too sparse. Collective."""
        inserted, deleted = ctypes.c_int64(), ctypes.c_int64()
        self._call("adjust_population", ctypes.byref(inserted), ctypes.byref(deleted))
        return PopulationChange(inserted.value, deleted.value)

    def rebalance(self) -> Placement:
        """Repartitions the work over the ranks. The nodes are unchanged; their owners change. A run
        does this by itself where it pays. Collective."""
        self._call("rebalance")
        return self

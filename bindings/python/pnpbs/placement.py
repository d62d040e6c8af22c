# SPDX-License-Identifier: BSD-3-Clause
"""Placements: the nodes in a domain, and the runs that compute them."""

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
from ._warnings import PNPBSWarning, WarningCode, WarningData, warning_class
from .context import _set_option
from .domain import Domain
from .errors import OutcomeError, Status
from .fields import Fields
from .mesh import Meshes
from .mesh_conversions import write_meshio
from .results import Results
from .voronoi import Tessellation


class Estimate(NamedTuple):
    """An estimate of a run: number of nodes on all ranks, bytes of memory of each process, and
    seconds."""

    nodes: int
    bytes: int
    seconds: float


class PopulationChange(NamedTuple):
    """Numbers of inserted and deleted nodes on all ranks."""

    inserted: int
    deleted: int


def _keep_going(fraction: float, step: int, nodes: int, max_speed: float) -> bool:
    """A monitor that does not stop the run."""
    return False


class Placement(Results, Fields, Meshes, Tessellation):
    """A placement of nodes in a domain, on the context of the domain. Set a spacing with
    `set_spacing`, then call `run`. The creation is collective.

    - `domain`: the domain, which is read when the placement is initialised.
    - `**options`: options by name, as in `set`. Other options have the values of the context.

    Ctrl-C ends a computation within a second or two with a `KeyboardInterrupt`. The nodes are then
    those of a run that a monitor has stopped, and the other ranks return `Status.STOPPED`.

    `initialise`, `run` and `step` issue the warnings of the library as warnings of Python, each
    once, on all ranks. Their classes derive from `PNPBSWarning`, such as `SpacingWarning`."""

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
        # The library holds the addresses of callbacks, so they must live. The current nodes refer
        # to the spacing with which they were placed, so a replaced one lives until the next run.
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
        """Releases the resources of the library. Repeated calls have no effect. Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_placement_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        if not self.is_open:
            return "<pnpbs.Placement, closed>"
        return f"<pnpbs.Placement, {self.dim}D, {counted(self.node_count, 'node')} on this rank>"

    # ------------------------------------------------------------ settings ---------------------

    def set(self, **options: OptionValue) -> Placement:
        """Sets options by name, as in `placement.set(steps=60, method="paper")`, and returns the
        placement. `pnpbs.option_table()` lists the options. Local.

        Raises `Status.ERROR_KEY` for an unknown name, with the nearest known one, and
        `Status.ERROR_ARGUMENT` for a value out of range, with the range."""
        for key, value in options.items():
            self.context._check(_set_option("placement", self._live(), key, value))
        return self

    def set_spacing(self, d: Union[ArrayFunction, ArrayLike], origin: Optional[ArrayLike] = None,
                    step: Optional[ArrayLike] = None) -> Placement:
        """Sets the spacing d(x), the requested distance between neighbouring nodes near x, and
        returns the placement. If the placement has nodes, it keeps them, and the next run starts
        from them. Collective.

        - `d`: a number is a constant spacing.
        - `d`: a function `d(x)` receives points of shape (n, dim) and returns n values. It must be
          pure. Ranks call it with different points, so it must do nothing collective. The placement
          keeps it. An exception that it raises is raised by the call in progress.
        - `d`: an array of `dim` dimensions, with `origin` and `step`, has the values on a
          rectangular grid; the first index runs along x. The spacing is linear between grid points
          and constant beyond the edge. On a sphere the grid has two dimensions, longitude and
          latitude in degrees; columns all around the sphere are joined.
        - `d`: an array of one dimension has the values at the nodes of this rank, in the order of
          `nodes`. The spacing is linear on each triangle or tetrahedron of their triangulation.
        - `origin`: the first point of the grid.
        - `step`: distance between grid points in each direction, greater than 0.

        Arrays are copied. Raises `Status.ERROR_SPACING` for values that are zero, negative or not
        finite; those of a function raise in `initialise` or `run`."""
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
            # The library checks the length, because it reports errors on all ranks.
            values = np.ascontiguousarray(d, np.float64).reshape(-1)
            self._call("set_spacing_at_nodes", len(values), values)
        return self._keep_spacing(callback)

    def _keep_spacing(self, callback: Any) -> Placement:
        """Keeps the callback of the current spacing alive, and those of earlier ones until the next
        run."""
        if self._spacing is not None:
            self._spacings_before.append(self._spacing)
        self._spacing = callback
        return self

    def set_spacing_mesh(self, points: ArrayLike, d: ArrayLike, corners: ArrayLike) -> Placement:
        """Sets the spacing to values at the nodes of a background mesh, and returns the placement.
        It is linear on each element. Beyond the mesh it is equal to the value at the nearest point
        of the mesh. Every rank passes the same arrays and stores a copy. Collective.

        - `points`: the nodes of the mesh, of shape (n, dim).
        - `d`: n values.
        - `corners`: indices of nodes, from 0: triangles, of shape (m, 3), in the plane and on a
          sphere, tetrahedra, of shape (m, 4), in space.

        Raises `Status.ERROR_SPACING` for values that are zero, negative or not finite, and
        `Status.ERROR_ARGUMENT` for an index out of range, a flat element, or arrays that differ
        between ranks."""
        coordinates, values = self._field(points, d)
        elements = as_indices(corners, self._extent_of_elements + 1, "corners")
        self._call("set_spacing_mesh", len(values), coordinates, values, len(elements), elements)
        return self._keep_spacing(None)

    def set_spacing_points(self, points: ArrayLike, d: ArrayLike) -> Placement:
        """Sets the spacing to values at scattered points, and returns the placement. It equals the
        given value at each point. Elsewhere it is a weighted mean of the values of the 8 (in space
        16) nearest points, in which points behind others count less or not at all. On a sphere
        distances are along it. Every rank passes the same arrays and stores a copy. Collective.

        - `points`: the points, of shape (n, dim).
        - `d`: n values.

        Raises `Status.ERROR_SPACING` for values that are zero, negative or not finite, and for
        coincident points with different values."""
        coordinates, values = self._field(points, d)
        self._call("set_spacing_points", len(values), coordinates, values)
        return self._keep_spacing(None)

    def set_spacing_file(self, path: Path, field: Optional[str] = None) -> Placement:
        """Sets the spacing to values at points from a file, and returns the placement. Every rank
        reads the file. Collective.

        - `path`: an unstructured grid of VTK (.vtu), a mesh of Gmsh with values at nodes (.msh), or
          a table with columns x, y, (z) and others (.csv). Triangles and quadrangles, in space
          tetrahedra, form a mesh as in `set_spacing_mesh`; on a sphere elements are those of the
          plane. Without elements the points are used as in `set_spacing_points`. In the plane z is
          ignored.
        - `field`: the name of the values in the file. By default it is the only name, or "spacing".

        Raises `Status.ERROR_FILE` for a file that cannot be read, and for a missing field."""
        self._call("set_spacing_file", os.fsencode(path),
                   None if field is None else field.encode())
        return self._keep_spacing(None)

    @property
    def _extent_of_elements(self) -> int:
        """The dimension of elements of a background mesh: 2 for triangles, also on a sphere."""
        return 2 if self.sphere_radius > 0 else self.dim

    def _field(self, points: ArrayLike, d: ArrayLike) -> Tuple[Doubles, Doubles]:
        """Converts points and values. Raises ValueError for wrong shapes."""
        coordinates = as_points(points, self.dim, "points")
        values = np.ascontiguousarray(d, np.float64)
        if values.shape != (len(coordinates),):
            raise ValueError(f"d has shape {values.shape}; ({len(coordinates)},) was expected")
        return coordinates, values

    def set_spacing_from_shape(self, nodes_per_turn: float = 0.0, nodes_across: float = 0.0,
                               nodes_per_edge: float = 0.0, growth: float = 0.0,
                               min_spacing: float = 0.0, max_spacing: float = 0.0) -> Placement:
        """Sets the spacing from the shape of the domain, and returns the placement. It is the
        minimum of the values that curves and surfaces require, each growing with the distance from
        them. Collective.

        - `nodes_per_turn`: by curvature: number of nodes on a full circle of the radius of
          curvature.
        - `nodes_across`: by width: at a boundary point, d is the diameter of the largest ball that
          touches the boundary there and meets no other part of it ahead, divided by this number.
        - `nodes_per_edge`: by the input: d is the length of a segment, or the mean edge length of a
          triangle, divided by this number.
        - `growth`: growth of d per distance; 0 stands for 0.15.
        - `min_spacing`, `max_spacing`: bounds of d; 0 stands for no bound.

        The first three are not used if they are 0. Raises `Status.ERROR_DOMAIN` if the domain is
        invalid, and `Status.ERROR_ARGUMENT` for negative numbers."""
        self._call("set_spacing_from_shape", nodes_per_turn, nodes_across, nodes_per_edge, growth,
                   min_spacing, max_spacing)
        return self._keep_spacing(None)

    def _set_spacing_grid(self, d: ArrayLike, origin: Optional[ArrayLike],
                          step: Optional[ArrayLike]) -> None:
        """Sets the spacing to values on a grid."""
        directions = self._extent_of_elements
        if np.ndim(d) != directions:
            raise ValueError(f"d has shape {np.shape(d)}; an array of {directions} dimensions was "
                             "expected")
        if origin is None or step is None:
            raise ValueError("values on a grid take both an origin and a step")
        # In the library the first index runs fastest.
        values = np.ascontiguousarray(np.asarray(d, np.float64).T)
        self._call("set_spacing_grid", np.array(np.shape(d), np.int64),
                   as_point(origin, directions, "origin"), as_point(step, directions, "step"),
                   values)

    def set_monitor(self, monitor: Optional[Monitor]) -> Placement:
        """Sets a function `monitor(fraction, step, nodes, max_speed)` that is called from time to
        time during a run, and returns the placement. If it returns True, the run ends early with
        valid nodes and `Status.STOPPED`. `fraction` is the completed part of the call in progress,
        from 0 to 1, and `max_speed` is in spacings per unit time. While the first nodes are laid,
        or the growth of the spacing is limited, `fraction` is 0 and each rank calls the monitor by
        its own clock, so it must do nothing collective then. None removes the monitor. Local."""
        # The library always has a monitor, because Ctrl-C takes effect there.
        callback = monitor_callback(_keep_going if monitor is None else monitor, self.context)
        self._call("set_monitor", callback, None)
        self._monitor, self._monitor_function = callback, monitor
        return self

    @contextlib.contextmanager
    def _progress_shown(self) -> Iterator[None]:
        """Shows a progress bar inside the block, in addition to the monitor that is set."""
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

    def add_spacing_hints(self, coordinates: ArrayLike) -> Placement:
        """Adds points at which the spacing is sampled as well, the rows of `coordinates`, (n, dim).
        A function is sampled at some points of each cell of a tree, so a place with a small d that
        is much smaller than the cells around it may be missed: give one point in each such place.
        The points are used from the next `run` or `initialise` on, until another spacing is set.
        Points outside a body in space are ignored. Collective; each rank may pass other points,
        including none: an array of shape (0, dim)."""
        points = as_points(coordinates, self.dim, "coordinates")
        self._call("add_spacing_hints", len(points), points)
        return self

    def set_nodes(self, coordinates: ArrayLike, ids: Optional[ArrayLike] = None) -> Placement:
        """Sets inner nodes from which the simulation starts instead of the initial fill, and
        returns the placement. The library places the boundary nodes. The current nodes are removed.
        Collective.

        - `coordinates`: points of shape (n, dim), anywhere in the domain, different ones on each
          rank. They are copied. Points outside the domain or too close to its boundary are dropped.
          In a periodic domain each point stands for its image in the box.
        - `ids`: n distinct global ids from 0, or None for ids that the library chooses.

        Raises ValueError if the ids are no integers, or if their number differs from that of
        points."""
        points = as_points(coordinates, self.dim, "coordinates")
        given = None if ids is None else np.asarray(ids)
        wrong = given is not None and (given.shape != (len(points),) or
                                       (given.size > 0 and given.dtype.kind not in "iu"))
        numbers = None if given is None or wrong else np.ascontiguousarray(given, np.int64)
        # If the ids are wrong on one rank, an invalid call informs the library and thus the other
        # ranks, which otherwise block.
        code = library().pnpbs_placement_set_nodes(self._live(), -1 if wrong else len(points), points,
                                                   numbers)
        if given is not None and wrong:
            raise ValueError(f"ids has shape {given.shape} and type {given.dtype}; {len(points)} "
                             "integers were expected")
        self.context._check(code)
        return self

    # ------------------------------------------------------------ running ----------------------

    def estimate(self) -> Estimate:
        """Estimates a run from scratch, from domain, spacing and options alone. Returns the number
        of nodes on all ranks, mostly within a few percent, the memory in bytes of each process for
        the run alone, and the approximate time in seconds. The current nodes do not change.
        Collective."""
        nodes, size, seconds = ctypes.c_int64(), ctypes.c_int64(), ctypes.c_double()
        self._call("estimate", ctypes.byref(nodes), ctypes.byref(size), ctypes.byref(seconds))
        return Estimate(nodes.value, size.value, seconds.value)

    def initialise(self) -> Placement:
        """Checks domain and spacing, lays the nodes from which the simulation starts, and returns
        the placement. `run` and `step` do this if necessary. Collective.

        Raises `Status.ERROR_DOMAIN` or `Status.ERROR_SPACING` for an invalid domain or spacing, and
        `Status.ERROR_MEMORY` if the nodes that d requires do not fit into memory."""
        self._call("initialise")
        self._warned.clear()
        self._warn()
        return self

    def _write_by_meshio(self, path: Path) -> Status:
        mesh = self.mesh()
        if mesh.owned_nodes != mesh.all_nodes:
            raise ValueError(f"{os.fsdecode(path)!r} would be written by meshio, on one rank: write "
                             "a .vtu or .msh file and convert it")
        names = self.domain.tag_names() if self.domain.is_open else {}
        write_meshio(mesh.to_meshio(), path, names)
        return Status.OK

    def run(self, progress: bool = False, strict: bool = False) -> Status:
        """Runs the whole placement and returns its outcome (see `Status`). It initialises if
        necessary, simulates until the bubbles are at rest or the option `steps` is reached, and
        finishes. A later run, for example with another spacing, starts from the current nodes.
        Collective.

        - `progress`: whether to show a progress bar on standard error: that of tqdm, or one of text
          if tqdm is not installed. On several ranks, set it on one of them: `progress=comm.rank ==
          0`.
        - `strict`: whether to raise `OutcomeError`, on all ranks, unless the outcome is
          `Status.OK`. The nodes are kept.

        Raises the errors of `initialise`."""
        with self._progress_shown() if progress else contextlib.nullcontext():
            outcome = self._call("run")
        self._spacings_before.clear()
        self._warn()
        if outcome == Status.NOT_CONVERGED:
            text = "the bubbles have not come to rest; allow more steps (option steps)"
            warnings.warn(PNPBSWarning(WarningData(WarningCode.UNKNOWN, text, 0, None, None)), stacklevel=2)
        if strict and outcome != Status.OK:
            raise OutcomeError(outcome, [data.text for data in self.warning_data()])
        return outcome

    def step(self, n: int = 1) -> Status:
        """Advances the simulation by n steps. Initialises if necessary. Returns `Status.OK` if the
        bubbles are at rest, `Status.NOT_CONVERGED` if they still move, or `Status.STOPPED`.
        Collective."""
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
        nodes where they are too sparse. Initialises if necessary. Returns the numbers of inserted
        and deleted nodes. Collective."""
        inserted, deleted = ctypes.c_int64(), ctypes.c_int64()
        self._call("adjust_population", ctypes.byref(inserted), ctypes.byref(deleted))
        return PopulationChange(inserted.value, deleted.value)

    def rebalance(self) -> Placement:
        """Repartitions the work over the ranks and returns the placement. The nodes do not change,
        but their owners and the ghosts do. A run repartitions by itself if the imbalance exceeds
        the option `rebalance_above`. Collective."""
        self._call("rebalance")
        return self

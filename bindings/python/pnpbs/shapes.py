# SPDX-License-Identifier: BSD-3-Clause
"""Geographic shapes and grids: GeoJSON, shapefiles and other formats that GDAL reads, projected to
x and y. Their library, libpnpbs_geo, exists only if PNPBS was built with GDAL. It is opened by the
first call that needs it."""

from __future__ import annotations

import ctypes
import enum
import os
import pathlib
from typing import Any, List, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import as_points
from ._interface import declared, library
from ._levels import common_folder
from ._library import library_path
from ._types import Doubles, Path
from .context import Handle
from .domain import Domain
from .errors import PNPBSError, Status

# A test compares these declarations with pnpbs_geo.h.
DECLARATIONS = """
const char *pnpbs_geo_last_error(void);
const char *pnpbs_geo_build_info(void);
pnpbs_status pnpbs_geo_read(const char *path, const char *layer, const char *projection,
    const char *unit, const char *tag_field, pnpbs_geo_shapes *shapes);
pnpbs_status pnpbs_geo_read_regions(const char *path, const char *layer, const char *projection,
    const char *unit, const char *tag_field, const char *region_field, pnpbs_geo_shapes *shapes);
pnpbs_status pnpbs_geo_destroy(pnpbs_geo_shapes *shapes);
pnpbs_status pnpbs_geo_add_to_domain(pnpbs_geo_shapes shapes, pnpbs_context context,
    pnpbs_domain domain, double corner_angle);
pnpbs_status pnpbs_geo_counts(pnpbs_geo_shapes shapes, int64_t *vertices, int64_t *boundary,
    int64_t *inner, int64_t *points);
pnpbs_status pnpbs_geo_projection(pnpbs_geo_shapes shapes, const char **name, const char **unit,
    const char **proj, const char **wkt, const char **prj);
pnpbs_status pnpbs_geo_scale(pnpbs_geo_shapes shapes, double *least, double *greatest);
pnpbs_status pnpbs_geo_write_prj(pnpbs_geo_shapes shapes, const char *results);
pnpbs_status pnpbs_geo_to_degrees(pnpbs_geo_shapes shapes, int64_t n, double *coordinates);
pnpbs_status pnpbs_geo_from_degrees(pnpbs_geo_shapes shapes, int64_t n, double *coordinates);
const char *pnpbs_geo_explain(pnpbs_geo_shapes shapes, const char *message);
pnpbs_status pnpbs_geo_note_count(pnpbs_geo_shapes shapes, int32_t *count);
pnpbs_status pnpbs_geo_get_note(pnpbs_geo_shapes shapes, int32_t index, const char **note);
pnpbs_status pnpbs_geo_get_note_data(pnpbs_geo_shapes shapes, int32_t index, int32_t *code,
    int64_t *count);
pnpbs_status pnpbs_geo_grid_read(const char *path, const char *variable, const char *projection,
    const double *low, const double *high, pnpbs_geo_grid *grid);
pnpbs_status pnpbs_geo_grid_destroy(pnpbs_geo_grid *grid);
pnpbs_status pnpbs_geo_grid_values(pnpbs_geo_grid grid, int64_t n, const double *coordinates,
    double *values, int32_t *inside);
pnpbs_status pnpbs_geo_grid_slopes(pnpbs_geo_grid grid, double radius, int64_t n,
    const double *coordinates, double *slopes);
pnpbs_status pnpbs_geo_depth_spacing(int64_t n, const double *depths, const double *slopes,
    double nodes_per_wave, double period, double nodes_per_slope, double least_depth, double metres,
    double *d);
pnpbs_status pnpbs_geo_grid_extent(pnpbs_geo_grid grid, double *low, double *high);
"""

_SONAME = "libpnpbs_geo.so.0"
_opened: Optional[ctypes.CDLL] = None


def _library() -> ctypes.CDLL:
    """Returns the library of shapes with declared functions. The first call opens it. Raises
    ImportError if it does not exist."""
    global _opened
    if _opened is None:
        library()  # libpnpbs_geo calls libpnpbs, which must be opened first
        beside = common_folder(pathlib.Path(library_path())) / _SONAME
        try:
            opened = ctypes.CDLL(str(beside) if beside.exists() else _SONAME)
        except OSError as error:
            raise ImportError(f"the library that reads shapes could not be opened: {error}; it "
                              "exists only if PNPBS was built with GDAL") from error
        _opened = declared(opened, DECLARATIONS)
    return _opened


def _check(code: int) -> None:
    """Raises `PNPBSError` if a call has failed."""
    if code < 0:
        raise PNPBSError(Status(code), _library().pnpbs_geo_last_error().decode())


def _text(value: Optional[Path]) -> Optional[bytes]:
    """Encodes an optional text."""
    return None if value is None else os.fsencode(value)


def geo_build_info() -> str:
    """Returns the versions of GDAL and PROJ in use, one "name: version" per line. Local."""
    return str(_library().pnpbs_geo_build_info().decode())


class ShapeCounts(NamedTuple):
    """Numbers of entities that were read.

    - `vertices`: distinct positions, including those of points.
    - `boundary`, `inner`: curves, which are closed or lie between the vertices where curves meet.
    - `points`: fixed nodes."""
    vertices: int
    boundary: int
    inner: int
    points: int


class NoteCode(enum.IntEnum):
    """Codes of notes, as documented in the header `pnpbs_geo.h`, which also defines what is
    counted. Codes that this package does not have become `UNKNOWN`."""

    UNKNOWN = 0
    NO_GEOMETRY = 1
    HEIGHTS_LEFT_OUT = 2
    NEARLY_TOUCHING = 3
    NO_REFERENCE_SYSTEM = 4
    DEGREES_IN_PLANE = 5
    SCALE = 6
    SEGMENTS_RETAGGED = 7
    LINES_ALONG_BOUNDARY = 8
    SHARED_SEGMENTS_LEFT_OUT = 9
    WHOLE_SPHERE = 10
    LINES_LEFT_OUT = 11
    SEGMENTS_LEFT_OUT = 12

    @classmethod
    def _missing_(cls, value: object) -> NoteCode:
        return cls.UNKNOWN  # code of a newer library


class NoteData(NamedTuple):
    """A note as data: its code, its text, and the number of features, lines or segments it is
    about, or 0 if they are not counted."""

    code: NoteCode
    text: str
    count: int  # type: ignore[assignment]  # hides tuple.count


class Projection(NamedTuple):
    """A projection as texts, which are empty if the file does not define its coordinate system: a
    name, the unit of x and y, the PROJ string, WKT 2, and the content of a .prj file. `scale` is
    the range (least, greatest) of projected length over length on the Earth."""
    name: str
    unit: str
    proj: str
    wkt: str
    prj: str
    scale: Tuple[float, float]


class Shapes(Handle):
    """Shapes of one layer of a file, projected. All methods are local.

    Polygons bound a domain, lines and edges that neighbours share become inner curves, and points
    become fixed nodes. `pnpbs_geo.h` has the details.

    - `path`: a file, or anything else that GDAL opens.
    - `layer`: the name of the layer; None if the file has only one.
    - `projection`: a code ("EPSG:2180"), a PROJ string, WKT, or the path of a .prj file. "auto" is
      a projection chosen for the data, and "none" keeps the coordinates of the file.
      "sphere(LON,LAT)" is for domains on a sphere (`Domain.on_sphere`), with longitude and latitude
      of the point outside. By default longitude and latitude are projected as by "auto", and other
      coordinates are kept.
    - `unit`: "m" or "km"; None for the unit of the projection.
    - `tag_field`: the attribute that becomes the tag; None for the tag 1.
    - `region_field`: the attribute of polygons that becomes the tag of the elements in them: an
      integer as it is, 0 for none; if other values occur, all are numbered from 1 in sorted order
      and named (`Domain.tag_names`). None for no regions.

    Raises `Status.ERROR_FILE` if the file, layer or field cannot be read or a polygon has no region,
    `Status.ERROR_ARGUMENT` for an invalid projection or unit, and `Status.ERROR_DOMAIN` if polygons
    overlap, or regions have a tiny gap between them.

        with pnpbs.Shapes("coast.geojson", unit="km") as shapes:
            shapes.add_to(domain, corner_angle=45)
    """

    def __init__(self, path: Path, layer: Optional[str] = None, projection: Optional[Path] = None,
                 unit: Optional[str] = None, tag_field: Optional[str] = None,
                 region_field: Optional[str] = None) -> None:
        super().__init__()
        handle = ctypes.c_void_p()
        _check(_library().pnpbs_geo_read_regions(
            os.fsencode(path), _text(layer), _text(projection), _text(unit), _text(tag_field),
            _text(region_field), ctypes.byref(handle)))
        self._handle = handle.value

    def close(self) -> None:
        """Releases the resources of the library. Shapes that were added to domains remain there.
        Repeated calls have no effect."""
        if self.is_open:
            _check(self._destroy(_library().pnpbs_geo_destroy))

    def __repr__(self) -> str:
        return f"<pnpbs.Shapes, {self.projection.name if self.is_open else 'closed'}>"

    def _call(self, name: str, *arguments: Any) -> None:
        """Calls the function pnpbs_geo_<name> with these shapes."""
        _check(getattr(_library(), f"pnpbs_geo_{name}")(self._live(), *arguments))

    def add_to(self, domain: Domain, corner_angle: float = 0.0) -> Domain:
        """Adds the shapes to a domain in the plane or on a sphere, and returns the domain. With
        `corner_angle=0` every vertex becomes a node. Otherwise only vertices where the direction
        turns by more than this angle in degrees become nodes."""
        self._call("add_to_domain", domain.context._live(), domain._live(), corner_angle)
        return domain

    @property
    def projection(self) -> Projection:
        """The projection of x and y."""
        texts = [ctypes.c_char_p() for _ in range(5)]
        self._call("projection", *(ctypes.byref(text) for text in texts))
        scale = ctypes.c_double(), ctypes.c_double()
        self._call("scale", *(ctypes.byref(number) for number in scale))
        name, unit, proj, wkt, prj = ((text.value or b"").decode() for text in texts)
        return Projection(name, unit, proj, wkt, prj, (scale[0].value, scale[1].value))

    @property
    def counts(self) -> ShapeCounts:
        """The numbers of entities that were read."""
        found = [ctypes.c_int64() for _ in range(4)]
        self._call("counts", *(ctypes.byref(one) for one in found))
        return ShapeCounts(*(one.value for one in found))

    @property
    def notes(self) -> List[str]:
        """Notes on the interpretation of the file, as texts."""
        count, note = ctypes.c_int32(), ctypes.c_char_p()
        self._call("note_count", ctypes.byref(count))
        notes = []
        for index in range(count.value):
            self._call("get_note", index, ctypes.byref(note))
            notes.append((note.value or b"").decode())
        return notes

    @property
    def note_data(self) -> List[NoteData]:
        """The same notes as a list of `NoteData`."""
        code, count = ctypes.c_int32(), ctypes.c_int64()
        data = []
        for index, text in enumerate(self.notes):
            self._call("get_note_data", index, ctypes.byref(code), ctypes.byref(count))
            data.append(NoteData(NoteCode(code.value), text, count.value))
        return data

    def write_prj(self, results: Path) -> None:
        """Writes the projection next to a file of results: "nodes.prj" for "nodes.vtu". On several
        ranks, call it on one of them. Raises `Status.ERROR_STATE` if the projection is not known.
        """
        self._call("write_prj", os.fsencode(results))

    def to_degrees(self, points: ArrayLike) -> Doubles:
        """Converts points of shape (n, 2) to longitude and latitude in degrees. Values that do not
        exist become infinite. Returns a new array."""
        return self._changed("to_degrees", points)

    def from_degrees(self, degrees: ArrayLike) -> Doubles:
        """Converts longitude and latitude in degrees, of shape (n, 2), to x and y. Values that do
        not exist become infinite. Returns a new array."""
        return self._changed("from_degrees", degrees)

    def _changed(self, name: str, points: ArrayLike) -> Doubles:
        """Returns a converted copy of the points."""
        changed = as_points(points, 2, "points").copy()
        self._call(name, len(changed), changed)
        return changed

    def explain(self, message: object) -> str:
        """Returns the message of the last error about a domain of these shapes, with longitude and
        latitude after each point, then the features with a segment there. Where curves cross, advice
        follows in a line of its own. Any other text is returned without changes."""
        text = _library().pnpbs_geo_explain(self._live(), str(message).encode())
        return str(text.decode())


class GeoGrid(Handle):
    """Values on a grid in a file: GeoTIFF, NetCDF and other formats that GDAL reads. An object is a
    function of points, like a spacing. All methods are local.

    - `path`: a file, or anything else that GDAL opens. It stays open, and blocks of it are read
      where values are requested.
    - `low`, `high`: opposite corners of the requested part, in the projection of the points.
    - `variable`: the name of a variable, or the number of a band; None if the file has only one.
    - `projection`: the projection of the points, as in `Shapes` or the `wkt` of its projection. By
      default the points are in the coordinate system of the grid.

    Raises `Status.ERROR_FILE` if the file or variable cannot be read, and `Status.ERROR_SPACING` if
    the grid has no values in the requested part.

        depth = pnpbs.GeoGrid("depth.tif", low, high, projection=shapes.projection.wkt)
        placement.set_spacing(lambda x: np.clip(0.02 * depth(x), 0.5, 20))
    """

    def __init__(self, path: Path, low: ArrayLike, high: ArrayLike,
                 variable: Union[str, int, None] = None, projection: Optional[Path] = None) -> None:
        super().__init__()
        handle = ctypes.c_void_p()
        corners = [as_points(np.atleast_2d(np.asarray(corner, float)), 2, "corner")
                   for corner in (low, high)]
        _check(_library().pnpbs_geo_grid_read(
            os.fsencode(path), _text(None if variable is None else str(variable)),
            _text(projection), *corners, ctypes.byref(handle)))
        self._handle = handle.value

    def close(self) -> None:
        """Releases the resources of the library. Repeated calls have no effect."""
        if self.is_open:
            _check(self._destroy(_library().pnpbs_geo_grid_destroy))

    def __repr__(self) -> str:
        return f"<pnpbs.GeoGrid, {'open' if self.is_open else 'closed'}>"

    def __call__(self, points: ArrayLike) -> Doubles:
        """Evaluates the grid at points of shape (n, 2) and returns n values. They are linear in
        each direction between the centres of the cells, and constant beyond the edge. Cells without
        data have the value of the nearest cell with data."""
        return self._asked(points)[0]

    def inside(self, points: ArrayLike) -> "np.ndarray[Any, np.dtype[np.bool_]]":
        """Returns whether points of shape (n, 2) lie in the grid or less than half a cell beyond
        its edge, also where no cell around them has data."""
        return np.asarray(self._asked(points)[1] != 0)

    def slopes(self, points: ArrayLike, radius: float = 0.0) -> Doubles:
        """Returns the slope of the grid at points of shape (n, 2): n values of the change per unit
        of length. If the points are longitude and latitude in degrees, `radius` is that of the
        sphere along which lengths are measured. With 0, lengths are those in the plane of the
        points."""
        x = as_points(points, 2, "points")
        slopes = np.zeros(len(x))
        _check(_library().pnpbs_geo_grid_slopes(self._live(), radius, len(x), x, slopes))
        return slopes

    def _asked(self, points: ArrayLike) -> Tuple[Doubles, "np.ndarray[Any, np.dtype[np.int32]]"]:
        """Returns values, and codes of their positions in the grid."""
        x = as_points(points, 2, "points")
        values, inside = np.zeros(len(x)), np.zeros(len(x), np.int32)
        _check(_library().pnpbs_geo_grid_values(self._live(), len(x), x, values, inside))
        return values, inside

    @property
    def extent(self) -> Tuple[Doubles, Doubles]:
        """The corners (low, high) of the bounding box of the whole grid in the file, in the
        projection of the points."""
        low, high = np.zeros(2), np.zeros(2)
        _check(_library().pnpbs_geo_grid_extent(self._live(), low, high))
        return low, high


def depth_spacing(depths: ArrayLike, slopes: Optional[ArrayLike] = None, *, wave: float = 30,
                  period: float = 44712, slope: float = 0, least: float = 10,
                  metres: float = 1) -> Doubles:
    """Returns the spacing of models of tides and surges by the depth h of the water: the lesser of
    the spacings by the length of waves and by the slope of the bottom. Water shallower than
    `least`, and land, count as flat at that depth. Local.

    - `depths`: depths in metres, positive down: elevations must be negated.
    - `slopes`: slopes of the depths, in metres per unit of length, as returned by `GeoGrid.slopes`;
      None if `slope` is 0.
    - `wave`: number of nodes per length of a long wave; 0 for no such bound.
    - `period`: period of the wave in seconds.
    - `slope`: number of nodes per 2 pi h / |grad h|; 0 for no such bound.
    - `least`: least depth in metres.
    - `metres`: metres per unit of length, for example 1000 for kilometres.

    Raises ValueError if slopes are missing or shapes differ, and `Status.ERROR_SPACING` for a depth
    or slope that is not a number.

        placement.set_spacing(lambda x: np.clip(
            pnpbs.depth_spacing(depth(x), depth.slopes(x), slope=20, metres=1000), 0.5, 20))
    """
    if slope > 0 and slopes is None:
        raise ValueError(f"slope is {slope}, which requires the argument slopes")
    h = np.ascontiguousarray(np.atleast_1d(depths), float)
    steep = np.zeros_like(h) if slopes is None else np.ascontiguousarray(np.atleast_1d(slopes),
                                                                         float)
    if h.ndim != 1 or steep.shape != h.shape:
        raise ValueError(f"depths and slopes have shapes {h.shape} and {steep.shape}; vectors of "
                         "the same length were expected")
    d = np.zeros_like(h)
    _check(_library().pnpbs_geo_depth_spacing(len(h), h, steep, wave, period, slope, least, metres,
                                              d))
    return d

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - geographic shapes: reads GeoJSON, shapefiles, GeoPackage and whatever else GDAL reads,
 * projected by PROJ, into a domain in the plane. A separate library, libpnpbs_geo, which exists
 * only where PNPBS was built with GDAL; libpnpbs itself needs neither.
 *
 *   pnpbs_geo_read("coast.geojson", NULL, "EPSG:2180", "km", NULL, &shapes);
 *   pnpbs_geo_add_to_domain(shapes, context, domain, 45);
 *   ... simplify, place, write nodes.vtu ...
 *   pnpbs_geo_write_prj(shapes, "nodes.vtu");                       writes nodes.prj
 *
 * How shapes are interpreted
 *
 *   polygons    their outlines bound the domain, which lies behind an odd number of them. So a
 *               polygon within the outline of another is a hole, like a hole of that polygon.
 *
 *               Edges shared by neighbours are inner curves, with the tag of the first; edges that
 *               one feature traverses in both directions are dropped, as where it was cut at 180
 *               degrees.
 *
 *   lines       inner curves. A line along the boundary is not a separate curve: that part of the
 *               boundary gets its tag, such as the open boundary of a sea. A line is along the
 *               boundary if all of it lies within 0.001 of the layer's extent of the boundary, and
 *               all of that part of the boundary as near to it; or if both have the same vertices.
 *
 *               Closed lines, also in several pieces, bound the domain in a layer without polygons,
 *               and where they enclose polygons, which are then holes.
 *
 *   points      fixed nodes.
 *
 *   vertices    with equal coordinates, bit for bit in the file, are merged; those on a segment of
 *               another curve, to 1e-9 of the extent, are added to that curve, too. Segments are
 *               straight in the projection. Heights are ignored.
 *
 * The conventions of pnpbs.h apply, except that messages are in pnpbs_geo_last_error. On several
 * ranks all must make the same calls. For optional arguments NULL and "" are equivalent.
 */
#ifndef PNPBS_PNPBS_GEO_H
#define PNPBS_PNPBS_GEO_H

#include "pnpbs/pnpbs.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Shapes of one layer of a file, projected. Opaque, like the handles of pnpbs.h. */
typedef struct pnpbs_geo_shapes_handle *pnpbs_geo_shapes;

/** Returns the message of the last error of this library on the calling thread; "" if there was
 *  none. Local; valid until the next call of this library on this thread. */
PNPBS_API const char *pnpbs_geo_last_error(void);

/** Returns the versions of GDAL and PROJ in use, one "name: version" per line. Local; valid for the
 *  life of the process. */
PNPBS_API const char *pnpbs_geo_build_info(void);

/** Reads one layer of a file and projects it. The file is unchanged. Local. Errors:
 *  PNPBS_ERROR_FILE if it cannot be read, a layer or field is missing (the message lists the
 *  existing ones), or a point cannot be projected (the message names the feature and the point);
 *  PNPBS_ERROR_ARGUMENT for an invalid projection or unit; PNPBS_ERROR_DOMAIN with the point where
 *  polygons overlap.
 *  @param[in] path        a file, or anything else that GDAL opens
 *  @param[in] layer       its name; NULL if the file has only one
 *  @param[in] projection  the coordinate system of x and y. NULL: longitude and latitude are
 *                         projected as by "auto", projected coordinates are kept. "auto": a
 *                         projection chosen for the data, on their own ellipsoid: the UTM zone that
 *                         they lie in, to half a degree beyond its edges, else Lambert's azimuthal
 *                         equal-area projection about their middle, in whole degrees. "none": the
 *                         coordinates of the file, even if in degrees. "sphere(LON,LAT)": for a
 *                         domain on a sphere (pnpbs_domain_create_sphere) with a point outside at
 *                         that longitude and latitude, in degrees. Otherwise a code
 *                         ("EPSG:2180"), a PROJ string, WKT, or the path of a .prj file. x points
 *                         east and y north, whatever the axis order of the register
 *  @param[in] unit        "m" or "km"; NULL: the projection's own, mostly metres
 *  @param[in] tag_field   the attribute that becomes the tag: integers unchanged; texts as 1, 2 and
 *                         so on in the order of the file, with their names; NULL: all tags are 1
 *  @param[out] shapes     the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_geo_read(const char *path, const char *layer, const char *projection,
                                      const char *unit, const char *tag_field,
                                      pnpbs_geo_shapes *shapes);

/** Reads one layer as pnpbs_geo_read does, and makes its polygons regions of the domain
 *  (pnpbs_domain_add_region): the elements in a polygon get the value that it has in a field.
 *  Local. Errors as of pnpbs_geo_read; PNPBS_ERROR_FILE for a polygon
 *  without a value, or with an integer of more than 32 bits; PNPBS_ERROR_DOMAIN with both features
 *  and the point where polygons overlap or have a gap below 1e-6 of the extent;
 *  PNPBS_ERROR_ARGUMENT on a sphere.
 *  @param[in] region_field  the attribute that becomes the tag of elements: integers unchanged, 0
 *                           for no region; if other values occur, all as 1, 2 and so on in sorted
 *                           order, with their names for dimension 2 (pnpbs_domain_get_tag_name);
 *                           NULL: as pnpbs_geo_read
 *  @param[out] shapes       the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_geo_read_regions(const char *path, const char *layer,
                                              const char *projection, const char *unit,
                                              const char *tag_field, const char *region_field,
                                              pnpbs_geo_shapes *shapes);

/** Destroys the handle and sets it to NULL; accepts NULL. What was added to domains stays there.
 *  Local. */
PNPBS_API pnpbs_status pnpbs_geo_destroy(pnpbs_geo_shapes *shapes);

/** Adds the shapes to a domain in the plane, or on a sphere: curves as pnpbs_domain_add_polyline
 *  does, points as pnpbs_domain_add_fixed_nodes does, names of tags for dimension 1. Curves that
 *  cross or do not close are found by pnpbs_domain_check; see pnpbs_geo_explain. May be called for
 *  several domains. If the domain splits curves where they meet (pnpbs_domain_set_fragment), say so
 *  before: polygons that are regions then have a point in each of their parts. Shapes for a sphere,
 *  which have no projection to report, are for any sphere with the same point outside. For a second
 *  layer of the same domain, read it with the projection of the first (pnpbs_geo_projection).
 * Local.
 *  @param[in] context       of the domain
 *  @param[in] corner_angle  degrees, 0 .. 180, as in pnpbs_domain_add_polyline. 0: every vertex
 *                           becomes a node */
PNPBS_API pnpbs_status pnpbs_geo_add_to_domain(pnpbs_geo_shapes shapes, pnpbs_context context,
                                               pnpbs_domain domain, double corner_angle);

/** Returns the numbers of what was read. Local; outputs may be NULL.
 *  @param[out] vertices  distinct positions, including those of points
 *  @param[out] boundary  curves, closed or between the vertices where curves meet
 *  @param[out] inner     likewise
 *  @param[out] points    fixed nodes */
PNPBS_API pnpbs_status pnpbs_geo_counts(pnpbs_geo_shapes shapes, int64_t *vertices,
                                        int64_t *boundary, int64_t *inner, int64_t *points);

/** Returns the projection as texts; "" where the file does not define its coordinate system, or a
 *  form cannot express it. Local; outputs may be NULL. The strings are valid until the shapes are
 *  destroyed.
 *  @param[out] name  e.g. "WGS 84 / UTM zone 34N"
 *  @param[out] unit  of x and y, e.g. "metre"
 *  @param[out] proj  PROJ string, without what it cannot express
 *  @param[out] wkt   WKT 2 (ISO 19162:2019), complete; accepted by pnpbs_geo_read
 *  @param[out] prj   WKT 1 as defined by ESRI, the content of .prj files */
PNPBS_API pnpbs_status pnpbs_geo_projection(pnpbs_geo_shapes shapes, const char **name,
                                            const char **unit, const char **proj, const char **wkt,
                                            const char **prj);

/** Returns the range of the scale, projected length over length on the Earth, along meridians and
 *  parallels at the vertices (of many, at some thousand of them); d is off by this factor. 1 and 1
 *  where it is not known. Local; outputs may be NULL. */
PNPBS_API pnpbs_status pnpbs_geo_scale(pnpbs_geo_shapes shapes, double *least, double *greatest);

/** Writes the projection beside a file of results, as for shapefiles: for "out/nodes.vtu" it writes
 *  or replaces "out/nodes.prj". Local; on several ranks call it on one. Errors: PNPBS_ERROR_STATE
 *  if the projection is not known, PNPBS_ERROR_FILE. */
PNPBS_API pnpbs_status pnpbs_geo_write_prj(pnpbs_geo_shapes shapes, const char *results);

/** Converts x and y to longitude and latitude in degrees, on the ellipsoid of the file, or back; in
 *  place. Values that do not exist become infinite. Local. Errors: PNPBS_ERROR_STATE if the file
 *  does not say where on the Earth it is.
 *  @param coordinates  [n][2], in and out */
PNPBS_API pnpbs_status pnpbs_geo_to_degrees(pnpbs_geo_shapes shapes, int64_t n,
                                            double *coordinates);
PNPBS_API pnpbs_status pnpbs_geo_from_degrees(pnpbs_geo_shapes shapes, int64_t n,
                                              double *coordinates);

/** Returns the message of the last error of pnpbs.h or of this library on the calling thread, with
 *  longitude and latitude inserted after each point "(x, y)" of a domain of these shapes that it
 *  names, then the features with a segment there. Where curves cross, advice follows in a line of
 *  its own. `message` may have other words around it; any other text is returned as it is. Local;
 *  valid until the next call of this library on this thread. Never NULL. */
PNPBS_API const char *pnpbs_geo_explain(pnpbs_geo_shapes shapes, const char *message);

/** Returns the notes on how the file was interpreted: their number, and one of them, valid until
 *  the shapes are destroyed. Local.
 *  @param[in] index  0 .. count-1 */
PNPBS_API pnpbs_status pnpbs_geo_note_count(pnpbs_geo_shapes shapes, int32_t *count);
PNPBS_API pnpbs_status pnpbs_geo_get_note(pnpbs_geo_shapes shapes, int32_t index,
                                          const char **note);

/** Codes of notes. More may be added: programs must expect numbers that they do not know. In
 *  parentheses: what is counted. NO_GEOMETRY: features without a geometry are left out (features).
 *  HEIGHTS_LEFT_OUT: heights in the file are ignored. NEARLY_TOUCHING: features that may be meant
 *  as neighbours have no edge in common (features). NO_REFERENCE_SYSTEM: the file does not say what
 *  its coordinates are. DEGREES_IN_PLANE: longitude and latitude are taken as x and y. SCALE:
 *  lengths in the projection differ from those on the Earth by 2 percent or more.
 *  SEGMENTS_RETAGGED: segments of polygons have the tag of a line (segments). LINES_ALONG_BOUNDARY:
 *  lines are parts of the boundary (lines). SHARED_SEGMENTS_LEFT_OUT: they lie between polygons
 *  (segments). WHOLE_SPHERE: nothing bounds the domain. LINES_LEFT_OUT: another line has the
 *  segments with another tag (segments). SEGMENTS_LEFT_OUT: they repeat others, or lead there and
 *  back (segments). */
#define PNPBS_GEO_NOTE_NO_GEOMETRY 1
#define PNPBS_GEO_NOTE_HEIGHTS_LEFT_OUT 2
#define PNPBS_GEO_NOTE_NEARLY_TOUCHING 3
#define PNPBS_GEO_NOTE_NO_REFERENCE_SYSTEM 4
#define PNPBS_GEO_NOTE_DEGREES_IN_PLANE 5
#define PNPBS_GEO_NOTE_SCALE 6
#define PNPBS_GEO_NOTE_SEGMENTS_RETAGGED 7
#define PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY 8
#define PNPBS_GEO_NOTE_SHARED_SEGMENTS_LEFT_OUT 9
#define PNPBS_GEO_NOTE_WHOLE_SPHERE 10
#define PNPBS_GEO_NOTE_LINES_LEFT_OUT 11
#define PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT 12

/** Returns a note as data. Local; outputs may be NULL.
 *  @param[in] index   0 .. count-1
 *  @param[out] code   one of PNPBS_GEO_NOTE_...
 *  @param[out] count  how many features, lines or segments it is about; 0: none are counted */
PNPBS_API pnpbs_status pnpbs_geo_get_note_data(pnpbs_geo_shapes shapes, int32_t index,
                                               int32_t *code, int64_t *count);

/** Values on a grid in a file. Opaque. */
typedef struct pnpbs_geo_grid_handle *pnpbs_geo_grid;

/** Opens a part of a grid: GeoTIFF, NetCDF and other formats that GDAL reads. The file stays open,
 *  and is read in blocks where values are requested, however large it is: a grid has 256 MiB of
 *  blocks at most, the last used ones, and 64 MiB of GDAL's. Local. Errors: PNPBS_ERROR_FILE if it
 *  cannot be read or does not say where its cells lie, and for a missing variable (the message
 *  lists the existing ones); PNPBS_ERROR_SPACING with both extents where it has nothing in the
 *  part; PNPBS_ERROR_ARGUMENT.
 *  @param[in] path        a file, or anything else that GDAL opens
 *  @param[in] variable    its name in a file of several, as in NetCDF, or the number of a band;
 *                         NULL if there is only one
 *  @param[in] projection  of the points at which the grid is evaluated, e.g. the wkt of
 *                         pnpbs_geo_projection; they are projected to the grid's own system. NULL:
 *                         they are in that
 *  @param[in] low         [2] of the requested part, in the projection of the points, e.g. from
 *                         pnpbs_domain_bounds
 *  @param[in] high        [2]
 *  @param[out] grid       the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_geo_grid_read(const char *path, const char *variable,
                                           const char *projection, const double *low,
                                           const double *high, pnpbs_geo_grid *grid);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_geo_grid_destroy(pnpbs_geo_grid *grid);

/** Evaluates the grid at points: linear in each direction between the centres of the cells,
 *  constant beyond the edge. Cells without data take the value of the nearest cell that has some,
 *  counted in columns plus rows. For use in a pnpbs_spacing_fn. Local. Errors: PNPBS_ERROR_FILE if
 *  the file can no longer be read.
 *  @param[in] coordinates  [n][2]
 *  @param[out] values      [n]
 *  @param[out] inside      [n] 0 where a point lies beyond the edge, to half a cell; 2 where no
 *                          cell around it has data; else 1; or NULL */
PNPBS_API pnpbs_status pnpbs_geo_grid_values(pnpbs_geo_grid grid, int64_t n,
                                             const double *coordinates, double *values,
                                             int32_t *inside);

/** Computes how steep the grid is at points: the change of its values per length, which between the
 *  centres of the cells is that of the values there, linear in each direction. Local. Errors as of
 *  pnpbs_geo_grid_values.
 *  @param[in] radius       of the sphere along which lengths are, if the points are longitude and
 *                          latitude in degrees; 0: lengths are those of the plane of the points
 *  @param[in] coordinates  [n][2]
 *  @param[out] slopes      [n] values per unit of length */
PNPBS_API pnpbs_status pnpbs_geo_grid_slopes(pnpbs_geo_grid grid, double radius, int64_t n,
                                             const double *coordinates, double *slopes);

/** Returns the d of models of tides and surges by the depth h of the water: the least of sqrt(g h)
 *  T / nodes_per_wave / metres, with g = 9.81 m/s2, and of 2 pi h / |grad h| / nodes_per_slope. In
 *  water that is shallower than least_depth, and on land, the bottom counts as flat at that depth.
 *  d is infinite where neither rule bounds it. For use in a pnpbs_spacing_fn. Local. Errors:
 *  PNPBS_ERROR_SPACING for a depth or a slope that is not a number (the message has its index);
 *  PNPBS_ERROR_ARGUMENT.
 *  @param[in] depths           [n] metres, positive down: elevations must be negated
 *  @param[in] slopes           [n] of the depths, metres per unit of length, as from
 *                              pnpbs_geo_grid_slopes; or NULL if nodes_per_slope is 0
 *  @param[in] nodes_per_wave   at least 0; 30, say; 0: no such rule
 *  @param[in] period           T in seconds, greater than 0; 44712 of the tide M2
 *  @param[in] nodes_per_slope  at least 0; 20, say; 0: no such rule
 *  @param[in] least_depth      metres, greater than 0; 10, say
 *  @param[in] metres           per unit of length, greater than 0: 1000 for kilometres
 *  @param[out] d               [n] */
PNPBS_API pnpbs_status pnpbs_geo_depth_spacing(int64_t n, const double *depths,
                                               const double *slopes, double nodes_per_wave,
                                               double period, double nodes_per_slope,
                                               double least_depth, double metres, double *d);

/** Returns the bounding box of the whole grid in the file, in the projection of the points. Local.
 *  @param[out] low   [2]
 *  @param[out] high  [2] */
PNPBS_API pnpbs_status pnpbs_geo_grid_extent(pnpbs_geo_grid grid, double *low, double *high);

#ifdef __cplusplus
}
#endif

#endif

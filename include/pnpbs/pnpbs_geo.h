/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - shapes as geographers have them: GeoJSON, shapefiles, GeoPackage and whatever else GDAL
 * reads, projected by PROJ, as a domain in the plane. In a library of its own, libpnpbs_geo, which
 * is there only where PNPBS was built with GDAL; libpnpbs itself needs neither.
 *
 *   pnpbs_geo_read("coast.geojson", NULL, "EPSG:2180", "km", NULL, &shapes);
 *   pnpbs_geo_add_to_domain(shapes, context, domain, 45);
 *   ... simplify, place, write nodes.vtu ...
 *   pnpbs_geo_write_prj(shapes, "nodes.vtu");                       writes nodes.prj
 *
 * What becomes of the shapes
 *
 *   polygons    their outlines bound the domain: it is what lies behind an odd number of them, so
 *               a polygon within another one's outline is a hole, as a hole of the other is.
 *
 *               Edges that neighbours have in common are inner curves, with the tag of the first;
 *               edges that one feature goes along there and back are left out, as where it was
 *               cut at 180 degrees.
 *
 *   lines       inner curves. A line that runs along the boundary is no curve of its own: that part
 *               of the boundary has its tag, as the open boundary of a sea has. It runs along it
 *               where all of it lies within 0.001 of the layer's extent of the boundary, and all of
 *               that part of the boundary as near to it; or where both have the same vertices.
 *
 *               Closed lines, also in several pieces, bound the domain in a layer without polygons,
 *               and where they lie around polygons, which are holes then.
 *
 *   points      fixed nodes.
 *
 *   vertices    at the same place, bit for bit in the file, are one, and those on a segment of
 *               another curve, to 1e-9 of the extent, become that one's, too. Segments are straight
 *               in the projection. Heights are left out.
 *
 * Conventions are those of pnpbs.h, but that messages are in pnpbs_geo_last_error. On several
 * ranks all must do the same. NULL and "" are the same for what may be left out.
 */
#ifndef PNPBS_PNPBS_GEO_H
#define PNPBS_PNPBS_GEO_H

#include "pnpbs/pnpbs.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Shapes of one layer of a file, projected. Opaque, as the handles of pnpbs.h are. */
typedef struct pnpbs_geo_shapes_handle *pnpbs_geo_shapes;

/** The message of the last error of this library on the calling thread; "" if there was none.
 *  Local; valid until the next call of this library on this thread. */
PNPBS_API const char *pnpbs_geo_last_error(void);

/** The versions of GDAL and PROJ that it runs with, one "name: version" per line. Local; valid for
 *  ever. */
PNPBS_API const char *pnpbs_geo_build_info(void);

/** Reads one layer of a file and projects it. The file stays as it is. Local. Errors:
 *  PNPBS_ERROR_FILE if it cannot be read, a layer or field is not there (the message lists those
 *  that are), or a point cannot be projected (the message names the feature and the point);
 *  PNPBS_ERROR_ARGUMENT for a projection or unit that is none; PNPBS_ERROR_DOMAIN with the place
 *  where polygons overlap.
 *  @param[in] path        a file, or anything else that GDAL opens
 *  @param[in] layer       its name; NULL if the file has only one
 *  @param[in] projection  what x and y shall be. NULL: longitude and latitude are projected as by
 *                         "auto", projected coordinates stay as they are. "auto": a projection
 *                         made for the data, on their own ellipsoid: the UTM zone that they lie
 *                         in, to half a degree beyond its edges, else Lambert's azimuthal
 *                         equal-area projection about their middle, in whole degrees. "none": the
 *                         coordinates as they are, be they degrees. Otherwise a code
 *                         ("EPSG:2180"), a string of PROJ's, WKT, or the path of a .prj file. x
 *                         leads east and y north, whatever order the register has
 *  @param[in] unit        "m" or "km"; NULL: the projection's own, mostly metres
 *  @param[in] tag_field   the attribute that becomes the tag: integers as they are; texts as 1, 2
 *                         and so on in the order of the file, with their names; NULL: all tags
 *                         are 1
 *  @param[out] shapes     the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_geo_read(const char *path, const char *layer, const char *projection,
                                      const char *unit, const char *tag_field,
                                      pnpbs_geo_shapes *shapes);

/** Destroys the handle and sets it to NULL; takes NULL. What was added to domains stays there.
 *  Local. */
PNPBS_API pnpbs_status pnpbs_geo_destroy(pnpbs_geo_shapes *shapes);

/** Adds the shapes to a domain in the plane: curves as by pnpbs_domain_add_polyline, points as by
 *  pnpbs_domain_add_fixed_nodes, names of tags for dimension 1. What crosses or does not close is
 *  found by pnpbs_domain_check; see pnpbs_geo_explain. May be called for several domains. For a
 *  second layer of the same domain, read that with the projection of this one
 *  (pnpbs_geo_projection). Local.
 *  @param[in] context       of the domain
 *  @param[in] corner_angle  degrees, 0 .. 180, as pnpbs_domain_add_polyline has it. 0: every
 *                           vertex becomes a node */
PNPBS_API pnpbs_status pnpbs_geo_add_to_domain(pnpbs_geo_shapes shapes, pnpbs_context context,
                                               pnpbs_domain domain, double corner_angle);

/** What was read. Local; outputs may be NULL.
 *  @param[out] vertices  different places, those of points included
 *  @param[out] boundary  curves, closed or from where curves meet to where they meet
 *  @param[out] inner     likewise
 *  @param[out] points    fixed nodes */
PNPBS_API pnpbs_status pnpbs_geo_counts(pnpbs_geo_shapes shapes, int64_t *vertices,
                                        int64_t *boundary, int64_t *inner, int64_t *points);

/** The projection, as texts; "" where the file does not say what its coordinates are, or a form
 *  cannot tell it. Local; outputs may be NULL. The strings are valid until the shapes are
 *  destroyed.
 *  @param[out] name  e.g. "WGS 84 / UTM zone 34N"
 *  @param[out] unit  of x and y, e.g. "metre"
 *  @param[out] proj  PROJ's string, which leaves out what it has no words for
 *  @param[out] wkt   WKT 2 (ISO 19162:2019), complete; pnpbs_geo_read takes it
 *  @param[out] prj   WKT 1 as ESRI has it, which .prj files contain */
PNPBS_API pnpbs_status pnpbs_geo_projection(pnpbs_geo_shapes shapes, const char **name,
                                            const char **unit, const char **proj, const char **wkt,
                                            const char **prj);

/** How long lengths on the Earth are in the projection, along meridians and parallels, at the
 *  vertices (of many, at some thousand of them): d is off by so much. 1 and 1 where it is not
 *  known. Local; outputs may be NULL. */
PNPBS_API pnpbs_status pnpbs_geo_scale(pnpbs_geo_shapes shapes, double *least, double *greatest);

/** Writes the projection beside a file of results, as shapefiles have it: for "out/nodes.vtu",
 *  "out/nodes.prj" is written anew. Local; of several ranks let one do it. Errors:
 *  PNPBS_ERROR_STATE if the projection is not known, PNPBS_ERROR_FILE. */
PNPBS_API pnpbs_status pnpbs_geo_write_prj(pnpbs_geo_shapes shapes, const char *results);

/** Longitude and latitude in degrees, on the ellipsoid of the file, from x and y, or x and y from
 *  them; in place. Where there are none they become infinite. Local. Errors: PNPBS_ERROR_STATE if
 *  the file does not say where on the Earth it is.
 *  @param coordinates  [n][2], in and out */
PNPBS_API pnpbs_status pnpbs_geo_to_degrees(pnpbs_geo_shapes shapes, int64_t n,
                                            double *coordinates);
PNPBS_API pnpbs_status pnpbs_geo_from_degrees(pnpbs_geo_shapes shapes, int64_t n,
                                              double *coordinates);

/** A message about a domain of these shapes, and after each place "(x, y)" in it its longitude and
 *  latitude. Local; valid until the next call of this library on this thread. Never NULL. */
PNPBS_API const char *pnpbs_geo_explain(pnpbs_geo_shapes shapes, const char *message);

/** What the user should know about how the file was taken: number of notes, and one of them, valid
 *  until the shapes are destroyed. Local.
 *  @param[in] index  0 .. count-1 */
PNPBS_API pnpbs_status pnpbs_geo_note_count(pnpbs_geo_shapes shapes, int32_t *count);
PNPBS_API pnpbs_status pnpbs_geo_get_note(pnpbs_geo_shapes shapes, int32_t index,
                                          const char **note);

/** Values on a grid in a file. Opaque. */
typedef struct pnpbs_geo_grid_handle *pnpbs_geo_grid;

/** Reads a part of a grid: GeoTIFF, NetCDF and whatever else GDAL reads. Local. Errors:
 *  PNPBS_ERROR_FILE if it cannot be read or does not say where its cells lie, for a variable that
 * is not there (the message lists those that are), and for more than 2 * 10^8 values in the part;
 *  PNPBS_ERROR_SPACING with both extents where it has nothing in the part; PNPBS_ERROR_ARGUMENT.
 *  @param[in] path        a file, or anything else that GDAL opens
 *  @param[in] variable    its name in a file of several, as NetCDF's, or the number of a band; NULL
 *                         if there is only one
 *  @param[in] projection  of the points that it will be asked at, e.g. the wkt of
 *                         pnpbs_geo_projection; they are projected to the grid's own system. NULL:
 *                         they are in that
 *  @param[in] low         [2] of the part that is wanted, as the points: pnpbs_domain_bounds, say
 *  @param[in] high        [2]
 *  @param[out] grid       the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_geo_grid_read(const char *path, const char *variable,
                                           const char *projection, const double *low,
                                           const double *high, pnpbs_geo_grid *grid);

/** Destroys the handle and sets it to NULL; takes NULL. Local. */
PNPBS_API pnpbs_status pnpbs_geo_grid_destroy(pnpbs_geo_grid *grid);

/** Values at points: linear in each direction between the middles of the cells, constant beyond
 *  the edge. Cells without data take the value of the nearest cell that has some. For use in a
 *  pnpbs_spacing_fn. Local.
 *  @param[in] coordinates  [n][2]
 *  @param[out] values      [n]
 *  @param[out] inside      [n] 0 where a point lies beyond the edge, to half a cell, else 1; or
 *                          NULL */
PNPBS_API pnpbs_status pnpbs_geo_grid_values(pnpbs_geo_grid grid, int64_t n,
                                             const double *coordinates, double *values,
                                             int32_t *inside);

/** What lies around all of the grid in the file, in the projection of the points. Local.
 *  @param[out] low   [2]
 *  @param[out] high  [2] */
PNPBS_API pnpbs_status pnpbs_geo_grid_extent(pnpbs_geo_grid grid, double *low, double *high);

#ifdef __cplusplus
}
#endif

#endif

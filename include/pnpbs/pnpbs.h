/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - parallel node placement by bubble simulation: the C interface.
 *
 * Glossary
 *   node        a point to compute on; the centre of a bubble
 *   spacing     d(x) > 0, the wanted distance between neighbouring nodes about x, in the
 *               unit of the coordinates; a bubble's diameter
 *   boundary    the curves that bound a domain in the plane, or the surfaces that bound one in
 *               space. Curves are cut into boundary edges between consecutive boundary nodes,
 *               surfaces into boundary triangles; every one of these is an edge or a face of the
 *               Delaunay triangulation that the stars describe
 *   tag         an integer that marks what a node, boundary edge or boundary triangle lies on;
 *               0 for inner nodes
 *   adjacency   all nodes within `adjacency_radius` times the mean spacing of the pair
 *   star        a node's neighbours in the constrained Delaunay triangulation, in the plane in
 *               order around it
 *
 * Conventions of every function
 *   status      a pnpbs_status is returned: 0 done; > 0 an outcome whose results are valid;
 *               < 0 an error: nothing changed, the message is in pnpbs_last_error.
 *   collective  "Collective" functions must be called by all ranks of the context, in the same
 *               order, and return the same status on all of them. "Local" ones need not.
 *   arrays      are the caller's, are read or filled during the call, and are never kept.
 *               Coordinates are interleaved, [n][dim] with dim = 2 in the plane, 3 in space.
 *               Counts, ids, indices and offsets are 64-bit; indices and offsets are 0-based.
 *   dimension   functions for domains or placements "in the plane" or "in space" refuse others with
 *               PNPBS_ERROR_ARGUMENT; all other functions are for both.
 *   range       coordinates reach up to 1e60; a domain is at least 1e-60 large, and at least 1e-10
 *               of its distance from the origin, so that the digits of its coordinates tell
 *               places apart. Others are PNPBS_ERROR_DOMAIN. A spacing may be larger than the
 *               domain: then only corners are nodes, and there is a warning.
 *   strings     we return belong to the library and stay valid until the next call on the
 *               same context (tables: for ever); strings we take are copied.
 *   callbacks   come on the calling thread, never two at once. From inside one, only queries
 *               of the library work; anything else returns PNPBS_ERROR_STATE.
 *   threads     one host thread at a time per context; contexts are independent.
 *   side effects  nothing is printed, no signal handler is installed, the process never ends.
 *   arithmetic  calls round to nearest, trap nothing and flush nothing to zero, whatever the
 *               calling thread does; callbacks and what comes after a call go by its settings.
 *
 * Source of the method: Y. Nie, W. Zhang, N. Qi, Y. Li, "Parallel node placement method by
 * bubble simulation", Comput. Phys. Commun. 185 (2014) 798-808 ("the paper").
 */
#ifndef PNPBS_PNPBS_H
#define PNPBS_PNPBS_H

#include <stdint.h>

#define PNPBS_VERSION_MAJOR 0
#define PNPBS_VERSION_MINOR 2
#define PNPBS_VERSION_PATCH 0
#define PNPBS_VERSION_STRING "0.2.0"

#if defined(_WIN32) || !defined(__GNUC__)
#define PNPBS_API
#else
#define PNPBS_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- status and errors ----- */

/** The one list of outcomes and errors: X(name, value, text). */
#define PNPBS_STATUS_LIST(X) PNPBS_STATUS_LIST_OK(X) PNPBS_STATUS_LIST_BUT_OK(X)

/* In two parts, for the enum below: in C89 and C++98 no comma may end one. */
#define PNPBS_STATUS_LIST_OK(X) X(PNPBS_OK, 0, "done")

#define PNPBS_STATUS_LIST_BUT_OK(X)                                                 \
  X(PNPBS_NOT_CONVERGED, 1, "the step limit was reached before the bubbles rested") \
  X(PNPBS_STOPPED, 2, "stopped by the monitor")                                     \
  X(PNPBS_SPACING_MISSED, 3, "somewhere the nodes do not follow the spacing")       \
  X(PNPBS_NOT_CONFORMING, 4, "the elements do not fill the domain")                 \
  X(PNPBS_ERROR_ARGUMENT, -1, "invalid argument")                                   \
  X(PNPBS_ERROR_HANDLE, -2, "not a live handle")                                    \
  X(PNPBS_ERROR_STATE, -3, "call not allowed in this state")                        \
  X(PNPBS_ERROR_DOMAIN, -4, "invalid domain")                                       \
  X(PNPBS_ERROR_SPACING, -5, "invalid spacing")                                     \
  X(PNPBS_ERROR_KEY, -6, "unknown option or statistic")                             \
  X(PNPBS_ERROR_CAPACITY, -7, "array too small")                                    \
  X(PNPBS_ERROR_FILE, -8, "cannot read or write file")                              \
  X(PNPBS_ERROR_CALLBACK, -9, "a callback asked to stop with an error")             \
  X(PNPBS_ERROR_MEMORY, -10, "out of memory")                                       \
  X(PNPBS_ERROR_MPI, -11, "MPI is not usable")                                      \
  X(PNPBS_ERROR_KOKKOS, -12, "Kokkos is not usable")                                \
  X(PNPBS_ERROR_UNSUPPORTED, -13, "not supported by this build")                    \
  X(PNPBS_ERROR_INTERNAL, -14, "internal error")

#define PNPBS_STATUS_ENUM_OK(name, value, text) name = value
typedef enum pnpbs_status {
  PNPBS_STATUS_LIST_OK(PNPBS_STATUS_ENUM_OK)
#define PNPBS_STATUS_ENUM(name, value, text) , name = value
      PNPBS_STATUS_LIST_BUT_OK(PNPBS_STATUS_ENUM)
#undef PNPBS_STATUS_ENUM
} pnpbs_status;
#undef PNPBS_STATUS_ENUM_OK
/** Opaque handles. The value is a registry key, never an address: a stale or foreign one is
 *  answered with PNPBS_ERROR_HANDLE. NULL is never a live handle. Children keep their parents
 *  alive, so handles may be destroyed in any order. */
typedef struct pnpbs_context_handle *pnpbs_context;
typedef struct pnpbs_domain_handle *pnpbs_domain;
typedef struct pnpbs_placement_handle *pnpbs_placement;
typedef struct pnpbs_transfer_handle *pnpbs_transfer;

/** What a status means, in a few words. Local. Never NULL. */
PNPBS_API const char *pnpbs_status_string(pnpbs_status status);

/** The message of the last error on `context` (or on its children); with NULL, of the calling
 *  thread, for failed creates and dead handles. Local. "" if there was none. */
PNPBS_API const char *pnpbs_last_error(pnpbs_context context);

/** The version of the library at run time. Any pointer may be NULL. Local. */
PNPBS_API pnpbs_status pnpbs_version(int32_t *major, int32_t *minor, int32_t *patch);

/** What the library was built with, one "name: value" per line: version, compiler, Kokkos and
 *  its back ends, linkage, MPI, HDF5. Local; valid for ever. */
PNPBS_API const char *pnpbs_build_info(void);

/** The MPI library we were built with, e.g. "Open MPI 4.1.4"; "" in a build without MPI.
 *  Local; calls no MPI function; valid for ever. */
PNPBS_API const char *pnpbs_mpi_library(void);

/* ---------------------------------------------------------------- context --------------- */

/** A context for one process; calls no MPI function, ever. Local.
 *  @param[out] context  the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_context_create_serial(pnpbs_context *context);

/** A context on a duplicate of the MPI communicator with the Fortran handle `comm`
 *  (MPI_Comm_c2f). Collective. Errors: PNPBS_ERROR_UNSUPPORTED in a build without MPI,
 *  PNPBS_ERROR_MPI if MPI is not initialised, already
 *  finalised, or `comm` is MPI_COMM_NULL. */
PNPBS_API pnpbs_status pnpbs_context_create_f(int32_t comm, pnpbs_context *context);

/** The same, for a caller that says whose handle it is: the communicator of one MPI library means
 *  nothing to another. pnpbs_context_create_mpi comes this way. Collective. Errors besides those of
 *  pnpbs_context_create_f: PNPBS_ERROR_MPI if the caller's library is not the one that PNPBS calls.
 *  @param[in] library  what MPI_Get_library_version tells the caller; blanks at its end are
 *                      ignored */
PNPBS_API pnpbs_status pnpbs_context_create_checked_f(int32_t comm, const char *library,
                                                      pnpbs_context *context);

/** Ends the context and sets *context to NULL; takes NULL. Its domains and placements live on
 *  until they are destroyed. Collective. */
PNPBS_API pnpbs_status pnpbs_context_destroy(pnpbs_context *context);

/** Ends Kokkos if PNPBS started it. Optional: otherwise Kokkos stays up until the process ends.
 *  Kokkos cannot start twice, so computing calls fail afterwards. Local. */
PNPBS_API pnpbs_status pnpbs_finalize(void);

/** Sets an option that placements created later on this context start with (see the options
 *  table, pnpbs_option_info). `threads` can only be set here, and only before the first
 *  placement of the process is created. Local. Errors: PNPBS_ERROR_KEY (the message has the
 *  nearest known name), PNPBS_ERROR_ARGUMENT (the message has the range).
 *  @param[in] value  as text; numbers parse the same in every locale */
PNPBS_API pnpbs_status pnpbs_context_set(pnpbs_context context, const char *key, const char *value);
PNPBS_API pnpbs_status pnpbs_context_set_int64(pnpbs_context context, const char *key,
                                               int64_t value);
PNPBS_API pnpbs_status pnpbs_context_set_double(pnpbs_context context, const char *key,
                                                double value);

/* ---------------------------------------------------------------- tables ---------------- */

/** Number of options. Local. */
PNPBS_API pnpbs_status pnpbs_option_count(int32_t *count);

/** One row of the options table. Local; any output may be NULL; strings valid for ever.
 *  @param[in]  index          0 .. count-1
 *  @param[out] type           "integer", "real", "choice"
 *  @param[out] default_value  as text
 *  @param[out] range          e.g. "1 .. 1000000" or "paper | default"
 *  @param[out] help           one line */
PNPBS_API pnpbs_status pnpbs_option_info(int32_t index, const char **name, const char **type,
                                         const char **default_value, const char **range,
                                         const char **help);

/** Number of statistics. Local. */
PNPBS_API pnpbs_status pnpbs_statistic_count(int32_t *count);

/** One row of the statistics table (the report's keys). Local; outputs may be NULL.
 *  @param[out] type  "integer", "real" or "string": which get function to use
 *  @param[out] help  one line, with the unit */
PNPBS_API pnpbs_status pnpbs_statistic_info(int32_t index, const char **name, const char **type,
                                            const char **help);

/** Number of file formats. Local. */
PNPBS_API pnpbs_status pnpbs_format_count(int32_t *count);

/** One row of the table of file formats (see pnpbs_placement_write). Local; any output may be
 *  NULL; strings valid for ever.
 *  @param[in]  index     0 .. count-1
 *  @param[out] name      also the extension, without its dot
 *  @param[out] help      one line
 *  @param[out] binary    1 if it is no text
 *  @param[out] elements  1 if one file holds nodes and, on request, elements */
PNPBS_API pnpbs_status pnpbs_format_info(int32_t index, const char **name, const char **help,
                                         int32_t *binary, int32_t *elements);

/* ---------------------------------------------------------------- domain ---------------- */

/** Role of a curve, or of a surface in space. BOUNDARY ones separate inside from outside: the
 *  inside is what lies behind an odd number of them (holes and islands nest to any depth). INNER
 *  ones lie in the domain, and the nodes follow them. Curves in space are always INNER. */
#define PNPBS_BOUNDARY 0
#define PNPBS_INNER 1

/** A curve in the plane by its parameter: fills coordinates[n][dim], dim = 2, for t[n]. Must be a
 *  pure function, continuous and with no self-intersection. Return 0, or nonzero to fail the call
 *  with PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_curve_fn)(int64_t n, int32_t dim, const double *t, double *coordinates,
                                  void *user);

/** An empty domain. Local.
 *  @param[in] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_domain_create(pnpbs_context context, int32_t dim,
                                           pnpbs_domain *domain);

/** Destroys the handle and sets it to NULL; takes NULL. Local. */
PNPBS_API pnpbs_status pnpbs_domain_destroy(pnpbs_domain *domain);

/** The dimension that the domain was created with. Local.
 *  @param[out] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_domain_dimension(pnpbs_domain domain, int32_t *dim);

/** Whether a domain in space is what its surfaces enclose, as it is at first, or the surfaces
 * alone: nodes on them and triangles between these, and nothing inside. Then surfaces of both roles
 * count alike and may be closed or open; nodes lie on their borders, and the triangles' normals
 * point to where those of most triangles of a surface did that was given. Polylines must follow
 * edges of the triangles, fixed nodes must be vertices of them, holes there are none. Options mean
 * what they do in the plane. Local.
 *  @param[in] filled  nonzero: what they enclose; 0: the surfaces alone */
PNPBS_API pnpbs_status pnpbs_domain_set_filled(pnpbs_domain domain, int32_t filled);

/** Takes the surfaces of a domain in space that are given as triangles and bound it, boxes, balls
 *  and cylinders among them, for what encloses one body badly: open, crossing, folded, turned this
 *  way and that, as scans are and parts put together. The body is where they wind around a point
 *  more than half a time (generalised winding number, Jacobson, Kavan and Sorkine-Hornung 2013),
 *  whichever way: holes are closed, what lies inside or encloses nothing is dropped, overlapping
 *  bodies are joined; a cavity must turn against what surrounds it. Its surface is found as that of
 *  a level set (pnpbs_domain_add_level_set), with its sharp edges, on the triangles given where
 *  there are any; all of it has the tag of the first triangle. What is thinner than the resolution
 *  can be lost. A warning and the statistics `repaired.*` tell how far the surface is from the
 *  triangles given. Other surfaces and nodes stay as they are. Local. Errors: PNPBS_ERROR_ARGUMENT;
 *  pnpbs_domain_check and whatever checks the domain return PNPBS_ERROR_DOMAIN if the triangles
 *  enclose nothing.
 *  @param[in] resolution  > 0, no more than the spacing at the surface; 0: 1/64 of the longest side
 *                         of the box around the triangles */
PNPBS_API pnpbs_status pnpbs_domain_set_repair(pnpbs_domain domain, double resolution);

/** Adds straight segments through n vertices. Local.
 *  @param[in] role          PNPBS_BOUNDARY or PNPBS_INNER; in space PNPBS_INNER
 *  @param[in] closed        nonzero: a segment leads from the last vertex to the first; the
 *                           first vertex is not repeated
 *  @param[in] coordinates   [n][dim]
 *  @param[in] tags          [number of segments], nonzero, or NULL for 1
 *  @param[in] corner_angle  degrees, 0 .. 180. 0: every vertex becomes a node. Otherwise only
 *                           vertices where the direction turns by more than this do, as do the
 *                           ends of open polylines and vertices where curves meet; between them
 *                           the polyline stands for a smooth curve. In space it does not count, but
 *                           the feature_angle of the surfaces does in its place */
PNPBS_API pnpbs_status pnpbs_domain_add_polyline(pnpbs_domain domain, int32_t role, int32_t closed,
                                                 int64_t n, const double *coordinates,
                                                 const int32_t *tags, double corner_angle);

/** Adds a triangulated surface to a domain in space. Closed ones with the role PNPBS_BOUNDARY bound
 *  it: the inside is what lies behind an odd number of them. PNPBS_INNER: nodes follow the surface,
 *  closed or open, inside the domain. Vertices that coincide are one; what the triangles enclose
 *  decides their orientation. Local.
 *  @param[in] role           PNPBS_BOUNDARY or PNPBS_INNER
 *  @param[in] coordinates    [vertices][3]
 *  @param[in] corners        [triangles][3], 0-based vertex indices
 *  @param[in] tags           [triangles], nonzero, or NULL for 1
 *  @param[in] feature_angle  degrees, 0 .. 180: where the normals of two triangles differ by more,
 *                            or their tags do, nodes lie on the edge between them. Between such
 *                            edges the triangles are the shape alone, whatever their size. 40 suits
 *                            most */
PNPBS_API pnpbs_status pnpbs_domain_add_surface(pnpbs_domain domain, int32_t role, int64_t vertices,
                                                const double *coordinates, int64_t triangles,
                                                const int64_t *corners, const int32_t *tags,
                                                double feature_angle);

/** The same from a file: .stl (text or binary), .off, .obj, .ply, or .poly and .smesh as TetGen has
 *  them. Solids, groups, materials and facet markers become tags, with their names
 *  (pnpbs_domain_get_tag_name), hole points holes of the domain in space.
 *  Local. Errors: PNPBS_ERROR_FILE with file, line and what was expected. */
PNPBS_API pnpbs_status pnpbs_domain_read_surface(pnpbs_domain domain, int32_t role,
                                                 const char *path, double feature_angle);

/** The role of all triangles in a domain in space that have this tag, whatever role they are added
 *  with, before or after: so single groups of a file can be inner surfaces. Local. Checking the
 *  domain fails if no triangle has the tag.
 *  @param[in] tag   nonzero
 *  @param[in] role  PNPBS_BOUNDARY or PNPBS_INNER */
PNPBS_API pnpbs_status pnpbs_domain_set_role(pnpbs_domain domain, int32_t tag, int32_t role);

/** Reads a mesh in Gmsh's MSH format, 4.1 or 2.2, text or binary, and adds what bounds it to the
 *  domain. In space these are its triangles and quadrangles: where elements of volumes, or the
 *  geometry that the file tells of, are on both sides, they are inner surfaces, else boundary;
 * where the file tells of neither, closed surfaces are boundary (within each other, too: cavities),
 * and sheets and what divides a body are inner. Lines and points in physical groups are inner
 * curves and fixed nodes. In the plane they are its lines, and the edges that bound triangles and
 *  quadrangles; points as in space. Without elements that fill the domain, closed lines are
 *  boundary and open ones inner. The tag of a physical group becomes the tag, its name stays with
 * it (pnpbs_domain_get_tag_name); where the file has no physical groups, the entities' numbers are
 * the tags. Elements of higher order are taken for straight ones, with a warning. Local. Errors:
 *  PNPBS_ERROR_FILE with file, line or byte, and what was expected.
 *  @param[in] feature_angle  degrees, 0 .. 180: as pnpbs_domain_add_surface has it, in the plane as
 *                            the corner_angle of pnpbs_domain_add_polyline, but 0 only makes every
 *                            vertex a node there */
PNPBS_API pnpbs_status pnpbs_domain_read_msh(pnpbs_domain domain, const char *path,
                                             double feature_angle);

/** The dimension of the domain that a file describes: by the ending of its name, of .poly by the
 *  second number in it, of .msh by whether it lies in a plane of constant z. Local. Errors:
 *  PNPBS_ERROR_FILE if a .msh cannot be read; other files are not checked.
 *  @param[out] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_file_dimension(const char *path, int32_t *dim);

/** Names a tag, copied: files that have physical groups (.msh) are written with it. Replaces the
 *  name that it has. Local.
 *  @param[in] dim   of what has the tag: 0 points, 1 curves, 2 surfaces, 3 bodies; the inside of
 *                   the domain has the domain's dimension
 *  @param[in] tag   nonzero */
PNPBS_API pnpbs_status pnpbs_domain_set_tag_name(pnpbs_domain domain, int32_t dim, int32_t tag,
                                                 const char *name);

/** Number of tags that have names, given or from files. Local. */
PNPBS_API pnpbs_status pnpbs_domain_tag_name_count(pnpbs_domain domain, int32_t *count);

/** One of the names, by dimension, then by tag. Local; any output may be NULL; the string is valid
 *  until the names change.
 *  @param[in] index  0 .. count-1 */
PNPBS_API pnpbs_status pnpbs_domain_get_tag_name(pnpbs_domain domain, int32_t index, int32_t *dim,
                                                 int32_t *tag, const char **name);

/** Adds a box to a domain in space; its sides bound the domain. Local.
 *  @param[in] low,high  [3] */
PNPBS_API pnpbs_status pnpbs_domain_add_box(pnpbs_domain domain, const double *low,
                                            const double *high, int32_t tag);

/** Adds a ball to a domain in space, as triangles within 1e-4 of the radius. Local.
 *  @param[in] centre  [3]
 *  @param[in] radius  > 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_ball(pnpbs_domain domain, const double *centre,
                                             double radius, int32_t tag);

/** Adds a round cylinder to a domain in space, as triangles within 1e-4 of the radius. Local.
 *  @param[in] begin,end  [3], the middles of its two circles
 *  @param[in] radius     > 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_cylinder(pnpbs_domain domain, const double *begin,
                                                 const double *end, double radius, int32_t tag);

/** A level set: fills values[n] with f at coordinates[n][dim], dim = 3; the body is where f < 0.
 *  Must be a pure function of the point, the same on all ranks, continuous and finite in its whole
 *  box; it need not be a distance. Return 0, or nonzero to fail the call with
 *  PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_level_set_fn)(int64_t n, int32_t dim, const double *coordinates,
                                      double *values, void *user);

/** Adds the body where f < 0 to a domain in space; it must lie in the box. Its surface is found on
 *  an octree that is refined near f = 0 down to cells of side `resolution`: what is thinner can be
 *  lost, and so can a body that is small beside the box and towards which f does not fall. Nodes on
 *  the surface lie where f = 0, however coarse the triangles are that lead them there. Where the
 *  gradient of f jumps by more than 40 degrees, as that of max(g, h) does, the surface has an edge,
 *  with nodes on it, and where such edges meet a corner; where triangles would cross, as they may
 *  at edges of less than 60 degrees, these stay rounded by the resolution, with a warning. The
 *  callback is called during this function, whenever a placement is initialised or runs, and for
 *  its normals, so it and `user` must outlive the placements made on the domain. Local. Errors:
 * PNPBS_ERROR_DOMAIN with the place where f is not finite, or negative on the border of the box, or
 * if it is negative nowhere.
 *  @param[in] level_set   not NULL
 *  @param[in] low,high    [3], the box, in which alone f is asked
 *  @param[in] resolution  > 0, at most the box's shortest side; no more than the spacing at the
 *                         surface, and than half of the least radius to which it is bent
 *  @param[in] tag         nonzero */
PNPBS_API pnpbs_status pnpbs_domain_add_level_set(pnpbs_domain domain, pnpbs_level_set_fn level_set,
                                                  void *user, const double *low, const double *high,
                                                  double resolution, int32_t tag);

/** Adds a circular arc to a domain in the plane; its ends join curves that end at the same point
 *  (within 1e-9 of the domain's size). Local.
 *  @param[in] centre          [2]
 *  @param[in] radius          > 0
 *  @param[in] begin,end       angles in radians; |end - begin| = 2 pi makes a full circle */
PNPBS_API pnpbs_status pnpbs_domain_add_arc(pnpbs_domain domain, int32_t role, const double *centre,
                                            double radius, double begin, double end, int32_t tag);

/** Adds a general curve, given by a callback on begin <= t <= end, to a domain in the plane. The
 *  callback is called during this function and whenever a placement is initialised, so it and
 *  `user` must outlive the placements made on the domain. A curve whose ends coincide is closed.
 *  Smooth inside: corners are where curves meet. Local. */
PNPBS_API pnpbs_status pnpbs_domain_add_curve(pnpbs_domain domain, int32_t role,
                                              pnpbs_curve_fn curve, void *user, double begin,
                                              double end, int32_t tag);

/** Adds a planar straight-line graph as Triangle means it to a domain in the plane: what the
 *  segments enclose is the domain, except the regions that contain a hole point; a loop without a
 *  hole point and any open chain are inner curves. Every vertex becomes a node. Shared vertices and
 *  T-junctions (within 1e-12 of the domain's size) are legal. Once a graph was added, this rule
 *  holds for all curves of the domain. Local.
 *  @param[in] coordinates   [vertices][2]
 *  @param[in] vertex_tags   [vertices] or NULL; 0 = take the segment's
 *  @param[in] segment_ends  [segments][2], 0-based vertex indices
 *  @param[in] segment_tags  [segments] or NULL for 1
 *  @param[in] hole_points   [holes][2]; may be NULL if holes is 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_pslg(pnpbs_domain domain, int64_t vertices,
                                             const double *coordinates, const int32_t *vertex_tags,
                                             int64_t segments, const int64_t *segment_ends,
                                             const int32_t *segment_tags, int64_t holes,
                                             const double *hole_points);

/** Removes from the domain the region around a point, as far as the next curves or surfaces of
 *  either role. Local.
 *  @param[in] point  [dim] */
PNPBS_API pnpbs_status pnpbs_domain_add_hole(pnpbs_domain domain, const double *point);

/** Adds nodes that must appear exactly. Local.
 *  @param[in] coordinates  [n][dim], inside the domain or on a vertex of its curves or surfaces
 *  @param[in] tags  [n], nonzero, or NULL for 1 */
PNPBS_API pnpbs_status pnpbs_domain_add_fixed_nodes(pnpbs_domain domain, int64_t n,
                                                    const double *coordinates, const int32_t *tags);

/** Reads a file of Triangle's .poly format (vertices numbered from 0 or 1, attributes ignored,
 *  markers kept as tags) and adds it to a domain in the plane as pnpbs_domain_add_pslg does. Local.
 *  Errors: PNPBS_ERROR_FILE with file, line and what was expected. */
PNPBS_API pnpbs_status pnpbs_domain_read_poly(pnpbs_domain domain, const char *path);

/** The same from memory. Local. @param[in] name  what to call the text in messages */
PNPBS_API pnpbs_status pnpbs_domain_parse_poly(pnpbs_domain domain, const char *text,
                                               int64_t length, const char *name);

/** Spacing callback: fills d[n] for coordinates[n][dim]. n may be 0. Must be a pure function of the
 *  point; may be asked anywhere in the domain's bounding box that lies inside the domain or on
 *  its boundary. Return 0, or nonzero to fail the call with PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_spacing_fn)(int64_t n, int32_t dim, const double *coordinates, double *d,
                                    void *user);

/** Where the graphs of a domain in the plane have corners (pnpbs_domain_add_pslg, _read_poly,
 *  _parse_poly), those given before and those given after: at vertices where the direction turns by
 *  more than this, where segments of different tags or other than two of them end, and at vertices
 *  with a tag of their own. Nodes lie on corners; between them a graph stands for a smooth curve,
 * and nodes lie on it as d says, however fine its segments are. Local.
 *  @param[in] corner_angle  degrees, 0 .. 180. 0, as it is at first: every vertex becomes a node */
PNPBS_API pnpbs_status pnpbs_domain_set_corner_angle(pnpbs_domain domain, double corner_angle);

/** Leaves out what is finer than d in a domain in the plane, as coastlines are: of the graphs and
 *  polylines given so far, vertices beside segments shorter than d, as long as the curve then
 * passes them within tolerance * d; and closed curves, islands and lakes, whose extent (the longer
 * side of their bounding box) is less than smallest * d. No other vertex, fixed node or hole point
 * comes to another side of a curve. Vertices stay where curves meet or end, where tags change or a
 * vertex has its own, and at fixed nodes. A curve with one of these, or around one that stays, is
 * not left out, nor is the largest; hole points within curves that are left out go with them. If it
 * fails, the domain stays as it was. Local; on several ranks all must do the same.
 *  @param[in] spacing    d, called during this function alone; it may ask for the shape of the
 *                        domain as it was, if that has been asked for before
 *  @param[in] tolerance  >= 0; 0.25 suits most
 *  @param[in] smallest   >= 0; 0 leaves no curve out
 *  @param[out] vertices  how many were left out, those of the curves included; may be NULL
 *  @param[out] curves    how many were left out; may be NULL */
PNPBS_API pnpbs_status pnpbs_domain_simplify(pnpbs_domain domain, pnpbs_spacing_fn spacing,
                                             void *user, double tolerance, double smallest,
                                             int64_t *vertices, int64_t *curves);

/** The same by a spacing from a file with values at points, as pnpbs_placement_set_spacing_file
 *  takes it; the growth of d is not limited here. Local; on several ranks all must do the same.
 *  Checks the domain first. Errors: PNPBS_ERROR_FILE for what cannot be read, PNPBS_ERROR_SPACING
 *  for a value that is zero, negative or not finite and for points that do not meet the domain's
 *  box, PNPBS_ERROR_DOMAIN as pnpbs_domain_check.
 *  @param[in] path   the file
 *  @param[in] field  the values that are meant; NULL: the only ones, or those called "spacing" */
PNPBS_API pnpbs_status pnpbs_domain_simplify_by_file(pnpbs_domain domain, const char *path,
                                                     const char *field, double tolerance,
                                                     double smallest, int64_t *vertices,
                                                     int64_t *curves);

/** Checks the whole geometry: duplicate vertices, self-intersections, boundary curves or surfaces
 *  that do not close, hole points outside or on one, fixed nodes outside or too close. Placements
 *  check too; asking early costs nothing extra. Local. Errors: PNPBS_ERROR_DOMAIN naming the
 *  vertex, segment or triangle. */
PNPBS_API pnpbs_status pnpbs_domain_check(pnpbs_domain domain);

/** Bounding box of the curves or surfaces. Local. @param[out] low,high  [dim] */
PNPBS_API pnpbs_status pnpbs_domain_bounds(pnpbs_domain domain, double *low, double *high);

/** Area of the inside, in space its volume, of surfaces alone their area. Local; checks the domain
 *  first. */
PNPBS_API pnpbs_status pnpbs_domain_measure(pnpbs_domain domain, double *measure);

/** Distances to the shape of the domain: exact to segments and triangles, to arcs and curves by
 *  callback within 1e-7 of the domain's size. Local; checks the domain first. The first question
 *  after a change of the domain builds a tree of its pieces, for which curves by callback are
 *  asked: ask one before asking from inside a callback (as a spacing callback may).
 *  Errors: PNPBS_ERROR_ARGUMENT if nothing has the tag.
 *  @param[in]  tag          of curves, surfaces or nodes; 0: to what bounds the domain
 *  @param[in]  coordinates  [n][dim]
 *  @param[out] distances    [n] */
PNPBS_API pnpbs_status pnpbs_domain_distance(pnpbs_domain domain, int32_t tag, int64_t n,
                                             const double *coordinates, double *distances);

/** The spacing that pnpbs_placement_set_spacing_from_shape would set, without its bounds: for a
 *  spacing callback that has its own use for it. Local; checks the domain first. What the shape
 *  asks for is found at the first question and kept: ask one before asking from inside a callback.
 *  @param[in]  nodes_per_turn,nodes_across,nodes_per_edge,growth  as there
 *  @param[in]  coordinates  [n][dim]
 *  @param[out] d            [n] at most the size of the domain */
PNPBS_API pnpbs_status pnpbs_domain_shape_spacing(pnpbs_domain domain, double nodes_per_turn,
                                                  double nodes_across, double nodes_per_edge,
                                                  double growth, int64_t n,
                                                  const double *coordinates, double *d);

/** Straight segments that show a domain in the plane (curves finely sampled), for pictures. Local.
 *  Ask with capacity 0 for the count.
 *  @param[out] count     number of segments
 *  @param[out] segments  [count][2][2], or NULL
 *  @param[out] tags      [count], or NULL */
PNPBS_API pnpbs_status pnpbs_domain_get_segments(pnpbs_domain domain, int64_t capacity,
                                                 int64_t *count, double *segments, int32_t *tags);

/* ---------------------------------------------------------------- placement ------------- */

/** Progress, told at fixed step numbers and, some times a second, while the first nodes are laid or
 *  the growth of the spacing is limited, between steps that take long (on one rank), and between
 *  the parts of the finish. While nodes are laid or growth is limited, ranks are asked each by its
 *  own clock: do nothing collective when fraction is 0. Return 0 to go on, nonzero to stop: the
 *  call in progress then ends with PNPBS_STOPPED and its nodes are valid; stopped before the first
 *  nodes are laid, it has none.
 *  @param fraction   of the work of the call in progress, 0 .. 1
 *  @param step       steps done so far
 *  @param nodes      nodes there are now, 0 while the first ones are laid
 *  @param max_speed  largest scaled speed (spacings per unit time) */
typedef int32_t (*pnpbs_monitor_fn)(double fraction, int64_t step, int64_t nodes, double max_speed,
                                    void *user);

/** A placement of nodes in `domain`, with the options of its context. The domain is taken as it
 *  is at initialise. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_create(pnpbs_context context, pnpbs_domain domain,
                                              pnpbs_placement *placement);

/** Destroys the handle and sets it to NULL; takes NULL. Local. */
PNPBS_API pnpbs_status pnpbs_placement_destroy(pnpbs_placement *placement);

/** Sets an option of this placement; otherwise as pnpbs_context_set. Local. */
PNPBS_API pnpbs_status pnpbs_placement_set(pnpbs_placement placement, const char *key,
                                           const char *value);
PNPBS_API pnpbs_status pnpbs_placement_set_int64(pnpbs_placement placement, const char *key,
                                                 int64_t value);
PNPBS_API pnpbs_status pnpbs_placement_set_double(pnpbs_placement placement, const char *key,
                                                  double value);

/** The spacing everywhere the same. On a live placement the spacing is replaced: the nodes there
 *  are stay, and the next run starts from them. Collective.
 *  Errors: PNPBS_ERROR_SPACING for zero, negative, not finite. */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d);

/** The spacing from a callback, which must stay valid as long as the placement uses it.
 *  Collective. Bad values are found when it is asked, in initialise or run: the error names the
 *  point and the number of nodes it would have meant. */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
                                                            pnpbs_spacing_fn spacing, void *user);

/** The spacing from values on a rectangular grid, copied; linear in each direction between them,
 *  constant beyond the grid's edge: where nodes lie farther than d and half a step from it there
 *  is a warning (pnpbs_placement_get_warning). In a direction with one grid point the value holds
 *  everywhere. Collective. Checks the domain first. Errors: PNPBS_ERROR_SPACING for a value that
 *  is zero, negative or not finite, and for a grid that does not meet the domain's box;
 *  PNPBS_ERROR_DOMAIN as pnpbs_domain_check.
 *  @param[in] size    [dim] number of grid points in each direction, >= 1
 *  @param[in] origin  [dim] the first grid point
 *  @param[in] step    [dim] > 0, distance of grid points
 *  @param[in] values  [size[1]][size[0]], in space [size[2]][size[1]][size[0]] (x fastest) */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement,
                                                        const int64_t *size, const double *origin,
                                                        const double *step, const double *values);

/** The spacing from values at the nodes of a background mesh, copied: linear on each triangle, in
 *  space on each tetrahedron, and beyond the mesh what it is at the mesh's nearest point: where
 *  nodes lie farther than d from it there is a warning (pnpbs_placement_get_warning). Elements
 *  may overlap (the one with the least node numbers counts) and need not share whole sides. Its
 *  growth is limited as that of any spacing (option growth_limit).
 *  Collective; every rank gives the same arrays, and holds them. Checks the domain first. Errors:
 *  PNPBS_ERROR_SPACING for a value that is zero, negative or not finite, and for a mesh whose box
 *  does not meet the domain's; PNPBS_ERROR_ARGUMENT for a node number out of range, an element
 *  that is flat, ranks that differ; PNPBS_ERROR_DOMAIN as pnpbs_domain_check.
 *  @param[in] n            number of nodes of the mesh, below 2^31
 *  @param[in] coordinates  [n][dim]
 *  @param[in] d            [n]
 *  @param[in] elements     number of triangles or tetrahedra, >= 1
 *  @param[in] corners      [elements][dim + 1] 0-based node numbers, whichever way round */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_mesh(pnpbs_placement placement, int64_t n,
                                                        const double *coordinates, const double *d,
                                                        int64_t elements, const int64_t *corners);

/** The spacing from values at scattered points, copied: at each of them its own value, elsewhere a
 *  plane fitted to the 8 (in space 16) nearest ones by weighted least squares, never below the
 * least nor above the largest of their values. A linear function is met amid its points; far from
 * all of them d is near the values of the nearest, with a warning where nodes lie far beyond the
 * points' box. The weights are (1/r - 1/R)^2, r the distance of
 * a point and R that of the nearest one that does not count, so d is continuous (R. Franke, G.
 * Nielson, Int. J. Numer. Methods Eng. 15 (1980) 1691-1704). The order of the points changes
 *  nothing.
 *  Collective; every rank gives the same arrays, and holds them. Checks the domain first. Errors:
 *  PNPBS_ERROR_SPACING for a value that is zero, negative or not finite, for points in one place
 *  with different values, and for points whose box does not meet the domain's;
 *  PNPBS_ERROR_ARGUMENT for ranks that differ; PNPBS_ERROR_DOMAIN as pnpbs_domain_check.
 *  @param[in] n            number of points, 1 .. 2^31 - 1
 *  @param[in] coordinates  [n][dim]
 *  @param[in] d            [n] */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_points(pnpbs_placement placement, int64_t n,
                                                          const double *coordinates,
                                                          const double *d);

/** The spacing from a file with values at points, by the ending of its name:
 *    .vtu   VTK's unstructured grid, as VTK, ParaView, meshio and pnpbs_placement_write write it:
 *           text, base64 or raw, packed by zlib or not
 *    .msh   Gmsh's, versions 4.1 and 2.2, text or binary, with $NodeData
 *    .csv   a header with columns x, y, (z) and others, and a point in each line
 *  Triangles and quadrangles, in space tetrahedra are a mesh as pnpbs_placement_set_spacing_mesh
 *  takes it; without any the points are as for pnpbs_placement_set_spacing_points. In the plane z
 * is left out. Collective; every rank reads the file. Errors: PNPBS_ERROR_FILE for a file that
 * cannot be read, is none of these or has other elements, and for a field that is not there, with
 * those that are; those of the two functions above.
 *  @param[in] path   the file
 *  @param[in] field  its name in the file; NULL or "": the only one, or the one called "spacing" */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_file(pnpbs_placement placement, const char *path,
                                                        const char *field);

/** The spacing from the shape of the domain as it is now: the least that its curves and surfaces
 * ask for, each growing with the distance from it. Collective. The same on any number of ranks.
 *  Errors: PNPBS_ERROR_DOMAIN as pnpbs_domain_check, PNPBS_ERROR_ARGUMENT for negative numbers,
 *  PNPBS_ERROR_SPACING where the domain is too narrow to take its width all along.
 *  @param[in] nodes_per_turn  by curvature: nodes on a full circle of its radius. That of polylines
 *                             is of the circle through neighbouring vertices, that of triangulated
 *                             surfaces is by how normals turn, where they turn by less than 40
 *                             degrees from one to the next. 0: does not count
 *  @param[in] nodes_across    by width: d at a place of the boundary is this part of the diameter
 * of the largest ball that touches it there and meets nothing ahead. 0: does not count
 *  @param[in] nodes_per_edge  by the input: d at a segment is this part of its length, at a
 * triangle of the mean length of its edges. Arcs and curves have none. 0: does not count
 *  @param[in] growth          of d per unit of distance; 0: 0.15
 *  @param[in] min_spacing     d is at least this; 0: no bound
 *  @param[in] max_spacing     d is at most this; 0: the size of the domain */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_from_shape(
    pnpbs_placement placement, double nodes_per_turn, double nodes_across, double nodes_per_edge,
    double growth, double min_spacing, double max_spacing);

/** The spacing from values at the nodes there are: d is linear on each triangle or tetrahedron of
 *  their Delaunay triangulation (pnpbs_placement_get_triangles, pnpbs_placement_get_tetrahedra),
 *  and beyond its rim, next to curved boundaries, what it is at the nearest point of the rim. Every
 *  rank gives the values of its own nodes; they stay with the ranks, copied together with the
 *  triangles or tetrahedra, and the nodes may go on to be replaced. Collective. Errors:
 *  PNPBS_ERROR_STATE without nodes, PNPBS_ERROR_SPACING for a value that is zero, negative or not
 *  finite: the message names the rank, the node's id and the value.
 *  @param[in] n  number of nodes of this rank (pnpbs_placement_count)
 *  @param[in] d  [n] in the order of pnpbs_placement_get_nodes */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_at_nodes(pnpbs_placement placement, int64_t n,
                                                            const double *d);

/** Sets the monitor, or removes it (NULL). Local. */
PNPBS_API pnpbs_status pnpbs_placement_set_monitor(pnpbs_placement placement,
                                                   pnpbs_monitor_fn monitor, void *user);

/** Inner nodes to start from instead of the initial fill, copied; the boundary is laid by the
 *  library. Over several ranks each gives some, wherever they lie. Where they are many times too
 *  dense for d they are thinned (statistic `deleted`). Points outside the domain or too close to
 *  its boundary are left out (statistic `dropped`). Clears the nodes there are. Collective.
 *  On surfaces alone they go to the nearest place on a surface, if that is no farther than d.
 *  @param[in] coordinates   [n][dim]
 *  @param[in] ids  [n], distinct, 0 .. 2^62, or NULL for ids of the library's choice */
PNPBS_API pnpbs_status pnpbs_placement_set_nodes(pnpbs_placement placement, int64_t n,
                                                 const double *coordinates, const int64_t *ids);

/** What a run from nothing would come to, from domain, spacing and options alone: d is sampled in
 *  some thousand places (where its growth is limited, in as many as by the run), no inner node is
 *  made, and the nodes there are stay as they are.
 *  Collective; outputs may be NULL. Errors: PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK.
 *  @param[out] nodes    on all ranks: in the plane mostly within one percent, in space five
 *  @param[out] bytes    memory of each process, for the run alone
 *  @param[out] seconds  roughly: by what a core of a present server does, times the threads of all
 *                       ranks */
PNPBS_API pnpbs_status pnpbs_placement_estimate(pnpbs_placement placement, int64_t *nodes,
                                                int64_t *bytes, double *seconds);

/** Checks domain and spacing, builds the background tree, lays the boundary nodes and the initial
 *  inner nodes. Where d varies these come from coarser levels (option `levels`), which are run.
 *  Collective. Errors: PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK; PNPBS_ERROR_MEMORY also where d
 *  asks for nodes that need more than the memory available, times the option `max_memory`. Returns
 *  PNPBS_OK, or PNPBS_STOPPED: of a coarser level there are nodes. */
PNPBS_API pnpbs_status pnpbs_placement_initialise(pnpbs_placement placement);

/** Advances the simulation by n steps, with the events (refresh of d, population, stop test)
 *  that fall on them. Initialises first if need be. Collective.
 *  Returns PNPBS_OK if the bubbles rest (stop test met), PNPBS_NOT_CONVERGED if they still move,
 *  PNPBS_STOPPED. */
PNPBS_API pnpbs_status pnpbs_placement_step(pnpbs_placement placement, int64_t n);

/** One population adjustment, now: deletes where the overlap ratio is too large, inserts where
 *  it is too small (equation (3) of the paper). Initialises first if need be; if the monitor stops
 *  that, PNPBS_STOPPED is returned, and nothing is adjusted. Collective. Outputs may be NULL. */
PNPBS_API pnpbs_status pnpbs_placement_adjust_population(pnpbs_placement placement,
                                                         int64_t *inserted, int64_t *deleted);

/** Deals the work out to the ranks anew, by METIS and the work counted in the lists, so that each
 *  owns an equal share and little changes its rank. The nodes stay as they are; who owns them, and
 *  who has which ghosts, changes. A run does so by itself where the statistic `imbalance` (largest
 *  over mean work) passes the option `rebalance_above`. Initialises first if need be; if the
 *  monitor stops that, PNPBS_STOPPED is returned, and the ranks keep what they have. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_rebalance(pnpbs_placement placement);

/** The whole job: initialise if need be, steps until the stop test is met or `steps` are done,
 *  finish. Afterwards it starts a new schedule from the nodes there are. Collective.
 *  Returns PNPBS_OK; PNPBS_NOT_CONVERGED (the best state is kept); PNPBS_SPACING_MISSED, whether
 *  the bubbles rest or not, if in one of the bands of pnpbs_placement_get_edge_bands with 50 edges
 *  or more the mean is off 1 by more than 0.1: then there is a warning that names the band;
 *  PNPBS_NOT_CONFORMING, whatever else is true, if there are no tetrahedra, nodes are in none, some
 *  have no volume, their boundary is torn or has another Euler characteristic than the domain's,
 *  the volume is off the domain's by more than 0.001 of it and more than boundary faces can cut
 *  off, or triangles of surfaces alone do not join: then there is a warning that says so;
 *  PNPBS_STOPPED. The nodes are valid in all these cases. In space, before it would return
 *  PNPBS_NOT_CONFORMING, d is made smaller around the places where elements are lacking, and the
 *  run goes on from its nodes, up to `conforming_rounds` times; a warning says what that cost
 *  (statistic `unresolved_places`). It stays smaller there until another spacing is set. There is a
 *  warning, too, where the tetrahedra's boundary does not follow the surfaces (statistic
 *  `missing_faces`): see the option `resolve`; and where corners and sharp edges are left out
 *  (statistic `left_out`), as no tetrahedra hold on to them: what lies between them is smaller than
 *  half of d, or the body ends there in a tip or an edge too sharp for any d. */
PNPBS_API pnpbs_status pnpbs_placement_run(pnpbs_placement placement);

/** The dimension of the placement's domain. Local.
 *  @param[out] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_placement_dimension(pnpbs_placement placement, int32_t *dim);

/** Number of nodes of this rank. Local. */
PNPBS_API pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t *nodes);

/** Copies the nodes of this rank out, in their local order; any array may be NULL. Local.
 *  @param[in]  capacity  nodes the arrays have room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] coordinates  [nodes][dim]
 *  @param[out] ids       [nodes] global ids, the same for any number of ranks and threads
 *  @param[out] tags      [nodes] 0 inner, otherwise the tag of the curve, surface or fixed node
 *  @param[out] spacing   [nodes] d at the node, no more than 1024 times the domain's size; on a
 *                        boundary that is far finer than d, 32 of the node's longest edge there */
PNPBS_API pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity,
                                                 double *coordinates, int64_t *ids, int32_t *tags,
                                                 double *spacing);

/** Copies out where the surfaces look at the nodes of this rank, of a placement in space: the unit
 *  normal of the triangle that a node lies on, on feature edges and in corners the mean of those on
 *  its sides (where these look against each other, and for inner nodes, 0). On level sets, but for
 *  their corners, it is the gradient of f, by differences. They point out of a filled domain.
 *  Local.
 *  @param[in]  capacity  nodes the array has room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] normals   [nodes][3] */
PNPBS_API pnpbs_status pnpbs_placement_get_normals(pnpbs_placement placement, int64_t capacity,
                                                   double *normals);

/** Number of ghosts: nodes of other ranks that this rank sees near its own. In lists, stars,
 *  triangles and tetrahedra ghost g has the local index nodes + g. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t *ghosts);

/** Copies the ghosts out, by increasing id; any array may be NULL. Collective.
 *  @param[in]  capacity  ghosts the arrays have room for
 *  @param[out] coordinates, ids, tags, spacing  as pnpbs_placement_get_nodes
 *  @param[out] owners    [ghosts] the rank that owns each */
PNPBS_API pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity,
                                                  double *coordinates, int64_t *ids, int32_t *tags,
                                                  double *spacing, int32_t *owners);

/** Sizes of the exchange pattern: how values at nodes reach their ghosts on other ranks.
 *  Collective; outputs may be NULL.
 *  @param[out] neighbours  ranks that have ghosts of our nodes, or nodes that are ghosts here
 *  @param[out] sends       nodes to send, one for every rank that has it as a ghost
 *  @param[out] receives    nodes to receive: the number of ghosts */
PNPBS_API pnpbs_status pnpbs_placement_exchange_sizes(pnpbs_placement placement,
                                                      int32_t *neighbours, int64_t *sends,
                                                      int64_t *receives);

/** The exchange pattern, for a solver to use again: send the values at nodes
 *  send_nodes[send_offsets[k] .. send_offsets[k+1]-1] to ranks[k], and put what comes from there
 *  into places receive_nodes[receive_offsets[k] .. receive_offsets[k+1]-1], in the same order (that
 *  of ids). It stays right until nodes move. Collective.
 *  @param[in] neighbours, sends, receives  what the arrays have room for; too small is
 *                                          PNPBS_ERROR_CAPACITY
 *  @param[out] ranks            [neighbours] in increasing order; rank r names s where s names r
 *  @param[out] send_offsets     [neighbours + 1]
 *  @param[out] send_nodes       [sends] local indices of this rank's nodes
 *  @param[out] receive_offsets  [neighbours + 1]
 *  @param[out] receive_nodes    [receives] local indices of ghosts (nodes + g) */
PNPBS_API pnpbs_status pnpbs_placement_get_exchange(pnpbs_placement placement, int32_t neighbours,
                                                    int64_t sends, int64_t receives, int32_t *ranks,
                                                    int64_t *send_offsets, int64_t *send_nodes,
                                                    int64_t *receive_offsets,
                                                    int64_t *receive_nodes);

/** Numbers that are contiguous per rank, as PETSc and hypre want them, besides the ids: node i of
 *  this rank has number first + i, and rank r's numbers follow those of rank r - 1. Unlike the ids
 *  they depend on the ranks. Collective; outputs may be NULL.
 *  @param[in]  capacity       ghosts `ghost_numbers` has room for; if that is given and too small,
 *                             PNPBS_ERROR_CAPACITY
 *  @param[out] first          the number of this rank's first node; 0 on rank 0
 *  @param[out] count          how many numbers this rank has: its nodes
 *  @param[out] ghost_numbers  [ghosts] the numbers of the ghosts, as pnpbs_placement_get_ghosts has
 *                             them */
PNPBS_API pnpbs_status pnpbs_placement_get_numbering(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *first, int64_t *count,
                                                     int64_t *ghost_numbers);

/** Gives the ghosts the values that their owners have, of a field of `components` numbers at each
 *  node. The plan of the exchange is made at the first call after nodes have moved, and kept.
 *  Collective. Errors: PNPBS_ERROR_ARGUMENT for another n, fewer than one component, or numbers of
 *  components that differ between ranks; PNPBS_ERROR_STATE without nodes, or while an update that
 *  was begun has not ended.
 *  @param[in] n           nodes and ghosts of this rank (pnpbs_placement_count, _ghost_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[out] values     [n][components] those of this rank's nodes, which are read, then those
 *                         of its ghosts, which are filled */
PNPBS_API pnpbs_status pnpbs_placement_update_ghosts(pnpbs_placement placement, int64_t n,
                                                     int32_t components, double *values);

/** The first half of pnpbs_placement_update_ghosts, for a solver that computes while messages
 *  travel: copies the values of this rank's nodes that others need, and sends them on their way.
 *  The array may change or go as soon as it returns. One update at a time is under way for a
 *  placement; other calls may come before it is ended. Collective. Errors: as there. */
PNPBS_API pnpbs_status pnpbs_placement_begin_update_ghosts(pnpbs_placement placement, int64_t n,
                                                           int32_t components,
                                                           const double *values);

/** The second half: waits for the values that the other ranks sent when they began, and fills those
 *  of the ghosts; those of this rank's nodes are not touched. Local: it waits for no other rank to
 *  end. Errors: PNPBS_ERROR_STATE without an update under way, or if nodes have moved since it
 *  began, which ends it; PNPBS_ERROR_ARGUMENT for another n or number of components, after which
 *  the update is still under way.
 *  @param[out] values     [n][components] of which those of the ghosts are filled; need not be
 *                         the array that the update began with */
PNPBS_API pnpbs_status pnpbs_placement_end_update_ghosts(pnpbs_placement placement, int64_t n,
                                                         int32_t components, double *values);

/** Adds the values at ghosts to those of the nodes that they stand for, on the ranks that own
 * these: the way of pnpbs_placement_update_ghosts back, for sums over elements to which several
 * ranks contribute. Each sum, of a node's own value and of those at its ghosts, is exact and
 * rounded once, so no order of ranks matters: it has the same bits wherever the terms are the same
 * ones. What a rank has added up by itself before it has been rounded there; so, unless these sums
 * are exact, other numbers of ranks give results that differ by rounding. Where all bits shall be
 * the same, pnpbs_placement_get_incident_elements has what a row needs on its own rank. NaN and
 * infinities as in pnpbs_placement_sum; a sum that is 0 is +0. May be called while an update is
 * under way. Collective. Errors: PNPBS_ERROR_ARGUMENT for another n, fewer than one component, or
 * numbers of components that differ between ranks; PNPBS_ERROR_STATE without nodes.
 *  @param[in] n           nodes and ghosts of this rank (pnpbs_placement_count, _ghost_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[out] values  [n][components] those of this rank's nodes, which become the sums, then
 *                         those of its ghosts, which stay as they are */
PNPBS_API pnpbs_status pnpbs_placement_add_from_ghosts(pnpbs_placement placement, int64_t n,
                                                       int32_t components, double *values);

/** Sums of a field over the nodes of all ranks, of each component by itself: the exact sum, rounded
 *  once, to the nearest double. So it has the same bits for any number of ranks and threads and any
 *  order of nodes. NaN where a value is NaN or where there are infinities of both signs; otherwise
 *  an infinity where a value is, or where the sum is beyond the largest double. A sum that is 0 is
 *  +0. Collective. Errors: as pnpbs_placement_update_ghosts, but for updates under way.
 *  @param[in] n           entries of the array: at least this rank's nodes; those behind, its
 *                         ghosts', do not count
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] values      [n][components]
 *  @param[out] sums       [components] the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_sum(pnpbs_placement placement, int64_t n, int32_t components,
                                           const double *values, double *sums);

/** Dot products of two fields over the nodes of all ranks, of each component by itself: the sum of
 *  the exact products, rounded once, with all that pnpbs_placement_sum says of its own. No product
 *  overflows or underflows; one of an infinity and 0 is NaN. Collective.
 *  @param[in] n           entries of the arrays: at least this rank's nodes
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] x, y        [n][components]; may be the same array
 *  @param[out] products   [components] the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_dot(pnpbs_placement placement, int64_t n, int32_t components,
                                           const double *x, const double *y, double *products);

/** Number of entries of all adjacency lists of this rank's nodes. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t *entries);

/** Adjacency lists in compressed rows: the neighbours of local node i are
 *  neighbours[offsets[i] .. offsets[i+1]-1], local indices in the order of global ids; directly
 *  usable for node-based local mesh generation. Pairs that a boundary separates are not
 *  neighbours; on surfaces alone, those are that share a patch and whose normals differ by less
 * than 90 degrees. Collective.
 *  @param[in] capacity  entries `neighbours` has room for
 *  @param[out] offsets  [nodes + 1] */
PNPBS_API pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *offsets, int64_t *neighbours);

/** Number of entries of all Delaunay stars. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_star_size(pnpbs_placement placement, int64_t *entries);

/** Each node's star in the constrained Delaunay triangulation of the domain: in the plane
 *  counter-clockwise; in space all nodes that share a tetrahedron with it, or a triangle of
 * surfaces alone, in no order that means anything. Collective.
 *  @param[out] offsets     [nodes + 1]
 *  @param[out] neighbours  [entries] local indices
 *  @param[out] triangle    [entries] 1 if the node, this neighbour and the next one around (the
 *                          first one after the last) are a triangle of the domain, 0 if a gap
 *                          outside the domain lies between them. In space 0. May be NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
                                                 int64_t *offsets, int64_t *neighbours,
                                                 int8_t *triangle);

/** Triangles of the stars of a placement in the plane, each once, counter-clockwise. Over several
 *  ranks a triangle is the rank's that owns its node with the least id; other corners may be
 *  ghosts, and the triangles of all ranks together are one conforming triangulation of the domain.
 *  Collective. Ask with capacity 0 for the count.
 *  @param[out] triangles  [count][3] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_triangles(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *count, int64_t *triangles);

/** Tetrahedra of the stars of a placement in space, each once: seen from the fourth corner, the
 *  first three turn counter-clockwise, so the volume (b-a) x (c-a) . (d-a) / 6 of corners a, b, c
 *  and d is positive. Over several ranks a tetrahedron is the rank's that owns its node with the
 *  least id; other corners may be ghosts, and the tetrahedra of all ranks together are one
 *  conforming triangulation of the domain. Surfaces alone have none. Collective. Ask with capacity
 * 0 for the count.
 *  @param[out] tetrahedra  [count][4] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_tetrahedra(pnpbs_placement placement, int64_t capacity,
                                                      int64_t *count, int64_t *tetrahedra);

/** Every element with a corner among this rank's nodes, whichever rank it belongs to: triangles
 *  in the plane, tetrahedra in space, triangles on surfaces alone. With these a rank assembles
 *  the rows of its nodes by itself, without a message. An element whose corners have several
 *  owners comes on each of these ranks. The corner with the least id comes first; so an element
 *  belongs to this rank, as pnpbs_placement_get_triangles and its relatives deal them out, if its
 *  first corner is a node of this rank. The others follow in the same orientation as there, in a
 *  tetrahedron the least id of the three first. Elements are in the order of the ids of their
 *  corners: so those of a node are the same, in the same order, for any number of ranks, and a
 *  row that adds them up in this order has the same bits. Collective. Ask with capacity 0 for the
 *  count.
 *  @param[in]  capacity  elements the array has room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] count     number of elements
 *  @param[out] corners   3 or 4: corners of an element; may be NULL
 *  @param[out] elements  [count][corners] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_incident_elements(pnpbs_placement placement,
                                                             int64_t capacity, int64_t *count,
                                                             int32_t *corners, int64_t *elements);

/** Triangles of the boundary of a placement in space: the faces of tetrahedra that have no other
 *  tetrahedron behind them, counter-clockwise as seen from outside. Of surfaces alone, the
 * triangles between the nodes on them, counter-clockwise as seen from where the surface's normal
 * points to. Over several ranks a triangle is the rank's that owns its node with the least id, and
 * the triangles of all ranks together conform. Collective. Ask with capacity 0 for the count.
 *  @param[out] triangles  [count][3] local indices, or NULL
 *  @param[out] tags       [count] of the surface there, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_boundary_triangles(pnpbs_placement placement,
                                                              int64_t capacity, int64_t *count,
                                                              int64_t *triangles, int32_t *tags);

/** Boundary edges of a placement in the plane: consecutive nodes on boundary and inner curves. Over
 *  several ranks an edge is the rank's that owns the node it begins with; the other end may be a
 *  ghost. Local. Ask with capacity 0 for the count.
 *  @param[out] edges  [count][2] local indices, or NULL
 *  @param[out] tags   [count], or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_boundary_edges(pnpbs_placement placement,
                                                          int64_t capacity, int64_t *count,
                                                          int64_t *edges, int32_t *tags);

/** Checks that the results keep what is promised of them: ids are unique, no two nodes lie in one
 *  place, all lie inside or on the boundary, and all that the boundary's curves or feature edges
 *  have are there; adjacency lists are symmetric; the triangles or tetrahedra of the stars are one
 *  conforming triangulation of the domain, each in the stars of all its corners, with every
 *  boundary edge, and their areas or volumes add up to what the boundary encloses; in space the
 *  boundary triangles are closed, and cut off no more of the domain than chords do; on surfaces
 *  alone every edge has a triangle on both sides, at borders on one, and the areas add up. It takes
 *  about as long as making lists and stars, and no rank holds more than its share. Collective.
 *  Returns PNPBS_OK; PNPBS_NOT_CONFORMING where a run returns it, too: pnpbs_last_error says where,
 *  and all that the elements there are must keep holds. Errors: PNPBS_ERROR_INTERNAL if something
 *  else is wrong: the message says what, with ids and coordinates; PNPBS_ERROR_STATE without nodes.
 */
PNPBS_API pnpbs_status pnpbs_placement_check(pnpbs_placement placement);

/** A statistic by key (see pnpbs_statistic_info). Collective (some are computed when asked).
 *  Errors: PNPBS_ERROR_KEY with the nearest known name, or if the type differs;
 *  PNPBS_ERROR_ARGUMENT if the key differs between ranks. */
PNPBS_API pnpbs_status pnpbs_placement_get_int64(pnpbs_placement placement, const char *key,
                                                 int64_t *value);
PNPBS_API pnpbs_status pnpbs_placement_get_double(pnpbs_placement placement, const char *key,
                                                  double *value);
PNPBS_API pnpbs_status pnpbs_placement_get_string(pnpbs_placement placement, const char *key,
                                                  const char **value);

/** How well the edges of the triangles or tetrahedra follow the spacing, by bands of it: eight,
 *  equal in log d between the least and the largest d at the nodes, or one if that is less than 1.1
 *  times the least. Bands without edges are left out. An edge's d is the mean of d at its ends.
 *  Edges between two boundary nodes, whose places the corners of the domain decide, do not count
 *  here. Over all ranks, and the same on each. Collective. Ask with capacity 0 for the count;
 *  arrays may be NULL.
 *  @param[in]  capacity   bands the arrays have room for; 8 is always enough
 *  @param[out] count      number of bands
 *  @param[out] d_from     [count] where each begins, in the unit of the coordinates; increasing
 *  @param[out] d_to       [count] where it ends
 *  @param[out] edges      [count] how many edges there are
 *  @param[out] mean       [count] of their length over d
 *  @param[out] deviation  [count] standard deviation of that */
PNPBS_API pnpbs_status pnpbs_placement_get_edge_bands(pnpbs_placement placement, int64_t capacity,
                                                      int64_t *count, double *d_from, double *d_to,
                                                      int64_t *edges, double *mean,
                                                      double *deviation);

/** Warnings about domain and spacing, gathered at initialise (a feature smaller than d, an unused
 *  vertex, ...), and about nodes that do not follow the spacing, of the last run. Local. */
PNPBS_API pnpbs_status pnpbs_placement_warning_count(pnpbs_placement placement, int32_t *count);
PNPBS_API pnpbs_status pnpbs_placement_get_warning(pnpbs_placement placement, int32_t index,
                                                   const char **text);

/* ---------------------------------------------------------------- transfer -------------- */

/** Takes a field to the nodes that will be: copies the values of all ranks at the nodes that the
 *  placement has now, together with these nodes and their triangles or tetrahedra, each rank its
 *  own. The nodes may then move, be replaced or change their ranks, and the placement may go. The
 *  field is linear on each triangle or tetrahedron; beyond their rim, next to curved boundaries, it
 *  goes on as on the one behind the nearest place of the rim. So fields that are linear stay what
 *  they are, and others change by a part of the second order in d. On surfaces alone it is linear
 *  on each triangle between their nodes, and elsewhere what it is at the nearest place of these.
 *  Collective. Errors: PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT for another n, fewer
 *  than one component, or a value that is not finite: the message names the rank, the component and
 *  the node's id.
 *  @param[in] placement   whose nodes there are values for
 *  @param[in] n           number of nodes of this rank (pnpbs_placement_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] values      [n][components] in the order of pnpbs_placement_get_nodes
 *  @param[out] transfer   the handle */
PNPBS_API pnpbs_status pnpbs_transfer_create(pnpbs_placement placement, int64_t n,
                                             int32_t components, const double *values,
                                             pnpbs_transfer *transfer);

/** The same with a field of second order: at each node a polynomial of second order goes through
 * its value and is fitted by least squares to those of its neighbours and of their neighbours in
 * the stars (so across no boundary, and the same for all components); within an element those of
 * its corners count as much as in the linear field. So fields that are quadratic in the coordinates
 * stay what they are, and smooth ones change by a part of the third order in d. Next to jumps the
 * field may leave the range of the values there. Where a node has too few neighbours for that, its
 * part is linear (pnpbs_transfer_order tells at how many), as it is everywhere on surfaces alone.
 *  Collective. Errors and parameters as there. */
PNPBS_API pnpbs_status pnpbs_transfer_create_second_order(pnpbs_placement placement, int64_t n,
                                                          int32_t components, const double *values,
                                                          pnpbs_transfer *transfer);

/** Of which order the field is. Outputs may be NULL. Local.
 *  @param[out] order         1 or 2
 *  @param[out] linear_nodes  nodes on all ranks without a polynomial of second order; with order 1
 *                            all, told as -1 */
PNPBS_API pnpbs_status pnpbs_transfer_order(pnpbs_transfer transfer, int32_t *order,
                                            int64_t *linear_nodes);

/** Destroys the handle and sets it to NULL; takes NULL. Local. */
PNPBS_API pnpbs_status pnpbs_transfer_destroy(pnpbs_transfer *transfer);

/** What shape its arrays have; outputs may be NULL. Local.
 *  @param[out] dim         2: in the plane, 3: in space
 *  @param[out] components  numbers at each node */
PNPBS_API pnpbs_status pnpbs_transfer_sizes(pnpbs_transfer transfer, int32_t *dim,
                                            int32_t *components);

/** The field at the nodes that a placement has now: the same bits for any number of ranks and
 *  threads, then and now. A node where there was one before gets its value as it was. The placement
 *  may be another one of the same context, in the same dimension. Collective. Errors:
 *  PNPBS_ERROR_CAPACITY; PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT for a placement of
 *  another context or dimension.
 *  @param[in] conserve  nonzero: to the values of each component the same number is added, so that
 *                       the integral of the field that is linear on the triangles or tetrahedra
 *                       (on surfaces alone, triangles) there are now is the integral that it had on
 *                       those before, to rounding. Where these fill the same domain the number is
 *                       of the second order in d, and rounding for a linear field; next to curved
 *                       boundaries, where they do not, it also makes up for what they fill more or
 *                       less. Values may thereby leave the range they had.
 *  @param[in] capacity  nodes the array has room for, at least those of this rank
 *  @param[out] values   [nodes][components] in the order of pnpbs_placement_get_nodes; those of
 *                       ghosts are for pnpbs_placement_update_ghosts */
PNPBS_API pnpbs_status pnpbs_transfer_at_nodes(pnpbs_transfer transfer, pnpbs_placement placement,
                                               int32_t conserve, int64_t capacity, double *values);

/** The field at any points, of which each rank asks those it wants, 0 or more. Collective. Errors:
 *  PNPBS_ERROR_ARGUMENT for coordinates that are not finite.
 *  @param[in] n            points of this rank
 *  @param[in] coordinates  [n][dim]
 *  @param[out] values      [n][components] */
PNPBS_API pnpbs_status pnpbs_transfer_at_points(pnpbs_transfer transfer, int64_t n,
                                                const double *coordinates, double *values);

/* ---------------------------------------------------------------- files ----------------- */

/** Writes the nodes of all ranks into one file. The extension is the format:
 *    .vtu   VTK's unstructured grid: nodes with id, tag and spacing; triangles with their quality,
 *           2 r_in / R, or tetrahedra with theirs, 3 r_in / R (without elements: one vertex cell
 *           per node). The facets, which are the edges of boundary and inner curves or the
 *           triangles of boundary and inner surfaces, are in a second grid with their tag,
 *           mesh_facets.vtu for mesh.vtu: its points are the same nodes. Of surfaces alone the
 *           triangles are the cells of mesh.vtu, and there is no second grid, nor beside streams
 *           and devices
 *    .pvtu  the same as a file that names one piece per rank, written by that rank beside it:
 *           mesh_0.vtu, mesh_1.vtu, ... for mesh.pvtu. Nodes of other ranks that a piece's elements
 *           need are in it, too, marked by vtkGhostType.
 *    .vtkhdf the same as .vtu as one file by HDF5, VTK's 1.0, and one of facets; no checkpoint
 *    .xdmf  the same as XDMF 3, which tells of the arrays in a second file of the same name, .h5;
 *           its grids are called mesh and facets, and points of the plane have two coordinates
 *    .msh   Gmsh's format 4.1: nodes, triangles and the edges of boundary and inner curves, or
 *           tetrahedra and the triangles of boundary and inner surfaces; the tags of these as
 *           physical groups with their names, or "tag_7" (without elements: one point per node).
 *           Of an inner surface, triangles are the faces whose tetrahedra lie on two sides of it;
 *           they turn as the surface does. The other formats in space have the same triangles
 *    .msh2  the same in Gmsh's format 2.2
 *    .node  Triangle's or TetGen's nodes, numbered from 1, tags as markers; with elements, these in
 *           a second file of the same name, .ele, and in space the triangles in a third, .face
 *    .ele   Triangle's triangles or TetGen's tetrahedra alone
 *    .face  TetGen's triangles of boundary and inner surfaces alone, in space
 *    .csv   id,x,y,tag,spacing, in space id,x,y,z,tag,spacing
 *  Nodes are in the order of their ids, elements and boundary in the order of their corners: all
 *  but .pvtu have the same bytes for any number of ranks and threads. All ranks write at the same
 *  time (MPI-IO), and none holds more than its share. A file appears under its name only when it is
 *  complete; after an error, what was there before is still there. The folder must be the same one
 *  for all ranks, and so must `path`. The monitor is asked now and then, and with fraction 1 before
 *  names are given; if it stops the call, PNPBS_STOPPED is returned, nothing changes. Collective.
 *  Errors: PNPBS_ERROR_FILE naming the file, PNPBS_ERROR_UNSUPPORTED for .vtkhdf and .xdmf if the
 *  library was built without HDF5 or does not find it, PNPBS_ERROR_ARGUMENT, and, where all of this
 *  is right, PNPBS_ERROR_STATE if there are no nodes yet.
 *  @param[in] path      - is standard output of rank 0 (pnpbs_placement_write_files tells in which
 *                       format). What is no regular file, such as a pipe, is written by rank 0, to
 *                       which the others send their parts in turn; .vtkhdf and .xdmf are regular
 *                       files alone.
 *  @param[in] elements  nonzero: triangles or tetrahedra (and the boundary) as well */
PNPBS_API pnpbs_status pnpbs_placement_write(pnpbs_placement placement, const char *path,
                                             int32_t elements);

/** Writes several files, which appear together when all are complete, or none does. Otherwise as
 *  pnpbs_placement_write. Collective.
 *  @param[in] paths     [n]
 *  @param[in] formats   [n] names of formats (pnpbs_format_info), or NULL for those of the
 *                       extensions; so is an entry that is NULL
 *  @param[in] elements  [n], or NULL for nodes only */
PNPBS_API pnpbs_status pnpbs_placement_write_files(pnpbs_placement placement, int32_t n,
                                                   const char *const *paths,
                                                   const char *const *formats,
                                                   const int32_t *elements);

/** Adds a field of the caller's, of `components` numbers at each node, to the files that are
 * written from now on: beside id, tag and spacing in .vtu, .pvtu, .vtkhdf and .xdmf, in .msh and
 * .msh2 as $NodeData. Other formats leave it out. The values are copied. They belong to the nodes
 * there are: once these have moved or changed their ranks, writing is PNPBS_ERROR_STATE until
 *  pnpbs_placement_clear_output_fields. When files are written, all ranks must have added the same
 *  fields in the same order, or it is PNPBS_ERROR_ARGUMENT. Local. Errors: PNPBS_ERROR_ARGUMENT for
 *  a name that is taken, fewer than 1 or more than 9 components, or too few values;
 *  PNPBS_ERROR_STATE without nodes.
 *  @param[in] name        1 to 63 letters, digits, '_' and '-'; none of id, tag, spacing, quality
 *                         and vtkGhostType
 *  @param[in] n           entries of the array: at least this rank's nodes; those behind, its
 *                         ghosts', do not count
 *  @param[in] components  numbers at each node; Gmsh's files have 1, 3 or 9, the last ones 0
 *  @param[in] values      [n][components] in the order of pnpbs_placement_get_nodes */
PNPBS_API pnpbs_status pnpbs_placement_add_output_field(pnpbs_placement placement, const char *name,
                                                        int64_t n, int32_t components,
                                                        const double *values);

/** Forgets the fields that pnpbs_placement_add_output_field has added. Local. */
PNPBS_API pnpbs_status pnpbs_placement_clear_output_fields(pnpbs_placement placement);

/** Writes a checkpoint: one file from which pnpbs_placement_read_checkpoint goes on, in another
 *  process and on any number of ranks, as if there had been no interruption: bit for bit. It holds
 *  the nodes with their velocities, where the run is in its schedule, and what tells another
 * domain, other options and another spacing; the spacing itself only where it is given by values at
 * nodes (pnpbs_placement_set_spacing_at_nodes). d is asked at every node. The file is VTKHDF, which
 *  ParaView opens (name it .vtkhdf): nodes with id, tag and spacing. All ranks write their own
 * nodes at the same time (MPI-IO), beside the file that is there, which is replaced only when all
 * is complete and on the disk. Changes nothing of the placement. May be called at any time when
 * there are nodes, after pnpbs_placement_step as after a whole run, and from the monitor of
 * pnpbs_placement_run and pnpbs_placement_step: at an event, and on one rank at every turn between
 * two steps. There it must be called on all ranks; it is PNPBS_ERROR_STATE in the monitor's other
 * turns, before the first nodes are laid, on coarser levels, and in the finish. Collective. Errors:
 * PNPBS_ERROR_STATE, also where the spacing or the options growth_limit, resolve or wanted_nodes
 * have been set since the nodes were placed; PNPBS_ERROR_FILE naming the file;
 *  PNPBS_ERROR_UNSUPPORTED if the library was built without HDF5; PNPBS_ERROR_ARGUMENT.
 *  @param[in] path  the same on all ranks, in a folder that all of them see */
PNPBS_API pnpbs_status pnpbs_placement_write_checkpoint(pnpbs_placement placement,
                                                        const char *path);

/** Goes on from a checkpoint. Beforehand the placement is given what it was given for the first
 * run: domain, options and spacing (unless that was given by values at nodes: the checkpoint brings
 * it; its nodes, too, where it was given some). Then the next pnpbs_placement_run or _step does
 * what it would have done where the checkpoint was written, and so do later calls, such as another
 * spacing with another run. Options may be changed afterwards, or, with the option restart_options
 * = changed, by this call, which tells them as a warning: then a run that its step limit ended goes
 * on if it is given more steps, and one that is at its end begins again from its nodes if other
 * options are set. Those that decide on no node (threads, exchange_interval, rebalance_above,
 * metis_seed, adjacency_radius, max_nodes, max_memory, restart_options) are free. After an error
 * the placement is as it was. Collective. Errors:
 * PNPBS_ERROR_FILE naming the file if it is damaged, no checkpoint, or of a newer format;
 *  PNPBS_ERROR_DOMAIN, PNPBS_ERROR_SPACING (with the first place found) or PNPBS_ERROR_ARGUMENT
 *  (other options, or the other dimension) if it is of another run; PNPBS_ERROR_UNSUPPORTED if the
 *  library was built without HDF5.
 *  @param[in] path  the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_read_checkpoint(pnpbs_placement placement, const char *path);

/** Removes what unfinished calls of this process have written aside so far, unless it is just
 *  getting its name. For signal handlers that end the program; async-signal-safe. Local. */
PNPBS_API pnpbs_status pnpbs_discard_unfinished_files(void);

#ifdef __cplusplus
}
#endif

#endif

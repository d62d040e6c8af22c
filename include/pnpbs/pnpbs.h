/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - parallel node placement by bubble simulation: the C interface.
 *
 * Glossary
 *   node        a point to compute on; the centre of a bubble
 *   spacing     d(x) > 0, the requested distance between neighbouring nodes near x, in the
 *               unit of the coordinates; a bubble's diameter
 *   boundary    the curves that bound a domain in the plane, or the surfaces that bound one in
 *               space. Curves are divided into boundary edges between consecutive boundary nodes,
 *               surfaces into boundary triangles; each of these is an edge or a face of the
 *               Delaunay triangulation that the stars describe
 *   tag         an integer that marks what a node, boundary edge or boundary triangle lies on;
 *               0 for inner nodes
 *   adjacency   all nodes within `adjacency_radius` times the mean spacing of the pair
 *   star        a node's neighbours in the constrained Delaunay triangulation, in the plane in
 *               order around it
 *
 * Conventions of every function
 *   status      a pnpbs_status is returned: 0 success; > 0 an outcome with valid results;
 *               < 0 an error: nothing changed, and pnpbs_last_error returns the message.
 *   collective  "Collective" functions must be called by all ranks of the context, in the same
 *               order, and return the same status on all of them. "Local" ones need not.
 *   arrays      belong to the caller, are read or filled during the call, and are never kept.
 *               Coordinates are interleaved, [n][dim] with dim = 2 in the plane, 3 in space
 *               and on a sphere. Counts, ids, indices and offsets are 64-bit; indices and offsets
 *               are 0-based.
 *   dimension   functions for domains or placements "in the plane" or "in space" reject others with
 *               PNPBS_ERROR_ARGUMENT; all other functions are for both. On a sphere
 *               (pnpbs_domain_create_sphere) functions are those of the plane, as far as there are
 *               any.
 *   range       coordinates reach up to 1e60. The size of a domain is at least 1e-60, and at least
 *               1e-10 of its distance from the origin, so that coordinates resolve distinct points;
 *               other domains are PNPBS_ERROR_DOMAIN. A spacing may be larger than the domain:
 *               then only corners are nodes, with a warning.
 *   strings     returned strings belong to the library and stay valid until the next call on the
 *               same context (tables: for the life of the process); string arguments are copied.
 *   callbacks   run on the calling thread, one at a time. Inside a callback only queries of the
 *               library work; anything else returns PNPBS_ERROR_STATE.
 *   threads     one host thread at a time per context; contexts are independent.
 *   processes   a process that was forked after the first placement was created has none of the
 *               library's threads: computing calls return PNPBS_ERROR_STATE there, unless `threads`
 *               is 1. Fork before, or start the process by exec.
 *   MPI         where a call of MPI fails on one rank, all ranks return PNPBS_ERROR_MPI. Later
 *               calls work if MPI does. Only a failed collective operation may leave ranks waiting.
 *   side effects  nothing is printed, no signal handler is installed, the process is never ended.
 *   arithmetic  calls round to nearest, without traps or flushing to zero, whatever the settings
 *               of the calling thread; these apply in callbacks and again after the call.
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

/** The list of outcomes and errors: X(name, value, text). */
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
/** Opaque handles. The value is a registry key, never an address: a stale or foreign handle returns
 *  PNPBS_ERROR_HANDLE. NULL is never a live handle. Children keep their parents alive, so handles
 *  may be destroyed in any order. */
typedef struct pnpbs_context_handle *pnpbs_context;
typedef struct pnpbs_domain_handle *pnpbs_domain;
typedef struct pnpbs_placement_handle *pnpbs_placement;
typedef struct pnpbs_transfer_handle *pnpbs_transfer;
typedef struct pnpbs_mesh_handle *pnpbs_mesh;
typedef struct pnpbs_voronoi_handle *pnpbs_voronoi;
typedef struct pnpbs_particles_handle *pnpbs_particles;

/* After a status below 0 everything is as it was before the call, on all ranks: nodes, owners,
 * ghosts, lists, statistics and warnings, except the statistics seconds.*, waiting.*, memory.* and
 * redundancy.*, which count what was spent. A call that is repeated has the result that it would
 * have had without the error. For this, calls that move nodes keep a copy of the nodes until they
 * end: about 100 bytes for each node and ghost of the rank in space, 80 in the plane. Where there
 * is no memory for the copy, the call fails with PNPBS_ERROR_MEMORY before it changes anything.
 * What was derived from the nodes, such as adjacency lists, is freed after an error and derived
 * again when it is requested. */

/** Returns the meaning of a status in a few words. Local. Never NULL. */
PNPBS_API const char *pnpbs_status_string(pnpbs_status status);

/** Returns the message of the last error on `context` or its children; with NULL, of the last error
 *  of any call by the calling thread, also of failed creates and dead handles. Local. "" if there
 *  was none. */
PNPBS_API const char *pnpbs_last_error(pnpbs_context context);

/** What else is known of an error, for programs that act on it: the status and this number decide,
 *  never the text. PNPBS_REASON_CROSSING comes with PNPBS_ERROR_DOMAIN: segments of curves cross or
 *  overlap, which pnpbs_domain_set_fragment allows. More may be added. */
#define PNPBS_REASON_OTHER 0
#define PNPBS_REASON_CROSSING 1

/** Returns data of the last error, as pnpbs_last_error selects it: one of PNPBS_REASON_..., and
 *  how many points the message names. Local; outputs may be NULL. Leaves the last error as it is.
 */
PNPBS_API pnpbs_status pnpbs_last_error_data(pnpbs_context context, int32_t *reason,
                                             int32_t *points);

/** Returns a point that the message of the last error names, and which bytes of the message do so:
 *  from `begin` to before `end`. Local; outputs may be NULL. Leaves the last error as it is, even
 *  where it returns PNPBS_ERROR_ARGUMENT, as for an index that is out of range.
 *  @param[in] index   0 .. points-1, in the order of the message
 *  @param[out] point  [3] in the plane with NaN behind x and y; on a sphere in space
 *  @param[out] begin  0-based
 *  @param[out] end    likewise */
PNPBS_API pnpbs_status pnpbs_last_error_point(pnpbs_context context, int32_t index, double *point,
                                              int64_t *begin, int64_t *end);

/** Returns the version of the library at run time. Any pointer may be NULL. Local. */
PNPBS_API pnpbs_status pnpbs_version(int32_t *major, int32_t *minor, int32_t *patch);

/** Returns the build configuration, one "name: value" per line: version, compiler, Kokkos and its
 *  back ends, linkage, MPI, HDF5. Local; valid for the life of the process. */
PNPBS_API const char *pnpbs_build_info(void);

/** Returns the MPI library that PNPBS was built with, e.g. "Open MPI 4.1.4"; "" in a build without
 *  MPI. Local; calls no MPI function; valid for the life of the process. */
PNPBS_API const char *pnpbs_mpi_library(void);

/* ---------------------------------------------------------------- context --------------- */

/** Creates a context for one process. It never calls an MPI function. Local.
 *  @param[out] context  the new handle; NULL on failure */
PNPBS_API pnpbs_status pnpbs_context_create_serial(pnpbs_context *context);

/** Creates a context on a duplicate of the MPI communicator with the Fortran handle `comm`
 *  (MPI_Comm_c2f). Collective. Errors: PNPBS_ERROR_UNSUPPORTED in a build without MPI,
 *  PNPBS_ERROR_MPI if MPI is not initialised, already finalised, or `comm` is MPI_COMM_NULL. */
PNPBS_API pnpbs_status pnpbs_context_create_f(int32_t comm, pnpbs_context *context);

/** Creates a context as pnpbs_context_create_f does, and checks the MPI library of the caller: a
 *  communicator of one MPI library is meaningless to another. Called by pnpbs_context_create_mpi.
 *  Collective. Errors besides those of pnpbs_context_create_f: PNPBS_ERROR_MPI if the caller's
 *  library is not the one that PNPBS calls.
 *  @param[in] library  what MPI_Get_library_version returns in the caller; trailing blanks are
 *                      ignored */
PNPBS_API pnpbs_status pnpbs_context_create_checked_f(int32_t comm, const char *library,
                                                      pnpbs_context *context);

/** Destroys the context and sets *context to NULL; accepts NULL. Its domains and placements remain
 *  valid until they are destroyed. Collective. */
PNPBS_API pnpbs_status pnpbs_context_destroy(pnpbs_context *context);

/** Finalises Kokkos if PNPBS initialised it. Optional: otherwise Kokkos runs until the process
 *  ends. Kokkos cannot be initialised twice, so computing calls fail afterwards. Waits until the
 *  calls of other threads that are in progress have returned. Calls that begin meanwhile return
 *  PNPBS_ERROR_STATE; those that destroy an object wait instead. Local. Errors: PNPBS_ERROR_STATE
 *  from inside a callback, while another thread finalises, or in a process that was forked after
 *  Kokkos had started several threads. */
PNPBS_API pnpbs_status pnpbs_finalize(void);

/** Sets an option that placements created later on this context start with (see the options table,
 *  pnpbs_option_info). `threads` can only be set here, and only before the first placement of the
 *  process is created. Local. Errors: PNPBS_ERROR_KEY (the message names the nearest known option),
 *  PNPBS_ERROR_ARGUMENT (the message gives the range).
 *  @param[in] value  as text; numbers are parsed the same in every locale */
PNPBS_API pnpbs_status pnpbs_context_set(pnpbs_context context, const char *key, const char *value);
PNPBS_API pnpbs_status pnpbs_context_set_int64(pnpbs_context context, const char *key,
                                               int64_t value);
PNPBS_API pnpbs_status pnpbs_context_set_double(pnpbs_context context, const char *key,
                                                double value);

/* ---------------------------------------------------------------- tables ---------------- */

/** Returns the number of options. Local. */
PNPBS_API pnpbs_status pnpbs_option_count(int32_t *count);

/** Returns one row of the options table. Local; any output may be NULL; strings are valid for the
 *  life of the process.
 *  @param[in] index           0 .. count-1
 *  @param[out] type           "integer", "real", "choice"
 *  @param[out] default_value  as text
 *  @param[out] range          e.g. "1 .. 1000000" or "paper | default"
 *  @param[out] help           one line */
PNPBS_API pnpbs_status pnpbs_option_info(int32_t index, const char **name, const char **type,
                                         const char **default_value, const char **range,
                                         const char **help);

/** Returns the number of statistics. Local. */
PNPBS_API pnpbs_status pnpbs_statistic_count(int32_t *count);

/** Returns one row of the statistics table (the keys of the report). Local; outputs may be NULL.
 *  @param[out] type  "integer", "real" or "string": which get function to use
 *  @param[out] help  one line, with the unit */
PNPBS_API pnpbs_status pnpbs_statistic_info(int32_t index, const char **name, const char **type,
                                            const char **help);

/** Returns the number of file formats. Local. */
PNPBS_API pnpbs_status pnpbs_format_count(int32_t *count);

/** Returns one row of the table of file formats (see pnpbs_placement_write). Local; any output may
 *  be NULL; strings are valid for the life of the process.
 *  @param[in] index      0 .. count-1
 *  @param[out] name      also the extension, without its dot
 *  @param[out] help      one line
 *  @param[out] binary    1 if the format is not text
 *  @param[out] elements  1 if one file holds nodes and, on request, elements */
PNPBS_API pnpbs_status pnpbs_format_info(int32_t index, const char **name, const char **help,
                                         int32_t *binary, int32_t *elements);

/* ---------------------------------------------------------------- domain ---------------- */

/** Role of a curve, or of a surface in space. PNPBS_BOUNDARY separates inside from outside: a point
 *  is inside if it lies behind an odd number of them (holes and islands nest to any depth).
 *  PNPBS_INNER lies in the domain, and nodes follow it. Curves in space are always PNPBS_INNER. */
#define PNPBS_BOUNDARY 0
#define PNPBS_INNER 1

/** Parametric curve in the plane: fills coordinates[n][dim], dim = 2, for t[n]. Must be a pure
 *  function, continuous and without self-intersection. Return 0, or nonzero to fail the call with
 *  PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_curve_fn)(int64_t n, int32_t dim, const double *t, double *coordinates,
                                  void *user);

/** Creates an empty domain. Local.
 *  @param[in] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_domain_create(pnpbs_context context, int32_t dim,
                                           pnpbs_domain *domain);

/** Creates an empty domain on a sphere about the origin. Its nodes lie on the sphere, d and its
 *  growth are lengths along it, and it has dimension 3: all points are x, y, z. Boundary curves
 *  (pnpbs_domain_add_polyline) are the shortest ways along great circles from vertex to vertex. The
 *  domain is what lies behind an odd number of them, seen from a point that is named here, which
 *  must be outside: with coasts and a point on land the domain is the sea, with a point in the sea
 *  it is the land. Nodes are placed in the stereographic projection from that point, so that it
 *  should be ten d or more away from the domain: best in the middle of a continent, or of an ocean.
 *  Without any boundary curve the domain is the whole sphere. Then nodes are laid first and fixed
 *  up to 12 d around the point, where d must be a quarter of the radius at most, and should vary
 *  little; no inner curve or fixed node may be there. The triangles close the sphere, and there are
 *  no boundary edges.
 *  Placements have triangles and boundary edges, as in the plane; options have the same meaning as
 *  there. Points are taken along the ray from the origin, and lie on the sphere then. Not on a
 *  sphere yet: particles and offsets, arcs, parametric curves, graphs, holes of a whole sphere, and
 *  files of curves other than those of geographic shapes.
 *  Local.
 *  @param[in] radius   > 0
 *  @param[in] outside  [3], any length but 0: its direction counts */
PNPBS_API pnpbs_status pnpbs_domain_create_sphere(pnpbs_context context, double radius,
                                                  const double *outside, pnpbs_domain *domain);

/** Computes points on a sphere about the origin from longitude and latitude. Local.
 *  @param[in]  radius       > 0
 *  @param[in]  degrees      [n][2]: longitude, in any turn, and latitude, -90 .. 90
 *  @param[out] coordinates  [n][3] */
PNPBS_API pnpbs_status pnpbs_sphere_points(double radius, int64_t n, const double *degrees,
                                           double *coordinates);

/** Computes longitude and latitude of the directions of points. Local.
 *  @param[in]  coordinates  [n][3], not 0
 *  @param[out] degrees      [n][2]: longitude, -180 .. 180, and latitude, -90 .. 90 */
PNPBS_API pnpbs_status pnpbs_sphere_degrees(int64_t n, const double *coordinates, double *degrees);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_domain_destroy(pnpbs_domain *domain);

/** Returns the dimension that the domain was created with. Local.
 *  @param[out] dim  2: in the plane, 3: in space and on a sphere */
PNPBS_API pnpbs_status pnpbs_domain_dimension(pnpbs_domain domain, int32_t *dim);

/** Sets whether a domain in space is the volume enclosed by its surfaces (the default) or the
 *  surfaces alone: nodes on them, triangles between these nodes, and no interior. On surfaces
 *  alone, both roles are equivalent and surfaces may be closed or open. Nodes lie on their borders,
 *  and the normals of the triangles point to the same side as those of most triangles given for the
 *  surface. Polylines must follow edges of the triangles, fixed nodes must be vertices of them, and
 *  there are no holes. Options have the same meaning as in the plane. Local.
 *  @param[in] filled  nonzero: the enclosed volume; 0: the surfaces alone */
PNPBS_API pnpbs_status pnpbs_domain_set_filled(pnpbs_domain domain, int32_t filled);

/** Repairs the triangulated boundary surfaces of a domain in space, including boxes, balls and
 *  cylinders, that enclose one body imperfectly: open, crossing, folded or inconsistently oriented,
 *  as in scans and assembled parts. Surfaces that pnpbs_domain_check accepts without a repair are
 *  unchanged, unless one body lies within another one with the same orientation; a warning reports
 *  that nothing is repaired. The body is where they wind around a point more than half a
 *  time (generalised winding number, Jacobson, Kavan and Sorkine-Hornung 2013), in either
 *  orientation. Holes are closed, surfaces inside the body or enclosing nothing are dropped, and
 *  overlapping bodies are joined; a cavity must be oriented against what surrounds it. The surface
 *  of the body is extracted as that of a level set (pnpbs_domain_add_level_set), with its sharp
 *  edges, and lies on the given triangles where there are any; all of it has the tag of the first
 *  triangle. Features thinner than the resolution can be lost. A warning and the statistics
 *  `repaired.*` report the distance of the surface from the given triangles. Other surfaces and
 *  nodes are unchanged. Local. Errors: PNPBS_ERROR_ARGUMENT; pnpbs_domain_check and all functions
 *  that check the domain return PNPBS_ERROR_DOMAIN if the triangles enclose nothing.
 *  @param[in] resolution  > 0, no more than the spacing at the surface; 0: 1/64 of the longest side
 *                         of the bounding box of the triangles */
PNPBS_API pnpbs_status pnpbs_domain_set_repair(pnpbs_domain domain, double resolution);

/** Replaces the triangulated boundary surfaces of a domain in space as pnpbs_domain_set_repair
 *  does, even if they need no repair: this removes what is finer than the resolution from a body.
 *  The last call of this function or pnpbs_domain_set_repair holds. Local. Errors: as there.
 *  @param[in] resolution  > 0, no more than the spacing at the surface; 0: 1/64 of the longest side
 *                         of the bounding box of the triangles */
PNPBS_API pnpbs_status pnpbs_domain_set_resurfaced(pnpbs_domain domain, double resolution);

/** The region tag of a part of a domain that several solids contain; see pnpbs_domain_set_fragment.
 *  PNPBS_OVERLAP_LAST and PNPBS_OVERLAP_FIRST: that of the solid added last or first.
 *  PNPBS_OVERLAP_OWN: one for each combination of solids, following those of the solids. */
#define PNPBS_OVERLAP_LAST 0
#define PNPBS_OVERLAP_FIRST 1
#define PNPBS_OVERLAP_OWN 2

/** Splits the curves or surfaces of a domain where they cross, touch or lie on each other, so that
 *  several solids, sheets and curves become regions of one domain with common nodes and facets. The
 *  domain is what any solid contains. Curves and surfaces that enclose nothing lie inside of it,
 * and their parts outside are left out. The first of several curves or triangles that lie on each
 * other gives the tag. The k-th solid, counted from 1 in the order in which they are added (groups
 * by tag), gives its elements the region tag k. pnpbs_domain_add_region sets other tags, and
 *  pnpbs_domain_add_hole removes regions. Intersections are computed exactly and rounded once.
 *
 *  In space each box, ball, cylinder and level set is a solid, and so is each closed group of an
 *  added surface, which are its triangles with one tag: a solid contains the points around which it
 *  winds, so triangles of a cavity are oriented into it. The other triangles of a surface enclose a
 *  further solid. Surfaces with the role PNPBS_INNER are no solids. Without this call, surfaces
 *  that touch are accepted if no solids overlap and each surface ends on others, as for stacked
 *  boxes and for a sheet from side to side of a box; others are an error of pnpbs_domain_check.
 *  Gaps up to the length of pnpbs_domain_set_snap are closed.
 *
 *  In the plane each closed boundary curve is a solid, and so are boundary curves that are joined
 *  at their ends to a closed one. It is a cavity if the solid before it encloses it and runs around
 *  in the other direction. Each closed group of a graph (pnpbs_domain_add_pslg), which are its
 *  segments with one tag, is a solid, and the rest of what the graph encloses is a further one.
 *  Without this call, curves that touch, also along common edges, are accepted if no solids
 *  overlap.
 *
 *  Excludes pnpbs_domain_set_repair. Not on a sphere. Local. Errors: PNPBS_ERROR_ARGUMENT.
 *  @param[in] overlap  PNPBS_OVERLAP_LAST, PNPBS_OVERLAP_FIRST or PNPBS_OVERLAP_OWN */
PNPBS_API pnpbs_status pnpbs_domain_set_fragment(pnpbs_domain domain, int32_t overlap);

/** An axis in pnpbs_domain_set_periodic. PNPBS_BOUNDED: the sides across it bound the domain.
 *  PNPBS_PERIODIC: the domain repeats itself along it. PNPBS_FLAT: as PNPBS_PERIODIC, and no
 *  element crosses the sides. */
#define PNPBS_BOUNDED 0
#define PNPBS_PERIODIC 1
#define PNPBS_FLAT 2

/** Makes the domain a box that repeats itself along some axes. It has no boundary across these
 * axes: bubbles on both sides of a seam act on each other. The other sides of the box are
 * boundaries. Closed curves and surfaces are holes and cavities or, with the role PNPBS_INNER or as
 * fragments, inclusions. They are given once, stand for all their copies, and may extend beyond a
 * periodic side. d is evaluated at points of the box only, and continued with its periods.
 *
 *  Nodes lie in the box; low <= x < high along a periodic axis. Results have the images of nodes
 *  near the box as ghosts (pnpbs_placement_get_ghosts), on a single rank as well: an image has the
 *  id of its node, and its coordinates differ from those of the node by whole periods. Adjacency
 *  lists and elements refer to images, so an element at a seam has its true shape, and no element
 *  occurs twice. Updates of ghosts and the exchange pattern (pnpbs_placement_get_exchange) include
 *  images, with messages of a rank to itself.
 *
 *  Coordinates along a periodic axis are multiples of 2^-50 times the largest coordinate of an
 *  image, and so is the period, which is rounded to it. So the node set does not depend on the
 *  ranks, like that of other domains. Not on a sphere, nor for surfaces alone, level sets and inner
 *  curves in space. Not yet for a periodic domain, but PNPBS_ERROR_UNSUPPORTED: files with elements
 *  of second order, distributed meshes, Voronoi cells, particles and cracks.
 *
 *  Files have the elements of the torus once, cut open: each is where the least of its corners
 *  along an axis is in the box, so elements extend beyond the upper sides only. A corner there is a
 *  copy of a node. Copies follow the nodes and have their ids, tags and fields. .msh and .msh2
 *  files have pairs of copies and nodes in $Periodic; .vtu, .vtkhdf and .xdmf files have an array
 *  partner, for a copy the index of its node, for a node its own. Other files with elements have
 *  the copies as nodes, but for .pvtu, .gr3 and .2dm, which are PNPBS_ERROR_UNSUPPORTED.
 *
 *  PNPBS_FLAT is for solvers that need a box: nodes lie on the sides as well, and opposite sides
 *  have the same facets. In the plane curves may cross such sides, and each part of a region that
 *  they divide needs a point of its own. In space surfaces must not cross them, and all periodic
 *  axes or none are flat (otherwise PNPBS_ERROR_UNSUPPORTED).
 *
 *  Local. Errors: PNPBS_ERROR_ARGUMENT. Calls that resolve the domain return PNPBS_ERROR_DOMAIN if
 *  a curve or surface ends on a periodic side and none goes on at the opposite side.
 *  pnpbs_placement_initialise and _run return PNPBS_ERROR_SPACING if a period is shorter than four
 *  spacings, or if a function d differs by more than 30 % between opposite sides.
 *  @param[in] low, high  [dim] corners of the box
 *  @param[in] periodic   [dim] PNPBS_BOUNDED, PNPBS_PERIODIC or PNPBS_FLAT
 *  @param[in] tags       [2 dim] of the sides that are not PNPBS_PERIODIC: low x, high x, low y,
 *                        ...; NULL: all are 1 */
PNPBS_API pnpbs_status pnpbs_domain_set_periodic(pnpbs_domain domain, const double *low,
                                                 const double *high, const int32_t *periodic,
                                                 const int32_t *tags);

/** Adds straight segments through n vertices. Local.
 *  @param[in] role          PNPBS_BOUNDARY or PNPBS_INNER; in space PNPBS_INNER
 *  @param[in] closed        nonzero: a segment joins the last vertex to the first; the first vertex
 *                           is not repeated
 *  @param[in] coordinates   [n][dim]
 *  @param[in] tags          [number of segments], nonzero, or NULL for 1
 *  @param[in] corner_angle  degrees, 0 .. 180. 0: every vertex becomes a node. Otherwise only
 *                           vertices where the direction turns by more than this, ends of open
 *                           polylines and vertices where curves meet become nodes; between them the
 *                           polyline represents a smooth curve. In space it is ignored, and the
 *                           feature_angle of the surfaces is used instead */
PNPBS_API pnpbs_status pnpbs_domain_add_polyline(pnpbs_domain domain, int32_t role, int32_t closed,
                                                 int64_t n, const double *coordinates,
                                                 const int32_t *tags, double corner_angle);

/** Adds a triangulated surface to a domain in space. Closed surfaces with the role PNPBS_BOUNDARY
 *  bound the domain: its inside lies behind an odd number of them. PNPBS_INNER: nodes follow the
 *  surface, closed or open, inside the domain. Coincident vertices are merged; the orientation is
 *  determined by what the triangles enclose. Local.
 *  @param[in] role           PNPBS_BOUNDARY or PNPBS_INNER
 *  @param[in] coordinates    [vertices][3]
 *  @param[in] corners        [triangles][3], 0-based vertex indices
 *  @param[in] tags           [triangles], nonzero, or NULL for 1
 *  @param[in] feature_angle  degrees, 0 .. 180: nodes lie on the edge between two triangles if
 *                            their normals differ by more than this, or if their tags differ.
 *                            Between such edges the triangles only define the shape, whatever their
 *                            size. 40 suits most */
PNPBS_API pnpbs_status pnpbs_domain_add_surface(pnpbs_domain domain, int32_t role, int64_t vertices,
                                                const double *coordinates, int64_t triangles,
                                                const int64_t *corners, const int32_t *tags,
                                                double feature_angle);

/** Reads a surface from a file and adds it as pnpbs_domain_add_surface does: .stl (text or binary),
 *  .off, .obj, .ply, or TetGen's .poly and .smesh. Solids, groups, materials and facet markers
 *  become tags with their names (pnpbs_domain_get_tag_name). In TetGen's files with the role
 *  PNPBS_BOUNDARY, all that the facets enclose is part of the domain, except for regions with a
 *  hole point: a closed surface within another one divides the domain, and bounds a cavity only if
 *  a hole point lies in it (or pnpbs_domain_set_role gives it that role). Regions whose attribute
 *  is an integer other than 0 get it as their tag (pnpbs_domain_add_region). Local. Errors:
 *  PNPBS_ERROR_FILE with file, line and what was expected. */
PNPBS_API pnpbs_status pnpbs_domain_read_surface(pnpbs_domain domain, int32_t role,
                                                 const char *path, double feature_angle);

/** Sets the role of all triangles with a tag in a domain in space. It overrides the role they are
 *  added with, before or after, so that single groups of a file can be inner surfaces. Local.
 *  Checking the domain fails if no triangle has the tag.
 *  @param[in] tag   nonzero
 *  @param[in] role  PNPBS_BOUNDARY or PNPBS_INNER */
PNPBS_API pnpbs_status pnpbs_domain_set_role(pnpbs_domain domain, int32_t tag, int32_t role);

/** Reads a mesh in Gmsh's MSH format, 4.1 or 2.2, text or binary, and adds its boundary to the
 *  domain. In space the boundary is its triangles and quadrangles: they are inner surfaces if
 *  volume elements, or volumes of the file's geometry, lie on both sides, and boundary otherwise.
 *  If the file has neither, closed surfaces are boundary (also within each other: cavities), and
 *  sheets and surfaces that divide a body are inner. Lines and points in physical groups are inner
 *  curves and fixed nodes. In the plane the boundary is its lines, and the edges that bound
 *  triangles and quadrangles; points are treated as in space. Without elements that fill the
 *  domain, closed lines are boundary and open ones inner. Several physical groups of elements that
 *  fill the domain become regions (pnpbs_domain_add_region). The tag of a physical group becomes
 *  the tag, and its name is kept (pnpbs_domain_get_tag_name); in a file without physical groups,
 *  the entity numbers are the tags. Higher-order elements are treated as straight, with a warning.
 *  Local. Errors: PNPBS_ERROR_FILE with file, line or byte, and what was expected.
 *  @param[in] feature_angle  degrees, 0 .. 180: in space as in pnpbs_domain_add_surface, in the
 *                            plane as the corner_angle of pnpbs_domain_add_polyline; 0 makes every
 *                            vertex a node only in the plane */
PNPBS_API pnpbs_status pnpbs_domain_read_msh(pnpbs_domain domain, const char *path,
                                             double feature_angle);

/** Returns the dimension of the domain that a file describes, from its extension; for .poly from
 *  the second number in the file, for .msh from whether the mesh lies in a plane of constant z.
 *  Local. Errors: PNPBS_ERROR_FILE if a .msh cannot be read; other files are not checked.
 *  @param[out] dim  2: in the plane, 3: in space */
PNPBS_API pnpbs_status pnpbs_file_dimension(const char *path, int32_t *dim);

/** Sets the name of a tag, which files with physical groups (.msh) contain. The name is copied and
 *  replaces an existing one. Local.
 *  @param[in] dim  of the entity with the tag: 0 points, 1 curves, 2 surfaces, 3 bodies; the inside
 *                  of the domain has the domain's dimension
 *  @param[in] tag  nonzero */
PNPBS_API pnpbs_status pnpbs_domain_set_tag_name(pnpbs_domain domain, int32_t dim, int32_t tag,
                                                 const char *name);

/** Returns the number of tags that have names, set or from files. Local. */
PNPBS_API pnpbs_status pnpbs_domain_tag_name_count(pnpbs_domain domain, int32_t *count);

/** Returns one of the names, sorted by dimension, then by tag. Local; any output may be NULL; the
 *  string is valid until the names change.
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

/** Adds a circular cylinder to a domain in space, as triangles within 1e-4 of the radius. Local.
 *  @param[in] begin,end  [3], the centres of its two circles
 *  @param[in] radius     > 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_cylinder(pnpbs_domain domain, const double *begin,
                                                 const double *end, double radius, int32_t tag);

/** Adds the surface of a box to a domain in space with a role, as pnpbs_domain_add_surface does.
 *  With PNPBS_BOUNDARY it is pnpbs_domain_add_box. Local.
 *  @param[in] role      PNPBS_BOUNDARY or PNPBS_INNER
 *  @param[in] low,high  [3] */
PNPBS_API pnpbs_status pnpbs_domain_add_box_surface(pnpbs_domain domain, int32_t role,
                                                    const double *low, const double *high,
                                                    int32_t tag);

/** Adds the surface of a ball to a domain in space with a role, as triangles within 1e-4 of the
 *  radius. With PNPBS_BOUNDARY it is pnpbs_domain_add_ball. Local.
 *  @param[in] role    PNPBS_BOUNDARY or PNPBS_INNER
 *  @param[in] centre  [3]
 *  @param[in] radius  > 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_ball_surface(pnpbs_domain domain, int32_t role,
                                                     const double *centre, double radius,
                                                     int32_t tag);

/** Adds the surface of a circular cylinder to a domain in space with a role, as triangles within
 *  1e-4 of the radius. With PNPBS_BOUNDARY it is pnpbs_domain_add_cylinder. Local.
 *  @param[in] role       PNPBS_BOUNDARY or PNPBS_INNER
 *  @param[in] begin,end  [3], the centres of its two circles
 *  @param[in] radius     > 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_cylinder_surface(pnpbs_domain domain, int32_t role,
                                                         const double *begin, const double *end,
                                                         double radius, int32_t tag);

/** Level set callback: fills values[n] with f at coordinates[n][dim], dim = 3 in space; the body is
 *  where f < 0. Must be a pure function of the point, the same on all ranks, continuous and finite
 *  in the whole box; it need not be a distance. Return 0, or nonzero to fail the call with
 *  PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_level_set_fn)(int64_t n, int32_t dim, const double *coordinates,
                                      double *values, void *user);

/** Adds the body where f < 0 to a domain in space; it must lie in the box. Its surface is found on
 *  an octree refined near f = 0 down to cells of side `resolution`. Thinner features can be lost,
 *  and so can a body that is small relative to the box and towards which f does not decrease. Nodes
 *  on the surface lie where f = 0, however coarse the triangles of the octree are. Where the
 *  gradient of f jumps by more than 40 degrees, as that of max(g, h) does, the surface has an edge
 *  with nodes on it, and a corner where such edges meet. Where triangles would cross, as they may
 *  at edges of less than 60 degrees, the edges stay rounded by the resolution, with a warning. The
 *  callback is called during this function, whenever a placement is initialised or runs, and for
 *  its normals, so it and `user` must outlive the placements made on the domain. Local. Errors:
 *  PNPBS_ERROR_DOMAIN with the point where f is not finite, or negative on the border of the box,
 *  or if it is negative nowhere.
 *  @param[in] level_set   not NULL
 *  @param[in] low,high    [3], the box; f is evaluated only inside it
 *  @param[in] resolution  > 0, at most the box's shortest side; no more than the spacing at the
 *                         surface, and half of the minimum radius of curvature
 *  @param[in] tag         nonzero */
PNPBS_API pnpbs_status pnpbs_domain_add_level_set(pnpbs_domain domain, pnpbs_level_set_fn level_set,
                                                  void *user, const double *low, const double *high,
                                                  double resolution, int32_t tag);

/** Adds a circular arc to a domain in the plane; its ends join curves that end at the same point
 *  (within 1e-9 of the domain's size). Local.
 *  @param[in] centre     [2]
 *  @param[in] radius     > 0
 *  @param[in] begin,end  angles in radians; |end - begin| = 2 pi makes a full circle */
PNPBS_API pnpbs_status pnpbs_domain_add_arc(pnpbs_domain domain, int32_t role, const double *centre,
                                            double radius, double begin, double end, int32_t tag);

/** Adds a general curve, given by a callback on begin <= t <= end, to a domain in the plane. The
 *  callback is called during this function and whenever a placement is initialised, so it and
 *  `user` must outlive the placements made on the domain. A curve whose ends coincide is closed.
 *  The curve is smooth between its ends: corners exist only where curves meet. Local. */
PNPBS_API pnpbs_status pnpbs_domain_add_curve(pnpbs_domain domain, int32_t role,
                                              pnpbs_curve_fn curve, void *user, double begin,
                                              double end, int32_t tag);

/** Adds a planar straight-line graph, as Triangle defines it, to a domain in the plane. The domain
 *  is what the segments enclose, except the regions that contain a hole point; a loop without a
 *  hole point and any open chain are inner curves. Every vertex becomes a node. Shared vertices and
 *  T-junctions (within 1e-12 of the domain's size) are allowed. Once a graph is added, this rule
 *  holds for all curves of the domain. Local.
 *  @param[in] coordinates   [vertices][2]
 *  @param[in] vertex_tags   [vertices] or NULL; 0: the segment's tag
 *  @param[in] segment_ends  [segments][2], 0-based vertex indices
 *  @param[in] segment_tags  [segments] or NULL for 1
 *  @param[in] hole_points   [holes][2]; may be NULL if holes is 0 */
PNPBS_API pnpbs_status pnpbs_domain_add_pslg(pnpbs_domain domain, int64_t vertices,
                                             const double *coordinates, const int32_t *vertex_tags,
                                             int64_t segments, const int64_t *segment_ends,
                                             const int32_t *segment_tags, int64_t holes,
                                             const double *hole_points);

/** Removes the region around a point from the domain, up to the next curves or surfaces of either
 *  role. Local.
 *  @param[in] point  [dim] */
PNPBS_API pnpbs_status pnpbs_domain_add_hole(pnpbs_domain domain, const double *point);

/** Gives a tag to the region around a point, up to the next curves or surfaces of either role:
 *  elements that lie in it have this tag (pnpbs_placement_get_element_tags,
 *  pnpbs_mesh_get_elements), in files too. So inner curves and surfaces divide a domain into
 *  materials. Elements of regions without a point have the tag 0. Local. Errors of
 *  pnpbs_domain_check: PNPBS_ERROR_DOMAIN if the point lies outside the domain, on a curve or
 *  surface, or in a region with another tag.
 *  @param[in] point  [dim]
 *  @param[in] tag    nonzero */
PNPBS_API pnpbs_status pnpbs_domain_add_region(pnpbs_domain domain, const double *point,
                                               int32_t tag);

/** Adds fixed nodes, which keep their exact coordinates. Local.
 *  @param[in] coordinates  [n][dim], inside the domain or on a vertex of its curves or surfaces
 *  @param[in] tags         [n], nonzero, or NULL for 1 */
PNPBS_API pnpbs_status pnpbs_domain_add_fixed_nodes(pnpbs_domain domain, int64_t n,
                                                    const double *coordinates, const int32_t *tags);

/** Reads a file in Triangle's .poly format (vertices numbered from 0 or 1, their attributes
 *  ignored, markers kept as tags) and adds it to a domain in the plane as pnpbs_domain_add_pslg
 *  does. Regions whose attribute is an integer other than 0 get it as their tag
 *  (pnpbs_domain_add_region). Local. Errors: PNPBS_ERROR_FILE with file, line and what was
 *  expected. */
PNPBS_API pnpbs_status pnpbs_domain_read_poly(pnpbs_domain domain, const char *path);

/** Does the same as pnpbs_domain_read_poly with a text in memory. Local.
 *  @param[in] name  the name of the text in messages */
PNPBS_API pnpbs_status pnpbs_domain_parse_poly(pnpbs_domain domain, const char *text,
                                               int64_t length, const char *name);

/** Gives a tag to the parts of the outline of a domain in the plane or on a sphere where f < 0,
 * such as the open boundary of a sea where its depth exceeds a threshold. The outline is the
 * boundary around the domain; boundaries around holes, such as islands, keep their tags. A segment
 * between two vertices has the tag if f < 0 at its middle, an arc or a general curve likewise as a
 * whole. Nodes are placed where the tag changes. On a sphere the outline is the boundary that
 * separates the domain from the point outside it. Checks the domain first. If the call fails, the
 * domain is unchanged. Local; must be called identically on all ranks. Errors: PNPBS_ERROR_DOMAIN
 * as in pnpbs_domain_check, PNPBS_ERROR_CALLBACK, PNPBS_ERROR_ARGUMENT in space.
 *  @param[in] level_set  f, with dim = 2 in the plane and 3 on a sphere; called only during this
 *                        function; it may query the shape of the domain as it was before, if that
 *                        has been queried before
 *  @param[in] tag        nonzero
 *  @param[out] count     segments and curves that have the tag now because of f; may be NULL */
PNPBS_API pnpbs_status pnpbs_domain_tag_outline(pnpbs_domain domain, pnpbs_level_set_fn level_set,
                                                void *user, int32_t tag, int64_t *count);

/** Spacing callback: fills d[n] for coordinates[n][dim]. n may be 0. Must be a pure function of the
 *  point; it may be evaluated anywhere in the domain's bounding box that lies inside the domain or
 *  on its boundary. Return 0, or nonzero to fail the call with PNPBS_ERROR_CALLBACK. */
typedef int32_t (*pnpbs_spacing_fn)(int64_t n, int32_t dim, const double *coordinates, double *d,
                                    void *user);

/** Sets the corner angle of the graphs of a domain in the plane (pnpbs_domain_add_pslg, _read_poly,
 *  _parse_poly), both those already added and later ones. Corners are vertices where the direction
 *  turns by more than this, where segments of different tags or other than two of them end, and
 *  vertices with a tag of their own. Nodes lie on corners; between them a graph represents a smooth
 *  curve, with nodes spaced by d, however short its segments are. Local.
 *  @param[in] corner_angle  degrees, 0 .. 180. 0, the default: every vertex becomes a node */
PNPBS_API pnpbs_status pnpbs_domain_set_corner_angle(pnpbs_domain domain, double corner_angle);

/** In the plane, sets the largest distance over which loose points are moved onto a curve or vertex
 *  that they miss: ends of open curves, ends of segments that join no other one, and fixed nodes.
 *  By default it is 1e-7 of the size of the domain, the longest side of its bounding box.
 *  pnpbs_domain_check moves them, with PNPBS_WARNING_VERTICES_MERGED; set it before. On a sphere
 *  none are moved. In space, with pnpbs_domain_set_fragment, surfaces become one where they are no
 *  farther from each other, with the same warning: gaps between solids and thin overlaps are
 * closed. Vertices within 16 times the length are then merged, and what is thinner is lost. By
 * default no gaps are closed. Local.
 *  @param[in] length  0: none are moved, and no gaps are closed */
PNPBS_API pnpbs_status pnpbs_domain_set_snap(pnpbs_domain domain, double length);

/** Removes features finer than d, such as those of coastlines, from a domain in the plane. From the
 *  graphs and polylines added so far, it removes vertices next to segments shorter than d, as long
 *  as the curve then passes them within tolerance * d, and closed curves, islands and lakes, whose
 *  extent (the longer side of their bounding box) is less than smallest * d. No other vertex, fixed
 *  node or hole point changes to another side of a curve. Vertices are kept where curves meet or
 *  end, where tags change or a vertex has its own, and at fixed nodes. A curve with one of these,
 *  or around one that is kept, is not removed, nor is the largest; hole points within removed
 *  curves are removed with them. If the call fails, the domain is unchanged. Local; must be called
 *  identically on all ranks.
 *  @param[in] spacing    d, called only during this function; it may query the shape of the domain
 *                        as it was before, if that has been queried before
 *  @param[in] tolerance  >= 0; 0.25 suits most
 *  @param[in] smallest   >= 0; 0 removes no curve
 *  @param[out] vertices  number removed, including those of the curves; may be NULL
 *  @param[out] curves    number removed; may be NULL */
PNPBS_API pnpbs_status pnpbs_domain_simplify(pnpbs_domain domain, pnpbs_spacing_fn spacing,
                                             void *user, double tolerance, double smallest,
                                             int64_t *vertices, int64_t *curves);

/** Does the same as pnpbs_domain_simplify with a spacing from a file with values at points, as in
 *  pnpbs_placement_set_spacing_file; the growth of d is not limited here. Local; must be called
 *  identically on all ranks. Checks the domain first. Errors: PNPBS_ERROR_FILE if the file cannot
 *  be read, PNPBS_ERROR_SPACING for a value that is zero, negative or not finite and for points
 *  that do not meet the domain's bounding box, PNPBS_ERROR_DOMAIN as in pnpbs_domain_check.
 *  @param[in] path   the file
 *  @param[in] field  the name of the values; NULL: the only ones, or those called "spacing" */
PNPBS_API pnpbs_status pnpbs_domain_simplify_by_file(pnpbs_domain domain, const char *path,
                                                     const char *field, double tolerance,
                                                     double smallest, int64_t *vertices,
                                                     int64_t *curves);

/** Adds the body between two distances from the boundary of another: points whose signed distance
 *  to it, negative inside, lies between low and high times d. Particles that each stand for d^dim
 *  of matter lie half a spacing inside the wall: they are placed between low = -infinity and high
 *  = -0.42 in the plane, -0.46 in space, as nodes with a spacing of 1.076 d or 1.147 d. Their
 *  number is then nearly the integral of 1 / d^dim over the body. n layers of wall particles lie
 *  outside, between 0.42 and n - 0.58 or, in space, 0.46 and n - 0.54. Its boundary is found as
 *  that of a level set (pnpbs_domain_add_level_set), in the plane by curves through points about
 *  a resolution apart, with corners where it turns by more than 20 degrees within it. What is
 *  thinner is lost. The body is checked first, and is not needed afterwards. In space the
 *  callback is called later, too, as that of a level set is, so it and `user` must outlive the
 *  placements made on the domain. Local; must be called identically on all ranks. Errors:
 *  PNPBS_ERROR_DOMAIN as in pnpbs_domain_check, or if nothing is left between these distances;
 *  PNPBS_ERROR_SPACING for a d that is zero, negative or not finite.
 *  @param[in] body        on the same context and with the same dimension; must have an inside
 *  @param[in] low         less than high; -infinity for all that is deeper
 *  @param[in] high        finite
 *  @param[in] spacing     d, which may be evaluated in the body's bounding box, and as far around
 *                         it as the new body reaches, and a little farther; NULL: 1 everywhere, so
 *                         that low and high are lengths
 *  @param[in] resolution  > 0, or 0 for an eighth (in space half) of the least d at the body's
 *                         boundary, or of the lesser of |low| and |high| if there is no callback
 *  @param[in] tag         of the new boundary, nonzero */
PNPBS_API pnpbs_status pnpbs_domain_add_offset(pnpbs_domain domain, pnpbs_domain body, double low,
                                               double high, pnpbs_spacing_fn spacing, void *user,
                                               double resolution, int32_t tag);

/** Checks the whole geometry: duplicate vertices, self-intersections, boundary curves or surfaces
 *  that do not close, hole points outside or on one, fixed nodes outside or too close. Placements
 *  check it, too; checking early adds no cost. In the plane, loose points that miss a curve by
 *  very little are moved onto it before (pnpbs_domain_set_snap). Local. Errors: PNPBS_ERROR_DOMAIN
 *  naming the vertex, segment or triangle. */
PNPBS_API pnpbs_status pnpbs_domain_check(pnpbs_domain domain);

/** Returns the bounding box of the curves or surfaces. Local.
 *  @param[out] low,high  [dim] */
PNPBS_API pnpbs_status pnpbs_domain_bounds(pnpbs_domain domain, double *low, double *high);

/** Returns the area of the inside, in space its volume, of surfaces alone their area. Local; checks
 *  the domain first. */
PNPBS_API pnpbs_status pnpbs_domain_measure(pnpbs_domain domain, double *measure);

/** Evaluates distances to the shape of the domain. They are exact for segments and triangles, and
 *  within 1e-7 of the domain's size for arcs and curves by callback. Local; checks the domain
 *  first. The first query after a change of the domain builds a search tree and calls the callbacks
 *  of curves: make one query before querying from inside a callback (as a spacing callback may).
 *  Errors: PNPBS_ERROR_ARGUMENT if nothing has the tag, or for coordinates beyond 1e60.
 *  @param[in] tag          of curves, surfaces or nodes; 0: the boundary of the domain
 *  @param[in] coordinates  [n][dim]
 *  @param[out] distances   [n] */
PNPBS_API pnpbs_status pnpbs_domain_distance(pnpbs_domain domain, int32_t tag, int64_t n,
                                             const double *coordinates, double *distances);

/** Returns the region tags at points (pnpbs_domain_add_region, pnpbs_domain_set_fragment), for use
 *  in a spacing callback: 0 where a region has no tag, and outside of the domain the tag of the
 *  region behind the nearest point of the boundary. A point within 1e-6 of the size of the domain
 *  from interfaces lies in the regions on both sides: use the least d of these, because nodes on
 *  interfaces lie on one side or the other by rounding. Local; checks the domain first: make one
 *  query before querying from inside a callback. Errors: PNPBS_ERROR_ARGUMENT if no region of the
 *  domain has a tag, or for coordinates beyond 1e60.
 *  @param[in] coordinates  [n][dim]
 *  @param[in] columns      >= 1: tags at each point
 *  @param[out] tags        [n][columns] first of the region that contains the point, then of others
 *                          at interfaces; the first one again where there are fewer */
PNPBS_API pnpbs_status pnpbs_domain_regions_at(pnpbs_domain domain, int64_t n,
                                               const double *coordinates, int32_t columns,
                                               int32_t *tags);

/** Evaluates the spacing that pnpbs_placement_set_spacing_from_shape would set, without its bounds,
 *  for use in a spacing callback. Local; checks the domain first. The first query computes what the
 *  shape requires and keeps it: make one query before querying from inside a callback.
 *  @param[in] nodes_per_turn,nodes_across,nodes_per_edge,growth  as there
 *  @param[in] coordinates  [n][dim]
 *  @param[out] d           [n] at most the size of the domain */
PNPBS_API pnpbs_status pnpbs_domain_shape_spacing(pnpbs_domain domain, double nodes_per_turn,
                                                  double nodes_across, double nodes_per_edge,
                                                  double growth, int64_t n,
                                                  const double *coordinates, double *d);

/** Returns straight segments that approximate the curves of a domain in the plane or on a sphere
 *  (curves finely sampled), for pictures. Local. Call with capacity 0 to get the count.
 *  @param[out] count     number of segments
 *  @param[out] segments  [count][2][2], on a sphere [count][2][3], or NULL
 *  @param[out] tags      [count], or NULL */
PNPBS_API pnpbs_status pnpbs_domain_get_segments(pnpbs_domain domain, int64_t capacity,
                                                 int64_t *count, double *segments, int32_t *tags);

/* ---------------------------------------------------------------- placement ------------- */

/** Progress callback. It is called at fixed step numbers and, a few times a second, while the first
 *  nodes are laid or the growth of the spacing is limited, between steps that take long (on one
 *  rank), and between the parts of the finish. While nodes are laid or growth is limited, each rank
 *  calls it by its own clock: do nothing collective when fraction is 0. Return 0 to continue,
 *  nonzero to stop: the call in progress then returns PNPBS_STOPPED with valid nodes; stopped
 *  before the first nodes are laid, it has none.
 *  @param fraction   of the work of the call in progress, 0 .. 1
 *  @param step       steps done so far
 *  @param nodes      current number of nodes, 0 while the first ones are laid
 *  @param max_speed  largest scaled speed (spacings per unit time) */
typedef int32_t (*pnpbs_monitor_fn)(double fraction, int64_t step, int64_t nodes, double max_speed,
                                    void *user);

/** Creates a placement of nodes in `domain`, with the options of its context. The domain is read
 *  when the placement is initialised. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_create(pnpbs_context context, pnpbs_domain domain,
                                              pnpbs_placement *placement);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_placement_destroy(pnpbs_placement *placement);

/** Sets an option of this placement; otherwise as pnpbs_context_set. Local. */
PNPBS_API pnpbs_status pnpbs_placement_set(pnpbs_placement placement, const char *key,
                                           const char *value);
PNPBS_API pnpbs_status pnpbs_placement_set_int64(pnpbs_placement placement, const char *key,
                                                 int64_t value);
PNPBS_API pnpbs_status pnpbs_placement_set_double(pnpbs_placement placement, const char *key,
                                                  double value);

/** Sets a constant spacing. On a live placement it replaces the spacing: the current nodes are
 *  kept, and the next run starts from them. Collective. Errors: PNPBS_ERROR_SPACING for zero,
 *  negative, not finite. */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d);

/** Sets the spacing to a callback, which must stay valid as long as the placement uses it. It is
 *  sampled about as densely as nodes would lie. A feature that is smaller than the d around it may
 *  be missed, unless a fixed node (pnpbs_domain_add_fixed_nodes) or a vertex of the boundary lies
 *  in it: d is sampled at each of these. Collective. Invalid values are detected when it is called,
 *  in initialise or run: the error names the point and the number of nodes it would have
 *  implied. */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
                                                            pnpbs_spacing_fn spacing, void *user);

/** Sets the spacing to values on a rectangular grid, which are copied. It is linear in each
 *  direction between grid points and constant beyond the grid's edge; nodes farther than d and half
 *  a step from the grid cause a warning (pnpbs_placement_get_warning). In a direction with one grid
 *  point the value holds everywhere. On a sphere the grid has two directions, longitude and
 *  latitude in degrees. Longitudes 360 degrees apart are the same: columns all around the sphere
 *  are joined, with or without the first one again at the end. A pole that is a step or less from
 *  the grid has the mean of the row beside it. Where d changes by a tenth or more from one grid
 *  point to the next, the lower one is a sample of d whatever the size of its surroundings.
 *  Collective. Checks the domain first. Errors: PNPBS_ERROR_SPACING for a value that is zero,
 *  negative or not finite, and in the plane and in space for a grid that does not meet the domain's
 *  bounding box, which on a sphere is an error in initialise or run; PNPBS_ERROR_ARGUMENT for a
 *  step that is not positive, and on a sphere for longitudes over more than 360 degrees and
 *  latitudes beyond a pole; PNPBS_ERROR_DOMAIN as in pnpbs_domain_check.
 *  @param[in] size    [dim], on a sphere [2]: number of grid points in each direction, >= 1
 *  @param[in] origin  [dim], on a sphere [2]: the first grid point
 *  @param[in] step    [dim], on a sphere [2]: > 0, distance between grid points
 *  @param[in] values  [size[1]][size[0]], in space [size[2]][size[1]][size[0]] (x fastest) */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement,
                                                        const int64_t *size, const double *origin,
                                                        const double *step, const double *values);

/** Sets the spacing to values at the nodes of a background mesh, which are copied. It is linear on
 *  each triangle, in space on each tetrahedron, and beyond the mesh equal to the value at the
 *  nearest point of the mesh; nodes farther than d from the mesh cause a warning
 *  (pnpbs_placement_get_warning). Elements may overlap (the one with the lowest node numbers is
 *  used) and need not share whole sides. On a sphere they are triangles, of the whole sphere or of
 *  a part; d at a point of the sphere is that of the plane triangle on the ray to it from the
 *  origin. Growth is limited as for any spacing (option growth_limit). Collective; every rank
 *  passes and stores the same arrays. Checks the domain first. Errors: PNPBS_ERROR_SPACING for a
 *  value that is zero, negative or not finite, and in the plane and in space for a mesh whose
 *  bounding box does not meet the domain's; PNPBS_ERROR_ARGUMENT for a node number out of range, a
 *  flat element, or arrays that differ between ranks; PNPBS_ERROR_DOMAIN as in pnpbs_domain_check.
 *  @param[in] n            number of nodes of the mesh, below 2^31
 *  @param[in] coordinates  [n][dim]
 *  @param[in] d            [n]
 *  @param[in] elements     number of triangles or tetrahedra, >= 1
 *  @param[in] corners      [elements][dim + 1], on a sphere [elements][3]: 0-based node numbers, in
 *                          either orientation */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_mesh(pnpbs_placement placement, int64_t n,
                                                        const double *coordinates, const double *d,
                                                        int64_t elements, const int64_t *corners);

/** Sets the spacing to values at scattered points, which are copied. It equals the given value at
 *  each point and elsewhere a weighted mean of the values of the 8 (in space 16) nearest points,
 *  with positive weights: it never leaves their range. Points that lie behind others count less or
 *  not at all, so beside a dense group of points d is that of its rim, whatever the points within
 *  it have. Linear functions are reproduced nearly between the points; far from all of them d is
 *  close to the values of the nearest, and nodes far beyond the points' bounding box cause a
 *  warning. The weights are 1/r - 1/R, with r the distance of a point and R that of the nearest
 *  unused one, so d is continuous (compare R. Franke, G. Nielson, Int. J. Numer. Methods Eng. 15
 *  (1980) 1691-1704); they are then changed, by factors of at most 3 and twice, to those of a plane
 *  fitted to the values. On a sphere 8 points count, in the azimuthal equidistant projection about
 *  each place, and nodes far beyond a cap that holds all points cause the warning. The order of the
 *  points has no effect. Collective; every rank passes and stores the same arrays. Checks the
 *  domain first. Errors: PNPBS_ERROR_SPACING for a value that is zero, negative or not finite, for
 *  coincident points with different values, and in the plane and in space for points whose bounding
 *  box does not meet the domain's; PNPBS_ERROR_ARGUMENT for arrays that differ between ranks;
 *  PNPBS_ERROR_DOMAIN as in pnpbs_domain_check.
 *  @param[in] n            number of points, 1 .. 2^31 - 1
 *  @param[in] coordinates  [n][dim]
 *  @param[in] d            [n] */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_points(pnpbs_placement placement, int64_t n,
                                                          const double *coordinates,
                                                          const double *d);

/** Sets the spacing to values at points from a file. The extension selects the format:
 *    .vtu   VTK's unstructured grid, as VTK, ParaView, meshio and pnpbs_placement_write write it:
 *           text, base64 or raw, with or without zlib compression
 *    .msh   Gmsh's, versions 4.1 and 2.2, text or binary, with $NodeData
 *    .csv   a header with columns x, y, (z) and others, and one point per line
 *  Triangles and quadrangles, in space tetrahedra, form a mesh as in
 *  pnpbs_placement_set_spacing_mesh; without any, the points are used as in
 *  pnpbs_placement_set_spacing_points. In the plane z is ignored; on a sphere points are x, y, z,
 *  and elements as in the plane. Collective; every rank reads the file. Errors: PNPBS_ERROR_FILE
 *  for a file that cannot be read, has another format or other elements, and for a missing field
 *  (the message lists the fields in the file); those of the two functions above.
 *  @param[in] path   the file
 *  @param[in] field  its name in the file; NULL or "": the only one, or the one called "spacing" */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_file(pnpbs_placement placement, const char *path,
                                                        const char *field);

/** Sets the spacing from the current shape of the domain: the minimum of what its curves and
 *  surfaces require, each value growing with the distance from them. Collective. The same on any
 *  number of ranks. Errors: PNPBS_ERROR_DOMAIN as in pnpbs_domain_check, PNPBS_ERROR_ARGUMENT for
 *  negative numbers, PNPBS_ERROR_SPACING where the domain is too narrow to measure its width
 *  everywhere.
 *  @param[in] nodes_per_turn  by curvature: nodes on a full circle of the radius of curvature. On
 *                             polylines it is the radius of the circle through neighbouring
 *                             vertices; on triangulated surfaces it follows from the change of the
 *                             normals, where they turn by less than 40 degrees from one to the
 *                             next. 0: not used
 *  @param[in] nodes_across    by width: d at a boundary point is the diameter of the largest ball
 *                             that touches the boundary there and meets nothing ahead, divided by
 *                             this. 0: not used
 *  @param[in] nodes_per_edge  by the input: d is the length of a segment, or the mean edge length
 *                             of a triangle, divided by this. Arcs and curves have none. 0: not
 *                             used
 *  @param[in] growth          of d per unit of distance; 0: 0.15
 *  @param[in] min_spacing     lower bound of d; 0: no bound
 *  @param[in] max_spacing     upper bound of d; 0: the size of the domain */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_from_shape(
    pnpbs_placement placement, double nodes_per_turn, double nodes_across, double nodes_per_edge,
    double growth, double min_spacing, double max_spacing);

/** Sets the spacing to values at the current nodes. It is linear on each triangle or tetrahedron of
 *  their Delaunay triangulation (pnpbs_placement_get_triangles, pnpbs_placement_get_tetrahedra),
 *  and beyond its boundary, next to curved boundaries, equal to the value at the nearest point of
 *  it. Each rank passes the values of its own nodes; they stay on that rank, copied together with
 *  the triangles or tetrahedra, and the nodes may be replaced afterwards. Collective. Errors:
 *  PNPBS_ERROR_STATE without nodes, PNPBS_ERROR_SPACING for a value that is zero, negative or not
 *  finite: the message names the rank, the node's id and the value.
 *  @param[in] n  number of nodes of this rank (pnpbs_placement_count)
 *  @param[in] d  [n] in the order of pnpbs_placement_get_nodes */
PNPBS_API pnpbs_status pnpbs_placement_set_spacing_at_nodes(pnpbs_placement placement, int64_t n,
                                                            const double *d);

/** Adds points at which the spacing is sampled as well. A callback or formula is sampled at some
 *  points of each cell of a tree, so a place with a small d that is much smaller than the cells
 *  around it may be missed: give one point in each such place. The points are used from the next
 *  pnpbs_placement_initialise or pnpbs_placement_run on, until another spacing is set. d is
 *  evaluated there in this call; nodes need not come to lie at these points. Points outside a
 *  body in space are ignored. Collective; each rank may pass other points, including none, and
 * every rank stores those of all. Errors: PNPBS_ERROR_STATE without a spacing, PNPBS_ERROR_SPACING
 * for a value that is zero, negative or not finite, PNPBS_ERROR_CALLBACK if the callback fails,
 *  PNPBS_ERROR_DOMAIN as in pnpbs_domain_check.
 *  @param[in] n            number of points of this rank, 0 or more
 *  @param[in] coordinates  [n][dim], not read if n is 0 */
PNPBS_API pnpbs_status pnpbs_placement_add_spacing_hints(pnpbs_placement placement, int64_t n,
                                                         const double *coordinates);

/** Sets the monitor, or removes it (NULL). Local. */
PNPBS_API pnpbs_status pnpbs_placement_set_monitor(pnpbs_placement placement,
                                                   pnpbs_monitor_fn monitor, void *user);

/** Sets inner nodes to start from instead of the initial fill; they are copied, and the library
 *  places the boundary nodes. On several ranks each passes some, wherever they lie. Nodes many
 *  times too dense for d are thinned (statistic `deleted`). Points outside the domain or too close
 *  to its boundary are dropped (statistic `dropped`). Clears the current nodes. Collective. On
 *  surfaces alone each point moves to the nearest point of a surface, if that is no farther than d.
 *  In a periodic domain each point stands for its image in the box, and ids above 2^50 are refused
 *  with PNPBS_ERROR_ARGUMENT when the nodes are placed.
 *  @param[in] coordinates  [n][dim]
 *  @param[in] ids          [n], distinct, 0 .. 2^62, or NULL for ids chosen by the library */
PNPBS_API pnpbs_status pnpbs_placement_set_nodes(pnpbs_placement placement, int64_t n,
                                                 const double *coordinates, const int64_t *ids);

/** Estimates a run from scratch, from domain, spacing and options alone. d is sampled at some
 *  thousand points (where its growth is limited, at as many as in the run), no inner node is
 *  created, and the current nodes are unchanged. Collective; outputs may be NULL. Errors:
 *  PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK.
 *  @param[out] nodes    on all ranks: accurate in the plane mostly to one percent, in space to five
 *  @param[out] bytes    memory of each process, for the run alone
 *  @param[out] seconds  rough: from the speed of a core of a current server, times the threads of
 *                       all ranks */
PNPBS_API pnpbs_status pnpbs_placement_estimate(pnpbs_placement placement, int64_t *nodes,
                                                int64_t *bytes, double *seconds);

/** Checks domain and spacing, builds the background tree, and lays the boundary nodes and the
 *  initial inner nodes. Where d varies, the inner nodes are computed by runs on coarser levels
 *  (option `levels`). Collective. Returns PNPBS_OK, or PNPBS_STOPPED; stopped on a coarser level,
 *  it keeps the nodes of that level. Errors: PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK;
 *  PNPBS_ERROR_MEMORY also where d requires nodes that need more than the memory available, times
 *  the option `max_memory`. */
PNPBS_API pnpbs_status pnpbs_placement_initialise(pnpbs_placement placement);

/** Advances the simulation by n steps, with the events (refresh of d, population, stop test) that
 *  fall on them. Initialises first if necessary. Collective. Returns PNPBS_OK if the bubbles are at
 *  rest (stop test met), PNPBS_NOT_CONVERGED if they still move, PNPBS_STOPPED. */
PNPBS_API pnpbs_status pnpbs_placement_step(pnpbs_placement placement, int64_t n);

/** Performs one population adjustment: deletes bubbles where the overlap ratio is too large,
 *  inserts them where it is too small (equation (3) of the paper). Initialises first if necessary;
 *  if the monitor stops that, returns PNPBS_STOPPED without an adjustment. Collective. Outputs may
 *  be NULL. */
PNPBS_API pnpbs_status pnpbs_placement_adjust_population(pnpbs_placement placement,
                                                         int64_t *inserted, int64_t *deleted);

/** Repartitions the work over the ranks, by METIS with the work counted in the lists, so that each
 *  rank owns an equal share and few nodes change rank. The nodes are unchanged; their owners and
 *  the ghosts of each rank change. A run does this by itself where the statistic `imbalance`
 *  (largest over mean work) exceeds the option `rebalance_above`. Initialises first if necessary;
 *  if the monitor stops that, returns PNPBS_STOPPED without a change of owners. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_rebalance(pnpbs_placement placement);

/** Runs the whole placement: initialises if necessary, steps until the stop test is met or `steps`
 *  are done, and finishes. A later call starts a new schedule from the current nodes. Collective.
 *  Returns PNPBS_OK; PNPBS_NOT_CONVERGED (the best state is kept); PNPBS_SPACING_MISSED, whether or
 *  not the bubbles are at rest, if in one of the bands of pnpbs_placement_get_edge_bands the mean
 *  over 50 edges or more differs from 1 by more than 0.1 (a warning names the band), and so does,
 *  where 50 edges or more join two nodes inside the domain, the mean over these (edges through a
 *  thin wall are as long as it is thick; where edges are too long, those at feature edges and
 * corners of a body do not count); PNPBS_NOT_CONFORMING, whatever else is true, if there are no
 * tetrahedra, nodes are in none, some have no volume, their boundary is torn or has another Euler
 * characteristic than the domain's, the volume differs from the domain's by more than 0.001 of it
 * and more than boundary faces cut off as chords, or triangles of surfaces alone do not join (a
 * warning says which); PNPBS_STOPPED. The nodes are valid in all these cases. In space, before it
 * would return PNPBS_NOT_CONFORMING, it reduces d where elements are missing and continues from its
 * nodes, up to `conforming_rounds` times; a warning reports the cost (statistic
 * `unresolved_places`). It does so also where dihedral angles are smaller than the option
 * `min_angle`. d stays reduced there until another spacing is set. There is also a warning where
 * the boundary of the tetrahedra does not follow the surfaces (statistic `missing_faces`; see the
 * option `resolve`), and where corners and sharp edges are left out (statistic `left_out`) because
 * no tetrahedra connect to them: what lies between them is smaller than half of d, or the body ends
 * there in a tip or an edge too sharp for any d. */
PNPBS_API pnpbs_status pnpbs_placement_run(pnpbs_placement placement);

/** Returns the dimension of the placement's domain. Local.
 *  @param[out] dim  2: in the plane, 3: in space and on a sphere */
PNPBS_API pnpbs_status pnpbs_placement_dimension(pnpbs_placement placement, int32_t *dim);

/** Returns the radius of the sphere that the placement's nodes lie on. Local.
 *  @param[out] radius  0: its domain is not on a sphere */
PNPBS_API pnpbs_status pnpbs_placement_sphere_radius(pnpbs_placement placement, double *radius);

/** Returns the number of nodes of this rank. Local. */
PNPBS_API pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t *nodes);

/** Copies the nodes of this rank, in their local order; any array may be NULL. Local.
 *  @param[in] capacity      nodes the arrays have room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] coordinates  [nodes][dim]
 *  @param[out] ids          [nodes] global ids, the same for any number of ranks and threads
 *  @param[out] tags         [nodes] 0 inner, otherwise the tag of the curve, surface or fixed node
 *  @param[out] spacing      [nodes] d at the node, no more than 1024 times the domain's size; on a
 *                           boundary that is far finer than d, 32 times the node's longest edge
 *                           there */
PNPBS_API pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity,
                                                 double *coordinates, int64_t *ids, int32_t *tags,
                                                 double *spacing);

/** Copies the surface normals at the nodes of this rank, of a placement in space: the unit normal
 *  of the triangle that a node lies on, and on feature edges and in corners the mean of the
 *  adjacent normals. It is 0 where these oppose each other, and for inner nodes. On level sets,
 *  except at their corners, it is the gradient of f, by differences. Normals point out of a filled
 *  domain. Local.
 *  @param[in] capacity  nodes the array has room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] normals  [nodes][3] */
PNPBS_API pnpbs_status pnpbs_placement_get_normals(pnpbs_placement placement, int64_t capacity,
                                                   double *normals);

/** Returns the number of ghosts: nodes of other ranks that this rank sees near its own. In lists,
 *  stars, triangles and tetrahedra ghost g has the local index nodes + g. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t *ghosts);

/** Copies the ghosts, by increasing id; any array may be NULL. Collective.
 *  @param[in] capacity  ghosts the arrays have room for
 *  @param[out] coordinates, ids, tags, spacing  as pnpbs_placement_get_nodes
 *  @param[out] owners   [ghosts] the rank that owns each */
PNPBS_API pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity,
                                                  double *coordinates, int64_t *ids, int32_t *tags,
                                                  double *spacing, int32_t *owners);

/** Returns the sizes of the exchange pattern, by which values at nodes reach their ghosts on other
 *  ranks. Collective; outputs may be NULL.
 *  @param[out] neighbours  ranks that have ghosts of our nodes, or nodes that are ghosts here
 *  @param[out] sends       nodes to send, one for every rank that has it as a ghost
 *  @param[out] receives    nodes to receive: the number of ghosts */
PNPBS_API pnpbs_status pnpbs_placement_exchange_sizes(pnpbs_placement placement,
                                                      int32_t *neighbours, int64_t *sends,
                                                      int64_t *receives);

/** Copies the exchange pattern, for reuse in a solver: send the values at nodes
 *  send_nodes[send_offsets[k] .. send_offsets[k+1]-1] to ranks[k], and store what it sends at
 *  receive_nodes[receive_offsets[k] .. receive_offsets[k+1]-1], in the same order (that of ids).
 *  Valid until nodes move. Collective.
 *  @param[in] neighbours, sends, receives  what the arrays have room for; too small is
 *                                          PNPBS_ERROR_CAPACITY
 *  @param[out] ranks            [neighbours] in increasing order; rank r lists s where s lists r
 *  @param[out] send_offsets     [neighbours + 1]
 *  @param[out] send_nodes       [sends] local indices of this rank's nodes
 *  @param[out] receive_offsets  [neighbours + 1]
 *  @param[out] receive_nodes    [receives] local indices of ghosts (nodes + g) */
PNPBS_API pnpbs_status pnpbs_placement_get_exchange(pnpbs_placement placement, int32_t neighbours,
                                                    int64_t sends, int64_t receives, int32_t *ranks,
                                                    int64_t *send_offsets, int64_t *send_nodes,
                                                    int64_t *receive_offsets,
                                                    int64_t *receive_nodes);

/** Returns numbers that are contiguous per rank, as PETSc and hypre require, in addition to the
 *  ids: node i of this rank has number first + i, and the numbers of rank r follow those of rank r
 *  - 1. Unlike the ids they depend on the ranks. Collective; outputs may be NULL.
 *  @param[in] capacity        ghosts `ghost_numbers` has room for; if that is given and too small,
 *                             PNPBS_ERROR_CAPACITY
 *  @param[out] first          the number of this rank's first node; 0 on rank 0
 *  @param[out] count          how many numbers this rank has: its nodes
 *  @param[out] ghost_numbers  [ghosts] the numbers of the ghosts, in the order of
 *                             pnpbs_placement_get_ghosts */
PNPBS_API pnpbs_status pnpbs_placement_get_numbering(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *first, int64_t *count,
                                                     int64_t *ghost_numbers);

/** Updates the values at ghosts from their owners, for a field of `components` numbers at each
 *  node. The exchange plan is built at the first call after nodes have moved, and kept. Collective.
 *  Errors: PNPBS_ERROR_ARGUMENT for another n, fewer than one component, or numbers of components
 *  that differ between ranks; PNPBS_ERROR_STATE without nodes, or while an update is in progress.
 *  @param[in] n           nodes and ghosts of this rank (pnpbs_placement_count, _ghost_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[out] values     [n][components] those of this rank's nodes, which are read, then those of
 *                         its ghosts, which are filled */
PNPBS_API pnpbs_status pnpbs_placement_update_ghosts(pnpbs_placement placement, int64_t n,
                                                     int32_t components, double *values);

/** Begins an update of ghosts, for a solver that computes while messages travel: copies the values
 *  of this rank's nodes that others need, and starts sending them. The array may be changed or
 *  freed after the call. A placement has at most one update in progress; other calls are allowed
 *  before it ends. Collective. Errors: as there. */
PNPBS_API pnpbs_status pnpbs_placement_begin_update_ghosts(pnpbs_placement placement, int64_t n,
                                                           int32_t components,
                                                           const double *values);

/** Ends an update of ghosts: waits for the values that the other ranks sent when they began, and
 *  fills those of the ghosts; those of this rank's nodes are unchanged. Local: does not wait for
 *  other ranks to end theirs. Errors: PNPBS_ERROR_STATE without an update in progress, or if nodes
 *  have moved since it began, which ends it; PNPBS_ERROR_MPI on a rank that lacks some of the
 *  values, which ends it; PNPBS_ERROR_ARGUMENT for another n or number of components, after which
 *  the update is still in progress.
 *  @param[out] values  [n][components] of which those of the ghosts are filled; need not be the
 *                      array that the update began with */
PNPBS_API pnpbs_status pnpbs_placement_end_update_ghosts(pnpbs_placement placement, int64_t n,
                                                         int32_t components, double *values);

/** Adds the values at ghosts to those of the nodes they represent, on the ranks that own these. It
 *  is the reverse of pnpbs_placement_update_ghosts, for sums over elements to which several ranks
 *  contribute. Each sum, of a node's own value and those at its ghosts, is exact and rounded once,
 *  so the order of ranks has no effect: it has the same bits wherever the terms are the same.
 *  Values that a rank has summed by itself before were rounded there, so unless these sums are
 *  exact, results differ by rounding between numbers of ranks. Where all bits must agree,
 *  pnpbs_placement_get_incident_elements provides what a row needs on its own rank. NaN and
 *  infinities as in pnpbs_placement_sum; a sum that is 0 is +0. May be called while an update is in
 *  progress. Collective. Errors: PNPBS_ERROR_ARGUMENT for another n, fewer than one component, or
 *  numbers of components that differ between ranks; PNPBS_ERROR_STATE without nodes.
 *  @param[in] n           nodes and ghosts of this rank (pnpbs_placement_count, _ghost_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[out] values     [n][components] those of this rank's nodes, which become the sums, then
 *                         those of its ghosts, which are unchanged */
PNPBS_API pnpbs_status pnpbs_placement_add_from_ghosts(pnpbs_placement placement, int64_t n,
                                                       int32_t components, double *values);

/** Sums each component of a field over the nodes of all ranks: the exact sum, rounded once to the
 *  nearest double. It has the same bits for any number of ranks and threads and any order of nodes.
 *  NaN where a value is NaN or where there are infinities of both signs; otherwise an infinity
 *  where a value is, or where the sum is beyond the largest double. A sum that is 0 is +0.
 *  Collective. Errors: as pnpbs_placement_update_ghosts, except for updates in progress.
 *  @param[in] n           entries of the array: at least this rank's nodes; entries after them, for
 *                         its ghosts, are ignored
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] values      [n][components]
 *  @param[out] sums       [components] the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_sum(pnpbs_placement placement, int64_t n, int32_t components,
                                           const double *values, double *sums);

/** Computes the dot product of two fields over the nodes of all ranks, for each component: the sum
 *  of the exact products, rounded once, with the properties of pnpbs_placement_sum. No product
 *  overflows or underflows; one of an infinity and 0 is NaN. Collective.
 *  @param[in] n           entries of the arrays: at least this rank's nodes
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] x, y        [n][components]; may be the same array
 *  @param[out] products   [components] the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_dot(pnpbs_placement placement, int64_t n, int32_t components,
                                           const double *x, const double *y, double *products);

/** Returns the number of entries of all adjacency lists of this rank's nodes. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t *entries);

/** Copies the adjacency lists in compressed rows: the neighbours of local node i are
 *  neighbours[offsets[i] .. offsets[i+1]-1], local indices in the order of global ids. They can be
 *  used directly for node-based local mesh generation. Pairs separated by a boundary are not
 *  neighbours; on surfaces alone, neighbours share a patch and their normals differ by less than 90
 *  degrees. Collective.
 *  @param[in] capacity  entries `neighbours` has room for
 *  @param[out] offsets  [nodes + 1] */
PNPBS_API pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *offsets, int64_t *neighbours);

/** Returns the number of entries of all Delaunay stars. Collective. */
PNPBS_API pnpbs_status pnpbs_placement_star_size(pnpbs_placement placement, int64_t *entries);

/** Copies each node's star in the constrained Delaunay triangulation of the domain: in the plane
 *  counter-clockwise; in space all nodes that share a tetrahedron with it, on surfaces alone a
 *  triangle, in no particular order. Collective.
 *  @param[out] offsets     [nodes + 1]
 *  @param[out] neighbours  [entries] local indices
 *  @param[out] triangle    [entries] 1 if the node, this neighbour and the next one around (the
 *                          first one after the last) are a triangle of the domain, 0 if a gap
 *                          outside the domain lies between them. It is 0 in space. May be NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
                                                 int64_t *offsets, int64_t *neighbours,
                                                 int8_t *triangle);

/** Copies the triangles of the stars of a placement in the plane or on a sphere, each once,
 *  counter-clockwise, on a sphere as seen from outside. On several ranks a triangle belongs to the
 * rank that owns its node with the lowest id; other corners may be ghosts, and the triangles of all
 * ranks together are one conforming triangulation of the domain. Collective. Call with capacity 0
 * to get the count.
 *  @param[out] triangles  [count][3] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_triangles(pnpbs_placement placement, int64_t capacity,
                                                     int64_t *count, int64_t *triangles);

/** Copies the tetrahedra of the stars of a placement in space, each once: seen from the fourth
 *  corner, the first three turn counter-clockwise, so the volume (b-a) x (c-a) . (d-a) / 6 of
 *  corners a, b, c and d is positive. On several ranks a tetrahedron belongs to the rank that owns
 *  its node with the lowest id; other corners may be ghosts, and the tetrahedra of all ranks
 *  together are one conforming triangulation of the domain. Surfaces alone and spheres have none.
 *  Collective.
 *  Call with capacity 0 to get the count.
 *  @param[out] tetrahedra  [count][4] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_tetrahedra(pnpbs_placement placement, int64_t capacity,
                                                      int64_t *count, int64_t *tetrahedra);

/** Copies the tag of each element: that of the region it lies in (pnpbs_domain_add_region), or 0 if
 *  the region has none. The order is that of pnpbs_placement_get_triangles, in space that of
 *  pnpbs_placement_get_tetrahedra. Collective. Call with capacity 0 to get the count. Errors:
 *  PNPBS_ERROR_CAPACITY; PNPBS_ERROR_ARGUMENT on surfaces alone.
 *  @param[out] tags  [count], or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_element_tags(pnpbs_placement placement, int64_t capacity,
                                                        int64_t *count, int32_t *tags);

/** Copies every element with a corner among this rank's nodes, whichever rank it belongs to:
 *  triangles in the plane, tetrahedra in space, triangles on surfaces alone. With these a rank
 *  assembles the rows of its nodes without communication. An element whose corners have several
 *  owners is returned on each of these ranks. The corner with the lowest id comes first, so an
 *  element belongs to this rank, as defined by pnpbs_placement_get_triangles and related functions,
 *  if its first corner is a node of this rank. The others follow in the same orientation as there;
 *  in a tetrahedron the lowest id of the three comes first. Elements are in the order of the ids of
 *  their corners, so those of a node are the same, in the same order, for any number of ranks, and
 *  a row summed in this order has the same bits. Collective. Call with capacity 0 to get the count.
 *  @param[in] capacity   elements the array has room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] count     number of elements
 *  @param[out] corners   3 or 4: corners of an element; may be NULL
 *  @param[out] elements  [count][corners] local indices, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_incident_elements(pnpbs_placement placement,
                                                             int64_t capacity, int64_t *count,
                                                             int32_t *corners, int64_t *elements);

/** Copies the edges of this rank's elements, and of the facets that it has, with a mid node on
 * each, for elements of second order. The mid node is the middle of the edge; on boundary and inner
 *  curves and surfaces it lies on these, on curves halfway along them, and on spheres all of them
 *  do. Balls and cylinders are triangles within 1e-4 of the radius here, too. Where an element
 *  would fold, or its Jacobian fall below a tenth of that of the straight one, its edges are
 *  straight. Edges, numbers and mid nodes are the same for any number of ranks; several ranks may
 *  have an edge. In a periodic domain a rank may have several images of an edge. They have the same
 *  number, and their mid nodes differ by whole periods. Collective. Call with capacity 0 to get the
 *  count; arrays may be NULL.
 *  @param[in] capacity    edges the arrays have room for; too small is PNPBS_ERROR_CAPACITY
 *  @param[out] count      number of edges
 *  @param[out] straight   edges of all ranks that are straight lest an element folds; may be NULL
 *  @param[out] ends       [count][2] local indices, ascending, and ascending from edge to edge
 *  @param[out] numbers    [count] 0, 1, ... over all ranks, in the order of the ids of the ends
 *  @param[out] midpoints  [count][dim] positions of the mid nodes */
PNPBS_API pnpbs_status pnpbs_placement_get_edges(pnpbs_placement placement, int64_t capacity,
                                                 int64_t *count, int64_t *straight, int64_t *ends,
                                                 int64_t *numbers, double *midpoints);

/** Finds the edges of elements or facets, as other functions return these, among those of
 *  pnpbs_placement_get_edges. For a triangle of corners 0, 1, 2 they are 01, 12, 02, and for a
 *  tetrahedron also 03, 13, 23, in the order in which VTK has mid nodes; Gmsh has 23 before 13.
 *  Collective; each rank passes its own cells, or none. Errors: PNPBS_ERROR_ARGUMENT for other
 *  numbers of corners, and for indices that are none of nodes and ghosts.
 *  @param[in] n        number of elements or facets
 *  @param[in] corners  2, 3 or 4: corners of each
 *  @param[in] cells    [n][corners] local indices
 *  @param[out] edges   [n][corners * (corners - 1) / 2] indices of edges; -1 for those of elements
 *                      of other ranks that this one does not have */
PNPBS_API pnpbs_status pnpbs_placement_find_edges(pnpbs_placement placement, int64_t n,
                                                  int32_t corners, const int64_t *cells,
                                                  int64_t *edges);

/** Sets which inner curves, in space inner surfaces, are cracks: those with these tags, except
 * where they bound the domain. pnpbs_placement_get_cracked_elements and the next functions return
 *  elements that share no node across a crack, as fracture mechanics and elements without thickness
 *  require, and so do files of elements written from now on in .msh, .msh2, .vtu and .vtkhdf; other
 *  formats, pieces and elements of second order are PNPBS_ERROR_ARGUMENT then. All other results
 *  are unchanged. The elements around a node fall into sectors that cracks separate. One sector
 *  keeps the node, along a crack that on the left of a curve or in front of a surface, and each
 *  other one gets a copy of it. So a node inside a crack, or where it meets the boundary, has one
 *  copy; where n cracks cross, it has 2 n - 1; and at the tip it has none. A crack must be at least
 *  two facets long to open. Local, with the same tags on all ranks. Errors: PNPBS_ERROR_ARGUMENT
 *  for the tag 0.
 *  @param[in] n     0: no cracks
 *  @param[in] tags  [n] */
PNPBS_API pnpbs_status pnpbs_placement_set_cracks(pnpbs_placement placement, int32_t n,
                                                  const int32_t *tags);

/** Copies the pairs of nodes on cracks: copies of this rank's nodes, and then copies of ghosts that
 *  its elements refer to. Copy k of this list has the local index nodes + ghosts + k, and position,
 *  tag and spacing of its original. Numbers do not depend on ranks. Collective. Call with capacity
 *  0 to get the count; arrays may be NULL. Errors: PNPBS_ERROR_ARGUMENT if no inner curve or
 * surface has one of the tags, if they differ between ranks, and on surfaces alone;
 * PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity  copies the arrays have room for
 *  @param[out] count    number of copies
 *  @param[out] all      number of copies of all ranks, each counted once; may be NULL
 *  @param[out] nodes    [count] local indices of the originals
 *  @param[out] numbers  [count] 0, 1, ... over all ranks, in the order of the ids of the originals
 */
PNPBS_API pnpbs_status pnpbs_placement_get_crack_nodes(pnpbs_placement placement, int64_t capacity,
                                                       int64_t *count, int64_t *all, int64_t *nodes,
                                                       int64_t *numbers);

/** Copies the elements with doubled nodes along cracks: triangles in the plane, tetrahedra in
 * space, in the order of pnpbs_placement_get_triangles and pnpbs_placement_get_tetrahedra, which is
 * also that of pnpbs_placement_get_element_tags. Collective. Call with capacity 0 to get the count.
 *  Errors: as there and pnpbs_placement_get_crack_nodes.
 *  @param[out] elements  [count][3 or 4] local indices, those from nodes + ghosts on of copies; or
 *                        NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_cracked_elements(pnpbs_placement placement,
                                                            int64_t capacity, int64_t *count,
                                                            int64_t *elements);

/** Copies both sides of the facets of cracks, edges in the plane and triangles in space. Their
 * nodes coincide in pairs and are different except at tips, so a facet is an element without
 * thickness. A facet belongs to the rank that pnpbs_placement_get_boundary_edges, in space the rule
 * of pnpbs_placement_get_boundary_triangles, assigns it to. Collective. Call with capacity 0 to get
 *  the count; arrays may be NULL. Errors: as pnpbs_placement_get_crack_nodes.
 *  @param[out] count    number of facets
 *  @param[out] covered  the area of the facets of all ranks over that of the surfaces, 1 in the
 *                       plane. Where d is too coarse for elements to follow a surface, facets are
 *                       missing, and elements connect its two sides there. May be NULL
 *  @param[out] front    [count][2 or 3] local indices, on the left of a curve from the first to the
 *                       second node, in front of a surface, from where the corners are
 *                       counter-clockwise
 *  @param[out] back     [count][2 or 3] of the same nodes on the other side
 *  @param[out] tags     [count] */
PNPBS_API pnpbs_status pnpbs_placement_get_crack_facets(pnpbs_placement placement, int64_t capacity,
                                                        int64_t *count, double *covered,
                                                        int64_t *front, int64_t *back,
                                                        int32_t *tags);

/** Copies the boundary triangles of a placement in space: the faces that belong to one tetrahedron
 *  only, counter-clockwise as seen from outside. On surfaces alone, they are the triangles between
 *  the nodes, counter-clockwise as seen from the side that the surface's normal points to. On
 *  several ranks a triangle belongs to the rank that owns its node with the lowest id, and the
 *  triangles of all ranks together conform. Collective. Call with capacity 0 to get the count.
 *  @param[out] triangles  [count][3] local indices, or NULL
 *  @param[out] tags       [count] of the surface there, or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_boundary_triangles(pnpbs_placement placement,
                                                              int64_t capacity, int64_t *count,
                                                              int64_t *triangles, int32_t *tags);

/** Copies the boundary edges of a placement in the plane or on a sphere: consecutive nodes on
 * boundary and inner curves. On several ranks an edge belongs to the rank that owns its first node;
 * the other end may be a ghost. Local. Call with capacity 0 to get the count.
 *  @param[out] edges  [count][2] local indices, or NULL
 *  @param[out] tags   [count], or NULL */
PNPBS_API pnpbs_status pnpbs_placement_get_boundary_edges(pnpbs_placement placement,
                                                          int64_t capacity, int64_t *count,
                                                          int64_t *edges, int32_t *tags);

/** Checks the invariants of the results. Ids are unique, no two nodes coincide, all lie inside or
 *  on the boundary, and all nodes of the boundary's curves or feature edges are present. Adjacency
 *  lists are symmetric. The triangles or tetrahedra of the stars are one conforming triangulation
 *  of the domain, each in the stars of all its corners, with every boundary edge, and their areas
 *  or volumes add up to what the boundary encloses. In space the boundary triangles are closed, and
 *  cut off no more of the domain than chords do; on surfaces alone every edge has a triangle on
 *  both sides, at borders on one, and the areas add up. It takes about as long as building lists
 *  and stars, and no rank holds more than its share. Collective. Returns PNPBS_OK;
 *  PNPBS_NOT_CONFORMING where a run returns it, too: pnpbs_last_error says where, and the existing
 *  elements satisfy all other invariants. Errors: PNPBS_ERROR_INTERNAL if something else is wrong:
 *  the message says what, with ids and coordinates; PNPBS_ERROR_STATE without nodes. */
PNPBS_API pnpbs_status pnpbs_placement_check(pnpbs_placement placement);

/** Returns a statistic by key (see pnpbs_statistic_info). Collective (some are computed on
 *  request). Errors: PNPBS_ERROR_KEY with the nearest known name, or if the type differs;
 *  PNPBS_ERROR_ARGUMENT if the key differs between ranks. */
PNPBS_API pnpbs_status pnpbs_placement_get_int64(pnpbs_placement placement, const char *key,
                                                 int64_t *value);
PNPBS_API pnpbs_status pnpbs_placement_get_double(pnpbs_placement placement, const char *key,
                                                  double *value);
PNPBS_API pnpbs_status pnpbs_placement_get_string(pnpbs_placement placement, const char *key,
                                                  const char **value);

/** Measures how well the edges of the triangles or tetrahedra follow the spacing, by bands of d.
 *  There are eight, equal in log d between the smallest and the largest d at the nodes, or one if
 *  the largest is less than 1.1 times the smallest. Bands without edges are left out. An edge's d
 *  is the mean of d at its ends. Edges between two boundary nodes are not counted, because the
 *  corners of the domain determine their positions. Includes all ranks, and is the same on each.
 *  Collective. Call with capacity 0 to get the count; arrays may be NULL.
 *  @param[in] capacity    bands the arrays have room for; 8 is always enough
 *  @param[out] count      number of bands
 *  @param[out] d_from     [count] lower end, in the unit of the coordinates; increasing
 *  @param[out] d_to       [count] upper end
 *  @param[out] edges      [count] number of edges
 *  @param[out] mean       [count] of their length over d
 *  @param[out] deviation  [count] standard deviation of that */
PNPBS_API pnpbs_status pnpbs_placement_get_edge_bands(pnpbs_placement placement, int64_t capacity,
                                                      int64_t *count, double *d_from, double *d_to,
                                                      int64_t *edges, double *mean,
                                                      double *deviation);

/** Measures the regions of the domain by the tags of their elements
 *  (pnpbs_placement_get_element_tags), also the elements without a tag if there are any. Includes
 *  all ranks, and is the same on each, with the same bits for any number of them. Collective. Call
 *  with capacity 0 to get the count; arrays may be NULL. Errors: PNPBS_ERROR_CAPACITY;
 *  PNPBS_ERROR_ARGUMENT on surfaces alone.
 *  @param[in] capacity   regions the arrays have room for
 *  @param[out] count     number of regions that have elements
 *  @param[out] tags      [count] increasing
 *  @param[out] nodes     [count] of the elements of the region; those of an interface are in
 * several
 *  @param[out] elements  [count]
 *  @param[out] measures  [count] volume of the elements, in the plane area, on a sphere along it */
PNPBS_API pnpbs_status pnpbs_placement_get_regions(pnpbs_placement placement, int64_t capacity,
                                                   int64_t *count, int32_t *tags, int64_t *nodes,
                                                   int64_t *elements, double *measures);

/** Measures the Voronoi cells of the nodes as finite volumes need them, by bands of d, in the plane
 *  and on spheres; elsewhere there are no bands. A cell is the polygon of the circumcentres of the
 *  triangles around an inner node that is not fixed. Measures are "edge_ratio", of each cell its
 *  shortest edge over its longest; "area_ratio", of each edge between two cells the area of the
 *  smaller cell over that of the larger; and "dual_offset", of each edge between two such nodes the
 *  distance of its middle from that of the Voronoi edge across it, over its length. Lengths and
 *  areas are along the sphere. The limits of the bands are those of pnpbs_placement_get_edge_bands,
 *  and bands with neither a cell nor an edge are left out, so they are the same for all measures. A
 *  cell's d is that of its node, an edge's the mean of d at its ends. Includes all ranks, and is
 *  the same on each. Collective. Call with capacity 0 to get the count; arrays may be NULL.
 *  @param[in] measure   its name
 *  @param[in] capacity  bands the arrays have room for; 8 is always enough
 *  @param[out] count    number of bands
 *  @param[out] d_from   [count] lower end, in the unit of the coordinates; increasing
 *  @param[out] d_to     [count] upper end
 *  @param[out] number   [count] number of cells or edges measured
 *  @param[out] mean     [count] of the measure; 0 if number is 0, as is worst
 *  @param[out] worst    [count] the smallest ratio, or the largest offset */
PNPBS_API pnpbs_status pnpbs_placement_get_cell_bands(pnpbs_placement placement,
                                                      const char *measure, int64_t capacity,
                                                      int64_t *count, double *d_from, double *d_to,
                                                      int64_t *number, double *mean, double *worst);

/** Returns warnings about domain and spacing, collected at initialise (a feature smaller than d, an
 *  unused vertex, ...), and about nodes that do not follow the spacing, from the last run.
 *  Local. */
PNPBS_API pnpbs_status pnpbs_placement_warning_count(pnpbs_placement placement, int32_t *count);
PNPBS_API pnpbs_status pnpbs_placement_get_warning(pnpbs_placement placement, int32_t index,
                                                   const char **text);

/** Warnings about the domain. In parentheses: what `count` and `value` of
 *  pnpbs_placement_get_warning_data are. More codes may be added: programs must expect numbers that
 *  they do not know. PNPBS_WARNING_UNKNOWN is none of the others.
 *
 *  LEFT_OUT_OUTSIDE: curves or triangles outside of the domain are left out (their names).
 *  UNUSED_VERTICES: vertices are in no segment (vertices). REGION_POINTS: region points have no
 *  effect (points). SIMPLIFIED: vertices were left out (vertices). REPAIRED: the body was repaired
 *  (triangles, resolution), or 0 triangles: it was sound. TRIANGLES_LEFT_OUT: they have no area,
 *  are given twice, or follow those that a binary STL announces (triangles). TRIANGLES_TURNED: to
 *  agree with neighbours, or outwards (triangles). VERTICES_MERGED: they were closer than the
 *  tolerance to others, or in the plane to a curve (vertices, tolerance). SURFACES_TOUCH: in single
 *  vertices (vertices). PIECES_LEFT_OUT: parts of a body are too thin (parts, mean thickness).
 *  EDGES_ROUNDED: edges of a level set are rounded by the resolution (triangle edges).
 *  CREASES_IGNORED: short creases are no features (edges). FEATURE_ANGLE: the smallest holds for
 *  all surfaces (-, degrees). CURVED_ELEMENTS: elements of a file are treated as straight
 *  (elements). GROUPS: entities of a file are in several groups (entities). */
#define PNPBS_WARNING_UNKNOWN 0
#define PNPBS_WARNING_LEFT_OUT_OUTSIDE 101
#define PNPBS_WARNING_UNUSED_VERTICES 102
#define PNPBS_WARNING_REGION_POINTS 103
#define PNPBS_WARNING_SIMPLIFIED 104
#define PNPBS_WARNING_REPAIRED 105
#define PNPBS_WARNING_TRIANGLES_LEFT_OUT 106
#define PNPBS_WARNING_TRIANGLES_TURNED 107
#define PNPBS_WARNING_VERTICES_MERGED 108
#define PNPBS_WARNING_SURFACES_TOUCH 109
#define PNPBS_WARNING_PIECES_LEFT_OUT 110
#define PNPBS_WARNING_EDGES_ROUNDED 111
#define PNPBS_WARNING_CREASES_IGNORED 112
#define PNPBS_WARNING_FEATURE_ANGLE 113
#define PNPBS_WARNING_CURVED_ELEMENTS 114
#define PNPBS_WARNING_GROUPS 115

/** Warnings about the spacing. FEATURE_UNRESOLVED: d is larger than a feature (boundary edges or
 *  nodes, the least length or distance over d). FIXED_NODES_CLOSE: to the boundary or each other
 *  (fixed nodes, the least distance over d). GROWTH: d grows too fast (-, growth per length).
 *  PARTIAL_EXTENT: d is given for a part of the domain only (nodes beyond it). SPACING_COARSE: d is
 *  too large for the whole domain (-, least d). SPACING_MISSED: the nodes do not follow d (edges of
 *  a band of d, their mean length over d). SPACING_HELD: d was reduced where it did not resolve the
 *  shape (points, least d). */
#define PNPBS_WARNING_FEATURE_UNRESOLVED 201
#define PNPBS_WARNING_FIXED_NODES_CLOSE 202
#define PNPBS_WARNING_GROWTH 203
#define PNPBS_WARNING_PARTIAL_EXTENT 204
#define PNPBS_WARNING_SPACING_COARSE 205
#define PNPBS_WARNING_SPACING_MISSED 206
#define PNPBS_WARNING_SPACING_HELD 207

/** Warnings about the elements. BOUNDARY_NOT_FOLLOWED: by the tetrahedra (triangles).
 *  NOT_CONFORMING: they do not fill the domain (nodes, edges or tetrahedra, or 0). SMALL_ANGLES:
 *  some dihedral angles are below a limit (tetrahedra, degrees). FEATURES_LEFT_OUT: the tetrahedra
 *  of a thin body do not reach corners and sharp edges (nodes). */
#define PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED 301
#define PNPBS_WARNING_NOT_CONFORMING 302
#define PNPBS_WARNING_SMALL_ANGLES 303
#define PNPBS_WARNING_FEATURES_LEFT_OUT 304

/** Warnings about options and the run. OPTION_WITHOUT_EFFECT: an option does nothing here.
 *  OPTIONS_CHANGED: since the checkpoint (options). DEPENDS_ON_RANKS: the nodes may do so
 *  (decisions). */
#define PNPBS_WARNING_OPTION_WITHOUT_EFFECT 401
#define PNPBS_WARNING_OPTIONS_CHANGED 402
#define PNPBS_WARNING_DEPENDS_ON_RANKS 403

/** Returns a warning as data. Local; outputs may be NULL.
 *  @param[in] index   0 .. count-1
 *  @param[out] code   one of PNPBS_WARNING_...
 *  @param[out] count  how many nodes, edges, triangles or points it is about; 0: not known
 *  @param[out] value  a number that it is about; NaN if there is none
 *  @param[out] point  [3] the first point that the text names, in the coordinates of nodes;
 *                     in the plane with NaN behind x and y; NaN if there is none */
PNPBS_API pnpbs_status pnpbs_placement_get_warning_data(pnpbs_placement placement, int32_t index,
                                                        int32_t *code, int64_t *count,
                                                        double *value, double *point);

/* ---------------------------------------------------------------- transfer -------------- */

/** Transfers a field to a later set of nodes: copies the values of all ranks at the current nodes
 *  of the placement, with these nodes and their triangles or tetrahedra, each rank its own. The
 *  nodes may then move, be replaced or change their ranks, and the placement may be destroyed. The
 *  field is linear on each triangle or tetrahedron; beyond their boundary, next to curved
 *  boundaries, it is extrapolated from the one at the nearest point of that boundary. Linear fields
 *  are thus preserved, and others change by a term of second order in d. On surfaces alone it is
 *  linear on each triangle between their nodes, and elsewhere equal to the value at the nearest
 *  point of these. On a sphere the value at a point is that of the plane triangle on the ray to it
 *  from the centre. Collective. Errors: PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT for
 *  another n, fewer than one component, or a value that is not finite: the message names the rank,
 *  the component and the node's id.
 *  @param[in] placement   whose nodes have the values
 *  @param[in] n           number of nodes of this rank (pnpbs_placement_count)
 *  @param[in] components  numbers at each node, the same on all ranks
 *  @param[in] values      [n][components] in the order of pnpbs_placement_get_nodes
 *  @param[out] transfer   the handle */
PNPBS_API pnpbs_status pnpbs_transfer_create(pnpbs_placement placement, int64_t n,
                                             int32_t components, const double *values,
                                             pnpbs_transfer *transfer);

/** Transfers a field as pnpbs_transfer_create does, with second order. At each node a quadratic
 *  polynomial passes through its value and is fitted by least squares to those of its neighbours
 *  and of their neighbours in the stars (so across no boundary, and the same for all components).
 *  Within an element the polynomials of its corners are weighted as in the linear field. Quadratic
 *  fields are thus preserved, and smooth ones change by a term of third order in d. Next to jumps
 *  the field may leave the range of the values there. Where a node has too few neighbours, its part
 *  is linear (pnpbs_transfer_order returns their number), as it is everywhere on surfaces alone.
 *  Collective. Errors and parameters as there. */
PNPBS_API pnpbs_status pnpbs_transfer_create_second_order(pnpbs_placement placement, int64_t n,
                                                          int32_t components, const double *values,
                                                          pnpbs_transfer *transfer);

/** Returns the order of the field. Outputs may be NULL. Local.
 *  @param[out] order         1 or 2
 *  @param[out] linear_nodes  nodes on all ranks without a quadratic polynomial; with order 1 all,
 *                            reported as -1 */
PNPBS_API pnpbs_status pnpbs_transfer_order(pnpbs_transfer transfer, int32_t *order,
                                            int64_t *linear_nodes);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_transfer_destroy(pnpbs_transfer *transfer);

/** Returns the shape of the arrays of a transfer; outputs may be NULL. Local.
 *  @param[out] dim         2: in the plane, 3: in space and on a sphere
 *  @param[out] components  numbers at each node */
PNPBS_API pnpbs_status pnpbs_transfer_sizes(pnpbs_transfer transfer, int32_t *dim,
                                            int32_t *components);

/** Evaluates the field at the current nodes of a placement: the same bits for any number of ranks
 *  and threads, at creation and now. A node at the position of an earlier one gets its value
 *  unchanged. The placement may be another one of the same context, in the same dimension.
 *  Collective. Errors: PNPBS_ERROR_CAPACITY; PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT
 *  for a placement of another context or dimension, or not on the same sphere.
 *  @param[in] conserve  nonzero: adds the same number to the values of each component, so that the
 *                       integral of the field that is linear on the current triangles or tetrahedra
 *                       (on surfaces alone, triangles) equals its integral on the previous ones, to
 *                       rounding. Where both fill the same domain, the number is of second order in
 *                       d, and rounding for a linear field; next to curved boundaries, where they
 *                       do not, it also compensates for the difference in what they fill. Values
 *                       may leave their previous range. On a sphere the integral is the sum, over
 *                       the triangles, of the area along the sphere times the mean of the values at
 *                       the corners.
 *  @param[in] capacity  nodes the array has room for, at least those of this rank
 *  @param[out] values   [nodes][components] in the order of pnpbs_placement_get_nodes; for those of
 *                       ghosts use pnpbs_placement_update_ghosts */
PNPBS_API pnpbs_status pnpbs_transfer_at_nodes(pnpbs_transfer transfer, pnpbs_placement placement,
                                               int32_t conserve, int64_t capacity, double *values);

/** Evaluates the field at arbitrary points; each rank passes its own, 0 or more. In a periodic
 *  domain each point stands for its image in the box. Collective.
 *  Errors: PNPBS_ERROR_ARGUMENT for coordinates that are not finite, or beyond 1e60.
 *  @param[in] n            points of this rank
 *  @param[in] coordinates  [n][dim]; on a sphere points are taken along the ray from the origin
 *  @param[out] values      [n][components] */
PNPBS_API pnpbs_status pnpbs_transfer_at_points(pnpbs_transfer transfer, int64_t n,
                                                const double *coordinates, double *values);

/* ---------------------------------------------------------------- distributed mesh ------ */

/** Makes a distributed mesh of the current nodes: on each rank the nodes, elements and facets that
 *  it owns, and layers of ghost elements with their nodes, in arrays that solvers take. No rank
 *  holds more than its part. Elements are triangles in the plane, tetrahedra in space, and
 *  triangles on surfaces alone, all with positive orientation (on surfaces alone counter-clockwise
 *  as seen from the side that the normal points to). A node belongs to the rank that owns it in the
 *  placement, and an element to the owner of its node with the lowest id. Both are numbered from 0,
 *  contiguously by rank: within a rank, nodes in the order of their ids (as by
 *  pnpbs_placement_get_numbering) and elements in the order of their corners' ids. A rank's indices
 *  count from 0, too: first what it owns, in the order of the numbers, then the ghosts, by number.
 *  The mesh is a copy: nodes may move afterwards, and the placement may be destroyed. Collective.
 *  Errors: PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT for ghost_layers out of 0 .. 16 or
 *  not the same on all ranks.
 *  @param[in] placement     whose nodes and elements it has
 *  @param[in] ghost_layers  0: this rank has only the elements that it owns. 1: also those of other
 *                           ranks that have a node in common with these, or with the nodes that it
 *                           owns, so all elements at its nodes. Each further layer adds the
 *                           elements that have a node in common with the layer before.
 *  @param[out] mesh         the handle */
PNPBS_API pnpbs_status pnpbs_mesh_create(pnpbs_placement placement, int32_t ghost_layers,
                                         pnpbs_mesh *mesh);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_mesh_destroy(pnpbs_mesh *mesh);

/** Returns what this rank has; outputs may be NULL. Local.
 *  @param[out] dim             coordinates of a node, 2 or 3
 *  @param[out] corners         nodes of an element, 3 or 4; a facet has one less
 *  @param[out] owned_nodes     nodes that this rank owns
 *  @param[out] nodes           these, and the nodes of other ranks in the elements here
 *  @param[out] owned_elements  elements that this rank owns
 *  @param[out] elements        these, and ghost elements
 *  @param[out] facets          facets of these elements (pnpbs_mesh_get_facets) */
PNPBS_API pnpbs_status pnpbs_mesh_sizes(pnpbs_mesh mesh, int32_t *dim, int32_t *corners,
                                        int64_t *owned_nodes, int64_t *nodes,
                                        int64_t *owned_elements, int64_t *elements,
                                        int64_t *facets);

/** Returns the numbers that this rank owns, and those of all ranks; outputs may be NULL. Local.
 *  @param[out] first_node      this rank owns the nodes first_node .. first_node + owned_nodes - 1
 *  @param[out] all_nodes       nodes of all ranks
 *  @param[out] first_element   likewise
 *  @param[out] all_elements    elements of all ranks, each counted once */
PNPBS_API pnpbs_status pnpbs_mesh_numbering(pnpbs_mesh mesh, int64_t *first_node,
                                            int64_t *all_nodes, int64_t *first_element,
                                            int64_t *all_elements);

/** Copies the nodes of this rank; arrays may be NULL. Local. Errors: PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity      nodes the arrays have room for
 *  @param[out] coordinates  [nodes][dim]
 *  @param[out] numbers      [nodes]
 *  @param[out] ids          [nodes] the ids, which do not depend on the ranks
 *  @param[out] owners       [nodes] the rank that owns it
 *  @param[out] tags         [nodes] as by pnpbs_placement_get_nodes */
PNPBS_API pnpbs_status pnpbs_mesh_get_nodes(pnpbs_mesh mesh, int64_t capacity, double *coordinates,
                                            int64_t *numbers, int64_t *ids, int32_t *owners,
                                            int32_t *tags);

/** Copies the elements of this rank; arrays may be NULL. Local. Errors: PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity  elements the arrays have room for
 *  @param[out] nodes    [elements][corners] local indices of the nodes at the corners
 *  @param[out] numbers  [elements]
 *  @param[out] owners   [elements] the rank that owns it
 *  @param[out] tags     [elements] of the region it lies in (pnpbs_domain_add_region), or 0 if
 *                       the region has none; on surfaces alone of the surface */
PNPBS_API pnpbs_status pnpbs_mesh_get_elements(pnpbs_mesh mesh, int64_t capacity, int32_t *nodes,
                                               int64_t *numbers, int32_t *owners, int32_t *tags);

/** Copies the numbers of the nodes at the corners of the elements of this rank. Local. Errors:
 *  PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity  elements the array has room for
 *  @param[out] numbers  [elements][corners] */
PNPBS_API pnpbs_status pnpbs_mesh_get_connectivity(pnpbs_mesh mesh, int64_t capacity,
                                                   int64_t *numbers);

/** The same for libraries that number in 32 bits. Local. Errors also: PNPBS_ERROR_CAPACITY if the
 *  mesh has more than 2^31 - 1 nodes over all ranks.
 *  @param[in] capacity  elements the array has room for
 *  @param[out] numbers  [elements][corners] */
PNPBS_API pnpbs_status pnpbs_mesh_get_connectivity_int32(pnpbs_mesh mesh, int64_t capacity,
                                                         int32_t *numbers);

/** Copies the facets of the elements of this rank: edges of triangles in the plane that are parts
 *  of the boundary or of inner curves; triangles of tetrahedra that are parts of the boundary or of
 *  inner surfaces; on surfaces alone the edges of only one triangle. Each comes once on a rank. It
 *  belongs to the owner of its element with the lowest number; arrays may be NULL. Local. Errors:
 *  PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity   facets the arrays have room for
 *  @param[out] nodes     [facets][corners - 1] local indices, in space counter-clockwise as seen
 *                        from outside, or turning as the inner surface does; in the plane in the
 *                        direction of the curve
 *  @param[out] tags      [facets] of the curve or surface; on surfaces alone, of the surface
 *  @param[out] elements  [facets][2] local indices of the elements at it; the second is -1 if there
 *                        is none, or if it is not on this rank
 *  @param[out] opposite  [facets] the corner of the first element, 0 .. corners - 1, that is none
 *                        of the facet's
 *  @param[out] inner     [facets] 1 if there are elements on both sides, on whichever ranks; 0 on
 *                        the boundary
 *  @param[out] owners    [facets] the rank it belongs to */
PNPBS_API pnpbs_status pnpbs_mesh_get_facets(pnpbs_mesh mesh, int64_t capacity, int32_t *nodes,
                                             int32_t *tags, int32_t *elements, int32_t *opposite,
                                             int8_t *inner, int32_t *owners);

/** Returns the sizes of the arrays of pnpbs_mesh_get_sharing; outputs may be NULL. Local.
 *  @param[out] nodes    nodes that this rank shares
 *  @param[out] entries  ranks it shares them with, added up over these nodes */
PNPBS_API pnpbs_status pnpbs_mesh_sharing_sizes(pnpbs_mesh mesh, int64_t *nodes, int64_t *entries);

/** Copies which ranks share nodes with this one. A node is shared by its owner and the ranks that
 *  own an element at it. Local. Errors: PNPBS_ERROR_CAPACITY.
 *  @param[in] nodes     nodes the arrays have room for
 *  @param[in] entries   ranks the array has room for
 *  @param[out] shared   [nodes] local indices of the nodes, by number
 *  @param[out] offsets  [nodes + 1] node k is shared with ranks[offsets[k]] to
 *                       ranks[offsets[k + 1] - 1]
 *  @param[out] ranks    [entries] other ranks, in increasing order for each node */
PNPBS_API pnpbs_status pnpbs_mesh_get_sharing(pnpbs_mesh mesh, int64_t nodes, int64_t entries,
                                              int32_t *shared, int64_t *offsets, int32_t *ranks);

/** Writes the mesh in files of Gmsh's format 4.1, in parts as Gmsh partitions a mesh: rank r writes
 *  prefix_<r + 1>.msh, partition r + 1. The file has the nodes, elements and ghost elements of the
 *  rank and the facets that it owns. Nodes and elements have their numbers plus 1, and facets are
 *  numbered behind all elements, so that the files have the same numbers for the same things. Tags
 *  are physical groups, named as by pnpbs_placement_write; the inside is one, too. Programs that
 *  read ghost elements, such as deal.II, need a mesh of one ghost layer; without layers the files
 *  have none. All files appear when all are complete; after an error, existing files are unchanged.
 *  Files of an earlier mesh on more ranks remain. Collective. Errors: PNPBS_ERROR_ARGUMENT for a
 *  prefix that is NULL, empty or not the same on all ranks; PNPBS_ERROR_FILE on all ranks if one
 *  cannot write, with a message that names its file.
 *  @param[in] prefix  folder and begin of the names of the files */
PNPBS_API pnpbs_status pnpbs_mesh_write(pnpbs_mesh mesh, const char *prefix);

/* ---------------------------------------------------------------- Voronoi cells --------- */

/** Makes the Voronoi cells of the current nodes: for each node the part of the elements of the
 *  placement that is closer to it than to any other, with its volume, its faces to neighbours and
 *  its share of the boundary. Volumes are areas in the plane and on surfaces, and areas of faces
 *  are lengths there; on surfaces distances are straight, and on spheres lengths, areas and
 *  distances are along the sphere. Each element is divided among the corners of all elements that
 *  touch it, so a node sees none through a gap that has no elements. The volumes add up to that of
 *  the elements to rounding, on spheres to that of the triangles along the sphere. Cells are
 *  functions of the nodes alone: any number of ranks and threads gives the same bits. The cells are
 *  a copy: nodes may move afterwards, and the placement may be destroyed. Collective. Errors:
 *  PNPBS_ERROR_STATE without nodes.
 *  @param[in] placement  whose nodes have the cells
 *  @param[out] voronoi   the handle */
PNPBS_API pnpbs_status pnpbs_voronoi_create(pnpbs_placement placement, pnpbs_voronoi *voronoi);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_voronoi_destroy(pnpbs_voronoi *voronoi);

/** Returns the sizes of the cells of this rank; outputs may be NULL. Local.
 *  @param[out] dim    coordinates of a node: 2 or 3
 *  @param[out] nodes  nodes that this rank owns, each of which has a cell
 *  @param[out] faces  faces of these cells: a face between two of them counts twice */
PNPBS_API pnpbs_status pnpbs_voronoi_sizes(pnpbs_voronoi voronoi, int32_t *dim, int64_t *nodes,
                                           int64_t *faces);

/** Copies the volumes of the cells and their shares of the boundary; arrays may be NULL. Nodes are
 *  in the order of pnpbs_placement_get_nodes. In the plane and in bodies the areas of a cell's
 * faces times their normals and its share of the boundary add up to 0. Local. Errors:
 *  PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity   nodes the arrays have room for
 *  @param[out] volumes   [nodes]
 *  @param[out] boundary  [nodes][dim] the outward normal integrated over the part of the boundary
 *                        that is closest to the node: where the boundary is flat, its length is the
 *                        area of this part; 0 for nodes away from the boundary */
PNPBS_API pnpbs_status pnpbs_voronoi_get_cells(pnpbs_voronoi voronoi, int64_t capacity,
                                               double *volumes, double *boundary);

/** Copies the faces of the cells in compressed rows: those of local node i are offsets[i] to
 *  offsets[i + 1] - 1, in the order of the neighbours' ids. Both cells at a face have the same area
 *  and distance to the last bit; arrays may be NULL. Local. Errors: PNPBS_ERROR_CAPACITY.
 *  @param[in] nodes       nodes the arrays have room for
 *  @param[in] faces       faces the arrays have room for
 *  @param[out] offsets    [nodes + 1]
 *  @param[out] ids        [faces] of the neighbour
 *  @param[out] numbers    [faces] of the neighbour, as by pnpbs_placement_get_numbering
 *  @param[out] areas      [faces]
 *  @param[out] distances  [faces] from the node to the neighbour
 *  @param[out] normals    [faces][dim] unit vector from the node to the neighbour, straight on
 *                         spheres, too */
PNPBS_API pnpbs_status pnpbs_voronoi_get_faces(pnpbs_voronoi voronoi, int64_t nodes, int64_t faces,
                                               int64_t *offsets, int64_t *ids, int64_t *numbers,
                                               double *areas, double *distances, double *normals);

/* ---------------------------------------------------------------- particles ------------- */

/** Makes particles that fill a body: each stands for a piece of matter of about d^2, or d^3 in
 *  space. The nodes of the placement, which lie in what pnpbs_domain_add_offset makes of the body,
 *  become the particles. Where two are closer than 0.5 times the mean of their d, as at creases and
 *  in thin places, one of them is left out; then pairs closer than 0.85, or 0.9 in the plane, are
 *  pushed apart, as far as the wall and other particles allow, by at most 0.3 d; and of pairs still
 *  closer than 0.611, or 0.651 in the plane, one is left out. All others stay where they are. The
 *  volume of a particle is that of its Voronoi cell within the elements (pnpbs_voronoi_create). At
 *  the wall, and beside particles that have moved or are left out, it is that of what the particle
 *  sees of the body, up to halfway to others, times one factor, so that all volumes add up to the
 *  body's measure. Any number of ranks and threads gives the same bits. The particles are a copy,
 *  and the placement stays as it is. Collective. Errors: PNPBS_ERROR_STATE without nodes;
 *  PNPBS_ERROR_ARGUMENT for a placement on surfaces alone, or a body without inside;
 *  PNPBS_ERROR_DOMAIN as in pnpbs_domain_check, if a node is not strictly inside of the body, or if
 *  the factor is not between 0.8 and 1.25: then the nodes do not fill the body.
 *  @param[in] placement   whose nodes become particles
 *  @param[in] body        with the placement's dimension, on the same context
 *  @param[out] particles  the handle */
PNPBS_API pnpbs_status pnpbs_particles_create(pnpbs_placement placement, pnpbs_domain body,
                                              pnpbs_particles *particles);

/** Destroys the handle and sets it to NULL; accepts NULL. Local. */
PNPBS_API pnpbs_status pnpbs_particles_destroy(pnpbs_particles *particles);

/** Returns how many particles there are; outputs may be NULL. Local.
 *  @param[out] dim    coordinates of a particle: 2 or 3
 *  @param[out] count  particles of this rank
 *  @param[out] all    particles of all ranks */
PNPBS_API pnpbs_status pnpbs_particles_sizes(pnpbs_particles particles, int32_t *dim,
                                             int64_t *count, int64_t *all);

/** Returns what became of the nodes, over all ranks; outputs may be NULL. Local.
 *  @param[out] left_out  nodes left out because others are too close
 *  @param[out] moved     particles that were pushed away from where their nodes are
 *  @param[out] closest   the least distance of two particles over the mean of their d; infinity if
 *                        no two are closer than that mean */
PNPBS_API pnpbs_status pnpbs_particles_figures(pnpbs_particles particles, int64_t *left_out,
                                               int64_t *moved, double *closest);

/** Copies the particles of this rank, in the order of their ids; arrays may be NULL. Local. Errors:
 *  PNPBS_ERROR_CAPACITY.
 *  @param[in] capacity  particles the arrays have room for
 *  @param[out] x        [particles][dim] coordinates
 *  @param[out] volumes  [particles] areas in the plane; over all ranks they add up to the body's
 *  @param[out] spacing  [particles] d of the bubbles that they were
 *  @param[out] ids      [particles] of the nodes that they were; there may be gaps
 *  @param[out] tags     [particles] of these nodes: the outermost ones have that of the offset, all
 *                       others 0 */
PNPBS_API pnpbs_status pnpbs_particles_get(pnpbs_particles particles, int64_t capacity, double *x,
                                           double *volumes, double *spacing, int64_t *ids,
                                           int32_t *tags);

/** Adds a field of the caller to files of particles written from now on, in the formats that
 *  pnpbs_placement_add_output_field names. A name can be used once. Local. Errors:
 *  PNPBS_ERROR_ARGUMENT.
 *  @param[in] name        as there; none of id, tag, spacing, volume, quality and vtkGhostType
 *  @param[in] n           entries of the array: at least this rank's particles
 *  @param[in] components  numbers at each particle
 *  @param[in] values      [n][components] in the order of pnpbs_particles_get */
PNPBS_API pnpbs_status pnpbs_particles_add_output_field(pnpbs_particles particles, const char *name,
                                                        int64_t n, int32_t components,
                                                        const double *values);

/** Writes the particles of all ranks into files, which appear together when all are complete, or
 *  not at all: id, tag and spacing, in the formats that have fields the field `volume` and those
 *  added, as pnpbs_placement_write writes nodes without elements. Formats of elements alone and
 *  .pvtu are PNPBS_ERROR_ARGUMENT. The files have the same bytes for any number of ranks and
 *  threads. While the placement exists, its monitor is called, and can stop the call, as there.
 *  Collective. Errors: as there.
 *  @param[in] n        files
 *  @param[in] paths    [n]
 *  @param[in] formats  [n] names of formats (pnpbs_format_info); where it or an entry is NULL, the
 *                      extension selects the format */
PNPBS_API pnpbs_status pnpbs_particles_write(pnpbs_particles particles, int32_t n,
                                             const char *const *paths, const char *const *formats);

/* ---------------------------------------------------------------- files ----------------- */

/** Writes the nodes of all ranks into one file. The extension selects the format:
 *    .vtu   VTK's unstructured grid: nodes with id, tag and spacing; triangles with their quality,
 *           2 r_in / R, or tetrahedra with theirs, 3 r_in / R (without elements: one vertex cell
 *           per node). The facets, which are the edges of boundary and inner curves or the
 *           triangles of boundary and inner surfaces, are in a second grid with their tag,
 *           mesh_facets.vtu for mesh.vtu, with the same nodes as points. On surfaces alone the
 *           triangles are the cells of mesh.vtu, and there is no second grid. Streams and devices
 *           have none either
 *    .pvtu  the same as a file that names one piece per rank, which that rank writes beside it:
 *           mesh_0.vtu, mesh_1.vtu, ... for mesh.pvtu. A piece also contains the nodes of other
 *           ranks that its elements need, marked by vtkGhostType.
 *    .vtkhdf the same as .vtu as one HDF5 file, VTK's 1.0, and one of facets; no checkpoint
 *    .xdmf  the same as XDMF 3, which describes arrays in a second file of the same name, .h5; its
 *           grids are called mesh and facets, and points of the plane have two coordinates
 *    .msh   Gmsh's format 4.1: nodes, triangles and the edges of boundary and inner curves, or
 *           tetrahedra and the triangles of boundary and inner surfaces; their tags as physical
 *           groups with their names, or "tag_7" (without elements: one point per node). The
 *           triangles of an inner surface are the faces with tetrahedra on two sides of it,
 *           oriented as the surface. The other formats in space have the same triangles
 *    .msh2  the same in Gmsh's format 2.2
 *    .node  Triangle's or TetGen's nodes, numbered from 1, tags as markers; with elements, these in
 *           a second file of the same name, .ele, and in space the triangles in a third, .face
 *    .ele   Triangle's triangles or TetGen's tetrahedra alone
 *    .face  TetGen's triangles of boundary and inner surfaces alone, in space
 *    .gr3   in the plane and on spheres, SCHISM's hgrid.gr3, the layout of ADCIRC's fort.14: nodes
 *           with x and y, on a sphere longitude and latitude in degrees, and the depth, an output
 *           field "depth" with one component or 0; triangles; and the boundary, counter-clockwise
 *           around the domain and clockwise around islands, in open segments, of tags whose name
 *           begins with "open", and segments of land (0) and islands (1). A loop all open, or all
 *           of land around the domain, is two segments. On a sphere an island is less than half
 *           of it
 *    .2dm   in the plane and on spheres, the 2DM file of Aquaveo's SMS: the same triangles with the
 *           tag of their region or 1 as material, nodes with minus the depth as z, and the boundary
 *           as node strings, each of one tag, which is its number
 *    .csv   id,x,y,tag,spacing, in space id,x,y,z,tag,spacing
 *    .peridigm  in space, the text of Peridigm, x y z block volume, without elements; the block is
 *           the tag of the node's region, or 1. Needs an output field "volume" with one component
 *           (pnpbs_placement_add_output_field)
 *    .lammps  in space, LAMMPS' data file with atom_style peri: id type volume density x y z, with
 *           types as the blocks above and ids from 1. Needs a field "density", too
 *    .hdf5  initial conditions of SWIFT and Gadget by HDF5, of gas at rest: PartType0 has
 *           coordinates, masses, densities and smoothing lengths of 1.2348 times the square or
 *           cube root of the volume. Needs the same fields
 *    .ugrid in the plane and on spheres, a mesh by the conventions of UGRID 1.0 as NetCDF (64-bit
 *           data format): nodes by x and y, on a sphere by longitude and latitude, triangles with
 *           their quality and region, edges that bound the domain with their tags, tags and d of
 *           nodes, and fields
 *    .mpas  on a sphere, a grid of MPAS in NetCDF's 64-bit data format: the Voronoi cells of all
 *           nodes but those of the boundary, their vertices and edges, how these are joined, and
 *           the weights that give velocities along edges (Thuburn and others 2009). Lengths are in
 *           the unit of the radius; cells are in the order of the nodes. Beyond the last cells
 *           there is land, as in grids that have been culled
 *    .graph on a sphere, which of these cells are beside each other, for METIS (graph.info of MPAS)
 *  Nodes are in the order of their ids, elements and boundary in the order of their corners: all
 *  formats but .pvtu have the same bytes for any number of ranks and threads. All ranks write at
 *  the same time (MPI-IO), and none holds more than its share. A file appears under its name only
 *  when it is complete; after an error, an existing file is unchanged. The folder and `path` must
 *  be the same for all ranks. The monitor is called from time to time, and with fraction 1 before
 *  files are renamed; if it stops the call, PNPBS_STOPPED is returned, and nothing changes.
 *  Collective. Errors: PNPBS_ERROR_FILE naming the file, PNPBS_ERROR_UNSUPPORTED for .vtkhdf,
 *  .xdmf and .hdf5 if the library was built without HDF5 or does not find it, PNPBS_ERROR_ARGUMENT,
 *  and, if none of these occurs, PNPBS_ERROR_STATE if there are no nodes yet.
 *  @param[in] path      - is standard output of rank 0 (pnpbs_placement_write_files sets its
 *                       format). What is not a regular file, such as a pipe, is written by rank 0,
 *                       to which the others send their parts in turn; .vtkhdf, .xdmf and .hdf5
 *                       must be regular files.
 *  @param[in] elements  nonzero: triangles or tetrahedra (and the boundary) as well; 2: of second
 *                       order, with the mid nodes of pnpbs_placement_get_edges after the nodes, in
 *                       .msh, .msh2, .vtu and .vtkhdf. Mid nodes have the smallest tag of the
 *                       facets there, or 0; the mean of d and of fields at both ends; and the id
 *                       -1. With cracks (pnpbs_placement_set_cracks) copies of nodes follow the
 *                       nodes, in the order of their numbers, with the id of their originals, and
 *                       there is a facet on each side of a crack
 */
PNPBS_API pnpbs_status pnpbs_placement_write(pnpbs_placement placement, const char *path,
                                             int32_t elements);

/** Writes several files, which appear together when all are complete, or not at all. Otherwise as
 *  pnpbs_placement_write. Collective.
 *  @param[in] paths     [n]
 *  @param[in] formats   [n] names of formats (pnpbs_format_info); where it or an entry is NULL, the
 *                       extension selects the format
 *  @param[in] elements  [n] as there, or NULL for nodes only */
PNPBS_API pnpbs_status pnpbs_placement_write_files(pnpbs_placement placement, int32_t n,
                                                   const char *const *paths,
                                                   const char *const *formats,
                                                   const int32_t *elements);

/** Adds a field of the caller, with `components` numbers at each node, to files written from now
 *  on: beside id, tag and spacing in .vtu, .pvtu, .vtkhdf and .xdmf, in .msh and .msh2 as
 *  $NodeData, and in .csv as a column "name", or "name:0", "name:1" and so on. Other formats omit
 *  it. The values are copied. They belong to the current nodes: once these have moved or changed
 *  their ranks, writing is PNPBS_ERROR_STATE until pnpbs_placement_clear_output_fields. When files
 *  are written, all ranks must have added the same fields in the same order, or it is
 *  PNPBS_ERROR_ARGUMENT. Local. Errors: PNPBS_ERROR_ARGUMENT for a name that is taken, fewer than 1
 *  or more than 9 components, or too few values; PNPBS_ERROR_STATE without nodes.
 *  @param[in] name        1 to 63 letters, digits, '_' and '-'; none of id, tag, spacing, quality
 *                         and vtkGhostType
 *  @param[in] n           entries of the array: at least this rank's nodes; entries after them, for
 *                         its ghosts, are ignored
 *  @param[in] components  numbers at each node; Gmsh's files have 1, 3 or 9, the last ones 0
 *  @param[in] values      [n][components] in the order of pnpbs_placement_get_nodes */
PNPBS_API pnpbs_status pnpbs_placement_add_output_field(pnpbs_placement placement, const char *name,
                                                        int64_t n, int32_t components,
                                                        const double *values);

/** Removes the fields that pnpbs_placement_add_output_field has added. Local. */
PNPBS_API pnpbs_status pnpbs_placement_clear_output_fields(pnpbs_placement placement);

/** Writes a checkpoint: one file from which pnpbs_placement_read_checkpoint continues, in another
 *  process and on any number of ranks, bit for bit as if there had been no interruption. It holds
 *  the nodes with their velocities, the position of the run in its schedule, and data that identify
 *  the domain, options and spacing; the spacing itself only if it is given by values at nodes
 *  (pnpbs_placement_set_spacing_at_nodes). d is evaluated at every node. The file is VTKHDF, which
 *  ParaView opens (name it .vtkhdf): nodes with id, tag and spacing. All ranks write their own
 *  nodes at the same time (MPI-IO), beside an existing file, which is replaced only when the new
 *  one is complete and on the disk. The placement is unchanged. May be called at any time when
 *  there are nodes, after pnpbs_placement_step as after a whole run, and from the monitor of
 *  pnpbs_placement_run and pnpbs_placement_step: at an event, and on one rank also at every call
 *  between two steps. There it must be called on all ranks; it is PNPBS_ERROR_STATE in other calls
 *  of the monitor, before the first nodes are laid, on coarser levels, and in the finish.
 *  Collective. Errors: PNPBS_ERROR_STATE, also where the spacing or the options growth_limit,
 *  resolve or wanted_nodes have been set since the nodes were placed; PNPBS_ERROR_FILE naming the
 *  file; PNPBS_ERROR_UNSUPPORTED if the library was built without HDF5; PNPBS_ERROR_ARGUMENT.
 *  @param[in] path  the same on all ranks, in a folder visible to all of them */
PNPBS_API pnpbs_status pnpbs_placement_write_checkpoint(pnpbs_placement placement,
                                                        const char *path);

/** Restores a placement from a checkpoint. Before the call, the placement must be given the domain,
 *  options and spacing of the first run (except a spacing given by values at nodes and nodes set by
 *  the caller, which the checkpoint contains). Then the next pnpbs_placement_run or _step does what
 *  it would have done where the checkpoint was written, and so do later calls, such as another
 *  spacing with another run. Options may be changed afterwards, or, with the option restart_options
 *  = changed, by this call, which reports them as a warning. A run that ended at its step limit
 *  then continues if it is given more steps, and a completed one starts again from its nodes if
 *  other options are set. Options that affect no node (threads, exchange_interval, rebalance_above,
 *  metis_seed, adjacency_radius, max_nodes, max_memory, restart_options) are free. After an error
 *  the placement is unchanged. Collective. Errors: PNPBS_ERROR_FILE naming the file if it is
 *  damaged, not a checkpoint, or of a newer format; PNPBS_ERROR_DOMAIN, PNPBS_ERROR_SPACING (with
 *  the first point found) or PNPBS_ERROR_ARGUMENT (other options, or the other dimension) if it is
 *  of another run; PNPBS_ERROR_UNSUPPORTED if the library was built without HDF5.
 *  @param[in] path  the same on all ranks */
PNPBS_API pnpbs_status pnpbs_placement_read_checkpoint(pnpbs_placement placement, const char *path);

/** Removes the temporary files of unfinished calls of this process, except one that is just being
 *  renamed. For signal handlers that end the program; async-signal-safe. Local. */
PNPBS_API pnpbs_status pnpbs_discard_unfinished_files(void);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Helpers of the tests of the C interface: calls that must succeed or fail with a given message,
 * domains, and results that are copied out and checked by brute force.
 */
#ifndef PNPBS_TESTS_API_SUPPORT_H
#define PNPBS_TESTS_API_SUPPORT_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check_runner.h"
#include "pnpbs/pnpbs.h"

#define PI 3.14159265358979323846
#define COUNT_OF(array) ((int)(sizeof(array) / sizeof((array)[0])))

/* ---------------------------------------------------------------- calls ----------------- */

/* Returns the last message of the calling thread, for any context. */
#define MESSAGE() pnpbs_last_error(NULL)

#define MUST_BE(expected, call)                                                                    \
  do {                                                                                             \
    const pnpbs_status must_status = (call);                                                       \
    ck_assert_msg(must_status == (expected), "%s: status %d, not %d; %s", #call, (int)must_status, \
                  (int)(expected), must_status < 0 ? MESSAGE() : "no error");                      \
  } while (0)

#define MUST(call) MUST_BE(PNPBS_OK, call)

/* Requires that a run or step succeeds, converged or not. */
#define MUST_COMPUTE(call)                                                       \
  do {                                                                           \
    const pnpbs_status must_status = (call);                                     \
    ck_assert_msg(must_status == PNPBS_OK || must_status == PNPBS_NOT_CONVERGED, \
                  "%s: status %d; %s", #call, (int)must_status,                  \
                  must_status < 0 ? MESSAGE() : "no error");                     \
  } while (0)

/* Requires that a call fails with this status, and that its message contains both texts. */
#define MUST_FAIL(expected, call, first, second)                                                   \
  do {                                                                                             \
    MUST_BE(expected, call);                                                                       \
    ck_assert_msg(strstr(MESSAGE(), first) != NULL, "%s: no \"%s\" in the message \"%s\"", #call,  \
                  first, MESSAGE());                                                               \
    ck_assert_msg(strstr(MESSAGE(), second) != NULL, "%s: no \"%s\" in the message \"%s\"", #call, \
                  second, MESSAGE());                                                              \
  } while (0)

/* ---------------------------------------------------------------- jobs ------------------ */

typedef struct {
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
} job;

job job_begin(void);         /* creates a context and an empty domain */
void job_place(job* it);     /* creates a placement in the current domain */
job square_job(double side); /* creates a placement in the square [0, side]^2 */
void job_end(job* it);

void add_rectangle(pnpbs_domain domain, int32_t role, double x0, double y0, double x1, double y1,
                   int32_t tag);
void add_circle(pnpbs_domain domain, int32_t role, double x, double y, double radius, int32_t tag);

/* A spacing callback with d = a + b hypot(x - x0, y - y0). */
typedef struct {
  double a, b, x0, y0;
} cone;
int32_t cone_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user);

int64_t integer_of(pnpbs_placement placement, const char* key);
double real_of(pnpbs_placement placement, const char* key);
typedef struct {
  char text[32];
} hash_text;
hash_text hash_of(pnpbs_placement placement);

/* ---------------------------------------------------------------- results --------------- */

/* All results of a placement in the plane that can be copied out. */
typedef struct {
  int64_t n;
  double* xy;
  int64_t* ids;
  int32_t* tags;
  double* d;

  int64_t entries; /* number of entries of the stars */
  int64_t* offsets;
  int64_t* neighbours;
  int8_t* is_triangle;

  int64_t triangles;
  int64_t* corners; /* [triangles][3] */

  int64_t edges; /* number of boundary edges */
  int64_t* ends; /* [edges][2] */
  int32_t* edge_tags;
  char* on_boundary; /* [n], whether the node ends a boundary edge */
} result;

result result_of(pnpbs_placement placement);
void result_free(result* it);

/* Returns the index of the node at exactly this position, or -1. */
int64_t node_at(const result* it, double x, double y);
int64_t node_with_id(const result* it, int64_t id);
/* Returns the tag of the boundary edge between nodes a and b, or 0 if there is none. */
int32_t edge_between(const result* it, int64_t a, int64_t b);
/* Returns whether b is in the star of a, and a in that of b. */
int are_star_neighbours(const result* it, int64_t a, int64_t b);

double clearance(const result* it, int64_t node); /* to edges without the node */

/* Returns the quality of a triangle: 2 r_in / R. */
double quality(const double* a, const double* b, const double* c);
typedef struct {
  double mean, least;
  double below_95; /* share of the triangles with a quality below 0.95 */
} quality_summary;
quality_summary quality_of(const result* it);

double triangle_area(const result* it); /* sum over all triangles */

/* Checks the invariants of any set of nodes: positions are finite and distinct, ids increase,
 * boundary edges are edges of the stars, stars go round counter-clockwise and agree with each other
 * and with the triangles, all triangles are Delaunay except at boundary edges, and inner nodes keep
 * 0.35 d off the boundary. `euler` is the number of pieces minus the number of holes, for Euler's
 * formula. */
void check_result(const result* it, int euler);
void check_placement(pnpbs_placement placement, int euler);

#endif

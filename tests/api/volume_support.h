/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Helpers of the tests of placements in space: bodies, and results that are copied out and summed
 * up.
 */
#ifndef PNPBS_TESTS_VOLUME_SUPPORT_H
#define PNPBS_TESTS_VOLUME_SUPPORT_H

#include "api_support.h"
#include "volume_bodies.h"

#define DATA PNPBS_SOURCE_DIR "/examples/data"

job body_job(volume_body body); /* creates a placement in the body */
job box_job(double d);          /* creates a placement in the unit box */

/* Returns a placement in a globe with bumps and dents. These are deeper for a larger `depth` and
 * narrower for larger `waves`. */
job rough_job(double depth, double waves, double d);
/* resolution 0 means no repair */
job repaired_job(double depth, double waves, double d, double resolution);

/* Returns a placement with a d that does not resolve the body. Its boundary is torn for any choice
 * of the elements. */
job unresolved_job(void);
/* Returns a placement on a small sphere without filling, on which triangles do not join. */
job unresolved_surface_job(void);

int warnings_with(pnpbs_placement placement, const char* words);

typedef struct {
  int64_t n, tetrahedra, triangles;
  double *xyz, *d;
  int64_t *ids, *corners, *sides; /* [tetrahedra][4], [triangles][3] */
  int32_t *tags, *side_tags;
} volume;

volume volume_of(pnpbs_placement p);
void volume_free(volume* v);

double distance(const double* a, const double* b);

/* Returns the sum of the volumes of the tetrahedra, each of which must be positive. */
double volume_sum(const volume* v);

/* Returns the area of the boundary triangles with a tag (0: with any tag), and the volume that all
 * of them enclose. */
double boundary_area(const volume* v, int32_t tag, double* enclosed);

/* Returns the distance of the nearest pair over the mean of its d. */
double nearest_pair(const volume* v);

/* Checks the body by the library's own check, and its volume by plain sums. */
void check_body(const job* it, double tolerance);

/* Checks a body whose bubbles still move. Until they have moved, tetrahedra may have no volume. */
void check_stopped_body(const job* it, double tolerance);

#endif

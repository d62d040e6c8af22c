/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What the tests of placements in space share: bodies, and results copied out and summed up.
 */
#ifndef PNPBS_TESTS_VOLUME_SUPPORT_H
#define PNPBS_TESTS_VOLUME_SUPPORT_H

#include "api_support.h"
#include "volume_bodies.h"

#define DATA PNPBS_SOURCE_DIR "/examples/data"

job body_job(volume_body body); /* a placement in the body */
job box_job(double d);          /* in the unit box */

/* In a globe with bumps and dents, the deeper and narrower the larger these two are. */
job rough_job(double depth, double waves, double d);
job repaired_job(double depth, double waves, double d, double resolution); /* 0: not repaired */

/* d does not resolve it: whatever is done with the elements, its boundary is torn. */
job unresolved_job(void);
/* A small sphere, filled with nothing, on which triangles do not join. */
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

/* Of the tetrahedra, each of which must be of positive volume. */
double volume_sum(const volume* v);

/* Of the triangles of the boundary with a tag (0: with any), and what all of them enclose. */
double boundary_area(const volume* v, int32_t tag, double* enclosed);

/* The nearest pair over the mean of its d. */
double nearest_pair(const volume* v);

/* The library's own check, and the volume by plain sums. */
void check_body(const job* it, double tolerance);

/* The same while bubbles still move: until they have, tetrahedra may have no volume. */
void check_stopped_body(const job* it, double tolerance);

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Support code of the tests of placements in space: bodies, and copies of results with their sums.
 */
#ifndef PNPBS_TESTS_VOLUME_SUPPORT_H
#define PNPBS_TESTS_VOLUME_SUPPORT_H

#include "api_support.h"
#include "volume_bodies.h"

#define DATA PNPBS_SOURCE_DIR "/examples/data"

job body_job(volume_body body); /* creates a placement in the body */
job box_job(double d);          /* creates one in the unit box with this d */

/* Creates a job in a globe with bumps and dents, whose depth and number grow with the first two
 * arguments. */
job rough_job(double depth, double waves, double d);
/* resolution 0 means no repair */
job repaired_job(double depth, double waves, double d, double resolution);

/* Creates a job in a body that d does not resolve: no choice of elements closes its boundary. */
job unresolved_job(void);
/* Creates a job on a small sphere without a volume, on which triangles do not join. */
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

/* Returns the total volume of the tetrahedra. Each must have a positive volume. */
double volume_sum(const volume* v);

/* Returns the area of the boundary triangles with a tag (0: any), and the volume that all of them
 * enclose. */
double boundary_area(const volume* v, int32_t tag, double* enclosed);

/* Returns the smallest distance between two nodes relative to the mean of their d. */
double nearest_pair(const volume* v);

/* Runs the library's own check, and compares the volume with a plain sum. */
void check_body(const job* it, double tolerance);

/* Runs the same check during the movement of bubbles, when tetrahedra may have no volume. */
void check_stopped_body(const job* it, double tolerance);

#endif

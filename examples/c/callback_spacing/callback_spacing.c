/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Nodes in a disc, with a small spacing at a point near the rim and a larger one elsewhere. A
 * callback defines the spacing, and a second callback monitors the run.
 *
 * Results to check: the number of nodes should be the integral of 2 / (sqrt(3) d^2) over the disc
 * plus half of the boundary nodes, because a boundary node represents half the area of an inner
 * one. The mean ratio of edge length to d should be close to 1.
 */
#include <math.h>
#include <pnpbs/pnpbs.h>
#include <stdio.h>
#include <stdlib.h>

static void check(pnpbs_status status, pnpbs_context context) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", pnpbs_status_string(status), pnpbs_last_error(context));
    exit(1);
  }
}

/* The parameters of the spacing; the callback receives them through its last argument, `user`. */
struct fine_spot {
  double x, y, finest, growth;
};

static double spacing_at(const struct fine_spot *spot, double x, double y) {
  return spot->finest + spot->growth * hypot(x - spot->x, y - spot->y);
}

/* Evaluates d at n points. A spacing callback must be a pure function of the point. */
static int32_t spacing(int64_t n, int32_t dim, const double *xyz, double *d, void *user) {
  const struct fine_spot *spot = user;
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = spacing_at(spot, xyz[i * dim], xyz[i * dim + 1]);
  return 0; /* any other value fails the call with PNPBS_ERROR_CALLBACK */
}

/* Counts the calls of the monitor. A nonzero return value stops the run early, with valid nodes. */
static int32_t watch(double fraction, int64_t step, int64_t nodes, double max_speed, void *user) {
  int64_t *calls = user;
  (void)fraction, (void)step, (void)nodes, (void)max_speed;
  ++*calls;
  return 0;
}

/* Returns the number of nodes that the spacing implies inside the unit disc. The integral is a sum
 * over rings and sectors. */
static double wanted_inner_nodes(const struct fine_spot *spot) {
  const double pi = 3.14159265358979323846;
  const int rings = 1000, sectors = 1000;
  double sum = 0;
  int i, j;
  for (i = 0; i < rings; ++i) {
    for (j = 0; j < sectors; ++j) {
      const double r = (i + 0.5) / rings, phi = 2 * pi * (j + 0.5) / sectors;
      const double d = spacing_at(spot, r * cos(phi), r * sin(phi));
      sum += r * 2 / (sqrt(3.0) * d * d);
    }
  }
  return sum * (1.0 / rings) * (2 * pi / sectors);
}

int main(void) {
  const double pi = 3.14159265358979323846;
  const double centre[2] = {0, 0};
  struct fine_spot spot = {0.8, 0, 0.01, 0.05};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_status status;
  int64_t nodes, triangles, boundary = 0, calls = 0, i, *corners;
  double *xy, *d, ratio = 0;
  int32_t *tags;

  check(pnpbs_context_create_serial(&context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 1.0, 0, 2 * pi, 1), context);
  check(pnpbs_placement_create(context, domain, &placement), context);
  check(pnpbs_placement_set_spacing_callback(placement, spacing, &spot), context);
  check(pnpbs_placement_set_monitor(placement, watch, &calls), context);
  status = pnpbs_placement_run(placement);
  check(status, context);

  check(pnpbs_placement_count(placement, &nodes), context);
  xy = malloc((size_t)nodes * 2 * sizeof *xy);
  d = malloc((size_t)nodes * sizeof *d);
  tags = malloc((size_t)nodes * sizeof *tags);
  if (xy == NULL || d == NULL || tags == NULL) return 1;
  check(pnpbs_placement_get_nodes(placement, nodes, xy, NULL, tags, d), context);
  for (i = 0; i < nodes; ++i) boundary += tags[i] != 0;

  check(pnpbs_placement_get_triangles(placement, 0, &triangles, NULL), context);
  corners = malloc((size_t)triangles * 3 * sizeof *corners);
  if (corners == NULL) return 1;
  check(pnpbs_placement_get_triangles(placement, triangles, &triangles, corners), context);
  for (i = 0; i < 3 * triangles; ++i) {
    const int64_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
    ratio += hypot(xy[2 * a] - xy[2 * b], xy[2 * a + 1] - xy[2 * b + 1]) / ((d[a] + d[b]) / 2);
  }

  printf("outcome: %s\n", pnpbs_status_string(status));
  printf("nodes: %lld, expected about %.0f\n", (long long)nodes,
         wanted_inner_nodes(&spot) + 0.5 * (double)boundary);
  printf("mean edge over spacing: %.3f, expected about 1\n", ratio / (3.0 * (double)triangles));
  printf("the monitor was called: %s\n", calls > 0 ? "yes" : "no");

  free(corners);
  free(tags);
  free(d);
  free(xy);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  return 0;
}

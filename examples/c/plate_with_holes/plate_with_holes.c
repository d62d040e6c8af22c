/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A plate of 4 by 2 with three round holes, a smaller spacing around the holes, and a fixed node at
 * the point where a load acts. Every boundary has a tag of its own, by which a solver can
 * distinguish them.
 *
 * Results to check: the number of nodes of each tag; the area of the triangles, which should exceed
 * that of the plate, 8 - pi (0.5^2 + 2 x 0.25^2), slightly, because polygons replace the circles;
 * and Euler's formula, nodes - edges + triangles = 1 - holes = -2.
 */
#include <math.h>
#include <pnpbs/pnpbs.h>
#include <stdio.h>
#include <stdlib.h>

#define HOLES 3
enum { TAG_OUTLINE = 1, TAG_CLAMPED = 2, TAG_LOAD = 3, TAG_FIRST_HOLE = 10 };

static void check(pnpbs_status status, pnpbs_context context) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", pnpbs_status_string(status), pnpbs_last_error(context));
    exit(1);
  }
}

static const double centres[HOLES][2] = {{2.0, 1.0}, {0.8, 0.6}, {3.2, 1.4}};
static const double radii[HOLES] = {0.5, 0.25, 0.25};

/* Evaluates the spacing: 0.04 on the holes, growing to 0.1 with the distance from them. */
static int32_t spacing(int64_t n, int32_t dim, const double *xyz, double *d, void *user) {
  int64_t i;
  int k;
  (void)user;
  for (i = 0; i < n; ++i) {
    const double *point = xyz + i * dim;
    d[i] = 0.1;
    for (k = 0; k < HOLES; ++k) {
      const double away = hypot(point[0] - centres[k][0], point[1] - centres[k][1]) - radii[k];
      d[i] = fmin(d[i], 0.04 + 0.15 * fmax(away, 0.0));
    }
  }
  return 0;
}

static int64_t count_tag(const int32_t *tags, int64_t n, int32_t tag) {
  int64_t i, found = 0;
  for (i = 0; i < n; ++i) found += tags[i] == tag;
  return found;
}

int main(void) {
  const double pi = 3.14159265358979323846;
  const double corners[4][2] = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  const int32_t side_tags[4] = {TAG_OUTLINE, TAG_OUTLINE, TAG_OUTLINE, TAG_CLAMPED};
  const double load[1][2] = {{3.7, 0.4}};
  const int32_t load_tag[1] = {TAG_LOAD};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int64_t nodes, triangles, entries, i, *offsets, *neighbours, *tri;
  int32_t *tags, k;
  double *xy, area = 0, exact = 8;

  check(pnpbs_context_create_serial(&context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], side_tags, 0),
        context);
  /* A boundary inside another one is a hole: a point is inside the domain if it lies behind an odd
   * number of boundaries. */
  for (k = 0; k < HOLES; ++k) {
    check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centres[k], radii[k], 0, 2 * pi,
                               TAG_FIRST_HOLE + k),
          context);
    exact -= pi * radii[k] * radii[k];
  }
  check(pnpbs_domain_add_fixed_nodes(domain, 1, &load[0][0], load_tag), context);
  /* This check is optional, because the run repeats it. It reports errors before the long work. */
  check(pnpbs_domain_check(domain), context);

  check(pnpbs_placement_create(context, domain, &placement), context);
  check(pnpbs_placement_set_spacing_callback(placement, spacing, NULL), context);
  check(pnpbs_placement_run(placement), context);

  check(pnpbs_placement_count(placement, &nodes), context);
  xy = malloc((size_t)nodes * 2 * sizeof *xy);
  tags = malloc((size_t)nodes * sizeof *tags);
  if (xy == NULL || tags == NULL) return 1;
  check(pnpbs_placement_get_nodes(placement, nodes, xy, NULL, tags, NULL), context);

  /* The neighbours of each node in the triangulation, in compressed rows: every edge occurs twice.
   */
  check(pnpbs_placement_star_size(placement, &entries), context);
  offsets = malloc((size_t)(nodes + 1) * sizeof *offsets);
  neighbours = malloc((size_t)entries * sizeof *neighbours);
  if (offsets == NULL || neighbours == NULL) return 1;
  check(pnpbs_placement_get_stars(placement, entries, offsets, neighbours, NULL), context);

  check(pnpbs_placement_get_triangles(placement, 0, &triangles, NULL), context);
  tri = malloc((size_t)triangles * 3 * sizeof *tri);
  if (tri == NULL) return 1;
  check(pnpbs_placement_get_triangles(placement, triangles, &triangles, tri), context);
  for (i = 0; i < triangles; ++i) {
    const double *a = xy + 2 * tri[3 * i], *b = xy + 2 * tri[3 * i + 1],
                 *c = xy + 2 * tri[3 * i + 2];
    area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }

  printf("nodes: %lld\n", (long long)nodes);
  printf("on the outline: %lld\n", (long long)count_tag(tags, nodes, TAG_OUTLINE));
  printf("on the clamped side: %lld\n", (long long)count_tag(tags, nodes, TAG_CLAMPED));
  for (k = 0; k < HOLES; ++k) {
    printf("on hole %d: %lld, expected about %.0f\n", (int)k + 1,
           (long long)count_tag(tags, nodes, TAG_FIRST_HOLE + k), 2 * pi * radii[k] / 0.04);
  }
  for (i = 0; i < nodes; ++i) {
    if (tags[i] == TAG_LOAD) printf("the load acts at (%.17g, %.17g)\n", xy[2 * i], xy[2 * i + 1]);
  }
  printf("area: %.4f, expected about %.4f\n", area, exact);
  printf("nodes - edges + triangles: %lld, expected %d\n",
         (long long)(nodes - entries / 2 + triangles), 1 - HOLES);

  free(tri);
  free(neighbours);
  free(offsets);
  free(tags);
  free(xy);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  return 0;
}

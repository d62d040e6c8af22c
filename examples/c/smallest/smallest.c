/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The smallest program: places nodes in the unit square with the constant spacing 0.05.
 *
 * Results to check: the boundary has 4 / 0.05 = 80 nodes. The area of the square is that of
 * 1 / (sqrt(3)/4 0.05^2) = 924 equilateral triangles with edges of 0.05. In a domain without holes,
 * n nodes, b of them on the boundary, form 2 n - b - 2 triangles, so n should be about 503.
 */
#include <pnpbs/pnpbs.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program after an error. Functions of the library return a status; a negative one is an
 * error, and pnpbs_last_error returns its message. */
static void check(pnpbs_status status, pnpbs_context context) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", pnpbs_status_string(status), pnpbs_last_error(context));
    exit(1);
  }
}

int main(void) {
  const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int64_t nodes, triangles, boundary = 0, i;
  int32_t *tags;

  check(pnpbs_context_create_serial(&context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], NULL, 0), context);
  check(pnpbs_placement_create(context, domain, &placement), context);
  check(pnpbs_placement_set_spacing_constant(placement, 0.05), context);
  check(pnpbs_placement_run(placement), context);

  /* Results are copied into arrays of the caller, so their number is queried first. */
  check(pnpbs_placement_count(placement, &nodes), context);
  tags = malloc((size_t)nodes * sizeof *tags);
  if (tags == NULL) return 1;
  check(pnpbs_placement_get_nodes(placement, nodes, NULL, NULL, tags, NULL), context);
  for (i = 0; i < nodes; ++i) boundary += tags[i] != 0;
  check(pnpbs_placement_get_triangles(placement, 0, &triangles, NULL), context);

  printf("nodes: %lld, expected about 503\n", (long long)nodes);
  printf("on the boundary: %lld, expected 80\n", (long long)boundary);
  printf("triangles: %lld, expected %lld\n", (long long)triangles,
         (long long)(2 * nodes - boundary - 2));

  free(tags);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  return 0;
}

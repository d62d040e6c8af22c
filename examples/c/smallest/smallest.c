/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The smallest program: nodes in the unit square with a spacing of 0.05.
 *
 * What to check: The boundary has 4 / 0.05 = 80 nodes. The square holds 1 / (sqrt(3)/4 0.05^2) =
 * 924 triangles with edges of length 0.05. n nodes with b of them on the boundary of a domain
 * without holes make 2 n - b - 2 triangles, so there should be about 503 nodes. */
#include <pnpbs/pnpbs.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program after an error. Every function of the library returns a status; a negative
 * status is an error with a message. */
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

  /* Get the number of nodes, allocate memory, and copy the nodes. */
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

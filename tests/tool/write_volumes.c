/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places nodes in a volume and writes the given files, for test_volume_files.py. The volume is a
 * box of 1 x 0.8 x 0.6 whose sides have the tags 1 to 6 (low x, high x, low y, ...), or a ball of
 * radius 0.5 around (1, 2, 3) with the tag 7. The program runs alone or over ranks.
 *
 *   write_volumes box|ball d elements(0|1|2) file ...
 *
 * With elements = 2 the files also have fields of 1, 2, 3 and 6 components, computed from the
 * positions of the nodes. */
#include <pnpbs/pnpbs.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef PNPBS_TEST_MPI
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#endif

static void must(pnpbs_status status, const char* what) {
  if (status == PNPBS_OK || status == PNPBS_NOT_CONVERGED) return;
  fprintf(stderr, "%s: status %d, %s\n", what, (int)status, pnpbs_last_error(NULL));
#ifdef PNPBS_TEST_MPI
  MPI_Abort(MPI_COMM_WORLD, 1);
#endif
  exit(1);
}

static pnpbs_context begin(int* argc, char*** argv) {
  pnpbs_context context;
#ifdef PNPBS_TEST_MPI
  MPI_Init(argc, argv);
  must(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
#else
  (void)argc, (void)argv;
  must(pnpbs_context_create_serial(&context), "context");
#endif
  return context;
}

/* Adds the box. Corner c lies at the high end of x, y or z if bit 0, 1 or 2 of c is set. */
static void add_tagged_box(pnpbs_domain domain) {
  const int64_t corners[] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                             2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  const int32_t tags[] = {1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6};
  double vertices[24];
  int c;
  for (c = 0; c < 8; ++c) {
    vertices[3 * c] = c & 1 ? 1 : 0;
    vertices[3 * c + 1] = c & 2 ? 0.8 : 0;
    vertices[3 * c + 2] = c & 4 ? 0.6 : 0;
  }
  must(pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, 8, vertices, 12, corners, tags, 40), "box");
}

/* Adds fields. Their components are x, y, z and then the squares of these, as many as the field
 * has. */
static void add_fields(pnpbs_placement placement) {
  static const char* const names[] = {"u-1", "Flow_2", "moved", "stress"};
  static const int32_t components[] = {1, 2, 3, 6};
  int64_t n, i;
  double *x, *values;
  int k;
  must(pnpbs_placement_count(placement, &n), "count");
  x = malloc((size_t)(3 * n + 1) * sizeof *x);
  values = malloc((size_t)(6 * n + 1) * sizeof *values);
  must(pnpbs_placement_get_nodes(placement, n, x, NULL, NULL, NULL), "nodes");
  for (k = 0; k < 4; ++k) {
    const int32_t each = components[k];
    for (i = 0; i < n * each; ++i) {
      const double at = x[3 * (i / each) + i % each % 3];
      values[i] = i % each < 3 ? at : at * at;
    }
    must(pnpbs_placement_add_output_field(placement, names[k], n, each, values), "field");
  }
  free(x), free(values);
}

int main(int argc, char** argv) {
  const double centre[] = {1, 2, 3};
  const pnpbs_context context = begin(&argc, &argv);
  pnpbs_context ending = context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int32_t elements[16];
  int k;
  if (argc < 5 || argc > 20) return 2;
  for (k = 4; k < argc; ++k) elements[k - 4] = atoi(argv[3]) && !strstr(argv[k], ".csv");
  must(pnpbs_domain_create(context, 3, &domain), "domain");
  if (strcmp(argv[1], "box") == 0)
    add_tagged_box(domain);
  else
    must(pnpbs_domain_add_ball(domain, centre, 0.5, 7), "ball");
  must(pnpbs_placement_create(context, domain, &placement), "placement");
  must(pnpbs_placement_set_spacing_constant(placement, atof(argv[2])), "spacing");
  must(pnpbs_placement_run(placement), "run");
  must(pnpbs_placement_check(placement), "check");
  if (atoi(argv[3]) == 2) add_fields(placement);
  must(pnpbs_placement_write_files(placement, argc - 4, (const char* const*)argv + 4, NULL,
                                   elements),
       "files");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&ending);
#ifdef PNPBS_TEST_MPI
  MPI_Finalize();
#endif
  return 0;
}

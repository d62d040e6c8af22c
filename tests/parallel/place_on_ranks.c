/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places nodes over the ranks of MPI_COMM_WORLD and prints the hash: the same for any number of
 * ranks. usage: place_on_ranks CASE SCALE [key=value]...  with CASE one of graded-square,
 * uniform-square, or a .poly file (graded) */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pnpbs_context context;

static void check(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

struct spacing_of {
  double constant, slope, x, y;
};

static int32_t spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct spacing_of* s = user;
  int64_t i;
  for (i = 0; i < n; ++i)
    d[i] = s->constant + s->slope * hypot(x[dim * i] - s->x, x[dim * i + 1] - s->y);
  return 0;
}

int main(int argc, char** argv) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  struct spacing_of s = {0.00068, 9 * 0.00068 / 0.7071, 0.5, 0.5};
  double scale, seconds, imbalance;
  const char* hash;
  pnpbs_domain domain;
  pnpbs_placement placement;
  int64_t nodes, held, steps, inserted, deleted, rebalances;
  int rank, size, a;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  scale = atof(argv[2]);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  check(pnpbs_domain_create(context, 2, &domain), "domain");
  if (strstr(argv[1], "square")) {
    check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0), "square");
    if (strstr(argv[1], "uniform")) {
      s.constant = 0.0034;
      s.slope = 0;
    }
  } else {
    check(pnpbs_domain_read_poly(domain, argv[1]), "poly");
    s.constant = 0.3;
    s.slope = 0.006;
    s.x = s.y = 0;
  }
  s.constant *= scale;
  s.slope *= scale;
  check(pnpbs_placement_create(context, domain, &placement), "placement");
  for (a = 3; a < argc; ++a) {
    char* value = strchr(argv[a], '=');
    *value++ = 0;
    check(pnpbs_placement_set(placement, argv[a], value), argv[a]);
  }
  check(pnpbs_placement_set_spacing_callback(placement, spacing, &s), "spacing");
  check(pnpbs_placement_run(placement), "run");
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes), "nodes");
  check(pnpbs_placement_get_int64(placement, "steps", &steps), "steps");
  check(pnpbs_placement_get_int64(placement, "inserted", &inserted), "inserted");
  check(pnpbs_placement_get_int64(placement, "deleted", &deleted), "deleted");
  check(pnpbs_placement_get_int64(placement, "nodes_held", &held), "nodes_held");
  check(pnpbs_placement_get_int64(placement, "rebalances", &rebalances), "rebalances");
  check(pnpbs_placement_get_double(placement, "imbalance", &imbalance), "imbalance");
  check(pnpbs_placement_get_double(placement, "seconds.total", &seconds), "seconds");
  check(pnpbs_placement_get_string(placement, "hash", &hash), "hash");
  if (rank == 0)
    printf(
        "hash %s nodes %lld held %lld steps %lld inserted %lld deleted %lld rebalances %lld "
        "imbalance %.3f seconds %.3f ranks %d\n",
        hash, (long long)nodes, (long long)held, (long long)steps, (long long)inserted,
        (long long)deleted, (long long)rebalances, imbalance, seconds, size);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}

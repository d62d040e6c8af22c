/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What goes wrong on one rank is every rank's error: nobody hangs, the message names the rank, and
 * the placement goes on once the fault is mended. Run on three ranks or more. */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pnpbs_context context;
static int rank, failures;

static void expect(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "rank %d: %s; last error: %s\n", rank, what, pnpbs_last_error(context));
  ++failures;
}

/* All ranks must have got the same status, and the message must have this part. */
static void expect_error(pnpbs_status status, pnpbs_status wanted, const char* part) {
  int least, most, mine = (int)status;
  MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  expect(least == most, "ranks disagree on the status");
  expect(status == wanted, "another status was expected");
  expect(strstr(pnpbs_last_error(context), part) != NULL, part);
}

struct fault {
  int rank, after_calls, calls;
  double value; /* what the bad rank gives; 0: it returns an error instead */
};

static int32_t spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  struct fault* fault = user;
  int64_t i;
  (void)dim, (void)x;
  for (i = 0; i < n; ++i) d[i] = 0.03;
  if (rank != fault->rank || ++fault->calls <= fault->after_calls) return 0;
  if (fault->value == 0) return 7;
  if (n > 0) d[n / 2] = fault->value;
  return 0;
}

static int32_t stop_on_rank_1(double fraction, int64_t step, int64_t nodes, double speed,
                              void* user) {
  (void)fraction, (void)step, (void)nodes, (void)speed, (void)user;
  return rank == 1;
}

static pnpbs_placement square_placement(double side) {
  const double corners[] = {0, 0, side, 0, side, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  expect(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0) == PNPBS_OK,
         "square");
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  return placement;
}

int main(int argc, char** argv) {
  struct fault none = {-1, 0, 0, 0}, fails = {1, 0, 0, 0}, later = {2, 6, 0, 0},
               bad = {1, 4, 0, -1};
  pnpbs_placement placement;
  int64_t nodes = 0;
  int all;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);

  expect(pnpbs_context_create_mpi(MPI_COMM_NULL, &context) == PNPBS_ERROR_MPI, "MPI_COMM_NULL");
  expect(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context) == PNPBS_OK, "context");
  placement = square_placement(1);

  /* A callback that fails on one rank: at once, and in the middle of the run. */
  pnpbs_placement_set_spacing_callback(placement, spacing, &fails);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_CALLBACK, "rank 1");
  pnpbs_placement_set_spacing_callback(placement, spacing, &later);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_CALLBACK, "rank 2");
  pnpbs_placement_set_spacing_callback(placement, spacing, &bad);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_SPACING, "rank 1");

  /* Mended, it goes on. */
  pnpbs_placement_set_spacing_callback(placement, spacing, &none);
  expect(pnpbs_placement_run(placement) >= 0, "run after the faults");
  expect(pnpbs_placement_get_int64(placement, "nodes", &nodes) == PNPBS_OK && nodes > 1000,
         "nodes after the faults");

  /* A stop asked for on one rank stops all. */
  pnpbs_placement_set_monitor(placement, stop_on_rank_1, NULL);
  expect(pnpbs_placement_run(placement) == PNPBS_STOPPED, "stopped by one rank");
  pnpbs_placement_destroy(&placement);

  /* Other options, other domains. */
  placement = square_placement(1);
  pnpbs_placement_set_spacing_constant(placement, 0.05);
  pnpbs_placement_set_int64(placement, "steps", rank == 0 ? 40 : 60);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_ARGUMENT, "options differ");
  pnpbs_placement_destroy(&placement);
  placement = square_placement(rank == 0 ? 1 : 2);
  pnpbs_placement_set_spacing_constant(placement, 0.05);
  expect_error(pnpbs_placement_run(placement), PNPBS_ERROR_DOMAIN, "domains differ");
  pnpbs_placement_destroy(&placement);

  pnpbs_context_destroy(&context);
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0) printf("%d failed\n", all);
  MPI_Finalize();
  return all != 0;
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What C programs over ranks that see the public interface share: what fails is told with the rank,
 * and the program fails on all ranks. */
#ifndef PNPBS_TESTS_RANK_PROGRAM_H
#define PNPBS_TESTS_RANK_PROGRAM_H

#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <string.h>

static pnpbs_context context;
static int rank, size, failures;

static inline void expect(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "rank %d: %s; last error: %s\n", rank, what, pnpbs_last_error(context));
  ++failures;
}

static inline void begin_ranks(int* argc, char*** argv) {
  MPI_Init(argc, argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  expect(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context) == PNPBS_OK, "context");
}

/* The unit square or cube. */
static inline pnpbs_domain unit_domain(int32_t dim) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  expect(pnpbs_domain_create(context, dim, &domain) == PNPBS_OK, "domain");
  if (dim == 2)
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0);
  else
    pnpbs_domain_add_box(domain, low, high, 1);
  return domain;
}

/* Three times as large at x = 1 as at x = 0, where it is what `finest` points to. */
static inline int32_t growing_spacing(int64_t n, int32_t dim, const double* x, double* d,
                                      void* finest) {
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = *(const double*)finest * (1 + 2 * x[dim * i]);
  return 0;
}

static inline void hash_of_nodes(pnpbs_placement placement, char hash[32]) {
  const char* text = "";
  expect(pnpbs_placement_get_string(placement, "hash", &text) == PNPBS_OK, "hash");
  strncpy(hash, text, 31)[31] = 0;
}

/* The exit status of the program. */
static inline int end_ranks(void) {
  int all;
  pnpbs_context_destroy(&context);
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0) printf("%d failed\n", all);
  MPI_Finalize();
  return all != 0;
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What C programs over ranks that see the public interface share: what fails is told with the rank,
 * and the program fails on all ranks. */
#ifndef PNPBS_TESTS_RANK_PROGRAM_H
#define PNPBS_TESTS_RANK_PROGRAM_H

#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>

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

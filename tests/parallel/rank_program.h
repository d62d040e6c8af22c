/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Common part of the C programs that test the public interface over ranks: runs the checks on
 * groups of ranks and reports failures with the rank. A failure on one rank makes the program fail
 * on all. */
#ifndef PNPBS_TESTS_RANK_PROGRAM_H
#define PNPBS_TESTS_RANK_PROGRAM_H

#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <string.h>

#include "rank_groups.h"

static MPI_Comm group;        /* communicator of the ranks that run the checks together */
static pnpbs_context context; /* on `group` */
static int rank, size;        /* in `group` */
static int failures;          /* of this rank, in all rounds */
static char** arguments; /* of the program, behind those that describe rounds; ends with NULL */

static inline void expect(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "rank %d of %d: %s; last error: %s\n", rank, size, what,
          pnpbs_last_error(context));
  ++failures;
}

/* Sets `group`, its context, rank and size. Collective over the communicator. */
static inline void begin_group(MPI_Comm communicator) {
  group = communicator;
  MPI_Comm_rank(group, &rank);
  MPI_Comm_size(group, &size);
  expect(pnpbs_context_create_mpi(group, &context) == PNPBS_OK, "context");
}

/* Starts MPI and makes all ranks the group. For programs that do not use run_in_groups. */
static inline void begin_ranks(int* argc, char*** argv) {
  MPI_Init(argc, argv);
  begin_group(MPI_COMM_WORLD);
}

/* Returns the unit square or cube. */
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

/* A spacing callback: d is `*finest` at x = 0, and three times as large at x = 1. */
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

/* Ends MPI. Returns the exit status of the program: 0 if no rank of MPI_COMM_WORLD has failures. */
static inline int end_mpi(void) {
  int all, rank_in_world;
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_in_world);
  if (rank_in_world == 0) printf("%d failed\n", all);
  MPI_Finalize();
  return all != 0;
}

/* Destroys the context and ends MPI, for programs that use begin_ranks. Returns the exit status of
 * the program. */
static inline int end_ranks(void) {
  pnpbs_context_destroy(&context);
  return end_mpi();
}

/* Runs the checks on each group of each round that the leading arguments describe (rank_groups.h).
 * Begins and ends MPI. Returns the exit status of the program. */
static inline int run_in_groups(int argc, char** argv, void (*checks)(void)) {
  int rounds, k;
  MPI_Init(&argc, &argv);
  rounds = count_rounds(argv + 1);
  if (rounds < 0) {
    MPI_Finalize();
    return WRONG_ROUNDS;
  }
  arguments = argv + 1 + rounds;
  for (k = 0; k == 0 || k < rounds; ++k) {
    MPI_Comm communicator = split_into_groups(rounds > 0 ? argv[1 + k] : NULL);
    if (communicator != MPI_COMM_NULL) {
      begin_group(communicator);
      checks();
      pnpbs_context_destroy(&context);
      MPI_Comm_free(&group);
    }
    wait_for_all_ranks();
  }
  return end_mpi();
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Splits the ranks of one start of MPI into groups, so that a program runs its checks on several
 * numbers of ranks at the same time. The leading arguments of the program describe rounds, which
 * follow each other: "1+2+5" is a round of three groups that have the first rank, the next two and
 * the next five of MPI_COMM_WORLD. Further ranks wait for the end of the round. Without such an
 * argument there is one round, whose only group has all ranks. */
#ifndef PNPBS_TESTS_RANK_GROUPS_H
#define PNPBS_TESTS_RANK_GROUPS_H

#include <mpi.h>
#include <poll.h>
#include <stdio.h>

/* The exit status of a program whose rounds are malformed or larger than MPI_COMM_WORLD. */
enum { WRONG_ROUNDS = 2 };

static inline int is_digit(char c) { return c >= '0' && c <= '9'; }

/* Returns the number of ranks in all groups of a round, or -1 if the argument is malformed. Sets
 * `index` to the index of the group that has `rank`, or to -1 if none has it. */
static inline int ranks_in_round(const char* round, int rank, int* index) {
  enum { MAX_RANKS = 100000 };
  int begin = 0, end, groups;
  *index = -1;
  for (groups = 0;; ++groups, ++round) {
    int ranks = 0;
    for (; is_digit(*round) && ranks < MAX_RANKS; ++round) ranks = 10 * ranks + (*round - '0');
    end = begin + ranks;
    if (ranks < 1 || end > MAX_RANKS) return -1;
    if (rank >= begin && rank < end) *index = groups;
    begin = end;
    if (*round == 0) return end;
    if (*round != '+') return -1;
  }
}

/* Returns the number of leading arguments that begin with a digit or a plus sign. Each of them must
 * describe a round that fits into MPI_COMM_WORLD: otherwise prints a message and returns -1. */
static inline int count_rounds(char** arguments) {
  int rank, size, index, rounds;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  for (rounds = 0; arguments[rounds]; ++rounds) {
    const char* round = arguments[rounds];
    int ranks;
    if (!is_digit(*round) && *round != '+') break;
    ranks = ranks_in_round(round, rank, &index);
    if (ranks > 0 && ranks <= size) continue;
    if (rank == 0 && ranks < 0)
      fprintf(stderr, "the round '%s' is malformed: write sizes of groups as in 1+2+5\n", round);
    else if (rank == 0)
      fprintf(stderr, "the round '%s' has %d ranks: start the program on as many, not on %d\n",
              round, ranks, size);
    return -1;
  }
  return rounds;
}

/* Returns the communicator of the group that has this rank in a round, which must fit into
 * MPI_COMM_WORLD; MPI_COMM_NULL if no group has it. The round NULL is one group of all ranks.
 * Collective over MPI_COMM_WORLD. */
static inline MPI_Comm split_into_groups(const char* round) {
  MPI_Comm communicator;
  int rank, index = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (round) ranks_in_round(round, rank, &index);
  MPI_Comm_split(MPI_COMM_WORLD, index < 0 ? MPI_UNDEFINED : index, rank, &communicator);
  return communicator;
}

/* Waits for all ranks of MPI_COMM_WORLD. Sleeps meanwhile, because ranks that poll take the cores
 * from those that still compute. */
static inline void wait_for_all_ranks(void) {
  MPI_Request request;
  int done = 0;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done) return;
    poll(NULL, 0, 1); /* 1 ms */
  }
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Counts the MPI calls of this process, by functions that replace those of the MPI library (its
 * profiling interface), also for calls of the library under test. */
#ifndef PNPBS_MPI_COUNTS_H
#define PNPBS_MPI_COUNTS_H

struct mpi_counts {
  double messages, sent; /* to single ranks: messages and their bytes */
  double collectives;    /* calls in which all ranks take part */
  double gathered;       /* bytes that these transferred to this rank */
  double seconds;        /* processor time in the calls: sending, receiving and waiting */
};

extern struct mpi_counts mpi_counts;

#endif

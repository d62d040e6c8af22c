/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What this process asks of MPI, counted: its functions stand before those of the MPI library (the
 * profiling interface), for the library under test, too. */
#ifndef PNPBS_MPI_COUNTS_H
#define PNPBS_MPI_COUNTS_H

struct mpi_counts {
  double messages, sent; /* to single ranks: how many, and their bytes */
  double collectives;    /* calls in which all ranks take part */
  double gathered;       /* bytes that these brought to this rank */
  double seconds;        /* of a core, in the calls: sending, receiving, and waiting for others */
};

extern struct mpi_counts mpi_counts;

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - the functions that take an MPI communicator, inline, so that the library itself has no
 * MPI type in its interface.
 */
#ifndef PNPBS_PNPBS_MPI_H
#define PNPBS_PNPBS_MPI_H

#include <mpi.h>

#include "pnpbs/pnpbs.h"

/** A context on a duplicate of `comm`: messages of yours never mix with ours. Collective.
 *  MPI must be initialised, at any thread level; calls come from the thread that calls us.
 *  Errors as pnpbs_context_create_f. Your MPI must be the one the library was built with
 *  (pnpbs_mpi_library). */
static inline pnpbs_status pnpbs_context_create_mpi(MPI_Comm comm, pnpbs_context *context) {
  return pnpbs_context_create_f((int32_t)MPI_Comm_c2f(comm), context);
}

#endif

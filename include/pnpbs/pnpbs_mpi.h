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
 *  Errors as pnpbs_context_create_checked_f, which compares your MPI with ours. */
static inline pnpbs_status pnpbs_context_create_mpi(MPI_Comm comm, pnpbs_context *context) {
  char library[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(library, &length); /* allowed before MPI_Init and after MPI_Finalize */
  return pnpbs_context_create_checked_f((int32_t)MPI_Comm_c2f(comm), library, context);
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * PNPBS - the functions that take an MPI communicator. They are inline, so that the interface of
 * the library itself has no MPI type.
 */
#ifndef PNPBS_PNPBS_MPI_H
#define PNPBS_PNPBS_MPI_H

#include <mpi.h>

#include "pnpbs/pnpbs.h"

/** Creates a context on a duplicate of `comm`: messages of the caller never mix with those of
 *  PNPBS. Collective. MPI must be initialised, at any thread level; MPI is called only from the
 *  calling thread. Errors as pnpbs_context_create_checked_f, which compares the caller's MPI with
 *  that of PNPBS. */
static inline pnpbs_status pnpbs_context_create_mpi(MPI_Comm comm, pnpbs_context *context) {
  char library[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0, initialized = 0, finalized = 0;
  int32_t handle = 0; /* looked at only while MPI runs; MPI_Comm_c2f would abort otherwise */
  MPI_Get_library_version(library, &length); /* as the next two, allowed at any time */
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  if (initialized && !finalized) handle = (int32_t)MPI_Comm_c2f(comm);
  return pnpbs_context_create_checked_f(handle, library, context);
}

#endif

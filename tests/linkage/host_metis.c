/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host program with a METIS of its own, like one that links a static 64-bit build. Its names are
 * exported, and a call to them instead of PNPBS's METIS ends the program. Compiled with
 * HOST_HAS_METIS=0, it has none. Prints the hash of the nodes placed over all ranks, or, with the
 * argument `serial`, in a context without MPI. */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "placement_cases.h"

#if HOST_HAS_METIS
/* Defines the partitioning functions of METIS, and some functions that they call. */
#define OWN(name)                                           \
  int name(void);                                           \
  int name(void) {                                          \
    fprintf(stderr, "PNPBS called the host's " #name "\n"); \
    abort();                                                \
  }
OWN(METIS_SetDefaultOptions)
OWN(METIS_PartGraphKway)
OWN(METIS_PartGraphRecursive)
OWN(libmetis__SetupCtrl)
OWN(libmetis__MlevelRecursiveBisection)
OWN(gk_malloc_init)
OWN(gk_free)
#endif

int main(int argc, char** argv) {
  const int serial = argc > 1 && strcmp(argv[1], "serial") == 0;
  struct case_spacing spacing;
  pnpbs_context context = NULL;
  pnpbs_placement placement;
  const char* hash;
  int64_t nodes;
  int rank;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (serial) {
    case_check(context, pnpbs_context_create_serial(&context), "context");
  } else {
    case_check(context, pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  }
  placement = case_placement(context, "graded-square", 8.0, 0, NULL, &spacing);
  case_check(context, pnpbs_placement_run(placement), "run");
  case_check(context, pnpbs_placement_get_int64(placement, "nodes", &nodes), "nodes");
  case_check(context, pnpbs_placement_get_string(placement, "hash", &hash), "hash");
  if (rank == 0) printf("%s, %lld nodes\n", hash, (long long)nodes);
  case_check(context, pnpbs_placement_destroy(&placement), "placement_destroy");
  case_check(context, pnpbs_context_destroy(&context), "context_destroy");
  MPI_Finalize();
  return 0;
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that writing files takes little memory beyond that of the run: compares the peak of each
 * rank while it writes each format with its peak before. */
#define _POSIX_C_SOURCE 200809L /* for mkdtemp */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "rank_program.h"

/* Returns the limit of the peak in KiB: a share above the peak of the run, and a constant for
 * windows and MPI-IO. */
static double most_after(long before) { return 1.15 * (double)before + 12 * 1024; }
/* Memory that HDF5 uses itself on the rank that calls it. [KiB] */
static const double hdf5_itself = 10 * 1024;

/* Returns the peak resident size of this process in KiB, or 0 if the system does not report it. The
 * peak never decreases, so a format raises it only if it takes more memory than the run and all
 * formats before. */
static long peak(void) {
  FILE* status = fopen("/proc/self/status", "r");
  char line[200];
  long kib = 0;
  while (status && fgets(line, sizeof line, status)) sscanf(line, "VmHWM: %ld kB", &kib);
  if (status) fclose(status);
  return kib;
}

/* Returns whether all ranks report their peaks. Collective. */
static int all_have_peaks(void) {
  int ok = peak() > 0;
  MPI_Allreduce(MPI_IN_PLACE, &ok, 1, MPI_INT, MPI_MIN, group);
  return ok;
}

/* Ends the program with the exit status that ctest reports as skipped. */
static int skip(void) {
  if (rank == 0) printf("Skipped: /proc/self/status has no VmHWM.\n");
  end_ranks();
  return 77;
}

static pnpbs_placement square_placement(double d) {
  const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_constant(placement, d);
  pnpbs_placement_set_int64(placement, "steps", 8);
  pnpbs_placement_set_int64(placement, "sweeps", 0);
  pnpbs_domain_destroy(&domain);
  return placement;
}

static int is_by_hdf5(const char* path) { return strstr(path, ".vtkhdf") || strstr(path, ".xdmf"); }

static void write_one(pnpbs_placement placement, long before, const char* path, int32_t elements) {
  char what[200];
  long after;
  expect(pnpbs_placement_write(placement, path, elements) == PNPBS_OK, path);
  after = peak();
  snprintf(what, sizeof what, "%s: the peak is %ld KiB, before %ld", path, after, before);
  if (rank == 0) printf("%s\n", what);
  expect((double)after < most_after(before) + (rank == 0 && is_by_hdf5(path) ? hdf5_itself : 0),
         what);
}

int main(int argc, char** argv) {
  char folder[] = "/tmp/pnpbs-memory-XXXXXX", command[100];
  const char* paths[] = {"a.vtu",  "a.pvtu", "a.msh",    "a.msh2",
                         "a.node", "a.csv",  "a.vtkhdf", "a.xdmf"};
  const size_t by_hdf5 = strstr(pnpbs_build_info(), "HDF5: none") ? 2 : 0;
  pnpbs_placement placement;
  int64_t nodes = 0;
  size_t k;
  long before;
  begin_ranks(&argc, &argv);
  if (!all_have_peaks()) return skip();
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, MPI_COMM_WORLD);
  expect(chdir(folder) == 0, "folder");
  placement = square_placement(argc > 1 ? atof(argv[1]) : 0.0024);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_placement_get_int64(placement, "nodes", &nodes);
  before = peak();
  if (rank == 0) printf("%" PRId64 " nodes, peak of the run %ld KiB\n", nodes, before);
  for (k = 0; k < sizeof paths / sizeof *paths - by_hdf5; ++k)
    write_one(placement, before, paths[k], strcmp(paths[k], "a.csv") != 0);
  pnpbs_placement_destroy(&placement);
  MPI_Barrier(MPI_COMM_WORLD);
  snprintf(command, sizeof command, "rm -r %s", folder);
  if (rank == 0) expect(system(command) == 0, "remove the files");
  return end_ranks();
}

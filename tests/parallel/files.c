/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests files over ranks through the C interface: ids with large gaps, errors on one rank, and
 * differences between ranks. The program must run on at least three ranks. */
#define _POSIX_C_SOURCE 200809L /* for mkdtemp */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "rank_program.h"

/* Expects this status on all ranks, and that the message contains `part`. */
static void expect_on_all(pnpbs_status status, pnpbs_status wanted, const char* part) {
  int least, most, mine = (int)status;
  MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, group);
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, group);
  expect(least == (int)wanted && most == (int)wanted, "another status was expected");
  expect(strstr(pnpbs_last_error(context), part) != NULL, part);
}

static pnpbs_placement square_placement(void) {
  const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  expect(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0) == PNPBS_OK,
         "square");
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_placement_set_spacing_constant(placement, 0.1) == PNPBS_OK, "spacing");
  pnpbs_domain_destroy(&domain);
  return placement;
}

/* Passes nodes on rank 1 only. Most ids are small, and a few are as large as allowed. */
#define GIVEN 36
static int64_t given_id(int64_t k) { return k % 9 == 8 ? (INT64_C(1) << 62) - k : k; }

static void place_given(pnpbs_placement placement) {
  double xy[2 * GIVEN];
  int64_t ids[GIVEN], k;
  for (k = 0; k < GIVEN; ++k) {
    xy[2 * k] = 0.15 + 0.14 * (double)(k % 6);
    xy[2 * k + 1] = 0.15 + 0.14 * (double)(k / 6);
    ids[k] = given_id(k);
  }
  expect(pnpbs_placement_set_nodes(placement, rank == 1 ? GIVEN : 0, xy, ids) == PNPBS_OK, "given");
  expect(pnpbs_placement_initialise(placement) == PNPBS_OK, "initialise");
}

/* Reads a file with the columns id, x, y, tag and spacing. Checks that ids increase and that it has
 * all given ids. Returns the number of nodes, or -1 for a malformed file. */
static int64_t check_ids(const char* path) {
  FILE* file = fopen(path, "r");
  char line[200];
  int64_t id, before = -1, nodes = 0, found = 0, k;
  if (!file || !fgets(line, sizeof line, file)) return -1;
  while (fgets(line, sizeof line, file)) {
    if (sscanf(line, "%" SCNd64 ",", &id) != 1 || id <= before) return -1;
    for (k = 0; k < GIVEN; ++k) found += id == given_id(k);
    before = id;
    ++nodes;
  }
  fclose(file);
  return found == GIVEN ? nodes : -1;
}

static void test_large_ids(void) {
  pnpbs_placement placement = square_placement();
  int64_t nodes = 0;
  place_given(placement);
  expect(pnpbs_placement_get_int64(placement, "nodes", &nodes) == PNPBS_OK, "nodes");
  expect(pnpbs_placement_write(placement, "ids.csv", 0) == PNPBS_OK, "ids.csv");
  if (rank == 0) expect(check_ids("ids.csv") == nodes, "ids in the file");
  expect(pnpbs_placement_write(placement, "ids.node", 1) == PNPBS_OK, "ids.node");
  pnpbs_placement_destroy(&placement);
  MPI_Barrier(group);
  if (rank == 0)
    expect(unlink("ids.csv") == 0 && unlink("ids.node") == 0 && unlink("ids.ele") == 0, "files");
}

static int32_t stop_on_rank_1(double fraction, int64_t step, int64_t nodes, double speed,
                              void* user) {
  (void)fraction, (void)step, (void)nodes, (void)speed, (void)user;
  return rank == 1;
}

static void test_fields_that_differ(pnpbs_placement placement) {
  int64_t n = 0;
  double* values;
  pnpbs_placement_count(placement, &n);
  values = calloc((size_t)n * 2 + 1, sizeof *values);
  expect(
      pnpbs_placement_add_output_field(placement, rank == 1 ? "v" : "u", n, 1, values) == PNPBS_OK,
      "a field");
  expect_on_all(pnpbs_placement_write(placement, "a.csv", 0), PNPBS_ERROR_ARGUMENT,
                "differ between ranks");
  pnpbs_placement_clear_output_fields(placement);
  expect(pnpbs_placement_add_output_field(placement, "u", n, rank == 1 ? 1 : 2, values) == PNPBS_OK,
         "a field");
  expect_on_all(pnpbs_placement_write(placement, "a.csv", 0), PNPBS_ERROR_ARGUMENT,
                "differ between ranks");
  pnpbs_placement_clear_output_fields(placement);
  free(values);
}

static void test_faults(void) {
  const int with_hdf5 = strstr(pnpbs_build_info(), "HDF5: none") == NULL;
  pnpbs_placement placement = square_placement();
  expect_on_all(pnpbs_placement_write(placement, "a.vtu", 1), PNPBS_ERROR_STATE, "run");
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect_on_all(pnpbs_placement_write(placement, "nowhere/a.vtu", 1), PNPBS_ERROR_FILE,
                "nowhere/a.vtu");
  expect_on_all(pnpbs_placement_write(placement, "nowhere/a.pvtu", 1), PNPBS_ERROR_FILE,
                "nowhere/a_0.vtu");
  if (with_hdf5)
    expect_on_all(pnpbs_placement_write(placement, "nowhere/a.xdmf", 1), PNPBS_ERROR_FILE,
                  "nowhere/a.xdmf");
  expect_on_all(pnpbs_placement_write(placement, "/dev/full", 1), PNPBS_ERROR_ARGUMENT, "format");
  /* These arguments differ between ranks or are wrong on one rank. */
  expect_on_all(pnpbs_placement_write(placement, rank == 2 ? "b.vtu" : "a.vtu", 1),
                PNPBS_ERROR_ARGUMENT, "rank 2");
  expect_on_all(pnpbs_placement_write(placement, "a.vtu", rank == 1), PNPBS_ERROR_ARGUMENT,
                "on all ranks");
  expect_on_all(pnpbs_placement_write(placement, rank == 1 ? "a.xyz" : "a.vtu", 1),
                PNPBS_ERROR_ARGUMENT, "rank 1");
  expect_on_all(pnpbs_placement_write(placement, rank == 1 ? NULL : "a.vtu", 1),
                PNPBS_ERROR_ARGUMENT, "rank 1");
  test_fields_that_differ(placement);
  /* A stop requested on one rank stops all ranks. */
  expect(pnpbs_placement_set_monitor(placement, stop_on_rank_1, NULL) == PNPBS_OK, "monitor");
  expect_on_all(pnpbs_placement_write(placement, "a.vtu", 1), PNPBS_STOPPED, "");
  expect_on_all(pnpbs_placement_write(placement, "a.pvtu", 1), PNPBS_STOPPED, "");
  if (with_hdf5) expect_on_all(pnpbs_placement_write(placement, "a.xdmf", 1), PNPBS_STOPPED, "");
  expect(pnpbs_placement_set_monitor(placement, NULL, NULL) == PNPBS_OK, "monitor");
  pnpbs_placement_destroy(&placement);
}

static void check_all(void) {
  char folder[] = "/tmp/pnpbs-files-XXXXXX";
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, group);
  expect(chdir(folder) == 0, "folder");
  test_large_ids();
  test_faults();
  MPI_Barrier(group);
  /* rmdir fails if any file is left. */
  if (rank == 0) expect(rmdir(folder) == 0, "something was left behind");
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }

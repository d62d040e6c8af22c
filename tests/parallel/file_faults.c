/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Makes every file call fail once, on one rank, while several files of a placement and a
 * partitioned mesh are written. All ranks must get the same status, and afterwards the folder must
 * contain either all new files or all previous ones, and nothing else. With an argument n, only
 * every n-th call for the placement fails. */
#define _POSIX_C_SOURCE 200809L /* for mkdtemp */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fault_calls.h"
#include "rank_program.h"

static const char* const asked[] = {"a.vtu", "b.pvtu", "c.csv", "d.node", "e.vtkhdf", "f.xdmf"};
static const int32_t elements[] = {1, 1, 0, 1, 1, 1};
static int asked_count = 6;
static char files[32][32]; /* all files that these consist of */
static int file_count;
static pnpbs_placement placement;
static pnpbs_mesh mesh;

static pnpbs_status write_placement(void) {
  return pnpbs_placement_write_files(placement, asked_count, asked, NULL, elements);
}
static pnpbs_status write_mesh(void) { return pnpbs_mesh_write(mesh, "m"); }

static void list_files_of_mesh(void) {
  for (file_count = 0; file_count < size; ++file_count)
    snprintf(files[file_count], sizeof *files, "m_%d.msh", file_count + 1);
}

static void list_files_of_placement(void) {
  static const char* const fixed[] = {
      "a.vtu",    "a_facets.vtu",    "b.pvtu", "b_facets.pvtu", "c.csv", "d.node",     "d.ele",
      "e.vtkhdf", "e_facets.vtkhdf", "f.xdmf", "f_facets.xdmf", "f.h5",  "f_facets.h5"};
  const int with_hdf5 = strstr(pnpbs_build_info(), "HDF5: none") == NULL;
  if (!with_hdf5) asked_count = 4;
  for (file_count = 0; file_count < (with_hdf5 ? 13 : 7); ++file_count)
    strcpy(files[file_count], fixed[file_count]);
  for (int r = 0; r < size; ++r) {
    snprintf(files[file_count++], sizeof *files, "b_%d.vtu", r);
    snprintf(files[file_count++], sizeof *files, "b_facets_%d.vtu", r);
  }
}

/* --- content of the folder, checked by rank 0 ------------------------------------------------ */

static void lay_old_files(int there) {
  for (int k = 0; k < file_count; ++k) {
    FILE* file;
    unlink(files[k]);
    if (!there || !(file = fopen(files[k], "w"))) continue;
    fputs("old", file);
    fclose(file);
  }
}

static int is_old(const char* path, int was_there) {
  char text[4] = "";
  FILE* file = fopen(path, "r");
  if (!file) return !was_there;
  if (fread(text, 1, 3, file) != 3) text[0] = '?';
  fclose(file);
  return was_there && strcmp(text, "old") == 0;
}

static int left_aside(void) {
  DIR* folder = opendir(".");
  struct dirent* entry;
  int count = 0;
  while ((entry = readdir(folder))) {
    if (strncmp(entry->d_name, ".pnpbs-", 7) != 0) continue;
    ++count;
    unlink(entry->d_name);
  }
  closedir(folder);
  return count;
}

static void check_folder(const char* what, int written, int old_there, int unlink_failed) {
  int left;
  for (int k = 0; k < file_count; ++k) {
    char text[512];
    snprintf(text, sizeof text, "%s: %.31s is not %s", what, files[k], written ? "new" : "old");
    expect(written ? !is_old(files[k], old_there) && access(files[k], F_OK) == 0
                   : is_old(files[k], old_there),
           text);
  }
  left = left_aside();
  expect(left <= unlink_failed, what); /* temporary files left behind */
}

/* --- faults --------------------------------------------------------------------------------- */

static void make_placement_and_mesh(void) {
  const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  expect(pnpbs_domain_create(context, 2, &domain) == PNPBS_OK, "domain");
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_constant(placement, 0.1);
  pnpbs_domain_destroy(&domain);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  expect(pnpbs_mesh_create(placement, 1, &mesh) == PNPBS_OK, "mesh");
}

/* Makes the n-th call on one rank fail. Returns whether there was such a call, and counts the calls
 * whose failure was an error. */
static int one_fault(pnpbs_status (*write)(void), int bad, long n, int old_there, long* errors) {
  char call[20] = "", what[100];
  pnpbs_status status;
  int mine, least, most;
  if (rank == 0) lay_old_files(old_there);
  MPI_Barrier(MPI_COMM_WORLD);
  fault_arm(rank == bad ? n : -1);
  status = write();
  if (fault_happened()) snprintf(call, sizeof call, "%s", fault_happened());
  fault_arm(-1);
  MPI_Bcast(call, sizeof call, MPI_CHAR, bad, MPI_COMM_WORLD);
  snprintf(what, sizeof what, "call %ld on rank %d, %s", n, bad, call);
  mine = (int)status;
  MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  expect(least == most, "ranks disagree on the status");
  expect(status == PNPBS_OK || (call[0] && status == PNPBS_ERROR_FILE), what);
  if (rank == 0) check_folder(what, status == PNPBS_OK, old_there, strcmp(call, "unlink") == 0);
  *errors += status != PNPBS_OK;
  return call[0] != 0;
}

/* Makes each `stride`-th call fail. Expects more than `few` errors, extrapolated to all calls. */
static void faults_on(pnpbs_status (*write)(void), int bad, int old_there, long stride, long few) {
  long n = (bad + old_there) % stride, errors = 0;
  while (one_fault(write, bad, n, old_there, &errors)) n += stride;
  if (rank == 0)
    printf("rank %d, %s: %ld calls, %ld errors\n", bad, old_there ? "files there" : "none there", n,
           errors);
  expect(errors * stride > few, "faults that are errors");
}

static void all_faults(pnpbs_status (*write)(void), long stride, long few) {
  for (int bad = 0; bad < size; ++bad)
    for (int old_there = 0; old_there < 2; ++old_there)
      faults_on(write, bad, old_there, stride, few);
  if (rank == 0) lay_old_files(0);
}

int main(int argc, char** argv) {
  char folder[] = "/tmp/pnpbs-faults-XXXXXX";
  const long stride = argc > 1 ? atol(argv[1]) : 1;
  begin_ranks(&argc, &argv);
  if (rank == 0 && !mkdtemp(folder)) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, MPI_COMM_WORLD);
  expect(chdir(folder) == 0, "folder");
  make_placement_and_mesh();
  list_files_of_placement();
  all_faults(write_placement, stride, 5); /* open, write, close, rename of a piece */
  list_files_of_mesh();
  all_faults(write_mesh, 1, 4); /* the same for one file */
  pnpbs_mesh_destroy(&mesh);
  pnpbs_placement_destroy(&placement);
  if (rank == 0) expect(rmdir(folder) == 0, "something was left behind");
  return end_ranks();
}

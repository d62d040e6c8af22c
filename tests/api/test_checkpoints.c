/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests checkpoints on one rank: which files and states are rejected, and that the placement then
 * stays as it was. tests/parallel checks that a continued run has the same bits, tests/tool checks
 * damaged files.
 */
#define _POSIX_C_SOURCE 200809L /* for mkdtemp */
#include <sys/stat.h>
#include <unistd.h>

#include "api_support.h"
#include "volume_support.h"

static char folder[400], path[440];

static void make_folder(void) {
  strcpy(folder, PNPBS_TEST_WORK_DIR "/checkpointsXXXXXX");
  ck_assert_ptr_nonnull(mkdtemp(folder));
  sprintf(path, "%s/a.vtkhdf", folder);
}

static void remove_folder(void) {
  unlink(path);
  ck_assert_msg(rmdir(folder) == 0, "something is left in %s", folder);
}

static int with_hdf5(void) { return strstr(pnpbs_build_info(), "HDF5: none") == NULL; }

static void set_file(const char* text) {
  FILE* file = fopen(path, "w");
  fputs(text, file);
  fclose(file);
}

static job square(double d) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  return it;
}

static job placed_square(void) {
  job it = square(0.1);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  return it;
}

START_TEST(without_hdf5_there_is_an_error) {
  job it;
  if (with_hdf5()) return;
  it = placed_square();
  MUST_FAIL(PNPBS_ERROR_UNSUPPORTED, pnpbs_placement_write_checkpoint(it.placement, path),
            "built without HDF5", "PNPBS_WITH_HDF5");
  MUST_FAIL(PNPBS_ERROR_UNSUPPORTED, pnpbs_placement_read_checkpoint(it.placement, path),
            "built without HDF5", "PNPBS_WITH_HDF5");
  job_end(&it);
}
END_TEST

START_TEST(what_cannot_be_written) {
  job it;
  char nowhere[460];
  if (!with_hdf5()) return;
  it = square(0.1);
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write_checkpoint(it.placement, path), "no nodes",
            "run");
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_checkpoint(it.placement, NULL), "path",
            "NULL");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_checkpoint(it.placement, ""), "path",
            "empty");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_checkpoint(it.placement, "-"), "stream",
            "-");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_checkpoint(it.placement, "/dev/null"),
            "device", "null");
  MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_placement_write_checkpoint(it.placement, folder), folder, "");
  sprintf(nowhere, "%s/none/a.vtkhdf", folder);
  MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_placement_write_checkpoint(it.placement, nowhere), nowhere, "");
  set_file("old");
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write_checkpoint(it.placement, path),
            "another spacing", "after a run");
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_set(it.placement, "wanted_nodes", "70"));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write_checkpoint(it.placement, path), "wanted_nodes",
            "after a run");
  MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_placement_read_checkpoint(it.placement, path), "HDF5", path);
  job_end(&it);
}
END_TEST

/* Reads the checkpoint into a placement that has nodes already. The call must fail, and the nodes
 * must stay as they are. */
static void must_refuse(job it, pnpbs_status status, const char* first, const char* second) {
  const hash_text before = hash_of(it.placement);
  const int64_t steps = integer_of(it.placement, "steps");
  MUST_FAIL(status, pnpbs_placement_read_checkpoint(it.placement, path), first, second);
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  ck_assert_int_eq(integer_of(it.placement, "steps"), steps);
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 1));
  job_end(&it);
}

START_TEST(another_run_is_told) {
  job it;
  if (!with_hdf5()) return;
  it = placed_square();
  MUST(pnpbs_placement_write_checkpoint(it.placement, path));
  job_end(&it);

  it = square_job(1.5);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  must_refuse(it, PNPBS_ERROR_DOMAIN, path, "domain");

  it = square(0.11);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  must_refuse(it, PNPBS_ERROR_SPACING, "it is 0.11, and it was 0.1", path);

  it = square(0.1);
  MUST(pnpbs_placement_set(it.placement, "time_step", "0.7"));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  must_refuse(it, PNPBS_ERROR_ARGUMENT, "time_step = 0.8", "time_step = 0.7");

  it = box_job(0.3);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  must_refuse(it, PNPBS_ERROR_ARGUMENT, "2 dimensions, not in 3", path);
}
END_TEST

START_TEST(free_options_may_differ) {
  job it, other;
  if (!with_hdf5()) return;
  it = placed_square();
  MUST(pnpbs_placement_write_checkpoint(it.placement, path));
  other = square(0.1);
  MUST(pnpbs_placement_set(other.placement, "exchange_interval", "3"));
  MUST(pnpbs_placement_set(other.placement, "adjacency_radius", "1.9"));
  MUST(pnpbs_placement_set(other.placement, "rest_length", "1.060"));
  MUST(pnpbs_placement_read_checkpoint(other.placement, path));
  ck_assert_str_eq(hash_of(other.placement).text, hash_of(it.placement).text);
  ck_assert_int_eq(integer_of(other.placement, "finished"), 1);
  MUST_COMPUTE(pnpbs_placement_step(other.placement, 1));
  ck_assert_int_eq(integer_of(other.placement, "finished"), 0);
  job_end(&it);
  job_end(&other);
}
END_TEST

/* ---------------------------------------------------------------- where d is held down -- */

static int32_t keep_held_round(double fraction, int64_t step, int64_t nodes, double speed,
                               void* data) {
  pnpbs_placement* placement = data;
  int64_t places;
  (void)fraction, (void)step, (void)nodes, (void)speed;
  MUST(pnpbs_placement_get_int64(*placement, "unresolved_places", &places));
  if (places == 0 || access(path, F_OK) == 0) return 0;
  return pnpbs_placement_write_checkpoint(*placement, path) == PNPBS_ERROR_STATE ? 0 : 1;
}

static job held_job(void) { return WHEN_SANITIZED(unresolved_surface_job(), unresolved_job()); }

/* A run that is stopped in a round in which d is held down continues with the same bits in another
 * placement. */
START_TEST(held_spacing_is_saved) {
  job whole, stopped, other;
  if (!with_hdf5()) return;
  whole = held_job();
  MUST_COMPUTE(pnpbs_placement_run(whole.placement));
  stopped = held_job();
  MUST(pnpbs_placement_set_monitor(stopped.placement, keep_held_round, &stopped.placement));
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(stopped.placement));
  other = held_job();
  MUST(pnpbs_placement_read_checkpoint(other.placement, path));
  ck_assert_int_gt(integer_of(other.placement, "unresolved_places"), 0);
  MUST_COMPUTE(pnpbs_placement_run(other.placement));
  ck_assert_str_eq(hash_of(other.placement).text, hash_of(whole.placement).text);
  ck_assert_int_eq(integer_of(other.placement, "unresolved_places"),
                   integer_of(whole.placement, "unresolved_places"));
  ck_assert_double_gt(real_of(other.placement, "unresolved_spacing"), 0);
  ck_assert_double_eq(real_of(other.placement, "unresolved_spacing"),
                      real_of(whole.placement, "unresolved_spacing"));
  job_end(&whole);
  job_end(&stopped);

  /* A checkpoint at the end of the run contains the held-down values as well, as they are part of
   * the spacing. */
  MUST(pnpbs_placement_write_checkpoint(other.placement, path));
  whole = held_job();
  MUST(pnpbs_placement_read_checkpoint(whole.placement, path));
  ck_assert_str_eq(hash_of(other.placement).text, hash_of(whole.placement).text);
  job_end(&other);
  job_end(&whole);
}
END_TEST

START_TEST(permissions_stay) {
  struct stat status;
  job it;
  if (!with_hdf5()) return;
  it = placed_square();
  set_file("old");
  ck_assert_int_eq(chmod(path, 0640), 0);
  MUST(pnpbs_placement_write_checkpoint(it.placement, path));
  ck_assert_int_eq(stat(path, &status), 0);
  ck_assert_int_eq(status.st_mode & 0777, 0640);
  ck_assert_int_gt(status.st_size, 1000);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_checkpoints) {
  Suite* suite = suite_create("checkpoints");
  TCase* tests = tcase_create("checkpoints");
  tcase_add_checked_fixture(tests, make_folder, remove_folder);
  tcase_add_test(tests, without_hdf5_there_is_an_error);
  tcase_add_test(tests, what_cannot_be_written);
  tcase_add_test(tests, another_run_is_told);
  tcase_add_test(tests, free_options_may_differ);
  tcase_add_test(tests, held_spacing_is_saved);
  tcase_add_test(tests, permissions_stay);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests groups: names of tags, roles by tag, and Gmsh files, which contain both.
 */
#include "api_support.h"

#define DATA PNPBS_SOURCE_DIR "/examples/data"

/* A square of side 2 with a square of side 1 in its middle. Their sides are in two groups. */
static const char* const square =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n1 4 \"rim\"\n1 5 \"hole\"\n2 9 \"sea\"\n$EndPhysicalNames\n"
    "$Nodes\n8\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 .5 .5 0\n6 1.5 .5 0\n7 1.5 1.5 0\n8 .5 1.5 "
    "0\n"
    "$EndNodes\n$Elements\n8\n"
    "1 1 2 4 1 1 2\n2 1 2 4 1 2 3\n3 1 2 4 1 3 4\n4 1 2 4 1 4 1\n"
    "5 1 2 5 2 5 6\n6 1 2 5 2 6 7\n7 1 2 5 2 7 8\n8 1 2 5 2 8 5\n$EndElements\n";

static void write_text(const char* path, const char* text) {
  FILE* file = fopen(path, "wb");
  ck_assert_ptr_nonnull(file);
  ck_assert_int_ge(fputs(text, file), 0);
  ck_assert_int_eq(fclose(file), 0);
}

static void expect_name(pnpbs_domain domain, int32_t index, int32_t dim, int32_t tag,
                        const char* name) {
  int32_t found_dim = -1, found_tag = 0;
  const char* found = NULL;
  MUST(pnpbs_domain_get_tag_name(domain, index, &found_dim, &found_tag, &found));
  ck_assert_int_eq(found_dim, dim);
  ck_assert_int_eq(found_tag, tag);
  ck_assert_str_eq(found, name);
  MUST(pnpbs_domain_get_tag_name(domain, index, NULL, NULL, NULL));
}

START_TEST(names) {
  job it = square_job(1);
  int32_t count = -1;
  MUST(pnpbs_domain_tag_name_count(it.domain, &count));
  ck_assert_int_eq(count, 0);
  MUST(pnpbs_domain_set_tag_name(it.domain, 2, 1, "water"));
  MUST(pnpbs_domain_set_tag_name(it.domain, 1, 7, "shore"));
  MUST(pnpbs_domain_set_tag_name(it.domain, 1, -3, "quay"));
  MUST(pnpbs_domain_set_tag_name(it.domain, 1, 7, "beach"));
  MUST(pnpbs_domain_tag_name_count(it.domain, &count));
  ck_assert_int_eq(count, 3);
  expect_name(it.domain, 0, 1, -3, "quay");
  expect_name(it.domain, 1, 1, 7, "beach");
  expect_name(it.domain, 2, 2, 1, "water");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_get_tag_name(it.domain, 3, NULL, NULL, NULL), "3",
            "3 names");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_get_tag_name(it.domain, -1, NULL, NULL, NULL), "-1",
            "names");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_tag_name(it.domain, 3, 1, "a"), "dim = 3",
            "0 .. 2");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_tag_name(it.domain, 1, 0, "a"), "tag", "0");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_tag_name(it.domain, 1, 1, ""), "name", "empty");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_tag_name(it.domain, 1, 1, NULL), "name", "NULL");
  job_end(&it);
}
END_TEST

START_TEST(files) {
  const char* const path = PNPBS_TEST_WORK_DIR "/groups.msh";
  pnpbs_context context = NULL;
  pnpbs_domain plane = NULL, space = NULL;
  double area = 0;
  int32_t dim = 0;
  write_text(path, square);
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 2, &plane));
  MUST(pnpbs_domain_create(context, 3, &space));
  MUST(pnpbs_domain_read_msh(plane, path, 40));
  MUST(pnpbs_domain_measure(plane, &area));
  ck_assert_double_eq_tol(area, 3, 1e-12);
  expect_name(plane, 0, 1, 4, "rim");
  expect_name(plane, 1, 1, 5, "hole");
  expect_name(plane, 2, 2, 9, "sea");
  MUST_BE(PNPBS_ERROR_FILE, pnpbs_domain_read_msh(space, path, 40));
  MUST_BE(PNPBS_ERROR_FILE, pnpbs_domain_read_msh(plane, "no/such.msh", 40));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_domain_read_msh(plane, path, 181));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_domain_read_msh(plane, NULL, 40));
  MUST(pnpbs_file_dimension(path, &dim));
  ck_assert_int_eq(dim, 2);
  MUST(pnpbs_file_dimension(DATA "/bracket.stl", &dim));
  ck_assert_int_eq(dim, 3);
  MUST(pnpbs_file_dimension(DATA "/lake_victoria.poly", &dim));
  ck_assert_int_eq(dim, 2);
  MUST_BE(PNPBS_ERROR_FILE, pnpbs_file_dimension("no/such.msh", &dim));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_file_dimension(NULL, &dim));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_file_dimension(path, NULL));
  MUST(pnpbs_domain_destroy(&space));
  MUST(pnpbs_domain_destroy(&plane));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

START_TEST(roles) {
  const double low[] = {0, 0, 0}, high[] = {2, 2, 2}, middle[] = {1, 1, 1};
  pnpbs_context context = NULL;
  pnpbs_domain body = NULL;
  double volume = 0;
  job plane = square_job(1);
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 3, &body));
  MUST(pnpbs_domain_add_box(body, low, high, 1));
  MUST(pnpbs_domain_set_role(body, 2, PNPBS_INNER));
  MUST_BE(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(body));
  MUST(pnpbs_domain_add_ball(body, middle, 0.5, 2));
  MUST(pnpbs_domain_measure(body, &volume));
  ck_assert_double_eq_tol(volume, 8, 1e-12);
  MUST(pnpbs_domain_set_role(body, 2, PNPBS_BOUNDARY));
  MUST(pnpbs_domain_measure(body, &volume));
  ck_assert_double_eq_tol(volume, 8 - PI / 6, 1e-3);
  MUST(pnpbs_domain_set_role(body, 1, PNPBS_INNER));
  MUST(pnpbs_domain_set_role(body, 2, PNPBS_INNER));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(body), "no boundary", "inner");
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_role(body, 0, PNPBS_INNER));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_role(body, 1, 2));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_set_role(plane.domain, 1, PNPBS_INNER), "two",
            "space");
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_context_destroy(&context));
  job_end(&plane);
}
END_TEST

TEST_SUITE(test_groups) {
  Suite* suite = suite_create("groups");
  TCase* tests = tcase_create("groups");
  tcase_add_test(tests, names);
  tcase_add_test(tests, files);
  tcase_add_test(tests, roles);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}

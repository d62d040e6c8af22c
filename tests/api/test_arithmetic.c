/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests hosts with floating-point settings of their own: rounding modes, traps and flushing of
 * subnormals. They get the same nodes, their settings are restored, and their callbacks run with
 * the default settings.
 */
#define _GNU_SOURCE
#include <fenv.h>

#include "api_support.h"

#if defined(__GLIBC__) && defined(FE_INVALID)
#define TRAPS (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
static void set_traps(void) { feenableexcept(TRAPS); }
static int traps(void) { return fegetexcept(); }
#else
#define TRAPS 0
static void set_traps(void) {}
static int traps(void) { return 0; }
#endif

static int rounding_inside, traps_inside;

static int32_t noting_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  int64_t i;
  (void)dim, (void)xyz, (void)user;
  rounding_inside = fegetround();
  traps_inside = traps();
  for (i = 0; i < n; ++i) d[i] = 0.1;
  return 0;
}

static hash_text placed(void) {
  job it = square_job(1);
  hash_text hash;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, noting_spacing, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  hash = hash_of(it.placement);
  job_end(&it);
  return hash;
}

START_TEST(rounding_of_the_host) {
  const hash_text plain = placed();
  hash_text rounded;
  int after;
  fesetround(FE_UPWARD);
  rounded = placed();
  after = fegetround();
  fesetround(FE_TONEAREST);
  ck_assert_str_eq(plain.text, rounded.text);
  ck_assert_int_eq(after, FE_UPWARD);
  ck_assert_int_eq(rounding_inside, FE_UPWARD);
}
END_TEST

START_TEST(traps_of_the_host) {
  const hash_text plain = placed();
  hash_text trapped;
  fenv_t before;
  int after, flags;
  fegetenv(&before);
  feclearexcept(FE_ALL_EXCEPT);
  set_traps();
  trapped = placed();
  after = traps();
  flags = fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  fesetenv(&before);
  ck_assert_str_eq(plain.text, trapped.text);
  ck_assert_int_eq(after, TRAPS);
  ck_assert_int_eq(traps_inside, TRAPS);
  ck_assert_int_eq(flags, 0);
}
END_TEST

TEST_SUITE(test_arithmetic) {
  Suite* suite = suite_create("arithmetic");
  TCase* hosts = tcase_create("hosts");
  tcase_add_test(hosts, rounding_of_the_host);
  tcase_add_test(hosts, traps_of_the_host);
  tcase_set_timeout(hosts, 0);
  suite_add_tcase(suite, hosts);
  return run_suite(suite);
}

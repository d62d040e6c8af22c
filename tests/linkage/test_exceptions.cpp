// SPDX-License-Identifier: BSD-3-Clause
// Tests exceptions that callbacks of a C++ host throw, which has a C++ library of its own. They are
// caught: the call fails with their text, and the placement can be used afterwards.
#include <pnpbs/pnpbs.h>

#include <cstring>
#include <stdexcept>

#include "check_runner.h"

namespace {

enum class Throws { nothing, spacing, foreign, monitor, curve };
Throws throws = Throws::nothing;

int32_t spacing(int64_t n, int32_t, const double*, double* d, void*) {
  if (throws == Throws::spacing) throw std::runtime_error("the table is empty");
  if (throws == Throws::foreign) throw 7;
  for (int64_t i = 0; i < n; ++i) d[i] = 0.1;
  return 0;
}

int32_t monitor(double, int64_t, int64_t, double, void*) {
  if (throws == Throws::monitor) throw std::logic_error("nobody watches");
  return 0;
}

int32_t curve(int64_t n, int32_t dim, const double* t, double* xy, void*) {
  (void)dim;
  if (throws == Throws::curve) throw std::out_of_range("beyond the curve");
  for (int64_t i = 0; i < n; ++i) {
    xy[2 * i] = t[i];
    xy[2 * i + 1] = 0.5;
  }
  return 0;
}

void expect_failure(pnpbs_context context, pnpbs_status status, const char* part) {
  ck_assert_int_lt(status, 0);
  ck_assert_msg(std::strstr(pnpbs_last_error(context), part) != nullptr, "no \"%s\" in \"%s\"",
                part, pnpbs_last_error(context));
}

}  // namespace

// The host throws the first exception in the process.
START_TEST(exceptions_of_callbacks) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
  ck_assert_int_eq(pnpbs_placement_create(context, domain, &placement), PNPBS_OK);
  pnpbs_placement_set_spacing_callback(placement, spacing, nullptr);
  pnpbs_placement_set_monitor(placement, monitor, nullptr);
  throws = Throws::spacing;
  expect_failure(context, pnpbs_placement_run(placement), "the table is empty");
  throws = Throws::foreign;
  expect_failure(context, pnpbs_placement_run(placement), "no std::exception");
  throws = Throws::monitor;
  expect_failure(context, pnpbs_placement_run(placement), "nobody watches");
  throws = Throws::curve;
  expect_failure(context, pnpbs_domain_add_curve(domain, PNPBS_INNER, curve, nullptr, 0.3, 0.6, 1),
                 "beyond the curve");
  throws = Throws::nothing;
  ck_assert_int_eq(pnpbs_domain_add_curve(domain, PNPBS_INNER, curve, nullptr, 0.3, 0.6, 1),
                   PNPBS_OK);
  ck_assert_int_ge(pnpbs_placement_run(placement), 0);
  ck_assert_int_eq(pnpbs_placement_check(placement), PNPBS_OK);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
}
END_TEST

int main() {
  Suite* suite = suite_create("exceptions");
  TCase* cases = tcase_create("callbacks");
  tcase_add_test(cases, exceptions_of_callbacks);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

// SPDX-License-Identifier: BSD-3-Clause
// Tests a host program that runs Kokkos itself, and ends it while the library is in use. The
// library has adopted a shared Kokkos of the host, so computing must then fail with an error. With
// a static Kokkos the library has its own and is not affected.
#include <Kokkos_Core.hpp>
#include <cstdint>

#include "check_runner.h"
#include "small_job.h"

namespace {

constexpr bool kShared = PNPBS_TEST_KOKKOS_IS_SHARED;

// These objects exist from before the host starts Kokkos until after it has ended it.
pnpbs_context context = nullptr;
pnpbs_domain domain = nullptr;
pnpbs_placement placement = nullptr;

std::int64_t host_sum() {
  std::int64_t sum = 0;
  Kokkos::parallel_reduce(
      "host_sum", 1000, KOKKOS_LAMBDA(int i, std::int64_t& part) { part += i; }, sum);
  return sum;
}

START_TEST(beside_a_running_host) {
  const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  ck_assert(Kokkos::is_initialized());
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  if (!kShared) ck_assert_int_eq(pnpbs_context_set(context, "threads", "2"), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
  ck_assert_int_eq(
      pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], nullptr, 0.0),
      PNPBS_OK);
  ck_assert_int_eq(pnpbs_placement_create(context, domain, &placement), PNPBS_OK);
  ck_assert_int_eq(pnpbs_placement_set_spacing_constant(placement, 0.02), PNPBS_OK);
  const pnpbs_status status = pnpbs_placement_run(placement);
  ck_assert_msg(status >= 0, "%s", pnpbs_last_error(context));
  std::int64_t threads = 0;
  ck_assert_int_eq(pnpbs_placement_get_int64(placement, "threads", &threads), PNPBS_OK);
  ck_assert_int_eq(threads, 2);  // with a shared Kokkos, the number that the host has set
  ck_assert_int_eq(host_sum(), 499500);
}
END_TEST

// pnpbs_finalize must not end the Kokkos that the host has started.
START_TEST(finalize_leaves_the_host_alone) {
  if (kShared) {
    ck_assert_int_eq(pnpbs_finalize(), PNPBS_OK);
    ck_assert(Kokkos::is_initialized());
    const small_job_result result = small_job(&linked_library, nullptr);
    ck_assert_msg(result.status >= 0, "%s", result.message);
  }
  ck_assert_int_eq(host_sum(), 499500);
}
END_TEST

START_TEST(the_host_ends_first) {
  Kokkos::finalize();
  const pnpbs_status status = pnpbs_placement_run(placement);
  const small_job_result result = small_job(&linked_library, nullptr);
  if (kShared) {
    ck_assert_int_eq(status, PNPBS_ERROR_KOKKOS);
    ck_assert_str_ne(pnpbs_last_error(context), "");
    ck_assert_int_eq(result.status, PNPBS_ERROR_KOKKOS);
  } else {
    ck_assert_msg(status >= 0, "%s", pnpbs_last_error(context));
    ck_assert_msg(result.status >= 0, "%s", result.message);
  }
  // Destroying objects must not require Kokkos.
  ck_assert_int_eq(pnpbs_placement_destroy(&placement), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_destroy(&domain), PNPBS_OK);
  ck_assert_int_eq(pnpbs_context_destroy(&context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_finalize(), PNPBS_OK);
}
END_TEST

}  // namespace

int main() {
  Kokkos::initialize(
      Kokkos::InitializationSettings().set_num_threads(2).set_disable_warnings(true));
  Suite* suite = suite_create("linkage: a host with Kokkos");
  TCase* cases = tcase_create("host");
  tcase_add_test(cases, beside_a_running_host);
  tcase_add_test(cases, finalize_leaves_the_host_alone);
  tcase_add_test(cases, the_host_ends_first);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests a library that is opened by name and closed again, as interpreters do it, while the threads
 * of OpenMP still exist.
 */
#define SMALL_JOB_BY_NAME
#include <dlfcn.h>
#include <string.h>

#include "check_runner.h"
#include "small_job.h"

static small_job_functions look_up(void* library) {
  small_job_functions f;
  /* Uses memcpy, as C has no cast from the address of an object to that of a function. */
#define SMALL_JOB_LOOK_UP(name)                        \
  {                                                    \
    void* address = dlsym(library, "pnpbs_" #name);    \
    ck_assert_msg(address != NULL, "no pnpbs_" #name); \
    memcpy(&f.name, &address, sizeof address);         \
  }
  SMALL_JOB_FUNCTIONS(SMALL_JOB_LOOK_UP)
#undef SMALL_JOB_LOOK_UP
  return f;
}

START_TEST(open_run_close_again) {
  int i;
  for (i = 0; i < 3; ++i) {
    small_job_functions functions;
    small_job_result result;
    void* library = dlopen(PNPBS_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    ck_assert_msg(library != NULL, "%s", dlerror());
    functions = look_up(library);
    /* The library stays loaded after it is closed, and so does the number of threads of the first
     * round. */
    result = small_job(&functions, i == 0 ? "2" : NULL);
    ck_assert_msg(result.status >= 0, "round %d: %s", i, result.message);
    ck_assert_int_eq(result.threads, 2);
    ck_assert_int_eq(dlclose(library), 0);
  }
}
END_TEST

int main(void) {
  Suite* suite = suite_create("linkage: opened by name");
  TCase* cases = tcase_create("dlopen");
  tcase_add_test(cases, open_run_close_again);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests the tables of options and statistics row by row: the behaviour is as they state.
 */
#include <locale.h>

#include "api_support.h"

typedef struct {
  const char *name, *type, *standard, *range, *help;
  double least, most; /* range of a number */
} option;

static option option_at(int32_t index) {
  option it = {NULL, NULL, NULL, NULL, NULL, 0, 0};
  MUST(pnpbs_option_info(index, &it.name, &it.type, &it.standard, &it.range, &it.help));
  if (strcmp(it.type, "choice") != 0) {
    ck_assert_msg(sscanf(it.range, "%lf .. %lf", &it.least, &it.most) == 2,
                  "option %s has the range \"%s\"", it.name, it.range);
  }
  return it;
}

static int32_t options(void) {
  int32_t count = 0; /* no assertion, since main calls it as well */
  return pnpbs_option_count(&count) == PNPBS_OK ? count : -1;
}

static int32_t statistics(void) {
  int32_t count = 0;
  return pnpbs_statistic_count(&count) == PNPBS_OK ? count : -1;
}

static void check_line(const char* name, const char* text) {
  ck_assert_ptr_nonnull(text);
  ck_assert_msg(text[0] != '\0' && strchr(text, '\n') == NULL, "%s: \"%s\"", name, text);
}

/* ---------------------------------------------------------------- options --------------- */

/* A context that exists before anything runs, so that `threads` can be set. */
static pnpbs_context context;

static void accept(const option* it, const char* value) {
  const pnpbs_status status = pnpbs_context_set(context, it->name, value);
  ck_assert_msg(status == PNPBS_OK, "%s = %s: %s", it->name, value, MESSAGE());
}

static void reject(const option* it, const char* value) {
  const pnpbs_status status = pnpbs_context_set(context, it->name, value);
  ck_assert_msg(status == PNPBS_ERROR_ARGUMENT, "%s = \"%s\": status %d", it->name, value,
                (int)status);
  ck_assert_msg(strstr(MESSAGE(), it->name) != NULL && strstr(MESSAGE(), value) != NULL &&
                    strstr(MESSAGE(), it->range) != NULL,
                "%s = \"%s\": the message is \"%s\"", it->name, value, MESSAGE());
}

static void accept_number(const option* it, double value) {
  char text[40];
  snprintf(text, sizeof text, "%.17g", value);
  if (strcmp(it->type, "integer") == 0) {
    snprintf(text, sizeof text, "%.0f", value);
    MUST(pnpbs_context_set_int64(context, it->name, (int64_t)value));
  }
  accept(it, text);
  MUST(pnpbs_context_set_double(context, it->name, value));
}

static void reject_number(const option* it, double value) {
  char text[40];
  snprintf(text, sizeof text, "%.17g", value);
  if (strcmp(it->type, "integer") == 0) {
    snprintf(text, sizeof text, "%.0f", value);
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_context_set_int64(context, it->name, (int64_t)value),
              it->name, it->range);
  }
  reject(it, text);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_context_set_double(context, it->name, value), it->name,
            it->range);
}

START_TEST(what_the_option_table_says) {
  const option it = option_at(_i);
  int32_t k;
  check_line("name", it.name);
  check_line(it.name, it.help);
  check_line(it.name, it.range);
  ck_assert(strcmp(it.type, "integer") == 0 || strcmp(it.type, "real") == 0 ||
            strcmp(it.type, "choice") == 0);
  for (k = 0; k < _i; ++k) ck_assert_str_ne(option_at(k).name, it.name);
  accept(&it, it.standard);
  MUST(pnpbs_option_info(_i, NULL, NULL, NULL, NULL, NULL));
}
END_TEST

START_TEST(ranges) {
  const option it = option_at(_i);
  reject(&it, "");
  reject(&it, "nonsense");
  reject(&it, "nan");
  if (strcmp(it.type, "choice") == 0) {
    char names[200];
    char* name;
    int count = 0, found = 0;
    snprintf(names, sizeof names, "%s", it.range);
    for (name = strtok(names, " |"); name != NULL; name = strtok(NULL, " |"), ++count) {
      accept(&it, name);
      found += strcmp(name, it.standard) == 0;
    }
    ck_assert_int_ge(count, 2);
    ck_assert_int_eq(found, 1);
    reject(&it, it.range);
    reject(&it, "0");
    return;
  }
  ck_assert(it.least < it.most);
  accept_number(&it, it.least);
  accept_number(&it, it.most);
  if (strcmp(it.type, "integer") == 0) {
    reject_number(&it, it.least - 1);
    reject_number(&it, it.most + 1);
    reject(&it, "1.5");
    reject(&it, "1e1");
    reject(&it, "9223372036854775808");
  } else {
    accept_number(&it, 0.25 * it.least + 0.75 * it.most);
    reject_number(&it, it.least - 1e-9);
    reject_number(&it, it.most * (1 + 1e-9));
    reject(&it, "inf");
    reject(&it, "-inf");
    reject(&it, "1,0");
    reject(&it, "1.0 m");
  }
}
END_TEST

START_TEST(misspelt_options) {
  const option it = option_at(_i);
  char name[80], quoted[80];
  snprintf(name, sizeof name, "%sx", it.name);
  snprintf(quoted, sizeof quoted, "\"%s\"", it.name);
  MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_context_set(context, name, it.standard), name, quoted);
  name[0] = '_';
  name[strlen(it.name)] = '\0';
  if (strlen(it.name) > 3) {
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_context_set_int64(context, name, 1), name, quoted);
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_context_set_double(context, name, 1), name, quoted);
  }
}
END_TEST

/* Options of a placement are set in the same way. */
START_TEST(options_of_a_placement) {
  job it = square_job(1);
  const option row = option_at(_i);
  if (strcmp(row.name, "threads") == 0) {
    MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_set(it.placement, row.name, "1"), "threads", "");
  } else {
    MUST(pnpbs_placement_set(it.placement, row.name, row.standard));
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set(it.placement, row.name, "none of these"),
              row.name, row.range);
  }
  job_end(&it);
}
END_TEST

/* Setting every option to its default changes nothing. */
START_TEST(defaults_change_nothing) {
  job it = square_job(1), plain = square_job(1);
  int32_t i;
  for (i = 0; i < options(); ++i) {
    const option row = option_at(i);
    if (strcmp(row.name, "threads") == 0) continue;
    MUST(pnpbs_placement_set(it.placement, row.name, row.standard));
  }
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_set_spacing_constant(plain.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(plain.placement));
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(plain.placement).text);
  job_end(&it);
  job_end(&plain);
}
END_TEST

/* A placement starts with the options that its context has at that moment. Later changes of the
 * context do not affect it. */
START_TEST(options_are_inherited) {
  job it = job_begin();
  pnpbs_placement later = NULL;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_context_set_double(it.context, "tolerance_mean", 0));
  MUST(pnpbs_context_set_int64(it.context, "steps", 7));
  job_place(&it);
  MUST(pnpbs_context_set_int64(it.context, "steps", 9));
  MUST(pnpbs_placement_create(it.context, it.domain, &later));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_set_spacing_constant(later, 0.2));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(later));
  ck_assert_int_eq(integer_of(it.placement, "steps"), 7);
  ck_assert_int_eq(integer_of(later, "steps"), 9);
  /* Options can be set on a live placement. */
  MUST(pnpbs_placement_set(later, "steps", "2"));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(later));
  ck_assert_int_eq(integer_of(later, "steps"), 11);
  MUST(pnpbs_placement_destroy(&later));
  job_end(&it);
}
END_TEST

/* A rejected value leaves the previous one in effect. */
START_TEST(rejected_values_change_nothing) {
  job it = square_job(1);
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "0"));
  MUST(pnpbs_placement_set(it.placement, "steps", "5"));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set(it.placement, "steps", "-3"));
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_double(it.placement, "steps", 2.5));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "steps"), 5);
  job_end(&it);
}
END_TEST

/* Numbers are read and written with a decimal point, also if the locale has a comma. Without such a
 * locale the test uses the default one. */
START_TEST(numbers_in_another_locale) {
  static const char* const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
  const char* range = NULL;
  char before[40];
  int k;
  snprintf(before, sizeof before, "%s", option_at(4).range);
  for (k = 0; k < COUNT_OF(names); ++k) {
    if (setlocale(LC_ALL, names[k]) != NULL) break;
  }
  MUST(pnpbs_context_set(context, "damping", "0.5"));
  MUST(pnpbs_context_set_double(context, "damping", 0.25));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_context_set(context, "damping", "0,5"), "0,5", "");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_context_set_double(context, "damping", -0.25), "-0.25", "");
  MUST(pnpbs_option_info(4, NULL, NULL, NULL, &range, NULL));
  setlocale(LC_ALL, "C");
  ck_assert_str_eq(range, before);
}
END_TEST

/* ---------------------------------------------------------------- statistics ------------ */

START_TEST(what_the_statistics_table_says) {
  job it = square_job(1);
  const char *name = NULL, *type = NULL, *help = NULL, *text = NULL;
  int64_t integer = -1;
  double real = NAN;
  int32_t k;
  const char* wrong_type = "of type";
  MUST(pnpbs_statistic_info(_i, &name, &type, &help));
  MUST(pnpbs_statistic_info(_i, NULL, NULL, NULL));
  check_line("name", name);
  check_line(name, help);
  for (k = 0; k < _i; ++k) {
    const char* other = NULL;
    MUST(pnpbs_statistic_info(k, &other, NULL, NULL));
    ck_assert_str_ne(other, name);
  }
  MUST(pnpbs_placement_set(it.placement, "steps", "10"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  if (strcmp(type, "integer") == 0) {
    MUST(pnpbs_placement_get_int64(it.placement, name, &integer));
    ck_assert_msg(integer >= 0, "%s is %lld", name, (long long)integer);
  } else {
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_placement_get_int64(it.placement, name, &integer), name, type);
    ck_assert_ptr_nonnull(strstr(MESSAGE(), wrong_type));
    ck_assert_int_eq(integer, -1);
  }
  if (strcmp(type, "real") == 0) {
    MUST(pnpbs_placement_get_double(it.placement, name, &real));
    ck_assert_msg(isfinite(real) && real >= 0, "%s is %g", name, real);
  } else {
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_placement_get_double(it.placement, name, &real), name, type);
    ck_assert(isnan(real));
  }
  if (strcmp(type, "string") == 0) {
    MUST(pnpbs_placement_get_string(it.placement, name, &text));
    ck_assert_ptr_nonnull(text);
    ck_assert_str_ne(text, "");
  } else {
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_placement_get_string(it.placement, name, &text), name, type);
    ck_assert_ptr_null(text);
  }
  job_end(&it);
}
END_TEST

/* Checks the meaning of some statistics. */
START_TEST(statistics_mean_what_they_say) {
  job it = square_job(1);
  const char* text = NULL;
  double parts = 0;
  int32_t k;
  result nodes;
  int64_t i, boundary = 0, steps;
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "0"));
  MUST(pnpbs_placement_set(it.placement, "steps", "45"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  steps = integer_of(it.placement, "steps");
  ck_assert_int_eq(steps, 45);
  MUST(pnpbs_placement_get_string(it.placement, "stop_reason", &text));
  ck_assert_str_eq(text, "step limit");
  nodes = result_of(it.placement);
  for (i = 0; i < nodes.n; ++i) boundary += nodes.on_boundary[i];
  ck_assert_int_eq(integer_of(it.placement, "nodes"), nodes.n);
  ck_assert_int_eq(integer_of(it.placement, "boundary_nodes"), boundary);
  ck_assert_int_eq(boundary, 40);
  ck_assert_int_gt(integer_of(it.placement, "rebuilds"), 0);
  ck_assert_int_eq(integer_of(it.placement, "ranks"), 1);
  ck_assert_int_ge(integer_of(it.placement, "threads"), 1);
  ck_assert_int_gt(integer_of(it.placement, "memory.peak_bytes"), 1 << 20);
  ck_assert(real_of(it.placement, "speed.mean") > 0);
  ck_assert(real_of(it.placement, "speed.largest") >= real_of(it.placement, "speed.mean"));
  for (k = 0; k < statistics(); ++k) {
    const char* name = NULL;
    MUST(pnpbs_statistic_info(k, &name, NULL, NULL));
    if (strncmp(name, "seconds.", 8) == 0 && strcmp(name, "seconds.total") != 0) {
      parts += real_of(it.placement, name);
    }
  }
  ck_assert(parts > 0);
  ck_assert_double_eq_tol(parts, real_of(it.placement, "seconds.total"), 1e-9 * parts);
  ck_assert(real_of(it.placement, "seconds.other") > 0);
  ck_assert(real_of(it.placement, "seconds.motion") < 0.9 * parts); /* no moment counts twice */
  ck_assert_double_eq(real_of(it.placement, "waiting.total"), 0);   /* one rank waits for none */
  ck_assert(real_of(it.placement, "seconds.boundary") > 0);
  result_free(&nodes);
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "1"));
  MUST(pnpbs_placement_set(it.placement, "tolerance_max", "10"));
  MUST(pnpbs_placement_run(it.placement)); /* the bubbles rest at the first event that tests it */
  ck_assert_int_gt(integer_of(it.placement, "steps"), steps);
  MUST(pnpbs_placement_get_string(it.placement, "stop_reason", &text));
  ck_assert_str_eq(text, "rest");
  job_end(&it);
}
END_TEST

/* The numbers of inserted and deleted nodes add up. */
START_TEST(the_population_adds_up) {
  job it = square_job(1);
  int64_t before, inserted, deleted, after;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_initialise(it.placement));
  before = integer_of(it.placement, "nodes");
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  inserted = integer_of(it.placement, "inserted");
  deleted = integer_of(it.placement, "deleted");
  after = integer_of(it.placement, "nodes");
  ck_assert_int_eq(before + inserted - deleted, after);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_tables) {
  Suite* suite = suite_create("tables");
  TCase* first = tcase_create("options of a context");
  TCase* then = tcase_create("options of a placement");
  TCase* last = tcase_create("statistics");
  int failed;
  if (pnpbs_context_create_serial(&context) != PNPBS_OK) return EXIT_FAILURE;
  if (options() < 10 || statistics() < 10) return EXIT_FAILURE;
  tcase_add_loop_test(first, what_the_option_table_says, 0, options());
  tcase_add_loop_test(first, ranges, 0, options());
  tcase_add_loop_test(first, misspelt_options, 0, options());
  tcase_add_test(first, numbers_in_another_locale);
  suite_add_tcase(suite, first);
  tcase_add_loop_test(then, options_of_a_placement, 0, options());
  tcase_add_test(then, defaults_change_nothing);
  tcase_add_test(then, options_are_inherited);
  tcase_add_test(then, rejected_values_change_nothing);
  suite_add_tcase(suite, then);
  tcase_add_loop_test(last, what_the_statistics_table_says, 0, statistics());
  tcase_add_test(last, statistics_mean_what_they_say);
  tcase_add_test(last, the_population_adds_up);
  suite_add_tcase(suite, last);
  failed = run_suite(suite);
  return pnpbs_context_destroy(&context) == PNPBS_OK ? failed : EXIT_FAILURE;
}

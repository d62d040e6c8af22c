/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests files that the library writes: every format, rejected arguments, and that incomplete files
 * never appear. tests/tool reads the contents by independent readers.
 */
#define _POSIX_C_SOURCE 200809L /* for mkdtemp */
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "api_support.h"

static char folder[] = PNPBS_TEST_WORK_DIR "/filesXXXXXX";

static const char* in_folder(const char* name) {
  static char paths[8][400];
  static int next;
  char* path = paths[next++ % 8];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

static void make_folder(void) {
  strcpy(folder + strlen(folder) - 6, "XXXXXX");
  ck_assert_ptr_nonnull(mkdtemp(folder));
}

/* Removes the files in the folder and returns their number. */
static int empty_folder(void) {
  DIR* open = opendir(folder);
  const struct dirent* entry;
  int files = 0;
  while ((entry = readdir(open)) != NULL) {
    if (entry->d_name[0] == '.' && strspn(entry->d_name, ".") == strlen(entry->d_name)) continue;
    ck_assert_int_eq(unlink(in_folder(entry->d_name)), 0);
    ++files;
  }
  closedir(open);
  return files;
}

static void remove_folder(void) {
  empty_folder();
  rmdir(folder);
}

static long size_of(const char* name) {
  struct stat status;
  return stat(in_folder(name), &status) == 0 ? (long)status.st_size : -1;
}

static void write_old(const char* name) {
  FILE* file = fopen(in_folder(name), "w");
  fputs("old", file);
  fclose(file);
}

static int is_old(const char* name) { return size_of(name) == 3; }

static job placed_square(void) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  return it;
}

static job placed_cube(void) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  job it;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_box(it.domain, low, high, 1));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.3));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  return it;
}

static int with_hdf5(void) { return strstr(pnpbs_build_info(), "HDF5: none") == NULL; }

static int is_by_hdf5(const char* format) {
  return strcmp(format, "vtkhdf") == 0 || strcmp(format, "xdmf") == 0 ||
         strcmp(format, "hdf5") == 0;
}

static int is_of_particles(const char* format) {
  return strcmp(format, "peridigm") == 0 || strcmp(format, "lammps") == 0 ||
         strcmp(format, "hdf5") == 0;
}

static int is_of_bodies(const char* format) {
  return strcmp(format, "face") == 0 || strcmp(format, "peridigm") == 0 ||
         strcmp(format, "lammps") == 0;
}

static int is_of_triangles(const char* format) {
  return strcmp(format, "gr3") == 0 || strcmp(format, "2dm") == 0 || strcmp(format, "ugrid") == 0;
}

static int is_of_spheres(const char* format) {
  return strcmp(format, "mpas") == 0 || strcmp(format, "graph") == 0;
}

/* Adds a field with the value 1 everywhere. */
static void add_ones(pnpbs_placement placement, const char* name, int32_t components) {
  int64_t n, i;
  double* values;
  MUST(pnpbs_placement_count(placement, &n));
  values = malloc((size_t)(n * components) * sizeof *values);
  for (i = 0; i < n * components; ++i) values[i] = 1;
  MUST(pnpbs_placement_add_output_field(placement, name, n, components, values));
  free(values);
}

/* A build without HDF5 reports the error even before there are nodes. */
START_TEST(without_hdf5_there_is_an_error) {
  const char* names[] = {"a.vtkhdf", "a.xdmf", "a.hdf5"};
  job it = square_job(1);
  int k;
  for (k = 0; k < 3; ++k)
    if (with_hdf5())
      MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write(it.placement, in_folder(names[k]), k < 2),
                "nodes", "run");
    else
      MUST_FAIL(PNPBS_ERROR_UNSUPPORTED,
                pnpbs_placement_write(it.placement, in_folder(names[k]), k < 2),
                "built without HDF5", "PNPBS_WITH_HDF5");
  ck_assert_int_eq(empty_folder(), 0);
  job_end(&it);
}
END_TEST

START_TEST(every_format) {
  job it = placed_square();
  int32_t count = 0, k, elements = 0, binary = 0, of_bodies = 0, of_spheres = 0;
  add_ones(it.placement, "volume", 1);
  add_ones(it.placement, "density", 1);
  MUST(pnpbs_format_count(&count));
  ck_assert_int_ge(count, 6);
  for (k = 0; k < count; ++k) {
    const char *name = NULL, *help = NULL;
    char path[40];
    MUST(pnpbs_format_info(k, &name, &help, &binary, &elements));
    MUST(pnpbs_format_info(k, NULL, NULL, NULL, NULL));
    ck_assert_int_gt((int)strlen(help), 10);
    ck_assert_int_eq(binary, strcmp(name, "vtu") == 0 || strcmp(name, "vtkhdf") == 0 ||
                                 strcmp(name, "hdf5") == 0 || strcmp(name, "ugrid") == 0 ||
                                 strcmp(name, "mpas") == 0);
    if (is_by_hdf5(name) && !with_hdf5()) continue;
    snprintf(path, sizeof path, "a.%s", name);
    if (is_of_bodies(name)) {
      MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder(path), 0),
                "bodies", path);
      ++of_bodies;
      continue;
    }
    if (is_of_spheres(name)) {
      MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder(path), 0),
                "cells of a sphere", path);
      ++of_spheres;
      continue;
    }
    MUST(pnpbs_placement_write(it.placement, in_folder(path), 0));
    if (elements) {
      const long without = size_of(path);
      MUST(pnpbs_placement_write(it.placement, in_folder(path), 1));
      if (strcmp(name, "pvtu") != 0 && strcmp(name, "xdmf") != 0)
        ck_assert_int_ne(size_of(path), without);
    }
    ck_assert_int_gt(size_of(path), 100);
  }
  ck_assert_int_gt(size_of("a_0.vtu"), size_of("a.pvtu"));
  if (with_hdf5()) ck_assert_int_gt(size_of("a.h5"), size_of("a.xdmf"));
  ck_assert_int_eq(of_bodies, 3);
  ck_assert_int_eq(of_spheres, 2);
  /* Beside one file per format there are a_0.vtu; a.h5; a_facets.vtu, .pvtu and _0.vtu; and the
   * facets as .vtkhdf, .xdmf and .h5. */
  ck_assert_int_eq(empty_folder(), count - of_bodies - of_spheres + (with_hdf5() ? 8 : 1));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_format_info(count, NULL, NULL, NULL, NULL), "index",
            "0 ..");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_format_count(NULL), "count", "NULL");
  job_end(&it);
}
END_TEST

/* Formats of particles need a volume, and a density except for Peridigm. */
START_TEST(fields_that_formats_need) {
  job it = placed_cube();
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a.peridigm"), 0),
            "'volume' with one component", "a.peridigm");
  add_ones(it.placement, "volume", 3);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a.peridigm"), 0),
            "'volume' with one component", "a.peridigm");
  MUST(pnpbs_placement_clear_output_fields(it.placement));
  add_ones(it.placement, "volume", 1);
  MUST(pnpbs_placement_write(it.placement, in_folder("a.peridigm"), 0));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a.lammps"), 0),
            "'density' with one component", "a.lammps");
  if (with_hdf5())
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a.hdf5"), 0),
              "'density' with one component", "a.hdf5");
  ck_assert_int_eq(empty_folder(), 1);
  job_end(&it);
}
END_TEST

/* Returns the third number of the node whose line begins like this. */
static double third_number(const char* name, const char* beginning) {
  char line[200];
  double numbers[3] = {0, 0, 0};
  FILE* file = fopen(in_folder(name), "r");
  while (fgets(line, sizeof line, file) != NULL)
    if (strncmp(line, beginning, strlen(beginning)) == 0 &&
        sscanf(line + strlen(beginning), "%lf %lf %lf", numbers, numbers + 1, numbers + 2) == 3)
      break;
  fclose(file);
  return numbers[2];
}

START_TEST(depths_of_nodes) {
  const char *names[] = {"a.gr3", "a.2dm"}, *nodes[] = {"7 ", "ND 7 "};
  const double signs[] = {1, -1};
  job it = placed_square();
  int k;
  for (k = 0; k < 2; ++k) {
    MUST(pnpbs_placement_write(it.placement, in_folder(names[k]), 0));
    ck_assert_double_eq(third_number(names[k], nodes[k]), 0);
    add_ones(it.placement, "depth", 2);
    MUST(pnpbs_placement_write(it.placement, in_folder(names[k]), 0));
    ck_assert_double_eq(third_number(names[k], nodes[k]), 0);
    MUST(pnpbs_placement_clear_output_fields(it.placement));
    add_ones(it.placement, "depth", 1);
    MUST(pnpbs_placement_write(it.placement, in_folder(names[k]), 0));
    ck_assert_double_eq(third_number(names[k], nodes[k]), signs[k]);
    MUST(pnpbs_placement_clear_output_fields(it.placement));
  }
  job_end(&it);
}
END_TEST

/* In formats with a single set of names, some names of fields are reserved. */
START_TEST(fields_with_names_of_others) {
  job it = placed_square();
  const char* names[] = {"mesh", "region", "mesh_node_x", "-x"};
  int k;
  for (k = 0; k < 4; ++k) {
    add_ones(it.placement, names[k], 1);
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a.ugrid"), 0),
              ".ugrid file cannot have an output field", names[k]);
    MUST(pnpbs_placement_clear_output_fields(it.placement));
  }
  add_ones(it.placement, "mesh_x", 3);
  MUST(pnpbs_placement_write(it.placement, in_folder("a.ugrid"), 0));
  ck_assert_int_eq(empty_folder(), 1);
  job_end(&it);
}
END_TEST

START_TEST(triangle_s_elements_are_beside) {
  job it = placed_square();
  MUST(pnpbs_placement_write(it.placement, in_folder("a.node"), 0));
  ck_assert_int_eq(empty_folder(), 1);
  MUST(pnpbs_placement_write(it.placement, in_folder("a.node"), 1));
  ck_assert_int_gt(size_of("a.ele"), 1000);
  job_end(&it);
}
END_TEST

START_TEST(every_format_in_space) {
  job it = placed_cube();
  int32_t count = 0, k, of_triangles = 0, of_spheres = 0;
  MUST(pnpbs_format_count(&count));
  add_ones(it.placement, "volume", 1);
  add_ones(it.placement, "density", 1);
  for (k = 0; k < count; ++k) {
    const char* name = NULL;
    char path[40];
    MUST(pnpbs_format_info(k, &name, NULL, NULL, NULL));
    if (is_by_hdf5(name) && !with_hdf5()) continue;
    snprintf(path, sizeof path, "a.%s", name);
    if (is_of_triangles(name)) {
      MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder(path), 1),
                "not for bodies", path);
      ++of_triangles;
      continue;
    }
    if (is_of_spheres(name)) {
      MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder(path), 1),
                "cells of a sphere", path);
      ++of_spheres;
      continue;
    }
    MUST(pnpbs_placement_write(it.placement, in_folder(path), 0));
    if (strcmp(name, "csv") == 0 || is_of_particles(name))
      MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder(path), 1),
                "cannot contain elements", path);
    else
      MUST(pnpbs_placement_write(it.placement, in_folder(path), 1));
    ck_assert_int_gt(size_of(path), 100);
  }
  ck_assert_int_eq(of_triangles, 3);
  ck_assert_int_eq(of_spheres, 2);
  ck_assert_int_eq(empty_folder(), count - of_triangles - of_spheres + (with_hdf5() ? 8 : 2));
  MUST(pnpbs_placement_write(it.placement, in_folder("b.node"), 1));
  ck_assert_int_gt(size_of("b.face"), 500);
  ck_assert_int_eq(empty_folder(), 3);
  job_end(&it);
}
END_TEST

START_TEST(several_with_formats_of_their_own) {
  const char* paths[] = {in_folder("mesh"), in_folder("nodes.csv")};
  const char* formats[] = {"MSH", NULL};
  const int32_t elements[] = {1, 0};
  job it = placed_square();
  MUST(pnpbs_placement_write_files(it.placement, 2, paths, formats, elements));
  ck_assert_int_gt(size_of("mesh"), size_of("nodes.csv"));
  MUST(pnpbs_placement_write_files(it.placement, 0, NULL, NULL, NULL));
  ck_assert_int_eq(empty_folder(), 2);
  job_end(&it);
}
END_TEST

START_TEST(refused) {
  const char *nothing = NULL, *standard_output = "-", *pieces = "pvtu", *node = "node";
  const int32_t yes = 1;
  job it = placed_square();
  const pnpbs_placement p = it.placement;
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, NULL, 0), "paths[0]", "NULL");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, "", 0), "name", "empty");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, in_folder("a"), 0), "'", "vtu");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, in_folder("a.xyz"), 0), "a.xyz", "vtu");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, in_folder("a.csv"), 1), "a.csv",
            "elements");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(p, "-", 0), "-", "format");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT,
            pnpbs_placement_write_files(p, 1, &standard_output, &pieces, NULL), "pieces", "output");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_files(p, 1, &standard_output, &node, &yes),
            "second file", "ele");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_files(p, 1, &nothing, NULL, NULL),
            "paths[0]", "NULL");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_files(p, 1, NULL, NULL, NULL), "paths",
            "NULL");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write_files(p, -1, &node, NULL, NULL), "n = -1",
            "negative");
  MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_placement_write(p, in_folder("nowhere/a.vtu"), 0),
            "nowhere/a.vtu", "No such");
  MUST_FAIL(PNPBS_ERROR_FILE,
            pnpbs_placement_write_files(p, 1, &(const char*){folder}, &node, NULL), "files",
            "directory");
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_placement_write(NULL, in_folder("a.vtu"), 0));
  ck_assert_int_eq(empty_folder(), 0);
  job_end(&it);
}
END_TEST

/* HDF5 files are written at several positions, so they cannot be streams. */
START_TEST(no_streams_by_hdf5) {
  const char *paths[] = {"-", "/dev/null"}, *formats[] = {"vtkhdf", "xdmf"};
  job it = placed_square();
  int k;
  for (k = 0; k < 2; ++k) {
    MUST_FAIL(PNPBS_ERROR_ARGUMENT,
              pnpbs_placement_write_files(it.placement, 1, &paths[0], &formats[k], NULL),
              formats[k], "standard output");
    MUST_FAIL(PNPBS_ERROR_ARGUMENT,
              pnpbs_placement_write_files(it.placement, 1, &paths[1], &formats[k], NULL),
              "no device", paths[1]);
  }
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_write(it.placement, in_folder("a:b.xdmf"), 0),
            "':'", "a:b.h5");
  ck_assert_int_eq(empty_folder(), 0);
  job_end(&it);
}
END_TEST

START_TEST(without_nodes) {
  job it = square_job(1);
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1), "nodes",
            "run");
  ck_assert_int_eq(empty_folder(), 0);
  job_end(&it);
}
END_TEST

/* The second file fails, so the first one must not appear either. */
START_TEST(together_or_not_at_all) {
  const char* paths[] = {in_folder("a.csv"), in_folder("a.pvtu"), "/dev/full"};
  const char* formats[] = {"csv", "pvtu", "vtu"};
  job it = placed_square();
  write_old("a.csv");
  MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_placement_write_files(it.placement, 3, paths, formats, NULL),
            "/dev/full", "space");
  ck_assert(is_old("a.csv"));
  ck_assert_int_eq(empty_folder(), 1);
  job_end(&it);
}
END_TEST

static int32_t stop(double fraction, int64_t step, int64_t nodes, double max_speed, void* user) {
  (void)step, (void)max_speed;
  *(int64_t*)user = fraction >= 0 && fraction <= 1 ? nodes : -1;
  return 1;
}

START_TEST(stopped_by_the_monitor) {
  int64_t told = 0, nodes;
  job it = placed_square();
  MUST(pnpbs_placement_count(it.placement, &nodes));
  write_old("a.vtu");
  MUST(pnpbs_placement_set_monitor(it.placement, stop, &told));
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1));
  ck_assert_int_eq(told, nodes);
  ck_assert(is_old("a.vtu"));
  ck_assert_int_eq(empty_folder(), 1);
  MUST(pnpbs_placement_set_monitor(it.placement, NULL, NULL));
  MUST(pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1));
  job_end(&it);
}
END_TEST

static int32_t write_inside(double fraction, int64_t step, int64_t nodes, double max_speed,
                            void* user) {
  (void)fraction, (void)step, (void)nodes, (void)max_speed;
  MUST_BE(PNPBS_ERROR_STATE, pnpbs_placement_write(*(pnpbs_placement*)user, "a.vtu", 0));
  return 0;
}

START_TEST(not_from_inside_a_callback) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_set_monitor(it.placement, write_inside, &it.placement));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  job_end(&it);
}
END_TEST

START_TEST(nothing_unfinished_to_discard) {
  job it = placed_square();
  MUST(pnpbs_placement_write(it.placement, in_folder("a.csv"), 0));
  MUST(pnpbs_discard_unfinished_files());
  ck_assert_int_eq(empty_folder(), 1);
  job_end(&it);
}
END_TEST

static void must_refuse_field(pnpbs_placement p, const char* name, int64_t n, int32_t components,
                              const double* values, const char* word) {
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_add_output_field(p, name, n, components, values),
            word, "");
}

START_TEST(fields_that_are_refused) {
  static const char* const ours[] = {"id", "tag", "spacing", "quality", "vtkGhostType", "ID"};
  static const char* const bad[] = {"",
                                    "a b",
                                    "a/b",
                                    "a\"b",
                                    "<a>",
                                    ".",
                                    ("gr\xc3\xb6\xc3\x9f"
                                     "e")};
  char long_name[65];
  job it = placed_square();
  int64_t n = 0;
  double* values;
  int k;
  MUST(pnpbs_placement_count(it.placement, &n));
  values = calloc((size_t)n * 10, sizeof *values);
  for (k = 0; k < COUNT_OF(ours); ++k)
    must_refuse_field(it.placement, ours[k], n, 1, values, "that files always contain");
  for (k = 0; k < COUNT_OF(bad); ++k)
    must_refuse_field(it.placement, bad[k], n, 1, values, "letters, digits");
  memset(long_name, 'a', 64);
  long_name[64] = 0;
  must_refuse_field(it.placement, long_name, n, 1, values, "1 to 63");
  MUST(pnpbs_placement_add_output_field(it.placement, long_name + 1, n, 9, values));
  must_refuse_field(it.placement, long_name + 1, n, 1, values, "there is an output field");
  must_refuse_field(it.placement, "u", n, 0, values, "components = 0");
  must_refuse_field(it.placement, "u", n, 10, values, "1 to 9");
  must_refuse_field(it.placement, "u", n - 1, 1, values, "give values for each of them");
  must_refuse_field(it.placement, "u", n, 1, NULL, "values is NULL");
  must_refuse_field(it.placement, NULL, n, 1, values, "name is NULL");
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_placement_add_output_field(NULL, "u", n, 1, values));
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_placement_clear_output_fields(NULL));
  MUST(pnpbs_placement_add_output_field(it.placement, "u", n, 1, values));
  free(values);
  job_end(&it);
}
END_TEST

START_TEST(fields_belong_to_the_nodes_there_are) {
  job it = square_job(1);
  double values[2000] = {0};
  int64_t n = 0, plain, entries;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_add_output_field(it.placement, "u", 2000, 1, values),
            "no nodes", "");
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_count(it.placement, &n));
  MUST(pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1));
  plain = size_of("a.vtu");
  MUST(pnpbs_placement_add_output_field(it.placement, "u", 1000, 2, values));
  /* Building lists and stars does not invalidate output fields. */
  MUST(pnpbs_placement_adjacency_size(it.placement, &entries));
  MUST(pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1));
  ck_assert_int_gt(size_of("a.vtu"), plain + 16 * n);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.11));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1), "'u'",
            "clear the output fields");
  ck_assert_int_gt(size_of("a.vtu"), plain + 16 * n);
  MUST(pnpbs_placement_clear_output_fields(it.placement));
  MUST(pnpbs_placement_write(it.placement, in_folder("a.vtu"), 1));
  ck_assert_int_lt(size_of("a.vtu"), plain);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_files) {
  Suite* suite = suite_create("files");
  TCase* tests = tcase_create("files");
  tcase_add_checked_fixture(tests, make_folder, remove_folder);
  tcase_add_test(tests, without_hdf5_there_is_an_error);
  tcase_add_test(tests, every_format);
  tcase_add_test(tests, fields_that_formats_need);
  tcase_add_test(tests, depths_of_nodes);
  tcase_add_test(tests, fields_with_names_of_others);
  tcase_add_test(tests, triangle_s_elements_are_beside);
  tcase_add_test(tests, every_format_in_space);
  tcase_add_test(tests, several_with_formats_of_their_own);
  tcase_add_test(tests, refused);
  tcase_add_test(tests, no_streams_by_hdf5);
  tcase_add_test(tests, without_nodes);
  tcase_add_test(tests, together_or_not_at_all);
  tcase_add_test(tests, stopped_by_the_monitor);
  tcase_add_test(tests, not_from_inside_a_callback);
  tcase_add_test(tests, nothing_unfinished_to_discard);
  tcase_add_test(tests, fields_that_are_refused);
  tcase_add_test(tests, fields_belong_to_the_nodes_there_are);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests values on grids in files, which are evaluated in another projection, and errors for files
 * without such values. A value is 3 longitude + 2 latitude, which interpolation in degrees
 * reproduces exactly.
 */
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geo_support.h"

enum { columns = 20, rows = 15 };
static const double west = 18, north = 56, cell = 0.1;
static const double everywhere_low[2] = {18, 54}, everywhere_high[2] = {20, 56};

static double plane_at(double longitude, double latitude) { return 3 * longitude + 2 * latitude; }

/* Writes a grid. The second band has twice the values of the first. From the row `empty` on there
 * are no data. */
static const char* write_grid(const char* name, int bands, int with_system, int empty) {
  static char path[1024];
  static float values[rows][columns];
  double transform[6] = {0, 0, 0, 0, 0, 0};
  GDALDatasetH dataset;
  int band, i, j;
  transform[0] = west, transform[1] = cell, transform[3] = north, transform[5] = -cell;
  snprintf(path, sizeof path, "%s/%s", PNPBS_TEST_WORK_DIR, name);
  GDALAllRegister();
  dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, columns, rows, bands, GDT_Float32, NULL);
  ck_assert_ptr_nonnull(dataset);
  if (with_system) {
    OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
    ck_assert_int_eq(OSRImportFromEPSG(system, 4326), OGRERR_NONE);
    GDALSetSpatialRef(dataset, system);
    OSRRelease(system);
    GDALSetGeoTransform(dataset, transform);
  }
  for (band = 1; band <= bands; ++band) {
    GDALRasterBandH handle = GDALGetRasterBand(dataset, band);
    for (j = 0; j < rows; ++j)
      for (i = 0; i < columns; ++i)
        values[j][i] =
            j >= empty
                ? -9999
                : (float)(band * plane_at(west + cell * (i + 0.5), north - cell * (j + 0.5)));
    GDALSetRasterNoDataValue(handle, -9999);
    ck_assert_int_eq(GDALRasterIO(handle, GF_Write, 0, 0, columns, rows, values[0], columns, rows,
                                  GDT_Float32, 0, 0),
                     CE_None);
  }
  GDALClose(dataset);
  return path;
}

enum { across = 2400, down = 1200, first_empty = 1000, last_empty = 1100 };
static const double degree = 360.0 / across;

static int number_at(int column, int row) { return (7 * column + 13 * row) % 30011; }

/* Writes a grid of the Earth in tiles, without data in some columns. A stored number n stands for
 * the value n / 2 + 100. */
static const char* write_earth(const char* name) {
  static char path[1024];
  static short numbers[down][across];
  double transform[6] = {-180, 0, 0, 90, 0, 0};
  char** options = CSLSetNameValue(NULL, "TILED", "YES");
  OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
  GDALDatasetH dataset;
  GDALRasterBandH band;
  int i, j;
  transform[1] = degree, transform[5] = -degree;
  snprintf(path, sizeof path, "%s/%s", PNPBS_TEST_WORK_DIR, name);
  GDALAllRegister();
  options = CSLSetNameValue(options, "COMPRESS", "DEFLATE");
  dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, across, down, 1, GDT_Int16, options);
  ck_assert_ptr_nonnull(dataset);
  CSLDestroy(options);
  ck_assert_int_eq(OSRImportFromEPSG(system, 4326), OGRERR_NONE);
  GDALSetSpatialRef(dataset, system);
  OSRRelease(system);
  GDALSetGeoTransform(dataset, transform);
  band = GDALGetRasterBand(dataset, 1);
  GDALSetRasterNoDataValue(band, -32768);
  GDALSetRasterScale(band, 0.5);
  GDALSetRasterOffset(band, 100);
  for (j = 0; j < down; ++j)
    for (i = 0; i < across; ++i)
      numbers[j][i] = (short)(i >= first_empty && i <= last_empty ? -32768 : number_at(i, j));
  ck_assert_int_eq(
      GDALRasterIO(band, GF_Write, 0, 0, across, down, numbers[0], across, down, GDT_Int16, 0, 0),
      CE_None);
  GDALClose(dataset);
  return path;
}

static double value_of(pnpbs_geo_grid grid, double x, double y, int32_t* inside) {
  const double place[2] = {x, y};
  double value = 0;
  GEO_MUST(pnpbs_geo_grid_values(grid, 1, place, &value, inside));
  return value;
}

START_TEST(in_its_own_system) {
  pnpbs_geo_grid grid = NULL;
  double low[2], high[2];
  int32_t inside = -1;
  GEO_MUST(pnpbs_geo_grid_read(write_grid("own.tif", 1, 1, rows), NULL, NULL, everywhere_low,
                               everywhere_high, &grid));
  ck_assert_double_eq_tol(value_of(grid, 19.03, 55.12, &inside), plane_at(19.03, 55.12), 1e-4);
  ck_assert_int_eq(inside, 1);
  /* Values are constant beyond the edge. The cells reach half a cell beyond their centres, and
   * points up to another half cell away count as inside. Longitudes may differ by 360 degrees. */
  ck_assert_double_eq_tol(value_of(grid, 17, 55.12, &inside), plane_at(18.05, 55.12), 1e-4);
  ck_assert_int_eq(inside, 0);
  ck_assert_double_eq_tol(value_of(grid, 17.96, 55.12, &inside), plane_at(18.05, 55.12), 1e-4);
  ck_assert_int_eq(inside, 1);
  ck_assert_double_eq_tol(value_of(grid, 19.03 - 360, 55.12, NULL), plane_at(19.03, 55.12), 1e-4);
  GEO_MUST(pnpbs_geo_grid_extent(grid, low, high));
  ck_assert_double_eq_tol(low[0], 18, 1e-9);
  ck_assert_double_eq_tol(low[1], 54.5, 1e-9);
  ck_assert_double_eq_tol(high[0], 20, 1e-9);
  ck_assert_double_eq_tol(high[1], 56, 1e-9);
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
  ck_assert_ptr_null(grid);
}
END_TEST

/* The points are in Poland's coordinates, by the projection of the shapes. */
START_TEST(projected) {
  pnpbs_geo_grid grid = NULL;
  const char* wkt = NULL;
  double low[2], high[2], place[2] = {19.2, 55.1};
  geo_case it = geo_begin(
      write_geojson("part.geojson", FEATURE("Polygon", "[[[18.5,54.8],[19.5,54.8],[19,55.5]]]")),
      "EPSG:2180", "km", NULL);
  GEO_MUST(pnpbs_geo_projection(it.shapes, NULL, NULL, NULL, &wkt, NULL));
  ck_assert_int_eq(pnpbs_domain_bounds(it.domain, low, high), PNPBS_OK);
  GEO_MUST(pnpbs_geo_grid_read(write_grid("part.tif", 1, 1, rows), NULL, wkt, low, high, &grid));
  GEO_MUST(pnpbs_geo_from_degrees(it.shapes, 1, place));
  ck_assert_double_eq_tol(value_of(grid, place[0], place[1], NULL), plane_at(19.2, 55.1), 1e-4);
  GEO_MUST(pnpbs_geo_grid_extent(grid, low, high));
  ck_assert_double_eq_tol(high[1] - low[1], 168, 3); /* 1.5 degrees in kilometres */
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
  geo_end(&it);
}
END_TEST

START_TEST(bands_and_gaps) {
  pnpbs_geo_grid grid = NULL;
  int32_t inside = -1;
  const char* const path = write_grid("bands.tif", 2, 1, 8);
  GEO_MUST_FAIL(PNPBS_ERROR_FILE,
                pnpbs_geo_grid_read(path, NULL, NULL, everywhere_low, everywhere_high, &grid),
                "has 2 bands", "FILE:1");
  GEO_MUST_FAIL(PNPBS_ERROR_FILE,
                pnpbs_geo_grid_read(path, "3", NULL, everywhere_low, everywhere_high, &grid),
                "no band '3'", "1, 2");
  GEO_MUST(pnpbs_geo_grid_read(path, "2", NULL, everywhere_low, everywhere_high, &grid));
  ck_assert_double_eq_tol(value_of(grid, 19.03, 55.5, NULL), 2 * plane_at(19.03, 55.5), 1e-4);
  /* The last row with data is the eighth, whose centre is at 55.25. */
  ck_assert_double_eq_tol(value_of(grid, 19.03, 54.6, &inside), 2 * plane_at(19.03, 55.25), 1e-4);
  ck_assert_int_eq(inside, 2);
  value_of(grid, 19.03, 55.17, &inside); /* between that row and the next */
  ck_assert_int_eq(inside, 1);
  value_of(grid, 19.03, 55.5, &inside);
  ck_assert_int_eq(inside, 1);
  value_of(grid, 21, 54.6, &inside);
  ck_assert_int_eq(inside, 0);
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
}
END_TEST

/* The last column is adjacent to the first one, so neither values nor slopes jump there. */
START_TEST(around_the_earth) {
  const double low[2] = {-180, -90}, high[2] = {180, 90};
  pnpbs_geo_grid grid = NULL;
  int k;
  GEO_MUST(pnpbs_geo_grid_read(write_earth("around.tif"), NULL, NULL, low, high, &grid));
  for (k = 0; k <= 8; ++k) {
    const int row = 100 * k + 50;
    const double part = k / 8.0, last = number_at(across - 1, row), first = number_at(0, row),
                 expected = 100 + 0.5 * (last + part * (first - last)),
                 x = 180 + degree * (part - 0.5), y = 90 - degree * (row + 0.5);
    ck_assert_double_eq_tol(value_of(grid, x, y, NULL), expected, 1e-6);
    ck_assert_double_eq_tol(value_of(grid, x - 360, y, NULL), expected, 1e-6);
  }
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
}
END_TEST

/* One call evaluates points all over the file in irregular order. Their longitudes differ by turns
 * around the Earth. */
START_TEST(of_many_blocks) {
  enum { n = 5000 };
  static double places[2 * n], values[n];
  const double low[2] = {-180, -90}, high[2] = {180, 90};
  pnpbs_geo_grid grid = NULL;
  int i;
  GEO_MUST(pnpbs_geo_grid_read(write_earth("earth.tif"), NULL, NULL, low, high, &grid));
  for (i = 0; i < n; ++i) {
    const int column = (i * 1777) % across, row = (i * 733) % down;
    places[2 * i] = -180 + degree * (column + 0.5) + 360 * (i % 3 - 1);
    places[2 * i + 1] = 90 - degree * (row + 0.5);
  }
  GEO_MUST(pnpbs_geo_grid_values(grid, n, places, values, NULL));
  for (i = 0; i < n; ++i) {
    const int column = (i * 1777) % across, row = (i * 733) % down;
    int nearest = column;
    if (column >= first_empty && column <= last_empty)
      nearest = column - first_empty <= last_empty - column ? first_empty - 1 : last_empty + 1;
    ck_assert_msg(fabs(values[i] - 0.5 * number_at(nearest, row) - 100) < 1e-6,
                  "column %d, row %d: %g", column, row, values[i]);
  }
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
}
END_TEST

/* Reads of a child process do not affect those of its parent. */
START_TEST(in_a_forked_process) {
  const double low[2] = {-180, -90}, high[2] = {180, 90};
  pnpbs_geo_grid grid = NULL;
  int k, status = 1;
  pid_t child;
  GEO_MUST(pnpbs_geo_grid_read(write_earth("forked.tif"), NULL, NULL, low, high, &grid));
  child = fork();
  ck_assert_int_ge(child, 0);
  for (k = 0; k < 400; ++k) {
    const int column = (131 * k) % 900, row = (257 * k) % down;
    const double found =
        value_of(grid, -180 + degree * (column + 0.5), 90 - degree * (row + 0.5), NULL);
    const int right = fabs(found - 0.5 * number_at(column, row) - 100) < 1e-6;
    if (child == 0 && !right) _exit(2);
    if (child != 0) ck_assert_msg(right, "column %d, row %d: %g", column, row, found);
  }
  if (child == 0) _exit(0);
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert_int_eq(status, 0);
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
}
END_TEST

/* Checks slopes of 3 longitude + 2 latitude, in the plane of degrees and along a sphere. */
START_TEST(slopes) {
  const double places[4] = {18.731, 55.117, 19.413, 54.822}, radius = 6371.22, pi = acos(-1);
  const double length = pi / 180 * radius; /* length of a degree */
  pnpbs_geo_grid grid = NULL;
  double found[2];
  int i;
  GEO_MUST(pnpbs_geo_grid_read(write_grid("slopes.tif", 1, 1, rows), NULL, NULL, everywhere_low,
                               everywhere_high, &grid));
  GEO_MUST(pnpbs_geo_grid_slopes(grid, 0, 2, places, found));
  for (i = 0; i < 2; ++i) ck_assert_double_eq_tol(found[i], hypot(3, 2), 1e-3);
  GEO_MUST(pnpbs_geo_grid_slopes(grid, radius, 2, places, found));
  for (i = 0; i < 2; ++i) {
    const double east = 3 / (length * cos(pi / 180 * places[2 * i + 1])), north = 2 / length;
    ck_assert_double_eq_tol(found[i], hypot(east, north), 1e-5);
  }
  GEO_MUST(pnpbs_geo_grid_slopes(grid, 0, 0, NULL, NULL));
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_grid_slopes(grid, -1, 2, places, found), "radius",
                "-1");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_grid_slopes(grid, 0, 2, places, NULL), "slopes",
                "NULL");
  GEO_MUST(pnpbs_geo_grid_destroy(&grid));
}
END_TEST

START_TEST(spacing_by_depth) {
  const double depths[5] = {4000, 200, 10, 2, -300}, steep[5] = {0, 50, 50, 50, 900}, pi = acos(-1);
  double d[5], unknown[2];
  int i;
  GEO_MUST(pnpbs_geo_depth_spacing(5, depths, NULL, 30, 44712, 0, 10, 1000, d));
  for (i = 0; i < 5; ++i)
    ck_assert_double_eq_tol(d[i], sqrt(9.81 * fmax(depths[i], 10)) * 44.712 / 30, 1e-9);
  GEO_MUST(pnpbs_geo_depth_spacing(5, depths, steep, 0, 44712, 20, 10, 1000, d));
  ck_assert(isinf(d[0]));
  ck_assert_double_eq_tol(d[1], 2 * pi * 200 / (20 * 50), 1e-12);
  for (i = 2; i < 5; ++i) ck_assert(isinf(d[i])); /* the bottom is flat */
  GEO_MUST(pnpbs_geo_depth_spacing(2, depths, steep, 30, 44712, 20, 10, 1000, d));
  ck_assert_double_eq_tol(d[0], sqrt(9.81 * 4000) * 44.712 / 30, 1e-9);
  ck_assert_double_eq_tol(d[1], 2 * pi * 200 / (20 * 50), 1e-12);
  unknown[0] = 5, unknown[1] = nan("");
  GEO_MUST_FAIL(PNPBS_ERROR_SPACING,
                pnpbs_geo_depth_spacing(2, unknown, NULL, 30, 44712, 0, 10, 1, d), "depths[1]",
                "not a number");
  GEO_MUST_FAIL(PNPBS_ERROR_SPACING,
                pnpbs_geo_depth_spacing(2, depths, unknown, 30, 44712, 20, 10, 1, d), "slopes[1]",
                "not a number");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT,
                pnpbs_geo_depth_spacing(2, depths, NULL, 30, 44712, 20, 10, 1, d), "slopes",
                "NULL");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_depth_spacing(2, depths, NULL, 30, 0, 0, 10, 1, d),
                "period", "0");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_depth_spacing(2, depths, NULL, 30, 1, 0, 0, 1, d),
                "least_depth", "0");
}
END_TEST

START_TEST(what_cannot_be_read) {
  const double far_low[2] = {30, 50}, far_high[2] = {31, 51}, south[2] = {18, 53},
               north_of_it[2] = {19, 54.9};
  pnpbs_geo_grid grid = NULL;
  GEO_MUST_FAIL(
      PNPBS_ERROR_SPACING,
      pnpbs_geo_grid_read(write_grid("own.tif", 1, 1, rows), NULL, NULL, far_low, far_high, &grid),
      "from (18, 54.5) to (20, 56)", "from (30, 50) to (31, 51)");
  ck_assert_ptr_null(grid);
  GEO_MUST_FAIL(
      PNPBS_ERROR_SPACING,
      pnpbs_geo_grid_read(write_grid("empty.tif", 1, 1, 0), NULL, NULL, south, north_of_it, &grid),
      "empty.tif", "no data");
  GEO_MUST_FAIL(PNPBS_ERROR_FILE,
                pnpbs_geo_grid_read(write_grid("plain.tif", 1, 0, rows), NULL, NULL, everywhere_low,
                                    everywhere_high, &grid),
                "plain.tif", "no geographic reference");
  GEO_MUST_FAIL(PNPBS_ERROR_FILE,
                pnpbs_geo_grid_read(write_file("text.tif", "hello", 5), NULL, NULL, everywhere_low,
                                    everywhere_high, &grid),
                "cannot read", "text.tif");
  GEO_MUST_FAIL(PNPBS_ERROR_FILE,
                pnpbs_geo_grid_read("none.tif", NULL, NULL, everywhere_low, everywhere_high, &grid),
                "none.tif", "no such file");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT,
                pnpbs_geo_grid_read("none.tif", NULL, NULL, everywhere_high, everywhere_low, &grid),
                "low and high", "corners");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT,
                pnpbs_geo_grid_read(NULL, NULL, NULL, everywhere_low, everywhere_high, &grid),
                "path", "NULL");
  GEO_MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_geo_grid_values(NULL, 0, NULL, NULL, NULL), "grid",
                "NULL");
  GEO_MUST(pnpbs_geo_grid_destroy(NULL));
}
END_TEST

TEST_SUITE(test_grids) {
  Suite* suite = suite_create("grids in files");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, in_its_own_system);
  tcase_add_test(cases, projected);
  tcase_add_test(cases, bands_and_gaps);
  tcase_add_test(cases, around_the_earth);
  tcase_add_test(cases, of_many_blocks);
  tcase_add_test(cases, in_a_forked_process);
  tcase_add_test(cases, slopes);
  tcase_add_test(cases, spacing_by_depth);
  tcase_add_test(cases, what_cannot_be_read);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

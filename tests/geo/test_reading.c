/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests the conversion of polygons, lines and points, tags and layers, and errors of files that are
 * rejected. Coordinates are not projected here, so areas are simple.
 */
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "geo_support.h"

static geo_case begin(const char* features) {
  return geo_begin(write_geojson("shapes.geojson", features), "none", NULL, NULL);
}

static void refuse(const char* path, const char* layer, const char* field, pnpbs_status status,
                   const char* part, const char* other_part) {
  pnpbs_geo_shapes shapes = NULL;
  GEO_MUST_FAIL(status, pnpbs_geo_read(path, layer, "none", NULL, field, &shapes), part,
                other_part);
  ck_assert_ptr_null(shapes);
}

/* ---------------------------------------------------------------- polygons --------------- */

START_TEST(hole_and_repeated_vertices) {
  geo_case it = begin(FEATURE("Polygon",
                              "[[[0,0],[0,0],[4,0],[4,4],[0,4],[0,4],[0,0],[0,0]],"
                              "[[1,1],[2,1],[2,2],[1,2],[1,1]]]"));
  expect_counts(it.shapes, 8, 2, 0, 0);
  ck_assert_double_eq_tol(geo_area(&it), 15, 1e-12);
  geo_end(&it);
}
END_TEST

/* Land with a lake with an island are parts of one feature, or separate features. */
START_TEST(islands_in_lakes) {
  geo_case it = begin(FEATURE("MultiPolygon",
                              "[[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[1,1],[8,1],[8,8],[1,8],[1,1]]],"
                              "[[[3,3],[5,3],[5,5],[3,5],[3,3]]],"
                              "[[[20,0],[21,0],[21,1],[20,1],[20,0]]]]"));
  expect_counts(it.shapes, 16, 4, 0, 0);
  ck_assert_double_eq_tol(geo_area(&it), 81 - 49 + 4 + 1, 1e-12);
  geo_end(&it);
  it = begin(FEATURE("Polygon", "[[[0,0],[9,0],[9,9],[0,9]]]") "," FEATURE(
      "Polygon", "[[[1,1],[8,1],[8,8],[1,8]]]") "," FEATURE("Polygon",
                                                            "[[[3,3],[5,3],[5,5],[3,5]]]"));
  ck_assert_double_eq_tol(geo_area(&it), 81 - 49 + 4, 1e-12);
  geo_end(&it);
}
END_TEST

/* The domain has two adjacent squares, a third one that only touches a corner, and one that fills a
 * hole. */
START_TEST(neighbours) {
  int64_t count = 0, s;
  double segments[32][2][2];
  int32_t tags[32], inner = 0;
  geo_case it = begin(FEATURE("Polygon",
                              "[[[0,0],[4,0],[4,4],[0,4],[0,0]],"
                              "[[1,1],[1,2],[2,2],[2,1],[1,1]]]") "," FEATURE(
      "Polygon", "[[[4,0],[8,0],[8,4],[4,4]]]") "," FEATURE("Polygon",
                                                            "[[[1,1],[2,1],[2,2],[1,2]]]") "," FEATURE("Polygon",
                                                                                                       "[[[8,4],[9,4],[9,5],[8,5]]]"));
  /* Boundary curves begin and end at the ends of the common edge and at the corner that is touched.
   */
  expect_counts(it.shapes, 13, 4, 2, 0);
  ck_assert_double_eq_tol(geo_area(&it), 33, 1e-12);
  ck_assert_int_eq(pnpbs_domain_get_segments(it.domain, 32, &count, segments[0][0], tags),
                   PNPBS_OK);
  for (s = 0; s < count; ++s)
    inner += segments[s][0][0] == 4 && segments[s][1][0] == 4 &&
             fabs(segments[s][0][1] - segments[s][1][1]) == 4;
  ck_assert_int_eq(inner, 1);
  geo_end(&it);
}
END_TEST

/* A vertex of one polygon lies on a straight side of its neighbour, to the last digit or a metre
 * off. */
START_TEST(vertices_that_only_one_neighbour_has) {
  const char* const projections[] = {"none", "EPSG:2180"};
  int k;
  for (k = 0; k < 2; ++k) {
    geo_case it = geo_begin(
        write_geojson(
            "sides.geojson",
            FEATURE("Polygon", "[[[18,54],[19,54],[19.1,55],[18,55]]]") "," FEATURE(
                "Polygon",
                "[[[19,54],[20,54],[20,55],[19.1,55],[19.05,54.5]]]") "," FEATURE("LineString",
                                                                                  "[[18.5,54],[18."
                                                                                  "5,54.5]]")),
        projections[k], NULL, NULL);
    /* The end of the line lies on a side as well. */
    expect_counts(it.shapes, 9, 3, 2, 0);
    ck_assert(!has_note(it.shapes, "almost touch"));
    geo_end(&it);
  }
  {
    geo_case it = begin(FEATURE("Polygon", "[[[18,54],[19,54],[19,55],[18,55]]]") "," FEATURE(
        "Polygon", "[[[19,54],[20,54],[20,55],[19,55],[19.000001,54.5]]]"));
    ck_assert(has_note(it.shapes, "features 1 and 0 almost touch at (19.000001, 54.5)"));
    geo_end(&it);
  }
}
END_TEST

START_TEST(spike_and_seam) {
  geo_case it = begin(FEATURE("Polygon", "[[[0,0],[4,0],[6,0],[4,0],[4,4],[0,4]]]"));
  ck_assert_double_eq_tol(geo_area(&it), 16, 1e-12);
  ck_assert(has_note(it.shapes, "2 segments"));
  ck_assert_int_eq(noted(it.shapes, PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT), 2);
  ck_assert_int_eq(noted(it.shapes, PNPBS_GEO_NOTE_SCALE), -1);
  geo_end(&it);
  it = begin(FEATURE("MultiPolygon", "[[[[0,0],[2,0],[2,4],[0,4]]],[[[2,0],[4,0],[4,4],[2,4]]]]"));
  expect_counts(it.shapes, 6, 1, 0, 0);
  geo_end(&it);
}
END_TEST

START_TEST(overlaps) {
  refuse(write_geojson("overlap.geojson",
                       FEATURE("Polygon", "[[[0,0],[4,0],[4,4],[0,4]]]") "," FEATURE(
                           "Polygon", "[[[0,0],[4,0],[4,3],[0,3]]]")),
         NULL, NULL, PNPBS_ERROR_DOMAIN, "features 0 and 1 overlap", "(0, 0) to (4, 0)");
}
END_TEST

/* The library finds the crossing in projected coordinates. The message is also available in
 * degrees. */
START_TEST(crosses_itself) {
  pnpbs_geo_shapes shapes = NULL;
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  const char* message;
  char given[2000];
  double longitude = 0, latitude = 0;
  GEO_MUST(pnpbs_geo_read(
      write_geojson("bow.geojson", FEATURE("Polygon", "[[[18,54],[19,55],[19,54],[18,55]]]")), NULL,
      "EPSG:2180", NULL, NULL, &shapes));
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
  GEO_MUST(pnpbs_geo_add_to_domain(shapes, context, domain, 0));
  ck_assert_int_eq(pnpbs_domain_check(domain), PNPBS_ERROR_DOMAIN);
  message = pnpbs_geo_explain(shapes, pnpbs_last_error(context));
  ck_assert_msg(strstr(message, "[longitude ") != NULL, "%s", message);
  ck_assert_int_eq(sscanf(strstr(message, "[longitude "), "[longitude %lf, latitude %lf]",
                          &longitude, &latitude),
                   2);
  ck_assert_double_eq_tol(longitude, 18.5, 0.51);
  ck_assert_double_eq_tol(latitude, 54.5, 0.51);
  ck_assert_int_eq(
      snprintf(given, sizeof given, "coast: %s (1, 2)", pnpbs_last_error(context)) > 20, 1);
  message = pnpbs_geo_explain(shapes, given);
  ck_assert_msg(strncmp(message, "coast: ", 7) == 0 && strstr(message, "[longitude ") != NULL &&
                    strcmp(message + strlen(message) - 7, " (1, 2)") == 0,
                "%s", message);
  /* Only points that belong to a message are converted, not those in any text. */
  ck_assert_str_eq(pnpbs_geo_explain(shapes, "(500000, 650000)"), "(500000, 650000)");
  ck_assert_str_eq(pnpbs_geo_explain(NULL, "as it is (1, 2)"), "as it is (1, 2)");
  GEO_MUST(pnpbs_geo_destroy(&shapes));
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
}
END_TEST

/* ---------------------------------------------------------------- lines and points ------- */

START_TEST(lines_and_points_in_polygons) {
  geo_case it = begin(FEATURE("Polygon", "[[[0,0],[9,0],[9,9],[0,9]]]") "," FEATURE(
      "LineString", "[[1,1],[2,2],[3,1]]") "," FEATURE("MultiLineString",
                                                       "[[[4,4],[6,4],[6,6],[4,4]],[[6,6],[7,7]"
                                                       "]]") "," FEATURE("MultiPoint",
                                                                         "[[8,1],[8,2]]"));
  expect_counts(it.shapes, 13, 1, 3, 2);
  ck_assert_double_eq_tol(geo_area(&it), 81, 1e-12);
  geo_end(&it);
}
END_TEST

/* Maps may cut a coast into pieces. Here a pier is added, and one piece occurs twice. */
START_TEST(coast_of_lines) {
  geo_case it = begin(FEATURE("LineString", "[[0,0],[9,0],[9,9]]") "," FEATURE(
      "LineString",
      "[[9,9],[0,9],[0,0]]") "," FEATURE("LineString",
                                         "[[9,0],[9,9]]") "," FEATURE("LineString",
                                                                      "[[9,9],[5,5]]"));
  ck_assert_double_eq_tol(geo_area(&it), 81, 1e-12);
  expect_counts(it.shapes, 5, 1, 1, 0);
  geo_end(&it);
  refuse(write_geojson("theta.geojson",
                       FEATURE("LineString", "[[0,0],[9,0],[9,9],[0,9],[0,0]]") "," FEATURE(
                           "LineString", "[[0,0],[9,9]]")),
         NULL, NULL, PNPBS_ERROR_DOMAIN, "3 lines", "(0, 0)");
}
END_TEST

START_TEST(second_layer_with_the_projection_of_the_first) {
  const char* wkt = NULL;
  pnpbs_geo_shapes more = NULL;
  geo_case it = geo_begin(
      write_geojson("land.geojson", FEATURE("Polygon", "[[[10,50],[12,50],[12,52],[10,52]]]")),
      NULL, "km", NULL);
  GEO_MUST(pnpbs_geo_projection(it.shapes, NULL, NULL, NULL, &wkt, NULL));
  GEO_MUST(pnpbs_geo_read(
      write_geojson("river.geojson", FEATURE("LineString", "[[10.5,51],[11,51.5],[11.5,51]]")),
      NULL, wkt, NULL, NULL, &more));
  expect_counts(more, 3, 0, 1, 0);
  GEO_MUST(pnpbs_geo_add_to_domain(more, it.context, it.domain, 0));
  ck_assert_int_eq(pnpbs_domain_check(it.domain), PNPBS_OK);
  GEO_MUST(pnpbs_geo_destroy(&more));
  geo_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- tags ------------------- */

START_TEST(tags_by_a_field) {
  const char* const path =
      write_geojson("tags.geojson", FEATURE("Polygon", "[[[0,0],[9,0],[9,9],[0,9]]]") "," FEATURE(
                                        "LineString", "[[1,1],[2,2],[3,1]]"));
  const char* name = NULL;
  int32_t tag = 0, count = 0, dim = -1;
  geo_case it = geo_begin(path, "none", NULL, "land");
  ck_assert_int_eq(pnpbs_domain_tag_name_count(it.domain, &count), PNPBS_OK);
  ck_assert_int_eq(count, 2);
  ck_assert_int_eq(pnpbs_domain_get_tag_name(it.domain, 1, &dim, &tag, &name), PNPBS_OK);
  ck_assert_int_eq(dim, 1);
  ck_assert_int_eq(tag, 2);
  ck_assert_str_eq(name, "LineString");
  geo_end(&it);
  it = geo_begin(path, "none", NULL, "code");
  {
    int32_t tags[16];
    int64_t segments = 0;
    ck_assert_int_eq(pnpbs_domain_get_segments(it.domain, 16, &segments, NULL, tags), PNPBS_OK);
    ck_assert_int_eq(segments, 6);
    ck_assert_int_eq(tags[0], 7);
  }
  geo_end(&it);
  refuse(path, NULL, "colour", PNPBS_ERROR_FILE, "no field 'colour'", "land, code");
  refuse(write_geojson("null.geojson",
                       "{\"type\":\"Feature\",\"properties\":{\"a\":null},\"geometry\":{\"type\":"
                       "\"LineString\",\"coordinates\":[[0,0],[1,1]]}},"
                       "{\"type\":\"Feature\",\"properties\":{\"a\":3},\"geometry\":null}"),
         NULL, "a", PNPBS_ERROR_FILE, "field 'a' of feature 0", "has no value");
  refuse(write_geojson("zero.geojson",
                       "{\"type\":\"Feature\",\"properties\":{\"a\":0},\"geometry\":{\"type\":"
                       "\"LineString\",\"coordinates\":[[0,0],[1,1]]}}"),
         NULL, "a", PNPBS_ERROR_FILE, "is 0", "other than 0");
}
END_TEST

/* ---------------------------------------------------------------- files ------------------ */

static const char* in_folder(const char* name) {
  static char path[1024];
  snprintf(path, sizeof path, "%s/%s", PNPBS_TEST_WORK_DIR, name);
  return path;
}

/* Writes layers with a square each, with sides of 1, 2, ... thousand, in Poland's coordinates or
 * without a system. */
static void write_layers(const char* driver_name, const char* path, int layers, int with_system) {
  GDALDriverH driver;
  GDALDatasetH dataset;
  int k;
  GDALAllRegister();
  driver = GDALGetDriverByName(driver_name);
  ck_assert_ptr_nonnull(driver);
  if (fopen(path, "rb")) GDALDeleteDataset(driver, path);
  dataset = GDALCreate(driver, path, 0, 0, 0, GDT_Unknown, NULL);
  for (k = 0; k < layers; ++k) {
    OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
    char name[8], wkt[200];
    OGRLayerH layer;
    OGRFeatureH feature;
    OGRGeometryH geometry = NULL;
    char* text = wkt;
    const int side = 1000 * (k + 1), x = 500000, y = 600000;
    ck_assert_int_eq(OSRImportFromEPSG(system, 2180), OGRERR_NONE);
    OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
    snprintf(name, sizeof name, "part%d", k);
    layer = GDALDatasetCreateLayer(dataset, name, with_system ? system : NULL, wkbPolygon, NULL);
    snprintf(wkt, sizeof wkt, "POLYGON((%d %d 7,%d %d 7,%d %d 7,%d %d 7,%d %d 7))", x, y, x + side,
             y, x + side, y + side, x, y + side, x, y);
    ck_assert_int_eq(OGR_G_CreateFromWkt(&text, NULL, &geometry), OGRERR_NONE);
    feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGR_F_SetGeometryDirectly(feature, geometry);
    ck_assert_int_eq(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
    OGR_F_Destroy(feature);
    OSRRelease(system);
  }
  GDALClose(dataset);
}

START_TEST(layers) {
  const char* const path = in_folder("layers.gpkg");
  pnpbs_geo_shapes shapes = NULL;
  write_layers("GPKG", path, 2, 1);
  refuse(path, NULL, NULL, PNPBS_ERROR_FILE, "2 layers", "part0, part1");
  refuse(path, "part7", NULL, PNPBS_ERROR_FILE, "no layer 'part7'", "part0, part1");
  GEO_MUST(pnpbs_geo_read(path, "part1", NULL, "km", NULL, &shapes));
  expect_counts(shapes, 4, 1, 0, 0);
  GEO_MUST(pnpbs_geo_destroy(&shapes));
}
END_TEST

/* Projected coordinates are kept unless another projection is requested. */
START_TEST(shapefile) {
  const char *name = NULL, *path = in_folder("square.shp");
  geo_case it;
  write_layers("ESRI Shapefile", path, 1, 1);
  it = geo_begin(path, NULL, NULL, NULL);
  ck_assert_double_eq_tol(geo_area(&it), 1e6, 1e-3);
  GEO_MUST(pnpbs_geo_projection(it.shapes, &name, NULL, NULL, NULL, NULL));
  ck_assert_msg(strstr(name, "CS92") != NULL, "%s", name);
  geo_end(&it);
  it = geo_begin(path, "auto", "km", NULL); /* scales of 0.9993 and 0.9996 */
  ck_assert_double_eq_tol(geo_area(&it), 1, 2e-3);
  GEO_MUST(pnpbs_geo_projection(it.shapes, &name, NULL, NULL, NULL, NULL));
  ck_assert_msg(strstr(name, "UTM zone 3") != NULL, "%s", name);
  geo_end(&it);
}
END_TEST

START_TEST(shapefile_without_its_companions) {
  const char *path = in_folder("plain.shp"), *name = NULL;
  geo_case it;
  pnpbs_geo_shapes shapes = NULL;
  write_layers("ESRI Shapefile", path, 1, 0);
  it = geo_begin(path, NULL, NULL, NULL);
  ck_assert(has_note(it.shapes, "has no coordinate reference system"));
  GEO_MUST(pnpbs_geo_projection(it.shapes, &name, NULL, NULL, NULL, NULL));
  ck_assert_str_eq(name, "");
  GEO_MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_geo_write_prj(it.shapes, path), "has no",
                "coordinate reference system");
  geo_end(&it);
  GEO_MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_geo_read(path, NULL, "EPSG:2180", NULL, NULL, &shapes),
                "EPSG:2180", ".prj");
  ck_assert_int_eq(remove(in_folder("plain.shx")), 0);
  refuse(in_folder("plain.shp"), NULL, NULL, PNPBS_ERROR_FILE, "plain.shx", "ogrinfo --config");
}
END_TEST

START_TEST(shapefile_that_ends_too_early) {
  char bytes[160];
  FILE* file;
  write_layers("ESRI Shapefile", in_folder("short.shp"), 1, 1);
  file = fopen(in_folder("short.shp"), "rb");
  ck_assert_uint_eq(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
  fclose(file);
  refuse(write_file("short.shp", bytes, sizeof bytes), NULL, NULL, PNPBS_ERROR_FILE, "to its end",
         "short.shp");
}
END_TEST

START_TEST(what_cannot_be_read) {
  refuse(in_folder("nothing.geojson"), NULL, NULL, PNPBS_ERROR_FILE, "nothing.geojson",
         "no such file");
  refuse(write_file("text.geojson", "hello", 5), NULL, NULL, PNPBS_ERROR_FILE, "cannot read",
         "text.geojson");
  refuse(write_geojson("empty.geojson", ""), NULL, NULL, PNPBS_ERROR_FILE, "empty.geojson",
         "is empty");
  refuse(
      write_geojson("null.geojson", "{\"type\":\"Feature\",\"properties\":{},\"geometry\":null}"),
      NULL, NULL, PNPBS_ERROR_FILE, "no shapes", "1 features");
  refuse(NULL, NULL, NULL, PNPBS_ERROR_ARGUMENT, "path", "NULL");
  ck_assert_int_eq(pnpbs_geo_read("a", NULL, NULL, NULL, NULL, NULL), PNPBS_ERROR_ARGUMENT);
}
END_TEST

/* ---------------------------------------------------------------- handles ---------------- */

START_TEST(handles) {
  const char* const path = write_geojson("a.geojson", FEATURE("Polygon", "[[[0,0],[9,0],[9,9]]]"));
  pnpbs_geo_shapes dead;
  pnpbs_domain space = NULL;
  int32_t count = 0;
  geo_case it = geo_begin(path, NULL, NULL, NULL);
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT,
                pnpbs_geo_add_to_domain(it.shapes, it.context, it.domain, 200), "corner_angle",
                "200");
  ck_assert_int_eq(pnpbs_domain_create(it.context, 3, &space), PNPBS_OK);
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_add_to_domain(it.shapes, it.context, space, 0),
                "domain", "in space");
  ck_assert_int_eq(pnpbs_geo_add_to_domain(it.shapes, it.context, NULL, 0), PNPBS_ERROR_HANDLE);
  pnpbs_domain_destroy(&space);
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_get_note(it.shapes, 99, NULL), "note", "NULL");
  ck_assert_ptr_nonnull(strstr(pnpbs_geo_build_info(), "PROJ: "));
  dead = it.shapes;
  geo_end(&it);
  GEO_MUST(pnpbs_geo_destroy(NULL));
  GEO_MUST(pnpbs_geo_destroy(&it.shapes));
  ck_assert_int_eq(pnpbs_geo_note_count(dead, &count), PNPBS_ERROR_HANDLE);
  ck_assert_int_eq(pnpbs_geo_counts(NULL, NULL, NULL, NULL, NULL), PNPBS_ERROR_HANDLE);
  ck_assert_int_eq(pnpbs_geo_projection(dead, NULL, NULL, NULL, NULL, NULL), PNPBS_ERROR_HANDLE);
  ck_assert_int_eq(pnpbs_geo_scale(dead, NULL, NULL), PNPBS_ERROR_HANDLE);
  ck_assert_int_eq(pnpbs_geo_destroy(&dead), PNPBS_ERROR_HANDLE);
}
END_TEST

TEST_SUITE(test_reading) {
  Suite* suite = suite_create("reading shapes");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, hole_and_repeated_vertices);
  tcase_add_test(cases, islands_in_lakes);
  tcase_add_test(cases, neighbours);
  tcase_add_test(cases, vertices_that_only_one_neighbour_has);
  tcase_add_test(cases, spike_and_seam);
  tcase_add_test(cases, overlaps);
  tcase_add_test(cases, crosses_itself);
  tcase_add_test(cases, lines_and_points_in_polygons);
  tcase_add_test(cases, coast_of_lines);
  tcase_add_test(cases, second_layer_with_the_projection_of_the_first);
  tcase_add_test(cases, tags_by_a_field);
  tcase_add_test(cases, layers);
  tcase_add_test(cases, shapefile);
  tcase_add_test(cases, shapefile_without_its_companions);
  tcase_add_test(cases, shapefile_that_ends_too_early);
  tcase_add_test(cases, what_cannot_be_read);
  tcase_add_test(cases, handles);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

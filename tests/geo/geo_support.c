/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Implements the helpers of geo_support.h. */
#include "geo_support.h"

const char* write_file(const char* name, const char* text, size_t length) {
  static char path[1024];
  FILE* file;
  snprintf(path, sizeof path, "%s/%s", PNPBS_TEST_WORK_DIR, name);
  file = fopen(path, "wb");
  ck_assert_ptr_nonnull(file);
  ck_assert_uint_eq(fwrite(text, 1, length, file), length);
  ck_assert_int_eq(fclose(file), 0);
  return path;
}

const char* write_geojson(const char* name, const char* features) {
  static char text[1 << 16];
  const int length =
      snprintf(text, sizeof text, "{\"type\":\"FeatureCollection\",\"features\":[%s]}", features);
  ck_assert_int_lt(length, (int)sizeof text);
  return write_file(name, text, (size_t)length);
}

geo_case geo_begin(const char* path, const char* projection, const char* unit, const char* field) {
  geo_case it = {NULL, NULL, NULL};
  GEO_MUST(pnpbs_geo_read(path, NULL, projection, unit, field, &it.shapes));
  ck_assert_int_eq(pnpbs_context_create_serial(&it.context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create(it.context, 2, &it.domain), PNPBS_OK);
  GEO_MUST(pnpbs_geo_add_to_domain(it.shapes, it.context, it.domain, 0));
  ck_assert_msg(pnpbs_domain_check(it.domain) == PNPBS_OK, "%s",
                pnpbs_geo_explain(it.shapes, pnpbs_last_error(it.context)));
  return it;
}

void geo_end(geo_case* it) {
  GEO_MUST(pnpbs_geo_destroy(&it->shapes));
  ck_assert_ptr_null(it->shapes);
  pnpbs_domain_destroy(&it->domain);
  pnpbs_context_destroy(&it->context);
}

double geo_area(const geo_case* it) {
  double area = -1;
  ck_assert_int_eq(pnpbs_domain_measure(it->domain, &area), PNPBS_OK);
  return area;
}

void expect_counts(pnpbs_geo_shapes shapes, int64_t vertices, int64_t boundary, int64_t inner,
                   int64_t points) {
  int64_t found[4] = {-1, -1, -1, -1};
  GEO_MUST(pnpbs_geo_counts(shapes, &found[0], &found[1], &found[2], &found[3]));
  ck_assert_int_eq(found[0], vertices);
  ck_assert_int_eq(found[1], boundary);
  ck_assert_int_eq(found[2], inner);
  ck_assert_int_eq(found[3], points);
}

int has_note(pnpbs_geo_shapes shapes, const char* part) {
  int32_t count = 0, k;
  GEO_MUST(pnpbs_geo_note_count(shapes, &count));
  for (k = 0; k < count; ++k) {
    const char* note = NULL;
    GEO_MUST(pnpbs_geo_get_note(shapes, k, &note));
    if (strstr(note, part)) return 1;
  }
  return 0;
}

int64_t noted(pnpbs_geo_shapes shapes, int32_t code) {
  int32_t notes = 0, k, found = 0;
  int64_t count = 0;
  GEO_MUST(pnpbs_geo_note_count(shapes, &notes));
  for (k = 0; k < notes; ++k) {
    GEO_MUST(pnpbs_geo_get_note_data(shapes, k, &found, &count));
    if (found == code) return count;
  }
  return -1;
}

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests damaged GeoJSON files, in which some bytes are changed or missing. Each is either read or
 * an error with a message. If it is read, a domain accepts it or rejects it with a message.
 */
#include "geo_support.h"

static uint64_t state = 20260715;
static unsigned draw(unsigned below) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (unsigned)((state >> 33) % below);
}

static const char whole[] =
    "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"a\":1},"
    "\"geometry\":{\"type\":\"MultiPolygon\",\"coordinates\":[[[[18.5,54.4],[19.75,54.375],[19.6,"
    "54.8],[18.4,54.85],[18.5,54.4]],[[18.8,54.5],[19,54.5],[19,54.6],[18.8,54.5]]],[[[20,54],[21,"
    "54]"
    ",[21,55],[20,54]]]]}},{\"type\":\"Feature\",\"properties\":{\"a\":2},\"geometry\":{\"type\":"
    "\"LineString\",\"coordinates\":[[18.6,54.7],[19,54.7],[19.2,54.72]]}},{\"type\":\"Feature\","
    "\"properties\":{\"a\":3},\"geometry\":{\"type\":\"Point\",\"coordinates\":[19.3,54.5]}}]}";

static size_t damage(char* text, size_t length) {
  static const char some[] = "0123456789-.,[]{}\":eE \n\\naNulltrue\x80\xff";
  unsigned changes = 1 + draw(4);
  while (changes-- > 0 && length > 8) {
    const unsigned at = draw((unsigned)length);
    switch (draw(4)) {
      case 0:
        text[at] = some[draw(sizeof some - 1)];
        break;
      case 1: /* removes a piece */
      {
        const size_t gone = 1 + draw((unsigned)(length - at));
        const size_t most = gone < 12 ? gone : 12;
        memmove(text + at, text + at + most, length - at - most);
        length -= most;
        break;
      }
      case 2: /* changes a digit */
        if (text[at] >= '0' && text[at] <= '9') text[at] = (char)('0' + draw(10));
        break;
      default:
        if (draw(8) == 0) length = at + 1;
    }
  }
  return length;
}

START_TEST(text_files) {
  static const char* const projections[] = {NULL, "EPSG:2180", "none", "auto"};
  char text[sizeof whole];
  int round, read = 0, placed = 0;
  pnpbs_context context = NULL;
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  for (round = 0; round < WHEN_SANITIZED(200, 500); ++round) {
    pnpbs_geo_shapes shapes = NULL;
    pnpbs_domain domain = NULL;
    pnpbs_status status;
    size_t length = sizeof whole - 1;
    memcpy(text, whole, sizeof whole);
    length = damage(text, length);
    status =
        pnpbs_geo_read(write_file("damaged.geojson", text, length), NULL, projections[round % 4],
                       round % 3 ? NULL : "km", round % 5 ? NULL : "a", &shapes);
    if (status != PNPBS_OK) {
      ck_assert_msg(status == PNPBS_ERROR_FILE || status == PNPBS_ERROR_DOMAIN ||
                        status == PNPBS_ERROR_ARGUMENT,
                    "round %d: %d, %s", round, status, pnpbs_geo_last_error());
      ck_assert_uint_gt(strlen(pnpbs_geo_last_error()), 10);
      ck_assert_ptr_null(shapes);
      continue;
    }
    ++read;
    ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
    status = pnpbs_geo_add_to_domain(shapes, context, domain, 30);
    ck_assert_msg(status == PNPBS_OK, "round %d: %s", round, pnpbs_geo_last_error());
    status = pnpbs_domain_check(domain);
    ck_assert_msg(status == PNPBS_OK || status == PNPBS_ERROR_DOMAIN, "round %d: %s", round,
                  pnpbs_last_error(context));
    placed += status == PNPBS_OK;
    pnpbs_domain_destroy(&domain);
    GEO_MUST(pnpbs_geo_destroy(&shapes));
  }
  ck_assert_int_gt(read, round / 10);
  ck_assert_int_gt(placed, round / 20);
  ck_assert_int_lt(placed, round);
  pnpbs_context_destroy(&context);
}
END_TEST

TEST_SUITE(test_damaged) {
  Suite* suite = suite_create("damaged files of shapes");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, text_files);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}

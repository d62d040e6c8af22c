/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Helpers of the tests of shapes: GeoJSON files, and a domain with the shapes that are read from
 * them.
 */
#ifndef PNPBS_TESTS_GEO_GEO_SUPPORT_H
#define PNPBS_TESTS_GEO_GEO_SUPPORT_H

#include <math.h>
#include <pnpbs/pnpbs_geo.h>
#include <stdio.h>
#include <string.h>

#include "check_runner.h"

#define GEO_MUST(call)                                                           \
  do {                                                                           \
    const pnpbs_status status_ = (call);                                         \
    ck_assert_msg(status_ == PNPBS_OK, "%s: %s", #call, pnpbs_geo_last_error()); \
  } while (0)

/* Requires that a call fails with this status, and that its message contains both parts. */
#define GEO_MUST_FAIL(expected, call, part, other_part)                                   \
  do {                                                                                    \
    const pnpbs_status status_ = (call);                                                  \
    const char* const message_ = pnpbs_geo_last_error();                                  \
    ck_assert_msg(status_ == (expected), "%s: %d, %s", #call, status_, message_);         \
    ck_assert_msg(strstr(message_, part) != NULL, "'%s' is not in: %s", part, message_);  \
    ck_assert_msg(strstr(message_, other_part) != NULL, "'%s' is not in: %s", other_part, \
                  message_);                                                              \
  } while (0)

/* Writes a file into the folder of the tests. Returns its path, which is valid until the next call.
 */
const char* write_file(const char* name, const char* text, size_t length);
/* Writes a FeatureCollection with these features. Returns the path like write_file. */
const char* write_geojson(const char* name, const char* features);

/* The text of a feature of this type with these coordinates, for write_geojson. The type is also
 * the value of its field "land". */
#define FEATURE(type, coordinates)                         \
  "{\"type\":\"Feature\",\"properties\":{\"land\":\"" type \
  "\",\"code\":7},\"geometry\":{\"type\":\"" type "\",\"coordinates\":" coordinates "}}"

typedef struct geo_case {
  pnpbs_geo_shapes shapes;
  pnpbs_context context;
  pnpbs_domain domain;
} geo_case;

/* Reads a file and adds the shapes to a domain, which is checked. */
geo_case geo_begin(const char* path, const char* projection, const char* unit, const char* field);
void geo_end(geo_case* it);

double geo_area(const geo_case* it);
void expect_counts(pnpbs_geo_shapes shapes, int64_t vertices, int64_t boundary, int64_t inner,
                   int64_t points);
/* Returns whether a note contains this text. */
int has_note(pnpbs_geo_shapes shapes, const char* part);
/* Returns the count of the note with this code, or -1 if there is no such note. */
int64_t noted(pnpbs_geo_shapes shapes, int32_t code);

#endif

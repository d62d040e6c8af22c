// SPDX-License-Identifier: BSD-3-Clause
// Surfaces in every format; valid variants of STL, OFF and OBJ; and invalid files.
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "run_suite.hpp"
#include "surface_reading.hpp"

namespace {

// Returns six times the enclosed volume.
double volume6(const SurfaceTriangles& s) {
  double sum = 0;
  for (const auto& triangle : s.triangles) {
    const auto &a = surface_files::corner(s, triangle, 0),
               &b = surface_files::corner(s, triangle, 1),
               &c = surface_files::corner(s, triangle, 2);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

// Two triangles on a square.
const char* const square_obj = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n";

}  // namespace

START_TEST(one_surface_in_all_formats) {
  ck_assert_double_eq(volume6(box), 6);
  for (const auto& [format, bytes] : surface_files::all(box)) {
    const SurfaceTriangles surface = read(format, bytes);
    expect_the_same(surface, box);
    ck_assert(surface.tag_names.empty());
    ck_assert(surface.holes.empty());
  }
}
END_TEST

START_TEST(formats_by_ending) {
  ck_assert(pnpbs::surface_format("a/b.c/d.STL") == SurfaceFormat::stl);
  ck_assert(pnpbs::surface_format("x.y.Off") == SurfaceFormat::off);
  ck_assert(pnpbs::surface_format("x.obj") == SurfaceFormat::obj);
  ck_assert(pnpbs::surface_format("x.PLY") == SurfaceFormat::ply);
  ck_assert(pnpbs::surface_format(".poly") == SurfaceFormat::poly);
  ck_assert(pnpbs::surface_format("x.smesh") == SurfaceFormat::smesh);
  for (const std::string path : {"x.step", "stl", "a.stl/b", "x.stl.gz", ""}) {
    expect_error(pnpbs::ErrorKind::file,
                 {(path + ": not known by its ending, expected .stl, .off").c_str()},
                 [&] { pnpbs::read_surface(path); });
  }
}
END_TEST

START_TEST(files) {
  for (const auto& [format, bytes] : surface_files::all(box)) {
    const char* const endings[] = {"stl", "off", "obj", "ply", "poly", "smesh"};
    const std::string path = work_path(std::string("box.") + endings[static_cast<int>(format)]);
    write(path, bytes);
    expect_the_same(pnpbs::read_surface(path), box);
    std::remove(path.c_str());
    expect_error(pnpbs::ErrorKind::file, {path.c_str(), ": cannot be read: No such file"},
                 [&] { pnpbs::read_surface(path); });
  }
}
END_TEST

// The counts were determined by other tools (grep -c, NumPy).
START_TEST(real_files) {
  const std::string data = PNPBS_SOURCE_DIR "/examples/data/";
  const SurfaceTriangles eros = pnpbs::read_surface(data + "eros.off");
  ck_assert_uint_eq(eros.vertices.size(), 7374);
  ck_assert_uint_eq(eros.triangles.size(), 14744);
  const SurfaceTriangles kleopatra = pnpbs::read_surface(data + "kleopatra.obj");
  ck_assert_uint_eq(kleopatra.vertices.size(), 2048);
  ck_assert_uint_eq(kleopatra.triangles.size(), 4092);
  ck_assert(kleopatra.triangles[0] == (std::array{835, 1513, 2}));
  const SurfaceTriangles bracket = pnpbs::read_surface(data + "bracket.stl");
  ck_assert_uint_eq(bracket.vertices.size(), 2672);
  ck_assert_uint_eq(bracket.triangles.size(), 5360);
  ck_assert_double_eq_tol(volume6(bracket) / 6, 86523.7868, 1e-3);
}
END_TEST

START_TEST(any_locale) {
  // Files have decimal points also in locales with decimal commas.
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) std::setlocale(LC_ALL, "C");
  expect_the_same(read(SurfaceFormat::off, surface_files::off(box)), box);
  std::setlocale(LC_ALL, "C");
}
END_TEST

// ------------------------------------------------------------------------ STL ---------------

START_TEST(stl_solids_and_their_names) {
  const std::string facet =
      "facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\n";
  const SurfaceTriangles surface =
      read(SurfaceFormat::stl, "solid part #1 \r\n" + facet + "endsolid part #1\nSOLID\n  FACET" +
                                   facet.substr(5) + "EndSolid\nsolid part #1\n" + facet +
                                   "endsolid\nsolid empty\nendsolid");
  ck_assert(surface.tags == (Tags{1, 2, 1}));
  ck_assert(surface.tag_names == (TagNames{{1, "part #1"}}));
  ck_assert_uint_eq(surface.vertices.size(), 3);
}
END_TEST

START_TEST(stl_binary_that_begins_as_text) {
  for (const char* header : {"solid", "solid box\nfacet normal", " solid "}) {
    const std::string bytes = surface_files::stl_binary(box, header);
    expect_the_same(read(SurfaceFormat::stl, bytes), box);
    expect_file_error(SurfaceFormat::stl,
                      {"is binary, though", "it has 683 bytes, expected 684 for the 12 triangles"},
                      bytes.substr(0, 683));
  }
}
END_TEST

START_TEST(stl_bytes_behind_the_triangles) {
  const SurfaceTriangles surface =
      read(SurfaceFormat::stl, surface_files::stl_binary(box) + std::string(120, '\0'));
  expect_the_same(surface, box);
  ck_assert_uint_eq(surface.warnings.size(), 1);
  ck_assert(surface.warnings[0].code == pnpbs::WarningCode::triangles_left_out);
  ck_assert_int_eq(surface.warnings[0].count, 2);
  expect_file_error(SurfaceFormat::stl, {"it has 120 bytes, expected 84 for the 0 triangles"},
                    std::string(120, '\0'));
}
END_TEST

START_TEST(stl_equal_corners_are_one_vertex) {
  SurfaceTriangles soup;
  soup.vertices = {{0, 1, 0}, {1, 0, 0}, {-0.0, 1, -0.0}, {1, 0, 1e-300}};
  soup.triangles = {{0, 1, 2}, {3, 1, 2}};
  const SurfaceTriangles text = read(SurfaceFormat::stl, surface_files::stl_text(soup));
  ck_assert(text.triangles == (Triangles{{0, 1, 0}, {2, 1, 0}}));
  ck_assert_uint_eq(text.vertices.size(), 3);
  const SurfaceTriangles binary = read(SurfaceFormat::stl, surface_files::stl_binary(soup));
  ck_assert(binary.triangles == (Triangles{{0, 1, 0}, {1, 1, 0}}));  // 1e-300 is 0 as a float
}
END_TEST

START_TEST(stl_many_vertices) {
  // A strip of triangles in which each vertex except the first and last ones occurs three times.
  SurfaceTriangles strip;
  const int count = 50000;
  for (int i = 0; i < count; ++i)
    strip.vertices.push_back({static_cast<double>(i), static_cast<double>(i % 2), 0.25});
  for (int i = 0; i + 2 < count; ++i) strip.triangles.push_back({i, i + 1, i + 2});
  strip.tags.assign(strip.triangles.size(), 1);
  expect_the_same(read(SurfaceFormat::stl, surface_files::stl_binary(strip)), strip);
}
END_TEST

START_TEST(stl_errors) {
  const auto expect = [](std::initializer_list<const char*> parts, const std::string& bytes) {
    expect_file_error(SurfaceFormat::stl, parts, bytes);
  };
  const std::string text = surface_files::stl_text(box);
  expect({"x: does not begin with 'solid'", "too short: 0 bytes, expected 84"}, "");
  expect({"as a binary file it is too short: 6 bytes"}, "sotid\n");
  expect({"as a binary file it has 100 bytes", " triangles"}, std::string(100, 'x'));
  expect({"x:1: the file ends, expected 'facet' or 'endsolid'"}, "solid a\n");
  expect({"x: holds no triangles"}, "solid a\nendsolid a\n");
  expect({"x:2: found 'facets', expected 'facet' or 'endsolid'"},
         replaced(text, "facet", "facets"));
  expect({"x:3: found 'inner', expected 'outer'"}, replaced(text, "outer", "inner"));
  expect({"x:3: the line ends, expected 'loop'"}, replaced(text, "outer loop", "outer"));
  expect({"x:5: found 'nan', expected y"}, replaced(text, "vertex 1 2 0", "vertex 1 nan 0"));
  expect({"x:5: found '1,5', expected x"}, replaced(text, "vertex 1 2 0", "vertex 1,5 2 0"));
  expect({"x:5: the line ends, expected z"}, replaced(text, "vertex 1 2 0", "vertex 1 2"));
  expect({"x:7: found 'vertex', expected 'endloop'"},
         replaced(text, "    endloop", "vertex 0 0 0\nendloop"));
  expect({"x:9: found 'solid', expected 'facet' or 'endsolid'"},
         replaced(text, "endfacet\n", "endfacet\nsolid b\n"));
  expect({"expected 'solid'"}, text + "end\n");
  std::string binary = surface_files::stl_binary(box);
  const float inf = INFINITY;
  std::memcpy(binary.data() + 84 + 50 + 12 + 4, &inf, 4);
  expect({"x: at byte 150: found inf, expected y (a number between"}, binary);
  binary.replace(80, 4, "\xff\xff\xff\xff");
  expect({"it has 684 bytes, expected 214748364834 for the 4294967295 triangles"}, binary);
}
END_TEST

// ------------------------------------------------------------------------ OFF ---------------

START_TEST(off_variants) {
  const std::string rest = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n3 0 1 2\n3 0 2 3\n";
  const SurfaceTriangles square = read(SurfaceFormat::obj, square_obj);
  expect_the_same(read(SurfaceFormat::off, "OFF\n4 2 5\n" + rest), square);
  expect_the_same(read(SurfaceFormat::off, "OFF 4 2\n" + rest), square);
  expect_the_same(read(SurfaceFormat::off, "4 2 0\n" + rest), square);
  expect_the_same(read(SurfaceFormat::off,
                       "\xef\xbb\xbf# colors\r\nCOFF\r\n\r\n4 2 0 # counts\r\n"
                       "0 0 0 255 0 0 255\r\n2 0 0 1 1 1\r\n+2 2 0 7\r\n0 .2e1 0\r\n\r\n"
                       "3 0 1 2 0.5 0.5 0.5\r\n3 0 2 3 9"),
                  square);
  expect_the_same(read(SurfaceFormat::off, "STCNOFF\n4 2 0\n" + rest), square);
}
END_TEST

START_TEST(off_errors) {
  const auto expect = [](std::initializer_list<const char*> parts, const std::string& text) {
    expect_file_error(SurfaceFormat::off, parts, text);
  };
  const std::string text = surface_files::off(box);
  expect({"x:1: the file ends, expected 'OFF'"}, "");
  expect({"x:1: found 'off', expected 'OFF'"}, "off\n");
  expect({"x:1: found '4OFF', expected 'OFF' of vertices with 3 coordinates"}, "4OFF\n");
  expect({"x:1: the file ends, expected the number of vertices"}, "OFF\n");
  expect({"x:1: found 'BINARY', expected the number of vertices"}, "OFF BINARY\n");
  expect({"x: holds zero bytes, expected text in OFF format"}, std::string("OFF\0", 4));
  expect({"x:1: the line ends, expected the number of faces"}, "OFF 8\n");
  expect({"x:1: the number of faces is -1"}, "OFF 8 -1\n");
  expect({"x:1: more than 2147483647 vertices"}, "OFF 2147483648 1\n");
  expect({"x:2: the file ends after 1 of 2147483647 vertices"}, "OFF 2147483647 1\n0 0 0\n");
  expect({"the file ends after 12 of 9000000000000000000 faces"},
         replaced(text, " 12 0", " 9000000000000000000"));
  expect({"x:5: found 'inf', expected y"}, replaced(text, "1 2 0", "1 inf 0"));
  expect({"x:12: there is no vertex 8, expected 0 to 7"}, replaced(text, "3 0 1 2", "3 0 8 2"));
  expect({"x:12: there is no vertex -1"}, replaced(text, "3 0 1 2", "3 0 -1 2"));
  expect({"x:12: found '1.5', expected a vertex number"}, replaced(text, "3 0 1 2", "3 0 1.5 2"));
  expect({"x:12: the line ends, expected a vertex number"}, replaced(text, "3 0 1 2", "4 0 1 2"));
  expect({"x:12: a polygon of 2 corners has no area, expected 3 corners"},
         replaced(text, "3 0 1 2", "2 0 1"));
  expect({"x:12: a polygon of 0 corners has no area, expected 3 corners"},
         replaced(text, "3 0 1 2", "0"));
  expect({"x:12: the number of corners is -3"}, replaced(text, "3 0 1 2", "-3 0 1 2"));
  expect({"x:12: a polygon of 4 corners has a vertex twice"},
         replaced(text, "3 0 1 2", "4 0 1 2 1"));
  expect({"x:23: found more lines than expected"}, replaced(text, "12 0\n", "11 0\n"));
}
END_TEST

START_TEST(triangles_that_are_nothing_are_read) {
  // Degenerate triangles are read as in STL files; the check of the surface removes them.
  const std::string text = surface_files::off(box);
  const SurfaceTriangles off = read(SurfaceFormat::off, replaced(text, "3 0 1 2", "3 0 1 0"));
  ck_assert(off.triangles[0] == (std::array{0, 1, 0}));
  ck_assert_uint_eq(off.triangles.size(), 12);
  const SurfaceTriangles obj =
      read(SurfaceFormat::obj, replaced(square_obj, "f 1 2 3", "f 1 1 2 2 3\nf 4 4 4 2 2"));
  ck_assert(obj.triangles == (Triangles{{0, 1, 2}, {3, 1, 1}, {0, 2, 3}}));
}
END_TEST

// ------------------------------------------------------------------------ OBJ ---------------

START_TEST(obj_forms_of_corners) {
  const std::string vertices =
      "v 0 0 0\nv 2 0 0 1\nvt 0 0\nvn 0 0 1\nv 2 2 0 0.1 0.2 0.3\nv 0 2 0\n";
  const SurfaceTriangles square = read(SurfaceFormat::obj, square_obj);
  for (const char* faces :
       {"f 1 2 3\nf 1 3 4", "f 1/1 2/7 3/9\nf 1/-1 3/ 4", "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n",
        "f 1/1/1 2/2/2 3/3/3\r\nf 1/1/1 3/3/3 4/4/4\r\n", "f -4 -3 -2\nf -4/-1 -2//-1 -1/-1/-1\n",
        "s off\nl 1 2\nmtllib none.mtl\nf 1 2 \\\n 3\nf 1\\\n3 4 # the end\n"})
    expect_the_same(read(SurfaceFormat::obj, vertices + faces), square);
  // Negative numbers count backwards from the line of the face.
  const SurfaceTriangles early =
      read(SurfaceFormat::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n");
  ck_assert(early.triangles == (Triangles{{0, 1, 2}, {0, 1, 3}}));
}
END_TEST

START_TEST(obj_names) {
  const SurfaceTriangles surface =
      read(SurfaceFormat::obj,
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no wing\nf 1 2 3\nusemtl color#f00 \nf 1 2 3\n"
           "f 1 2 3\ng upper  skin\nf 1 2 3\ng\nf 1 2 3\no\nf 1 2 3\ng unused\n");
  ck_assert(surface.tags == (Tags{1, 2, 3, 3, 4, 3, 5}));
  ck_assert(surface.tag_names == (TagNames{{2, "wing"},
                                           {3, "wing/color#f00"},
                                           {4, "wing/upper  skin/color#f00"},
                                           {5, "color#f00"}}));
}
END_TEST

START_TEST(obj_errors) {
  const auto expect = [](std::initializer_list<const char*> parts, const std::string& text) {
    expect_file_error(SurfaceFormat::obj, parts, text);
  };
  const std::string text = square_obj;
  expect({"x: holds no triangles"}, "");
  expect({"x: holds no triangles"}, "v 0 0 0\n");
  expect({"x: holds zero bytes"}, std::string("v\0", 2));
  expect({"x:2: found '-nan', expected x"}, replaced(text, "v 2 0 0", "v -nan 0 0"));
  expect({"x:2: found '1e400', expected y"}, replaced(text, "v 2 0 0", "v 2 1e400 0"));
  expect({"x:2: the line ends, expected z"}, replaced(text, "v 2 0 0", "v 2 0"));
  expect({"x:5: there is no vertex 5 among the 4 so far"}, replaced(text, "f 1 2 3", "f 1 5 3"));
  expect({"x:5: there is no vertex -5 among the 4 so far"}, replaced(text, "f 1 2 3", "f 1 -5 3"));
  expect({"x:5: there is no vertex 0 among"}, replaced(text, "f 1 2 3", "f 0 1 2"));
  expect({"x:5: found '', expected a vertex number"}, replaced(text, "f 1 2 3", "f 1 /2 3"));
  expect({"x:5: found '99999999999999999999', expected a vertex number"},
         replaced(text, "f 1 2 3", "f 1 99999999999999999999 3"));
  expect({"x:5: a polygon of 2 corners"}, replaced(text, "f 1 2 3", "f 1 2 # 3"));
  expect({"x:6: a polygon of 2 corners"}, text.substr(0, text.size() - 2) + "\\");
}
END_TEST

TEST_SUITE(test_surface_readers) {
  return run_suite(
      "surface_readers",
      {one_surface_in_all_formats, formats_by_ending, files, real_files, any_locale,
       stl_solids_and_their_names, stl_binary_that_begins_as_text, stl_bytes_behind_the_triangles,
       stl_equal_corners_are_one_vertex, stl_many_vertices, stl_errors, off_variants, off_errors,
       triangles_that_are_nothing_are_read, obj_forms_of_corners, obj_names, obj_errors});
}

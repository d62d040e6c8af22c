// SPDX-License-Identifier: BSD-3-Clause
// Surface formats with sections, PLY and TetGen's: valid variants, and invalid files.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "run_suite.hpp"
#include "surface_reading.hpp"

// ------------------------------------------------------------------------ PLY ---------------

// All optional elements and properties of a header, which the reader ignores.
START_TEST(ply_other_elements_and_properties) {
  const std::string head =
      "comment\nobj_info 3 4\nelement nothing 4000000000\nelement material 2\n"
      "property list uint8 float64 v\nproperty float e\n"
      "element vertex 3\nproperty uchar red\nproperty int16 z\nproperty float32 y\n"
      "property list ushort char names\nproperty double x\n"
      "element face 1\nproperty float area\nproperty list int uint vertex_index\n"
      "property list uchar float texcoord\nend_header\n";
  SurfaceTriangles expected;
  expected.vertices = {{0, 0, -1}, {2.5, 0, -1}, {0, 0.5, 300}};
  expected.triangles = {{2, 1, 0}};
  expected.tags = {1};
  expect_the_same(read(SurfaceFormat::ply, "ply\r\nformat ascii 1.0\r\n" + head +
                                               "2 0.5 nan inf\r\n0 7\n255 -1 0 0 0\n"
                                               "255 -1 0 2 65 66 2.5\n0 300 0.5 0 0\n"
                                               "0.1 3 2 1 0 2 1 1\n\n"),
                  expected);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string bytes = std::string("ply\nformat binary_") +
                        (order == std::endian::big ? "big" : "little") + "_endian 1.0\n" + head;
    const auto put = [&](auto... values) { (surface_files::append(bytes, values, order), ...); };
    using u8 = std::uint8_t;
    using u16 = std::uint16_t;
    using i16 = std::int16_t;
    put(u8{2}, 0.5, double{NAN}, float{INFINITY}, u8{0}, 7.0F);
    put(u8{255}, i16{-1}, 0.0F, u16{0}, 0.0);
    put(u8{255}, i16{-1}, 0.0F, u16{2}, 'A', 'B', 2.5);
    put(u8{0}, i16{300}, 0.5F, u16{0}, 0.0);
    put(0.1F, std::int32_t{3}, 2U, 1U, 0U, u8{2}, 1.0F, 1.0F);
    expect_the_same(read(SurfaceFormat::ply, bytes), expected);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      expect_file_error(SurfaceFormat::ply, {"x:"}, bytes.substr(0, length));
  }
}
END_TEST

START_TEST(ply_binary_whose_data_begin_with_a_line_end) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string bytes;
    for (const char* line :
         {"ply", "format binary_little_endian 1.0", "element vertex 3", "property uchar red",
          "property float x", "property float y", "property float z", "element face 1",
          "property list uchar int vertex_indices", "end_header"})
      bytes += line + end;
    for (int i = 0; i < 3; ++i) {
      bytes += '\n';
      for (const int x : {i, i * i, 0}) surface_files::append(bytes, static_cast<float>(x));
    }
    bytes += '\3';
    for (const std::int32_t i : {0, 1, 2}) surface_files::append(bytes, i);
    const SurfaceTriangles surface = read(SurfaceFormat::ply, bytes);
    ck_assert(surface.vertices[2] == (pnpbs::Point<3>{2, 4, 0}));
    ck_assert(surface.triangles == (Triangles{{0, 1, 2}}));
  }
}
END_TEST

START_TEST(ply_errors) {
  const auto expect = [](std::initializer_list<const char*> parts, const std::string& text) {
    expect_file_error(SurfaceFormat::ply, parts, text);
  };
  const std::string text = surface_files::ply_text(box);
  expect({"x:1: the file ends, expected 'ply'"}, "");
  expect({"x:1: found 'plyx', expected 'ply'"}, replaced(text, "ply", "plyx"));
  expect({"x:2: found 'binary', expected 'ascii', 'binary_little_endian' or"},
         replaced(text, "ascii", "binary"));
  expect({"the header has no line 'format'"}, replaced(text, "format ascii 1.0", "comment"));
  expect({"x:3: found 'commend', expected a line of the header"},
         replaced(text, "comment", "commend"));
  expect({"x:3: found a property before the first element"},
         replaced(text, "comment a box", "property int a"));
  expect({"x:4: found '-8.0', expected the number of vertex"},
         replaced(text, "vertex 8", "vertex -8.0"));
  expect({"x:4: the number of vertex is -8"}, replaced(text, "vertex 8", "vertex -8"));
  expect({"x:5: found 'real', expected a type"}, replaced(text, "double x", "real x"));
  expect({"x:5: the line ends, expected the name of a property"},
         replaced(text, "double x", "double"));
  expect({"x:9: the length of a list has a real type, expected an integer type"},
         replaced(text, "uchar int", "float int"));
  expect({"the file ends, expected a line of the header"},
         text.substr(0, text.find("element face")));
  expect({"the header has no property z of vertices"}, replaced(text, "double z", "double w"));
  expect({"the header has no property z"}, replaced(text, "double z", "list uchar double z"));
  for (const char* list :
       {"list uchar int vertices", "list uchar float vertex_index", "int vertex_indices"}) {
    expect({"the header has no list of integers 'vertex_indices' of faces"},
           replaced(text, "list uchar int vertex_indices", list));
  }
  expect({"found no vertices"}, replaced(text, "vertex 8", "point 8"));
  expect({"more than 2147483647 vertices"}, replaced(text, "vertex 8", "vertex 2147483648"));
  expect({"x:12: found 'nan', expected y"}, replaced(text, "\n1 2 0\n", "\n1 nan 0\n"));
  expect({"x:19: there is no vertex 8, expected 0 to 7"}, replaced(text, "3 0 1 2", "3 0 8 2"));
  expect({"x:19: the length of vertex_indices is negative"}, replaced(text, "3 0 1 2", "-3 0 1 2"));
  expect({"x:19: a polygon of 1 corners has no area, expected 3 corners"},
         replaced(text, "3 0 1 2", "1 0"));
  expect({"the file ends after 12 of 13 face"}, replaced(text, "face 12", "face 13"));
  expect({"x:30: found more than the header declares"}, replaced(text, "face 12", "face 11"));
  expect({"x: holds zero bytes"}, text + std::string("\0", 1));
  expect({"x: holds no triangles"}, text.substr(0, text.find("element face")) + "end_header\n" +
                                        surface_files::vertex_lines(box, ""));

  const std::string bytes = surface_files::ply_binary<float>(box, std::endian::little);
  const std::size_t body = bytes.find("end_header\n") + 11;
  std::string bad = bytes;
  const float nan = NAN;
  std::memcpy(bad.data() + body + 16, &nan, 4);
  expect({("x: at byte " + std::to_string(body + 16) + ": found nan, expected y").c_str()}, bad);
  expect({"the file ends, expected y"}, bytes.substr(0, body + 6));
  expect({"the file ends after 1 of 8 vertex"}, bytes.substr(0, body + 12));
  expect({"the file ends, expected a vertex number"}, bytes.substr(0, bytes.size() - 1));
  expect({"found more than the header declares"}, bytes + "\n");
  expect({"the file ends after 8 of 2147483647 vertex"},
         replaced(bytes, "vertex 8", "vertex 2147483647").substr(0, body + 9 + 96));
  // A polygon of 2^32 corners in a file with a hundred bytes left.
  expect({"the file ends, expected a vertex number"},
         replaced(bytes, "uchar int", "uint uchar").substr(0, body + 1 + 96) +
             std::string(4, '\xff') + std::string(100, '\0'));
}
END_TEST

// ------------------------------------------------------------------------ TetGen ------------

START_TEST(tetgen_sections) {
  const std::string text =
      "# a tetrahedron in a tetrahedron\n8 3 1 1\n"
      "1 0 0 0 7.5 0\n2 9 0 0 x 0\n3 0 9 0 0 0\n4 0 0 9 0 0\n"
      "5 1 1 1 0 0\n6 2 1 1 0 0\n7 1 2 1 0 0\n8 1 1 2 0 0\n";
  const SurfaceTriangles smesh =
      read(SurfaceFormat::smesh, text +
                                     "8 1\n3 1 3 2 5\n3 1 2 4 0\n3 2 3 4 -6\n3 3 1\n  4 7 # rest\n"
                                     "3 5 6 7 8\n3 5 8 6 8\n3 6 8 7 8\n3 7 8 5 8\n"
                                     "1\n1 1.1 1.2 1.3\n1\n1 5 5 5 17 0.1\n");
  ck_assert(smesh.tags == (Tags{5, 1, -6, 7, 8, 8, 8, 8}));
  ck_assert(smesh.triangles[3] == (std::array{2, 0, 3}));
  ck_assert(smesh.divides);
  ck_assert(smesh.holes == (std::vector<pnpbs::Point<3>>{{1.1, 1.2, 1.3}}));
  const SurfaceTriangles poly =
      read(SurfaceFormat::poly,
           text +
               "7 1\n1 0 5\n3 1 3 2\n1 0 0\n3 1 2 4\n1 0 -6\n3 2 3 4\n1 0 7\n3 3 1\n4\n"
               "2 0 8\n3 5 6 7\n3 5 8 6\n1 0 8\n3 6 8 7\n1 0 8\n3 7 8 5\n1\n1 1.1 1.2 1.3\n");
  expect_the_same(poly, smesh);
  ck_assert(poly.holes == smesh.holes && poly.divides);
}
END_TEST

START_TEST(tetgen_node_file) {
  for (const std::string ending : {".poly", ".smesh"}) {
    const std::string path = work_path("split.v1" + ending);
    const bool is_poly = ending == ".poly";
    write(path, is_poly ? surface_files::poly(box, false) : surface_files::smesh(box, false));
    write(work_path("split.v1.node"), surface_files::node(box));
    expect_the_same(pnpbs::read_surface(path), box);
    write(work_path("split.v1.node"), "8 3\n0 0 0 zero\n");
    expect_error(pnpbs::ErrorKind::file, {"split.v1.node:2: found 'zero', expected z"},
                 [&] { pnpbs::read_surface(path); });
    std::remove(work_path("split.v1.node").c_str());
    expect_error(pnpbs::ErrorKind::file, {"split.v1.node: cannot be read"},
                 [&] { pnpbs::read_surface(path); });
    std::remove(path.c_str());
  }
  expect_file_error(SurfaceFormat::poly, {"x:1: 0 vertices mean a separate .node file"},
                    surface_files::poly(box, false));
}
END_TEST

START_TEST(tetgen_errors) {
  const auto expect = [](std::initializer_list<const char*> parts, const std::string& text) {
    expect_file_error(SurfaceFormat::poly, parts, text);
  };
  const std::string text = surface_files::poly(box);
  expect({"x:1: found dimension 2, expected 3"}, "8 2 0 0\n");
  expect({"x:1: the file ends after 0 of 8 vertices"}, "8\n");
  expect({"x:2: the first vertex is 2, expected 0 or 1"}, "8 3\n2 0 0 0\n");
  expect({"x:3: found '1e61', expected y"}, replaced(text, "1 1 2 0", "1 1 1e61 0"));
  expect({"the file ends, expected the number of facets"}, surface_files::node(box));
  expect({"x:10: the number of facets is -12"}, replaced(text, "\n12 0\n", "\n-12 0\n"));
  expect({"x:10: found 2, expected the number of boundary markers"},
         replaced(text, "\n12 0\n", "\n12 2\n"));
  expect({"x:11: the facet has no polygon"}, replaced(text, "1\n3 0 1 2", "0\n3 0 1 2"));
  expect({"x:11: the facet has holes: divide it into polygons without holes"},
         replaced(text, "1\n3 0 1 2", "2 1\n3 0 1 2"));
  expect({"x:11: the line ends, expected a boundary marker"},
         replaced(text, "\n12 0\n", "\n12 1\n"));
  expect({"x:12: there is no vertex 8, expected 0 to 7"}, replaced(text, "3 0 1 2", "3 0 1 8"));
  expect({"x:12: a polygon of 2 corners has no area, expected 3 corners"},
         replaced(text, "3 0 1 2", "2 0 1"));
  expect({"the file ends after 12 of 13 facets"},
         replaced(text, "\n12 0\n", "\n13 0\n").substr(0, text.size() - 2));
  expect({"the file ends after 38 of 4000000000 corners"},
         replaced(text, "3 3 4 7\n0\n", "4000000000 3 4 7" + std::string(70, ' ')) +
             "\n0 1 2 3 4\n\n0 1 2 3 4 0 1 2 3 4 0 1 2 3 4 0 1 2 3 4 0 1 2 3 4 0 1 2 3 4\n");
  expect({"the file ends, expected the number of holes"}, text.substr(0, text.size() - 2));
  expect({"found more lines than expected"}, text + "0\n0\n");
}
END_TEST

TEST_SUITE(test_surface_sections) {
  return run_suite("surface_sections",
                   {ply_other_elements_and_properties, ply_binary_whose_data_begin_with_a_line_end,
                    ply_errors, tetgen_sections, tetgen_node_file, tetgen_errors});
}

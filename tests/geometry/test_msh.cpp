// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's files: the same mesh in all versions, the domains built from them, and invalid files.
#include <cmath>
#include <functional>
#include <string>

#include "domain/from_files.hpp"
#include "expect_error.hpp"
#include "msh_files.hpp"
#include "run_suite.hpp"

namespace {

using msh_files::Entity;
using msh_files::Kind;
using msh_files::Mesh;
using pnpbs::BoundaryTriangle;
using pnpbs::ErrorKind;
using pnpbs::PlaneDomain;
using pnpbs::VolumeDomain;

constexpr Kind kinds[] = {Kind::text, Kind::little_endian, Kind::big_endian};

VolumeDomain body_of(const std::string& bytes) {
  VolumeDomain body;
  add_msh(body, pnpbs::parse_msh(bytes, "m"), 40);
  body.check();
  return body;
}

PlaneDomain plane_of(const std::string& bytes, double corner_angle = 40) {
  PlaneDomain plane;
  add_msh(plane, pnpbs::parse_msh(bytes, "m"), corner_angle);
  plane.check();
  return plane;
}

// Returns the area of the triangles with this tag, either those on the boundary or those inside.
double area_of(const VolumeDomain& body, std::int32_t tag, bool inside) {
  double area = 0;
  for (const BoundaryTriangle& facet : body.mesh().facets) {
    if (facet.tag != tag || inside != (facet.front_inside && facet.back_inside)) continue;
    std::array<pnpbs::Point<3>, 3> x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = body.mesh().nodes[static_cast<std::size_t>(facet.nodes[k])].position;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      const double n =
          (x[1][l] - x[0][l]) * (x[2][m] - x[0][m]) - (x[1][m] - x[0][m]) * (x[2][l] - x[0][l]);
      square += n * n;
    }
    area += std::sqrt(square) / 2;
  }
  return area;
}

void expect_near(double value, double expected) {
  ck_assert_msg(std::fabs(value - expected) < 1e-12, "%.15g, not %.15g", value, expected);
}

// Returns the text with one part replaced. Fails if `what` does not occur.
std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  ck_assert_msg(at != std::string::npos, "no '%s'", what.c_str());
  return text.replace(at, what.size(), with);
}

void expect_refused(const std::string& bytes, std::initializer_list<const char*> parts) {
  expect_error(ErrorKind::file, parts, [&] { body_of(bytes); });
}

// Adds a square with sides of 2 size about the origin, counter-clockwise, with its lines.
void add_square(Mesh& mesh, double size, std::int32_t group) {
  const auto first = static_cast<std::int32_t>(mesh.nodes.size()) + 1;
  for (std::int32_t i = 0; i < 4; ++i) {
    mesh.nodes.push_back({(i % 3 == 0 ? -1 : 1) * size, (i < 2 ? -1 : 1) * size, 0.5});
    mesh.elements.push_back({1, group, group, {first + i, first + (i + 1) % 4}});
  }
}

// Returns two cubes, one hexahedron each, on top of each other and in different groups.
Mesh tower() {
  Mesh mesh;
  for (int z = 0; z < 3; ++z)
    for (int i = 0; i < 4; ++i)
      mesh.nodes.push_back({double(i == 1 || i == 2), double(i / 2), double(z)});
  mesh.elements.push_back({5, 1, 1, {1, 2, 3, 4, 5, 6, 7, 8}});
  mesh.elements.push_back({5, 2, 2, {5, 6, 7, 8, 9, 10, 11, 12}});
  mesh.names = "3 1 \"lower\"\n3 2 \"upper\"\n2 9 \"top\"\n";
  return mesh;
}

}  // namespace

START_TEST(one_mesh_in_all_versions) {
  Mesh cube = msh_files::cube();
  for (const std::int64_t step : {1, 3}) {
    cube.step = step;
    cube.first_node = 2 * step;
    for (const Kind kind : kinds)
      for (const std::string& bytes :
           {version_41(cube, msh_files::sides_of_cube(), kind), version_22(cube, kind)}) {
        const VolumeDomain body = body_of(bytes);
        expect_near(body.volume(), 1);
        for (std::int32_t tag = 11; tag < 17; ++tag) {
          expect_near(area_of(body, tag, false), 1);
          const std::string* name = body.names().find({2, tag});
          ck_assert(name && *name == "side " + std::to_string(tag - 11));
        }
        ck_assert(body.warnings().empty());
      }
  }
}
END_TEST

START_TEST(entities_are_tags_without_groups) {
  Mesh cube = msh_files::cube();
  cube.names.clear();
  for (msh_files::Element& element : cube.elements) element.group = 0;
  for (std::int32_t tag = 1; tag < 7; ++tag)
    expect_near(area_of(body_of(version_22(cube, Kind::text)), tag, false), 1);
  // Sides without a group get the smallest free number.
  cube.elements[0].group = cube.elements[1].group = 8;
  const VolumeDomain body = body_of(version_22(cube, Kind::text));
  expect_near(area_of(body, 8, false), 1);
  expect_near(area_of(body, 7, false), 5);
}
END_TEST

START_TEST(elements_of_volumes_tell_the_sides) {
  Mesh mesh = tower();
  mesh.elements.push_back({3, 9, 9, {9, 10, 11, 12}});
  for (const Kind kind : kinds) {
    const VolumeDomain body = body_of(version_22(mesh, kind));
    expect_near(body.volume(), 2);
    expect_near(area_of(body, 9, false), 1);
    expect_near(area_of(body, 3, false), 9);  // facets that the file does not contain
    expect_near(area_of(body, 3, true), 1);   // the interface of the groups
    ck_assert_int_eq(body.warnings().size(), 0);
    ck_assert_int_eq(body.regions()->tag_at({0.4, 0.5, 0.3}), mesh.elements[0].group);
    ck_assert_int_eq(body.regions()->tag_at({0.4, 0.5, 1.3}), mesh.elements[1].group);
  }
  // A single group has no interface inside the body unless the file contains its facets.
  mesh.elements[1].group = 1;
  ck_assert(area_of(body_of(version_22(mesh, Kind::text)), 2, true) == 0);
  ck_assert_ptr_null(body_of(version_22(mesh, Kind::text)).regions());
  mesh.elements.push_back({3, 10, 10, {5, 6, 7, 8}});
  expect_near(area_of(body_of(version_22(mesh, Kind::text)), 10, true), 1);
}
END_TEST

START_TEST(entities_tell_the_sides) {
  // The cube contains another cube, which is a volume as well or is empty.
  Mesh mesh = msh_files::cube();
  const Mesh inner = msh_files::cube();
  for (const auto& x : inner.nodes)
    mesh.nodes.push_back({0.25 + 0.5 * x[0], 0.25 + 0.5 * x[1], 0.25 + 0.5 * x[2]});
  for (msh_files::Element element : inner.elements) {
    for (std::int32_t& node : element.nodes) node += 8;
    element.entity += 10;
    mesh.elements.push_back(element);
  }
  std::vector<Entity> entities = msh_files::sides_of_cube();
  for (Entity side : msh_files::sides_of_cube()) {
    side.tag += 10;
    entities.push_back(side);
  }
  entities.push_back({3, 1, 0, {1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16}});
  expect_near(body_of(version_41(mesh, entities, Kind::text)).volume(), 1 - 0.125);
  entities.push_back({3, 2, 0, {11, 12, 13, 14, 15, 16}});
  const VolumeDomain whole = body_of(version_41(mesh, entities, Kind::little_endian));
  expect_near(whole.volume(), 1);
  expect_near(area_of(whole, 14, true), 0.25);
  // Only one volume is in a group, so the other is not part of the body.
  entities[entities.size() - 2].group = 5;
  expect_near(body_of(version_41(mesh, entities, Kind::text)).volume(), 1 - 0.125);
  // Nested surfaces bound cavities if the file has no entities.
  expect_near(body_of(version_22(mesh, Kind::text)).volume(), 1 - 0.125);
}
END_TEST

START_TEST(sheets_and_partitions_are_inner_by_their_place) {
  Mesh mesh = msh_files::cube();
  mesh.elements.push_back({2, 21, 21, {1, 4, 8}});  // a partition from edge to edge
  mesh.elements.push_back({2, 21, 21, {1, 8, 5}});
  mesh.nodes.push_back({0.7, 0.3, 0.2});
  mesh.nodes.push_back({0.8, 0.3, 0.2});
  mesh.nodes.push_back({0.7, 0.3, 0.4});
  mesh.elements.push_back({2, 22, 22, {9, 10, 11}});  // a separate sheet
  const VolumeDomain body = body_of(version_22(mesh, Kind::text));
  expect_near(body.volume(), 1);
  expect_near(area_of(body, 21, true), std::sqrt(2));
  expect_near(area_of(body, 22, true), 0.01);
  // A cube that lacks a triangle is reported as open, and so is a sheet outside.
  Mesh open = msh_files::cube();
  open.elements.pop_back();
  expect_error(ErrorKind::domain, {"not closed"}, [&] { body_of(version_22(open, Kind::text)); });
  for (std::size_t i = 8; i < 11; ++i) mesh.nodes[i][0] += 1;
  expect_error(ErrorKind::domain, {"not closed"}, [&] { body_of(version_22(mesh, Kind::text)); });
}
END_TEST

START_TEST(roles_by_tag) {
  Mesh mesh = msh_files::cube();
  VolumeDomain body = body_of(version_22(mesh, Kind::text));
  const pnpbs::Point<3> middle{0.5, 0.5, 0.5};
  body.add_ball(middle, 0.25, 3);
  body.check();
  ck_assert(body.volume() < 0.95);
  body.set_role(3, pnpbs::SurfaceRole::inner);
  body.check();
  expect_near(body.volume(), 1);
  ck_assert(area_of(body, 3, true) > 0.7);
  body.set_role(4, pnpbs::SurfaceRole::inner);
  expect_error(ErrorKind::domain, {"the tag 4"}, [&] { body.check(); });
}
END_TEST

START_TEST(curves_and_points) {
  Mesh mesh = msh_files::cube();
  mesh.nodes.push_back({0.5, 0.4, 0.3});
  mesh.nodes.push_back({0.6, 0.4, 0.3});
  mesh.elements.push_back({1, 31, 31, {9, 10}});
  mesh.elements.push_back({1, 0, 32, {1, 2}});  // in no group
  mesh.elements.push_back({15, 33, 33, {8}});
  mesh.elements.push_back({15, 0, 34, {7}});
  const VolumeDomain body = body_of(version_22(mesh, Kind::text));
  int segments = 0;
  for (const BoundaryTriangle& facet : body.mesh().facets)
    if (facet.nodes[1] == facet.nodes[2] && facet.nodes[0] != facet.nodes[1]) {
      ck_assert_int_eq(facet.tag, 31);
      ++segments;
    }
  ck_assert_int_eq(segments, 1);
  ck_assert_int_eq(body.fixed_nodes().size(), 1);
  ck_assert_int_eq(body.fixed_nodes()[0].tag, 33);
}
END_TEST

START_TEST(plane_by_its_elements) {
  Mesh mesh;
  add_square(mesh, 2, 5);
  mesh.elements.clear();
  add_square(mesh, 1, 6);
  for (std::int32_t i = 1; i < 5; ++i)
    mesh.elements.push_back({3, 7, 7, {i, i % 4 + 1, i % 4 + 5, i + 4}});
  mesh.elements.push_back({1, 8, 8, {1, 5}});
  for (const Kind kind : kinds) {
    const std::string bytes = version_22(mesh, kind);
    ck_assert_int_eq(pnpbs::parse_msh(bytes, "m").dimension(), 2);
    const PlaneDomain plane = plane_of(bytes);
    expect_near(plane.area(), 12);
    int inner = 0;
    double derived = 0;
    for (const pnpbs::BoundaryCurve& curve : plane.curves()) {
      inner += curve.left_inside && curve.right_inside;
      if (curve.tag == 1) derived += pnpbs::distance<2>(curve.points.front(), curve.points.back());
    }
    ck_assert_int_eq(inner, 1);
    expect_near(derived, 16);  // the outer square, which the file does not contain
  }
}
END_TEST

START_TEST(plane_of_lines_alone) {
  Mesh mesh;
  add_square(mesh, 3, 5);
  add_square(mesh, 2, 6);
  add_square(mesh, 1, 7);
  mesh.nodes.push_back({-2.7, 2.5, 0.5});
  mesh.nodes.push_back({2.7, 2.5, 0.5});
  mesh.nodes.push_back({2.7, 2.8, 0.5});
  mesh.elements.push_back({1, 8, 8, {13, 14}});
  mesh.elements.push_back({1, 8, 8, {14, 15}});
  mesh.elements.push_back({15, 9, 9, {1}});
  const PlaneDomain plane = plane_of(version_22(mesh, Kind::text));
  expect_near(plane.area(), 36 - 16 + 4);
  // Entities of version 4.1 define what curves bound. Here the last square divides a surface.
  std::vector<Entity> entities{{1, 5, 5, {}},     {1, 6, 6, {}},  {1, 7, 7, {}},    {1, 8, 8, {}},
                               {2, 1, 0, {5, 6}}, {2, 2, 0, {7}}, {2, 3, 0, {6, 7}}};
  std::ranges::sort(entities, {}, &Entity::dimension);
  expect_near(plane_of(version_41(mesh, entities, Kind::text)).area(), 36);
}
END_TEST

// Except for corners, vertices of a mesh define the shape only.
START_TEST(plane_of_smooth_curves) {
  Mesh mesh;
  constexpr std::int32_t n = 40;
  for (std::int32_t i = 0; i < n; ++i) {
    const double turn = 2 * 3.14159265358979 * i / n;
    mesh.nodes.push_back({std::cos(turn), std::sin(turn), 0});
    mesh.elements.push_back({1, i < n / 2 ? 3 : 4, 1, {i + 1, (i + 1) % n + 1}});
  }
  const std::string bytes = version_22(mesh, Kind::text);
  ck_assert_int_eq(plane_of(bytes).corners().size(), 2);  // where the groups meet
  ck_assert_int_eq(plane_of(bytes, 0).corners().size(), n);
}
END_TEST

START_TEST(higher_order) {
  Mesh mesh = msh_files::cube();
  mesh.elements[0].type = 9;
  mesh.elements[0].nodes.insert(mesh.elements[0].nodes.end(), {4, 5, 6});
  const VolumeDomain body = body_of(version_22(mesh, Kind::little_endian));
  expect_near(body.volume(), 1);
  ck_assert_int_eq(body.warnings().size(), 1);
  ck_assert(body.warnings()[0].message.text().find("1 elements of higher order") !=
            std::string::npos);
}
END_TEST

START_TEST(elements_in_several_groups) {
  Mesh mesh = msh_files::cube();
  mesh.elements.push_back({2, 99, 1, {5, 7, 1}});
  const VolumeDomain body = body_of(version_22(mesh, Kind::text));
  expect_near(area_of(body, 11, false), 1);
  ck_assert(area_of(body, 99, false) == 0);
}
END_TEST

START_TEST(what_is_refused) {
  const Mesh cube = msh_files::cube();
  const std::string text = version_41(cube, msh_files::sides_of_cube(), Kind::text);
  const std::string old = version_22(cube, Kind::text);
  const std::string binary = version_41(cube, msh_files::sides_of_cube(), Kind::little_endian);
  body_of(text);
  body_of(binary);
  expect_refused("", {"m:1: the file ends, expected '$MeshFormat'"});
  expect_refused("mshid=1\n", {"m:1: found 'mshid=1', expected '$MeshFormat'"});
  expect_refused(replaced(text, "4.1 0 8", "4 0 8"),
                 {"m:2: found '4', expected version 4.1 or 2.2"});
  expect_refused(replaced(text, "4.1 0 8", "4.1 2 8"), {"m:2: found '2', expected 0 for text"});
  expect_refused(replaced(text, "4.1 0 8", "4.1 0 4"), {"m:2: found '4', expected numbers of 8"});
  expect_refused(text.substr(0, text.find("$Nodes")), {"the file ends, expected '$Nodes'"});
  expect_refused(text.substr(0, text.find("$Elements")), {"the file ends, expected '$Elements'"});
  expect_refused(replaced(text, "$EndNodes", "$EndNode"),
                 {"found '$EndNode', expected '$EndNodes'"});
  expect_refused(replaced(text, "$Entities", "$PartitionedEntities"), {"partitioned"});
  expect_refused(replaced(text, "1 8 1 8", "1 800000000000 1 8"),
                 {"no room for 800000000000 nodes"});
  expect_refused(replaced(text, "1 8 1 8", "1 7 1 8"), {"more nodes than the 7 announced"});
  expect_refused(replaced(text, "1 8 1 8", "1 9 1 8"), {"found 8 of 9 nodes"});
  expect_refused(replaced(text, "12 12 1 12", "11 12 1 12"), {"found 11 of 12 elements"});
  expect_refused(replaced(old, "2 2 11 1 1 5 7", "77 2 11 1 1 5 7"),
                 {"elements of type 77 cannot be read"});
  expect_refused(replaced(old, "2 2 11 1 1 5 7", "2 2 11 1 1 5 70"), {"there is no node 70"});
  expect_refused(replaced(old, "2 2 11 1 1 5 7", "2 2 11 1 1 5 5"), {"has node 5 twice"});
  expect_refused(replaced(old, "\"side 0\"", "side 0"), {"quotation"});
  expect_refused(binary.substr(0, binary.size() - 100), {"m: at byte", "the file ends"});
  Mesh lines;
  add_square(lines, 1, 5);
  expect_refused(version_22(lines, Kind::text), {"holds no triangles"});
  expect_error(ErrorKind::file, {"expected one in a plane"}, [&] { plane_of(old); });
  Mesh shared = tower();
  shared.elements.push_back({4, 3, 3, {1, 2, 3, 9}});
  shared.elements.push_back({4, 3, 3, {1, 2, 3, 10}});
  shared.elements.push_back({4, 3, 3, {1, 2, 3, 11}});
  expect_refused(version_22(shared, Kind::text), {"3 elements share the nodes 1, ", "two at most"});
}
END_TEST

TEST_SUITE(test_msh) {
  return run_suite(
      "msh", {one_mesh_in_all_versions, entities_are_tags_without_groups,
              elements_of_volumes_tell_the_sides, entities_tell_the_sides,
              sheets_and_partitions_are_inner_by_their_place, roles_by_tag, curves_and_points,
              plane_by_its_elements, plane_of_lines_alone, plane_of_smooth_curves, higher_order,
              elements_in_several_groups, what_is_refused});
}

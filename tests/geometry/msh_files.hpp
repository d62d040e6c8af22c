// SPDX-License-Identifier: BSD-3-Clause
// Small meshes as files in Gmsh's format.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace msh_files {

struct Element {
  int type;
  std::int32_t group, entity;
  std::vector<std::int32_t> nodes;  // numbers from 1
};

struct Mesh {
  std::vector<std::array<double, 3>> nodes;
  std::vector<Element> elements;
  std::string names;  // lines of $PhysicalNames
  std::int64_t first_node = 1, step = 1;

  std::int64_t tag(std::int64_t node) const { return first_node + step * (node - 1); }
};

inline int dimension_of(int type) {
  switch (type) {
    case 15:
      return 0;
    case 1:
    case 8:
      return 1;
    case 2:
    case 3:
    case 9:
      return 2;
    default:
      return 3;
  }
}

enum class Kind { text, little_endian, big_endian };

// Writes numbers one after the other, as text or binary.
class Writer {
 public:
  explicit Writer(Kind kind) : kind_(kind) {}

  void text(const std::string& line) { bytes_ += line; }
  template <class Number>
  void number(Number value, char after = ' ') {
    if (kind_ == Kind::text) {
      if constexpr (std::is_same_v<Number, double>) {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.17g", value);
        bytes_ += digits;
      } else {
        bytes_ += std::to_string(value);
      }
      bytes_ += after;
      return;
    }
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    const bool big = std::endian::native == std::endian::big;
    if (big != (kind_ == Kind::big_endian)) std::reverse(raw.begin(), raw.end());
    bytes_.append(raw.data(), raw.size());
  }
  std::string take() { return std::move(bytes_); }

 private:
  Kind kind_;
  std::string bytes_;
};

inline void write_beginning(const Mesh& mesh, const std::string& version, Kind kind, Writer& out) {
  out.text("$MeshFormat\n" + version + (kind == Kind::text ? " 0 8\n" : " 1 8\n"));
  if (kind != Kind::text) {
    out.number(std::int32_t{1});
    out.text("\n");
  }
  out.text("$EndMeshFormat\n");
  const auto names = std::count(mesh.names.begin(), mesh.names.end(), '\n');
  if (names > 0)
    out.text("$PhysicalNames\n" + std::to_string(names) + "\n" + mesh.names +
             "$EndPhysicalNames\n");
}

// An entity of version 4.1 with its dimension, tag and group. `bounded_by` are the sides of a
// volume or surface.
struct Entity {
  int dimension;
  std::int32_t tag, group;
  std::vector<std::int32_t> bounded_by;
};

inline std::string version_41(const Mesh& mesh, const std::vector<Entity>& entities, Kind kind) {
  Writer out(kind);
  write_beginning(mesh, "4.1", kind, out);
  out.text("$Entities\n");
  for (int d = 0; d < 4; ++d)
    out.number<std::int64_t>(std::count_if(entities.begin(), entities.end(),
                                           [d](const Entity& e) { return e.dimension == d; }),
                             d < 3 ? ' ' : '\n');
  for (const Entity& entity : entities) {
    out.number(entity.tag);
    for (int k = 0; k < (entity.dimension == 0 ? 3 : 6); ++k) out.number(0.5);
    out.number<std::int64_t>(entity.group != 0);
    if (entity.group != 0) out.number(entity.group);
    if (entity.dimension > 0) {
      out.number<std::int64_t>(std::ssize(entity.bounded_by));
      for (const std::int32_t side : entity.bounded_by) out.number(side);
    }
    if (kind == Kind::text) out.text("\n");
  }
  out.text("\n$EndEntities\n$Nodes\n");
  const auto n = std::ssize(mesh.nodes);
  for (const std::int64_t count : {std::int64_t{1}, std::int64_t{n}, mesh.tag(1), mesh.tag(n)})
    out.number(count);
  for (const std::int32_t block : {2, 1, 0}) out.number(block);
  out.number<std::int64_t>(n, '\n');
  for (std::int64_t i = 1; i <= n; ++i) out.number(mesh.tag(i), '\n');
  for (const auto& x : mesh.nodes)
    for (const std::size_t k : {0, 1, 2}) out.number(x[k], k < 2 ? ' ' : '\n');
  out.text("\n$EndNodes\n$Elements\n");
  const auto m = std::ssize(mesh.elements);
  for (const std::int64_t count :
       {std::int64_t{m}, std::int64_t{m}, std::int64_t{1}, std::int64_t{m}})
    out.number(count);
  std::int64_t number = 0;
  for (const Element& element : mesh.elements) {
    for (const std::int32_t value : {dimension_of(element.type), element.entity, element.type})
      out.number(value);
    out.number<std::int64_t>(1, '\n');
    out.number(++number);
    for (const std::int32_t node : element.nodes) out.number(mesh.tag(node));
    if (kind == Kind::text) out.text("\n");
  }
  out.text("\n$EndElements\n");
  return out.take();
}

inline std::string version_22(const Mesh& mesh, Kind kind) {
  Writer out(kind);
  write_beginning(mesh, "2.2", kind, out);
  out.text("$Nodes\n" + std::to_string(mesh.nodes.size()) + "\n");
  std::int64_t i = 0;
  for (const auto& x : mesh.nodes) {
    out.number(static_cast<std::int32_t>(mesh.tag(++i)));
    for (const std::size_t k : {0, 1, 2}) out.number(x[k], k < 2 ? ' ' : '\n');
  }
  out.text("\n$EndNodes\n$Elements\n" + std::to_string(mesh.elements.size()) + "\n");
  std::int32_t number = 0;
  for (const Element& element : mesh.elements) {
    ++number;
    if (kind == Kind::text) out.number(number);
    out.number<std::int32_t>(element.type);
    if (kind != Kind::text) out.number<std::int32_t>(1);  // number of elements of this type
    out.number<std::int32_t>(2);                          // number of tags
    if (kind != Kind::text) out.number(number);
    out.number(element.group);
    out.number(element.entity);
    for (const std::int32_t node : element.nodes)
      out.number(static_cast<std::int32_t>(mesh.tag(node)));
    if (kind == Kind::text) out.text("\n");
  }
  out.text("\n$EndElements\n");
  return out.take();
}

// Returns a cube with two triangles on each side. Each side is a group (11 to 16) and an entity (1
// to 6).
inline Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.nodes.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  const std::int32_t sides[6][4] = {{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5},
                                    {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}};
  for (std::int32_t s = 0; s < 6; ++s) {
    const auto& [a, b, c, d] = sides[s];
    mesh.elements.push_back({2, 11 + s, 1 + s, {a, b, c}});
    mesh.elements.push_back({2, 11 + s, 1 + s, {a, c, d}});
    mesh.names += "2 " + std::to_string(11 + s) + " \"side " + std::to_string(s) + "\"\n";
  }
  return mesh;
}

inline std::vector<Entity> sides_of_cube() {
  std::vector<Entity> entities;
  for (std::int32_t s = 0; s < 6; ++s) entities.push_back({2, 1 + s, 11 + s, {}});
  return entities;
}

}  // namespace msh_files

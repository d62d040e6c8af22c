// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a file of Gmsh's holds it: the MSH file format, versions 4.1 and 2.2, text and binary
// (Gmsh reference manual, https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "base/warning.hpp"
#include "formats/group_names.hpp"

namespace pnpbs {

enum class MshShape { point, line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };
inline constexpr std::array kMshCorners{1, 2, 3, 4, 4, 8, 6, 5};
inline constexpr std::array kMshDimensions{0, 1, 2, 2, 3, 3, 3, 3};
inline constexpr std::size_t kMshShapes = kMshCorners.size();

// What elements of one shape lie in: an entity of the geometry, perhaps in a physical group.
struct MshRegion {
  int dimension;
  std::int32_t entity;
  std::int32_t group;  // its tag; 0: in none
  int bounds = 0;      // so many entities of the next dimension say that it bounds them
};

struct MshCells {
  std::vector<std::int32_t> corners;  // as many of each as its shape has; nodes from 0
  std::vector<std::int32_t> regions;  // of each

  std::size_t count() const { return regions.size(); }
};

// Values at nodes, of one $NodeData section.
struct MshNodeValues {
  std::string name;
  std::int32_t components;
  std::vector<std::int64_t> node_tags;
  std::vector<double> values;  // [node_tags][components]
};

struct MshMesh {
  std::string name;  // of the file
  std::vector<Point<3>> nodes;
  std::vector<std::int64_t> node_tags;  // what the file calls them
  std::vector<MshRegion> regions;
  std::array<MshCells, kMshShapes> cells;
  GroupNames names;
  std::vector<MshNodeValues> node_values;  // if they are wanted
  std::vector<Warning> warnings;

  const MshCells& of(MshShape shape) const { return cells[static_cast<std::size_t>(shape)]; }
  // Has it any elements of this dimension?
  bool has(int dimension) const;
  // Of the domain that it describes: 2 if all of it lies in a plane of constant z.
  int dimension() const;
};

// Throws Error(ErrorKind::file, "path:line: ...") or, from binary files, "path: at byte 84: ...".
// Elements of higher order become straight ones between their corners.
MshMesh read_msh(const std::string& path);

// By the ending of the file's name, in capitals or not.
bool is_msh(const std::string& path);

// The same from memory. `name` stands for the file in messages.
enum class MshWanted { mesh, mesh_and_node_values };
MshMesh parse_msh(std::string_view bytes, const std::string& name,
                  MshWanted wanted = MshWanted::mesh);

// Leaves one of each set of elements with the same corners, the first: in version 2.2 an element in
// several physical groups is there once for each.
void remove_repeated(MshMesh& mesh);

// Tags for the elements of this dimension, by region: that of their physical group. Without one
// they have, if no element of this dimension has any, the number of their entity, else the least
// positive tag that is free.
std::vector<std::int32_t> tags_of_regions(const MshMesh& mesh, int dimension);
// The least positive number that is neither a group's nor an entity's, of whatever dimension.
std::int32_t free_tag(const MshMesh& mesh);

}  // namespace pnpbs

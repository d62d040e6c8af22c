// SPDX-License-Identifier: BSD-3-Clause
// The contents of a file in Gmsh's MSH format, versions 4.1 and 2.2, text and binary (Gmsh
// reference manual, https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format).
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

// The geometric entity that elements lie in, and its physical group.
struct MshRegion {
  int dimension;
  std::int32_t entity;
  std::int32_t group;  // tag of the physical group; 0: none
  int bounds = 0;      // number of entities of the next dimension that it bounds
};

// The elements of one shape.
struct MshCells {
  // Indices of nodes from 0; as many per element as the shape has corners.
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> regions;  // region of each element, as index in MshMesh::regions

  std::size_t count() const { return regions.size(); }
};

// Values at nodes of one $NodeData section.
struct MshNodeValues {
  std::string name;
  std::int32_t components;
  std::vector<std::int64_t> node_tags;
  std::vector<double> values;  // [node_tags][components]
};

// A mesh from Gmsh.
struct MshMesh {
  std::string name;  // name of the file
  std::vector<Point<3>> nodes;
  std::vector<std::int64_t> node_tags;  // tags of the nodes in the file
  std::vector<MshRegion> regions;
  std::array<MshCells, kMshShapes> cells;
  GroupNames names;
  std::vector<MshNodeValues> node_values;  // filled on request only
  std::vector<Warning> warnings;

  const MshCells& of(MshShape shape) const { return cells[static_cast<std::size_t>(shape)]; }
  // Returns whether the mesh has elements of this dimension.
  bool has(int dimension) const;
  // Returns the dimension of the domain: 2 if all elements lie in a plane of constant z, else 3.
  int dimension() const;
};

// Reads a file. Elements of higher order become straight ones between their corners. Throws
// Error(ErrorKind::file, "path:line: ..."), or "path: at byte 84: ..." for binary files.
MshMesh read_msh(const std::string& path);

// Returns whether the file has the extension .msh, in upper or lower case.
bool is_msh(const std::string& path);

// Selects the sections that the parser stores.
enum class MshSections { mesh, mesh_and_node_values };
// Parses the bytes of a file like read_msh(). `name` stands for the file in messages.
MshMesh parse_msh(std::string_view bytes, const std::string& name,
                  MshSections wanted = MshSections::mesh);

// Keeps the first of several elements with the same corners. In version 2.2 an element in several
// physical groups appears once for each.
void remove_repeated(MshMesh& mesh);

// Returns the tag of each region: that of its physical group. If no element of this dimension is in
// a group, it is the number of the entity. Otherwise regions in no group get free_tag().
std::vector<std::int32_t> tags_of_regions(const MshMesh& mesh, int dimension);
// Returns the smallest positive number that is not the tag of a group or entity of any dimension.
std::int32_t free_tag(const MshMesh& mesh);

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// Types of elements in Gmsh's files, by the list in its manual.
#pragma once

#include <array>
#include <cstdint>

#include "formats/msh_mesh.hpp"

namespace pnpbs {

struct MshType {
  std::int32_t number;
  MshShape shape;
  int nodes;  // the corners come first
};

// Up to fifth order.
inline constexpr std::array kMshTypes{
    MshType{15, MshShape::point, 1},        MshType{1, MshShape::line, 2},
    MshType{8, MshShape::line, 3},          MshType{26, MshShape::line, 4},
    MshType{27, MshShape::line, 5},         MshType{28, MshShape::line, 6},
    MshType{2, MshShape::triangle, 3},      MshType{9, MshShape::triangle, 6},
    MshType{20, MshShape::triangle, 9},     MshType{21, MshShape::triangle, 10},
    MshType{22, MshShape::triangle, 12},    MshType{23, MshShape::triangle, 15},
    MshType{24, MshShape::triangle, 15},    MshType{25, MshShape::triangle, 21},
    MshType{3, MshShape::quadrangle, 4},    MshType{10, MshShape::quadrangle, 9},
    MshType{16, MshShape::quadrangle, 8},   MshType{4, MshShape::tetrahedron, 4},
    MshType{11, MshShape::tetrahedron, 10}, MshType{29, MshShape::tetrahedron, 20},
    MshType{30, MshShape::tetrahedron, 35}, MshType{31, MshShape::tetrahedron, 56},
    MshType{5, MshShape::hexahedron, 8},    MshType{12, MshShape::hexahedron, 27},
    MshType{17, MshShape::hexahedron, 20},  MshType{92, MshShape::hexahedron, 64},
    MshType{93, MshShape::hexahedron, 125}, MshType{6, MshShape::prism, 6},
    MshType{13, MshShape::prism, 18},       MshType{18, MshShape::prism, 15},
    MshType{7, MshShape::pyramid, 5},       MshType{14, MshShape::pyramid, 14},
    MshType{19, MshShape::pyramid, 13}};

}  // namespace pnpbs

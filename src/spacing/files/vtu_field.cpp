// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <initializer_list>
#include <limits>
#include <utility>

#include "spacing/files/field_file.hpp"
#include "spacing/files/vtu_arrays.hpp"

namespace pnpbs {

namespace {

// Kinds of VTK cells that matter here. All VTK cells list their corners before other points.
enum class CellKind { triangle, pixel, quadrangle, tetrahedron, other_face, other_solid, less };

struct VtkCell {
  CellKind kind;
  int corners;
};

VtkCell cell_of(double type) {
  if (!(type >= 0 && type < 256)) return {CellKind::other_solid, 0};
  switch (static_cast<int>(type)) {
    case 5:   // triangle
    case 22:  // quadratic triangle
    case 34:  // biquadratic triangle
    case 69:  // Lagrange triangle
    case 76:  // Bezier triangle
      return {CellKind::triangle, 3};
    case 8:  // pixel
      return {CellKind::pixel, 4};
    case 9:   // quadrangle
    case 23:  // quadratic
    case 28:  // biquadratic
    case 30:  // quadratic linear
    case 70:  // Lagrange
    case 77:  // Bezier
      return {CellKind::quadrangle, 4};
    case 10:  // tetrahedron
    case 24:  // quadratic
    case 71:  // Lagrange
    case 78:  // Bezier
      return {CellKind::tetrahedron, 4};
    case 6:   // triangle strip
    case 7:   // polygon
    case 36:  // quadratic polygon
      return {CellKind::other_face, 0};
    case 0:   // empty
    case 1:   // vertex
    case 2:   // vertices
    case 3:   // line
    case 4:   // lines
    case 21:  // quadratic line
    case 35:  // cubic line
    case 68:  // Lagrange curve
    case 75:  // Bezier curve
      return {CellKind::less, 0};
    default:
      return {CellKind::other_solid, 0};
  }
}

class FieldReader {
 public:
  FieldReader(std::string_view bytes, const std::string& name, const std::string& wanted)
      : file_(bytes, name) {
    std::vector<FieldName> fields;
    for (const VtuArray& array : file_.pieces().front().arrays)
      if (array.section == "PointData")
        fields.push_back({array.name, array.components, array.type.starts_with("Float")});
    field_.field = fields[chosen_field(fields, wanted, name)].name;
  }

  FileField read() {
    for (const VtuPiece& piece : file_.pieces()) {
      const auto first = static_cast<std::int64_t>(field_.points.size());
      if (piece.points == 0) continue;
      read_points(piece);
      if (piece.cells > 0) read_cells(piece, first);
    }
    return std::move(field_);
  }

 private:
  const VtuArray& array(const VtuPiece& piece, const char* section, const std::string& name) {
    const VtuArray* found = file_.find(piece, section, name);
    if (!found)
      file_.fail(std::string("found no array '") + name + "' of " + section + " in a <Piece>");
    return *found;
  }

  void read_points(const VtuPiece& piece) {
    const VtuArray& points = array(piece, "Points", "Points");
    if (points.components != 3)
      file_.fail("points have " + std::to_string(points.components) + " coordinates, expected 3");
    const std::vector<double> x = file_.read(points, piece.points);
    const std::vector<double> values =
        file_.read(array(piece, "PointData", field_.field), piece.points);
    if (values.size() * 3 != x.size())
      file_.fail("field '" + field_.field + "' has not one value at each point");
    if (field_.points.size() + values.size() >= std::numeric_limits<std::int32_t>::max())
      file_.fail("more than 2147483646 points");
    for (std::size_t i = 0; i < values.size(); ++i)
      field_.points.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    field_.values.insert(field_.values.end(), values.begin(), values.end());
  }

  void read_cells(const VtuPiece& piece, std::int64_t first) {
    const std::vector<double> ends = file_.read(array(piece, "Cells", "offsets"), piece.cells);
    const std::vector<double> types = file_.read(array(piece, "Cells", "types"), piece.cells);
    constexpr double kMany = 1e15;
    double begin = 0;
    for (const double end : ends) {
      if (!(end >= begin && end < kMany))
        file_.fail("the offsets of the cells do not increase from 0 on");
      begin = end;
    }
    if (types.size() != ends.size()) file_.fail("not each cell has one type and one offset");
    const std::vector<double> corners =
        file_.read(array(piece, "Cells", "connectivity"), static_cast<std::int64_t>(begin));
    if (static_cast<double>(corners.size()) != begin)
      file_.fail("the cells do not have as many corners as their offsets say");
    for (std::size_t c = 0; c < ends.size(); ++c) {
      const auto at = static_cast<std::size_t>(c > 0 ? ends[c - 1] : 0);
      const VtkCell cell = cell_of(types[c]);
      if (static_cast<double>(at + static_cast<std::size_t>(cell.corners)) > ends[c])
        file_.fail("cell " + std::to_string(c) + " has fewer corners than its type");
      add_cell(cell, corners.data() + at, first, piece.points);
    }
  }

  void add_cell(const VtkCell& cell, const double* corners, std::int64_t first,
                std::int64_t points) {
    std::array<std::int32_t, 4> c{};
    for (int k = 0; k < cell.corners; ++k) {
      if (!(corners[k] >= 0 && corners[k] < static_cast<double>(points)))
        file_.fail("a cell has the corner " + std::to_string(corners[k]) + ", expected 0 .. " +
                   std::to_string(points - 1));
      c[static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(first + static_cast<std::int64_t>(corners[k]));
    }
    switch (cell.kind) {
      case CellKind::triangle:
        return add(field_.triangles, {c[0], c[1], c[2]});
      case CellKind::pixel:
        std::swap(c[2], c[3]);
        [[fallthrough]];
      case CellKind::quadrangle:
        return add(field_.triangles, {c[0], c[1], c[2], c[0], c[2], c[3]});
      case CellKind::tetrahedron:
        return add(field_.tetrahedra, {c[0], c[1], c[2], c[3]});
      case CellKind::other_face:
        ++field_.other_faces;
        return;
      case CellKind::other_solid:
        ++field_.other_solids;
        return;
      case CellKind::less:
        return;
    }
  }

  static void add(std::vector<std::int32_t>& all, std::initializer_list<std::int32_t> corners) {
    all.insert(all.end(), corners);
  }

  VtuFile file_;
  FileField field_;
};

}  // namespace

FileField parse_vtu_field(std::string_view bytes, const std::string& name,
                          const std::string& wanted) {
  return FieldReader(bytes, name, wanted).read();
}

}  // namespace pnpbs

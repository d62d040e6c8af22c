// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_curves.hpp"

#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "formats/msh_facets.hpp"

namespace pnpbs {

namespace {

struct MshLine {
  std::array<std::int32_t, 2> ends;  // nodes of the mesh
  std::int32_t tag;
  bool inner;
};

class CurveFinder {
 public:
  CurveFinder(const std::vector<MshLine>& lines, const std::vector<MshPoint>& stops)
      : lines_(lines), used_(lines.size(), 0) {
    for (const MshPoint& stop : stops) stops_.insert(stop.node);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const std::int32_t end : lines[i].ends) at_[end].push_back(i);
  }

  std::vector<MshCurve> find() {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      for (const int k : {0, 1})
        if (!used_[i] && ends_at(lines_[i].ends[static_cast<std::size_t>(k)]))
          walk(i, lines_[i].ends[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (!used_[i]) walk(i, lines_[i].ends[0]);
    return std::move(curves_);
  }

 private:
  bool ends_at(std::int32_t node) const {
    const std::vector<std::size_t>& lines = at_.at(node);
    if (lines.size() != 2 || stops_.contains(node)) return true;
    const MshLine &a = lines_[lines[0]], &b = lines_[lines[1]];
    return a.tag != b.tag || a.inner != b.inner;
  }

  void walk(std::size_t line, std::int32_t begin) {
    MshCurve curve{{begin}, false, lines_[line].tag, lines_[line].inner};
    for (std::int32_t node = begin;;) {
      used_[line] = 1;
      const auto& ends = lines_[line].ends;
      node = ends[0] == node ? ends[1] : ends[0];
      if (node == begin) {
        curve.closed = true;
        break;
      }
      curve.nodes.push_back(node);
      if (ends_at(node)) break;
      const std::vector<std::size_t>& here = at_.at(node);
      line = here[0] == line ? here[1] : here[0];
    }
    curves_.push_back(std::move(curve));
  }

  const std::vector<MshLine>& lines_;
  std::vector<char> used_;
  std::set<std::int32_t> stops_;
  std::map<std::int32_t, std::vector<std::size_t>> at_;  // the lines that each node ends
  std::vector<MshCurve> curves_;
};

void require_plane(const MshMesh& mesh) {
  if (mesh.dimension() != 2)
    throw Error(ErrorKind::file, mesh.name +
                                     ": holds a mesh in space, expected one in a plane of "
                                     "constant z");
}

// Of lines of which the file does not tell more, those that belong to open chains lie inside.
void find_open_chains(const std::vector<MshFacet>& facets, std::vector<MshLine>& lines) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (facets[i].sides == MshSides::unknown)
      for (const std::int32_t end : lines[i].ends) at[end].push_back(i);
  std::vector<std::int32_t> ends;
  for (const auto& [node, here] : at)
    if (here.size() == 1) ends.push_back(node);
  while (!ends.empty()) {
    const std::int32_t node = ends.back();
    ends.pop_back();
    if (at[node].size() != 1) continue;
    const std::size_t line = at[node].front();
    lines[line].inner = true;
    for (const std::int32_t end : lines[line].ends) {
      std::erase(at[end], line);
      if (at[end].size() == 1) ends.push_back(end);
    }
  }
}

std::int32_t group_of(const MshMesh& mesh, std::int32_t region) {
  return mesh.regions[static_cast<std::size_t>(region)].group;
}

}  // namespace

std::vector<MshCurve> curves_of_plane(const MshMesh& mesh, const std::vector<MshPoint>& points) {
  require_plane(mesh);
  const std::vector<MshFacet> facets = facets_of(mesh, 2);
  std::vector<MshLine> lines;
  for (const MshFacet& facet : facets)
    lines.push_back(
        {{facet.corners[0], facet.corners[1]}, facet.tag, facet.sides == MshSides::both_inside});
  find_open_chains(facets, lines);
  return CurveFinder(lines, points).find();
}

std::vector<MshCurve> curves_in_groups(const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::line);
  std::vector<MshLine> lines;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = group_of(mesh, cells.regions[e]))
      lines.push_back({{cells.corners[2 * e], cells.corners[2 * e + 1]}, group, true});
  return CurveFinder(lines, {}).find();
}

std::vector<MshPoint> points_in_groups(const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::point);
  std::vector<MshPoint> points;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = group_of(mesh, cells.regions[e]))
      points.push_back({cells.corners[e], group});
  return points;
}

}  // namespace pnpbs

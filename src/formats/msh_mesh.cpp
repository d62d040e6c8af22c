// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_mesh.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/extension.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

void remove_repeated(MshCells& cells, std::size_t corners) {
  std::vector<std::int32_t> sorted = cells.corners;
  for (std::size_t e = 0; e < cells.count(); ++e) {
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(corners * e);
    std::sort(begin, begin + static_cast<std::ptrdiff_t>(corners));
  }
  std::vector<std::size_t> order(cells.count());
  for (std::size_t e = 0; e < order.size(); ++e) order[e] = e;
  const auto compared = [&](std::size_t a, std::size_t b) {
    const std::int32_t *x = sorted.data() + corners * a, *y = sorted.data() + corners * b;
    return std::lexicographical_compare_three_way(x, x + corners, y, y + corners);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto way = compared(a, b);
    return way != 0 ? way < 0 : a < b;
  });
  std::vector<char> repeated(cells.count(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
    repeated[order[i]] = compared(order[i - 1], order[i]) == 0;
  MshCells kept;
  for (std::size_t e = 0; e < cells.count(); ++e) {
    if (repeated[e]) continue;
    const auto begin = cells.corners.begin() + static_cast<std::ptrdiff_t>(corners * e);
    kept.corners.insert(kept.corners.end(), begin, begin + static_cast<std::ptrdiff_t>(corners));
    kept.regions.push_back(cells.regions[e]);
  }
  cells = std::move(kept);
}

}  // namespace

void remove_repeated(MshMesh& mesh) {
  for (std::size_t shape = 0; shape < kMshShapes; ++shape)
    remove_repeated(mesh.cells[shape], static_cast<std::size_t>(kMshCorners[shape]));
}

bool MshMesh::has(int dimension) const {
  for (std::size_t shape = 0; shape < kMshShapes; ++shape)
    if (kMshDimensions[shape] == dimension && cells[shape].count() > 0) return true;
  return false;
}

int MshMesh::dimension() const {
  if (has(3)) return 3;
  const double* z = nullptr;
  for (std::size_t shape = 0; shape < kMshShapes; ++shape)
    for (const std::int32_t node : cells[shape].corners) {
      const double& here = nodes[static_cast<std::size_t>(node)][2];
      if (z && *z != here) return 3;
      z = &here;
    }
  return 2;
}

bool is_msh(const std::string& path) { return extension_of(path) == "msh"; }

MshMesh read_msh(const std::string& path) { return parse_msh(read_whole_file(path), path); }

std::int32_t free_tag(const MshMesh& mesh) {
  std::set<std::int32_t> used;
  for (const MshRegion& region : mesh.regions) used.insert({region.entity, region.group});
  for (const auto& [group, name] : mesh.names.all()) used.insert(group.tag);
  std::int32_t tag = 1;
  while (used.contains(tag)) ++tag;
  return tag;
}

std::vector<std::int32_t> tags_of_regions(const MshMesh& mesh, int dimension) {
  const bool any_group = std::ranges::any_of(mesh.regions, [&](const MshRegion& region) {
    return region.dimension == dimension && region.group != 0;
  });
  const std::int32_t other = free_tag(mesh);
  std::vector<std::int32_t> tags;
  for (const MshRegion& region : mesh.regions) {
    const std::int32_t tag = any_group ? region.group : region.entity;
    tags.push_back(tag == 0 ? other : tag);
  }
  return tags;
}

}  // namespace pnpbs

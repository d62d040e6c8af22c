// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_region_points.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "formats/msh_sides.hpp"

namespace pnpbs {

using namespace msh_sides;

namespace {

struct Element {
  Point<3> middle;
  double size;  // its area or volume, but for a factor
  std::int32_t group;
};

struct Side {
  Key key;
  std::int64_t element;
};

class Parts {
 public:
  Parts(const MshMesh& mesh, int dimension) : mesh_(mesh), dimension_(dimension) {
    for_cells(mesh, dimension,
              [&](MshShape shape, std::span<const std::int32_t> corners, std::size_t region) {
                add(shape, corners, mesh.regions[region].group);
              });
  }

  bool has_several_groups() const {
    std::set<std::int32_t> groups;
    for (const MshRegion& region : mesh_.regions)
      if (region.dimension == dimension_) groups.insert(region.group);
    return groups.size() > 1;
  }

  std::vector<MshRegionPoint> points() {
    UnionFind<std::int64_t> part(elements_.size());
    join_across_sides(part);
    // The largest element stands for its part, so that the point is far from its sides.
    std::vector<std::int64_t> largest(elements_.size(), -1);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      std::int64_t& best =
          largest[static_cast<std::size_t>(part.root(static_cast<std::int64_t>(e)))];
      if (best < 0 || elements_[e].size > elements_[static_cast<std::size_t>(best)].size)
        best = static_cast<std::int64_t>(e);
    }
    std::vector<MshRegionPoint> points;
    for (const std::int64_t e : largest) {
      if (e < 0) continue;
      const Element& element = elements_[static_cast<std::size_t>(e)];
      if (element.group != 0 && element.size > 0)
        points.push_back({element.middle, element.group, name_of(element.group)});
    }
    return points;
  }

 private:
  void add(MshShape shape, std::span<const std::int32_t> corners, std::int32_t group) {
    Element element{{}, 0, group};
    for (const std::int32_t node : corners)
      for (std::size_t k = 0; k < 3; ++k)
        element.middle[k] += position(node)[k] / static_cast<double>(corners.size());
    for (const std::array<int, 4>& side : sides_of(shape)) {
      Key nodes{kNone, kNone, kNone, kNone};
      for (std::size_t k = 0; k < 4; ++k)
        if (side[k] >= 0) nodes[k] = corners[static_cast<std::size_t>(side[k])];
      element.size += size_over(nodes, element.middle);
      sides_.push_back({key_of(nodes), std::ssize(elements_)});
    }
    elements_.push_back(element);
  }

  const Point<3>& position(std::int32_t node) const {
    return mesh_.nodes[static_cast<std::size_t>(node)];
  }

  // Of what lies between the side and the middle.
  double size_over(const Key& side, const Point<3>& middle) const {
    const Point<3> a = difference(position(side[0]), middle),
                   b = difference(position(side[1]), middle);
    const Point<3> normal = cross(a, b);
    if (dimension_ == 2) return std::abs(normal[2]);
    double size = 0;
    for (std::int32_t k = 2; k < count_of(side); ++k)
      size += std::abs(
          dot(cross(a, difference(position(side[static_cast<std::size_t>(k) - 1]), middle)),
              difference(position(side[static_cast<std::size_t>(k)]), middle)));
    return size;
  }

  // But those that are facets, which divide the domain.
  void join_across_sides(UnionFind<std::int64_t>& part) {
    std::set<Key> facets;
    for_cells(mesh_, dimension_ - 1,
              [&](MshShape, std::span<const std::int32_t> corners, std::size_t) {
                Key all{kNone, kNone, kNone, kNone};
                std::copy(corners.begin(), corners.end(), all.begin());
                facets.insert(key_of(all));
              });
    std::stable_sort(sides_.begin(), sides_.end(),
                     [](const Side& a, const Side& b) { return a.key < b.key; });
    for (std::size_t s = 1; s < sides_.size(); ++s) {
      const std::int64_t one = sides_[s - 1].element, other = sides_[s].element;
      if (sides_[s - 1].key == sides_[s].key && group_of(one) == group_of(other) &&
          !facets.contains(sides_[s].key))
        part.join(one, other);
    }
  }

  std::int32_t group_of(std::int64_t element) const {
    return elements_[static_cast<std::size_t>(element)].group;
  }

  std::string name_of(std::int32_t group) const {
    const std::string* name = mesh_.names.find({dimension_, group});
    return "the group " + (name ? "'" + *name + "'" : std::to_string(group));
  }

  const MshMesh& mesh_;
  int dimension_;
  std::vector<Element> elements_;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<MshRegionPoint> region_points_of(const MshMesh& mesh, int dimension) {
  Parts parts(mesh, dimension);
  if (!parts.has_several_groups()) return {};
  return parts.points();
}

}  // namespace pnpbs

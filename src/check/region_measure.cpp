// SPDX-License-Identifier: BSD-3-Clause
#include "check/region_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/space_vectors.hpp"
#include "check/volume_node_check.hpp"
#include "domain/volume/surface_walk.hpp"
#include "level/volume/inner_facets.hpp"
#include "level/volume/settled_elements.hpp"
#include "results/element_regions.hpp"

namespace pnpbs {

namespace {

// Sums over the faces between elements of different regions.
class RegionMeasuring : public VolumeNodeCheck {
 public:
  explicit RegionMeasuring(const Results<3>& results) : VolumeNodeCheck(results), tags_(results) {}

  std::vector<RegionMeasure> all() {
    collective_try(comm_, [&] {
      for (const auto& [tag, volume] : geometry_.domain().regions()->volumes())
        measures_[tag].measure.domain = volume;
      for_owned([&](std::int64_t i) {
        if (!is_far_from_facets(level_, i)) add_faces_of(i);
      });
    });
    constexpr double kRounding = 1e-9;  // relative to the domain
    std::vector<RegionMeasure> result;
    for (auto& [tag, region] : measures_) {
      ElementMeasure& measure = region.measure;
      for (double* value : {&measure.elements, &measure.chord_error, &measure.absolute_chord_error})
        *value = sum_over_ranks(*value, measure.domain);
      measure.rounding = kRounding * geometry_.measure();
      region.tag = tag;
      result.push_back(std::move(region));
    }
    return result;
  }

 private:
  // A face of a node together with one of its tetrahedra.
  struct Face {
    std::array<std::int64_t, 2> ids;    // ids of the other two nodes, ascending
    std::array<std::int64_t, 3> nodes;  // counter-clockwise as seen from outside the tetrahedron
    std::int32_t tag;                   // of the region of the tetrahedron
  };

  // Adds the faces whose node with the smallest id is node i.
  void add_faces_of(std::int64_t i) {
    faces_.clear();
    level_.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
      const std::int32_t tag = tags_.of_element({i, others[0], others[1], others[2]});
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t a = others[k], b = others[(k + 1) % 3];
        const auto [low, high] = std::minmax(nodes_.id(a), nodes_.id(b));
        if (low > nodes_.id(i)) faces_.push_back({{low, high}, {i, b, a}, tag});
      }
    });
    std::ranges::sort(faces_, {}, &Face::ids);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const bool shared = f + 1 < faces_.size() && faces_[f].ids == faces_[f + 1].ids;
      if (!shared) {
        add(faces_[f], false);
      } else if (faces_[f].tag != faces_[f + 1].tag) {
        add(faces_[f], true);
        add(faces_[f + 1], true);
      }
      f += shared;
    }
  }

  void add(const Face& face, bool shared) {
    const auto found = measures_.find(face.tag);
    if (found == measures_.end()) return;
    ElementMeasure& measure = found->second.measure;
    std::array<Point<3>, 3> x;
    for (std::size_t k = 0; k < 3; ++k) {
      if (shared) found->second.corners.push_back(position(face.nodes[k]));
      x[k] = difference(position(face.nodes[k]), geometry_.bounds().low);
    }
    measure.elements += dot(x[0], cross(x[1], x[2])) / 6;
    const double chord_error = chord_error_at(face.nodes);
    measure.chord_error += chord_error;
    measure.absolute_chord_error += std::fabs(chord_error);
  }

  // Returns an estimate of the volume between a face and the surface on which its nodes lie,
  // positive outside the tetrahedron. It is 0 if they do not lie on one surface. Four triangles
  // between the corners and the points of the surface nearest to the middles of the sides explain
  // three quarters of it, because the chord error is of second order.
  double chord_error_at(const Three& nodes) const {
    if (!lies_along_surface(level_, nodes)) return 0;
    const std::int32_t facet = facet_beside(nodes);
    const std::array<Point<3>, 3> x{position(nodes[0]), position(nodes[1]), position(nodes[2])};
    std::array<Point<3>, 3> feet;
    for (std::size_t k = 0; k < 3; ++k)
      feet[k] = foot_of(middle_of<3>(x[k], x[(k + 1) % 3]), facet);
    const auto pyramid = [&](const Point<3>& a, const Point<3>& b, const Point<3>& c) {
      return dot(difference(a, x[0]), cross(difference(b, x[0]), difference(c, x[0]))) / 6;
    };
    double volume = pyramid(feet[0], feet[1], feet[2]);
    for (std::size_t k = 0; k < 3; ++k)
      volume += pyramid(x[k], feet[k], feet[(k + 2) % 3]) + pyramid(x[k], x[(k + 1) % 3], feet[k]);
    return volume * 4 / 3;
  }

  // Returns a facet of a surface on which all these nodes lie, if one of them lies within it, or
  // else -1.
  std::int32_t facet_beside(const Three& nodes) const {
    const std::vector<std::int32_t> patches = common_patches(level_, nodes);
    for (const std::int64_t i : nodes)
      if (nodes_.carrier(i) == Carrier::surface &&
          std::ranges::binary_search(patches, geometry_.surface().patch(nodes_.boundary_node(i))))
        return nodes_.boundary_node(i);
    return -1;
  }

  Point<3> foot_of(const Point<3>& x, std::int32_t facet) const {
    if (facet >= 0) return pull_back(geometry_.surface(), x, facet).position;
    return geometry_.domain().index().nearest(x, std::numeric_limits<double>::infinity()).x;
  }

  ElementRegions<3> tags_;
  std::map<std::int32_t, RegionMeasure> measures_;
  std::vector<Face> faces_;
};

}  // namespace

std::vector<RegionMeasure> regions_far_off(const Results<3>& results) {
  // The surfaces of a periodic domain are those of several copies of its cell.
  if (results.level().geometry.cell().any()) return {};
  if (!results.level().geometry.has_inner_surfaces() ||
      !results.level().geometry.domain().regions())
    return {};
  std::vector<RegionMeasure> measures = RegionMeasuring(results).all();
  std::erase_if(measures, [](const RegionMeasure& of) { return !of.measure.far_off(); });
  return measures;
}

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// Which nodes are closest in some part of an element: its corners, and those of their neighbours
// that are closer than the corners somewhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "voronoi/divided_element.hpp"
#include "voronoi/element_sites.hpp"
#include "voronoi/few_nodes.hpp"

namespace pnpbs {

// A node that is not a corner is a site if it is closer than the corners, or as close: then two
// nodes may have a side of the element in common.
constexpr double kAsClose = 1 + 1e-12;  // of squared distances
constexpr double kAboveRounding = 1 + 1e-9;

// Finds the sites of one element after another.
template <int Dim, std::size_t Corners>
class SiteFinder {
 public:
  // neighbours: the nodes that have an element in common with each node.
  SiteFinder(const ElementSites<Dim>& nodes, const ChunkedRows<std::int32_t>& neighbours)
      : nodes_(nodes), neighbours_(neighbours) {}

  // corners: by id. Appends them and the others.
  void find(const std::array<std::int32_t, Corners>& corners, std::vector<std::int32_t>& sites) {
    list_vertices(corners);
    sites.insert(sites.end(), corners.begin(), corners.end());
    const std::size_t first_other = sites.size();
    for (const std::int32_t node : near(corners))
      if (is_close(node)) sites.push_back(node);
    const auto others = sites.begin() + static_cast<std::ptrdiff_t>(first_other);
    std::sort(others, sites.end(), [&](std::int32_t a, std::int32_t b) { return id(a) < id(b); });
    for (auto other = others; other != sites.end(); ++other)
      x_.push_back(nodes_.x[static_cast<std::size_t>(*other)]);
    divided_.set(x_);
  }

  // That element, with the faces between its corners. Until the next one is looked at.
  DividedElement<Dim, Corners>& divided() { return divided_; }

 private:
  // Where the cells of the corners, by themselves, have their corners within the element.
  void list_vertices(const std::array<std::int32_t, Corners>& corners) {
    x_.clear();
    for (const std::int32_t corner : corners)
      x_.push_back(nodes_.x[static_cast<std::size_t>(corner)]);
    divided_.set(x_);
    divided_.divide_among_corners();
    count_ = 0;
    middle_ = {};
    for (const Point<Dim>& corner : x_)
      for (std::size_t k = 0; k < Dim; ++k) middle_[k] += corner[k] / Corners;
    squared_reach_ = 0;
    for (std::size_t b = 1, face = 0; b < Corners; ++b)
      for (std::size_t a = 0; a < b; ++a, ++face)
        for (const Point<Dim>& vertex : divided_.faces_of_corners()[face].points())
          add_vertex(vertex, x_[a]);
  }
  void add_vertex(const Point<Dim>& vertex, const Point<Dim>& closest) {
    if (count_ == squared_distances_.size()) {
      for (auto& coordinates : vertices_) coordinates.resize(2 * count_ + 1);
      squared_distances_.resize(2 * count_ + 1);
    }
    for (std::size_t k = 0; k < Dim; ++k) vertices_[k][count_] = vertex[k];
    const double squared = squared_distance<Dim>(vertex, closest) * kAsClose;
    squared_distances_[count_++] = squared;
    enclose(squared_distance<Dim>(middle_, vertex), squared);
  }
  // No node farther from the middle than the reach is closer to any of the vertices than the
  // corners. Of this one, by the squares of its distances from the middle and the closest corners.
  void enclose(double from_middle, double from_corners) {
    // (a + b)^2 <= 2 (a^2 + b^2): mostly this needs no root.
    if (2 * (from_middle + from_corners) * kAboveRounding <= squared_reach_) return;
    const double reach = std::sqrt(from_middle) + std::sqrt(from_corners);
    squared_reach_ = std::max(squared_reach_, reach * reach * kAboveRounding);
  }
  double squared_distance_to(std::size_t vertex, const Point<Dim>& x) const {
    double sum = 0;
    for (std::size_t k = 0; k < Dim; ++k)
      sum += (vertices_[k][vertex] - x[k]) * (vertices_[k][vertex] - x[k]);
    return sum;
  }

  // The neighbours within reach, each once, without the corners. Without branches: what comes next
  // takes the place of one that is not kept.
  std::span<const std::int32_t> near(const std::array<std::int32_t, Corners>& corners) {
    std::size_t most = 0;
    for (const std::int32_t corner : corners) most += neighbours_.row(corner).size();
    if (near_.size() < most) near_.resize(most);
    const Point<Dim> middle = middle_;
    const double squared_reach = squared_reach_;
    std::int32_t* const nodes = near_.data();
    std::size_t within = 0, kept = 0;
    for (const std::int32_t corner : corners)
      for (const std::int32_t node : neighbours_.row(corner)) {
        nodes[within] = node;
        const Point<Dim>& x = nodes_.x[static_cast<std::size_t>(node)];
        within += squared_distance<Dim>(middle, x) <= squared_reach;
      }
    for (std::size_t k = 0; k < within; ++k) {
      const std::int32_t node = nodes[k];
      nodes[kept] = node;
      const bool known = has({nodes, kept}, node), corner = has(corners, node);
      kept += static_cast<std::size_t>(!known && !corner);
    }
    return {nodes, kept};
  }
  bool is_close(std::int32_t node) const {
    const Point<Dim>& x = nodes_.x[static_cast<std::size_t>(node)];
    unsigned close = 0;
    for (std::size_t v = 0; v < count_; ++v)
      close |= static_cast<unsigned>(squared_distance_to(v, x) <= squared_distances_[v]);
    return close != 0;
  }
  std::int64_t id(std::int32_t node) const { return nodes_.ids[static_cast<std::size_t>(node)]; }

  const ElementSites<Dim>& nodes_;
  const ChunkedRows<std::int32_t>& neighbours_;
  DividedElement<Dim, Corners> divided_;
  std::vector<Point<Dim>> x_;  // of the sites
  // Coordinates, and squares of the distances to the closest corners, each by itself for vector
  // instructions.
  std::array<std::vector<double>, Dim> vertices_;
  std::vector<double> squared_distances_;
  std::size_t count_ = 0;
  std::vector<std::int32_t> near_;
  Point<Dim> middle_{};  // of the corners
  double squared_reach_ = 0;
};

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// The star of each node within its surface, found in its own tangent plane independently of other
// nodes. Where four nodes lie nearly on a circle, their stars can disagree.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/nodes.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "domain/volume/surface.hpp"
#include "neighbors/buckets.hpp"
#include "partition/known_region.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// The data from which the stars are found, all for the same positions. No node may be free.
struct SurfaceStarInput {
  const Nodes<3>& nodes;
  const BackgroundTree<3>& tree;
  const Buckets<3>& buckets;
  const KnownRegion<3>& known;
  const Surface& surface;
  const FeatureNodes& features;
  std::function<SurfaceSupport(std::int64_t)> place;  // Surface point of a node.
};

class SurfaceRings {
 public:
  // A neighbour, and whether the node, this and the next neighbour are a triangle.
  struct Entry {
    std::int32_t node;
    bool triangle;
  };

  void build(const SurfaceStarInput& input);

  // Return the size and the entries of the star of node i, counter-clockwise. Where sheets end or
  // meet, one sheet follows the other.
  std::size_t size(std::int64_t i) const { return rows_.row(i).size(); }
  Entry at(std::int64_t i, std::size_t k) const {
    const std::int32_t packed = rows_.row(i)[k];
    return {packed / 2, packed % 2 != 0};
  }
  // Returns 0 if the star of node i has been found. Otherwise returns the distance up to which all
  // nodes around it must be known.
  double needs(std::int64_t i) const { return needs_[static_cast<std::size_t>(i)]; }
  std::vector<double> take_needs() { return std::move(needs_); }

 private:
  ChunkedRows<std::int32_t, 256> rows_;
  std::vector<double> needs_;
};

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// The stars of surfaces alone, written down: a header, the neighbours, then two nodes for each
// triangle.
#include <algorithm>

#include "delaunay/volume/agreed_triangles.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

namespace {

class SurfaceStarWriter {
 public:
  SurfaceStarWriter(const Nodes<3>& nodes, const SurfaceRings& rings)
      : nodes_(nodes), agreed_(nodes, rings) {}

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    agreed_.of(i, triangles_);
    neighbours_.clear();
    for (const AgreedTriangles::Others& others : triangles_)
      neighbours_.insert(neighbours_.end(), others.begin(), others.end());
    std::ranges::sort(neighbours_, {}, [this](std::int32_t j) { return nodes_.id(j); });
    const bool closed = each_comes_twice();
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    out.push_back(VolumeStars::header(neighbours_.size(), closed));
    out.insert(out.end(), neighbours_.begin(), neighbours_.end());
    for (const AgreedTriangles::Others& others : triangles_)
      out.insert(out.end(), others.begin(), others.end());
  }

 private:
  bool each_comes_twice() const {
    for (std::size_t k = 0; k < neighbours_.size(); k += 2)
      if (k + 1 == neighbours_.size() || neighbours_[k] != neighbours_[k + 1]) return false;
    return !neighbours_.empty();
  }

  const Nodes<3>& nodes_;
  AgreedTriangles agreed_;
  std::vector<AgreedTriangles::Others> triangles_;
  std::vector<std::int32_t> neighbours_;
};

}  // namespace

void VolumeStars::build(const SurfaceStarInput& input) {
  on_surfaces_ = true;
  SurfaceRings rings;
  rings.build(input);
  rows_.build("pnpbs::VolumeStars::build_on_surfaces", input.nodes.count,
              [&] { return SurfaceStarWriter(input.nodes, rings); });
  needs_ = rings.take_needs();
}

}  // namespace pnpbs

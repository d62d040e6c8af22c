// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/patch_images.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "base/image_range.hpp"
#include "base/rank_limit.hpp"

namespace pnpbs {

namespace {

// Adds images of the rows of a patch.
template <int Dim>
class PatchImages {
 public:
  PatchImages(Patch<Dim>& patch, const PeriodicCell<Dim>& cell) : patch_(patch), cell_(cell) {}

  // Adds the images of a row that may be within `margin` periods of the cell. copy(image) adds that
  // for which the copy `image` is seen as the cell.
  template <std::size_t N, class Copy>
  void for_images(const std::array<std::int32_t, N>& row, double margin, const Copy& copy) const {
    Point<Dim> low = position(row[0]), high = low;
    for (const std::int32_t n : row)
      for (std::size_t k = 0; k < Dim; ++k) {
        low[k] = std::min(low[k], position(n)[k]);
        high[k] = std::max(high[k], position(n)[k]);
      }
    for (int k = 0; k < Dim; ++k) {
      low[k] -= margin * cell_.period(k);
      high[k] += margin * cell_.period(k);
    }
    pnpbs::for_images(cell_.image_of(low), cell_.image_of(high), [&](const Image<Dim>& image) {
      if (image != Image<Dim>{}) copy(image);
    });
  }

  // Returns the image of a row of nodes for which the copy `image` is seen as the cell.
  template <std::size_t N>
  std::array<std::int32_t, N> seen_from(const Image<Dim>& image, std::array<std::int32_t, N> row) {
    for (std::int32_t& n : row) n = node_seen_from(image, n);
    return row;
  }
  std::int32_t node_seen_from(const Image<Dim>& image, std::int32_t n) {
    const auto [at, is_new] = image_nodes_.try_emplace({n, image}, 0);
    if (is_new) {
      const Translation<Dim> translation{cell_, image};
      const PatchNode<Dim>& node = patch_.nodes[static_cast<std::size_t>(n)];
      at->second = static_cast<std::int32_t>(patch_.nodes.size());
      require_fits_rank(std::ssize(patch_.nodes) + 1, "nodes");
      patch_.nodes.push_back({translation(node.x), translation.id(node.id), node.value});
      patch_.images.push_back(n);
    }
    return at->second;
  }

 private:
  const Point<Dim>& position(std::int32_t n) const {
    return patch_.nodes[static_cast<std::size_t>(n)].x;
  }

  Patch<Dim>& patch_;
  const PeriodicCell<Dim>& cell_;
  std::map<std::pair<std::int32_t, Image<Dim>>, std::int32_t> image_nodes_;
};

}  // namespace

template <int Dim>
void add_images(Patch<Dim>& patch, const PeriodicCell<Dim>& cell) {
  if (!cell.any()) return;
  PatchImages<Dim> images(patch, cell);
  for (std::size_t s = 0, simplices = patch.simplices.size(); s < simplices; ++s) {
    const auto row = patch.simplices[s];
    images.for_images(row, 0, [&](const Image<Dim>& image) {
      patch.simplices.push_back(images.seen_from(image, row));
    });
  }
  // The nearest image of a point is at most half a period away along each axis.
  for (std::size_t f = 0, facets = patch.border.size(); f < facets; ++f) {
    const auto row = patch.border[f];
    const std::int32_t behind = patch.behind.empty() ? -1 : patch.behind[f];
    images.for_images(row, 0.5, [&](const Image<Dim>& image) {
      patch.border.push_back(images.seen_from(image, row));
      if (!patch.behind.empty())
        patch.behind.push_back(behind < 0 ? -1 : images.node_seen_from(image, behind));
    });
  }
}

template void add_images(Patch<2>&, const PeriodicCell<2>&);
template void add_images(Patch<3>&, const PeriodicCell<3>&);

}  // namespace pnpbs

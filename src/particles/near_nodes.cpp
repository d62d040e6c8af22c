// SPDX-License-Identifier: BSD-3-Clause
#include "particles/near_nodes.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace pnpbs {

template <int Dim>
NearNodes<Dim>::NearNodes(std::span<const Point<Dim>> x, std::span<const double> d,
                          std::span<const char> kept, double radius)
    : x_(x), d_(d), half_radius_(0.5 * radius) {
  std::vector<Box<Dim>> boxes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (kept[i] == 0) continue;
    nodes_.push_back(static_cast<std::int32_t>(i));
    boxes.push_back(ball_box(i));
  }
  tree_ = BoxTree<Dim>(std::move(boxes));
}

template <int Dim>
Box<Dim> NearNodes<Dim>::ball_box(std::size_t i) const {
  constexpr double kAboveRounding = 1 + 1e-9;
  const double reach = kAboveRounding * half_radius_ * d_[i];
  Box<Dim> box;
  for (std::size_t k = 0; k < Dim; ++k) {
    box.low[k] = x_[i][k] - reach;
    box.high[k] = x_[i][k] + reach;
  }
  return box;
}

template <int Dim>
ChunkedRows<std::int32_t> near_rows(const NearNodes<Dim>& near, std::int64_t owned,
                                    std::span<const std::int64_t> ids) {
  ChunkedRows<std::int32_t> rows;
  rows.build("pnpbs::particles::near", owned, [&] {
    return [&](std::int64_t node, std::vector<std::int32_t>& out) {
      const auto first = static_cast<std::ptrdiff_t>(out.size());
      near.for_near(node, [&](std::int32_t j) { out.push_back(j); });
      std::sort(out.begin() + first, out.end(),
                [&](std::int32_t a, std::int32_t b) { return ids[index(a)] < ids[index(b)]; });
    };
  });
  return rows;
}

template class NearNodes<2>;
template class NearNodes<3>;
template ChunkedRows<std::int32_t> near_rows(const NearNodes<2>&, std::int64_t,
                                             std::span<const std::int64_t>);
template ChunkedRows<std::int32_t> near_rows(const NearNodes<3>&, std::int64_t,
                                             std::span<const std::int64_t>);

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// An attribute of the nodes: one value for each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/execution.hpp"
#include "base/types.hpp"

namespace pnpbs {

// A View is a handle, and whoever has a constant one may write what it points to. Of this one only
// who may change the nodes may. Copies share the values, as those of a View do.
template <class T>
class NodeArray {
 public:
  NodeArray() = default;
  NodeArray(View<T> view) : view_(std::move(view)) {}  // NOLINT: of a View it is made everywhere

  T& operator()(std::int64_t i) { return view_(i); }
  const T& operator()(std::int64_t i) const { return view_(i); }
  T* data() { return view_.data(); }
  const T* data() const { return view_.data(); }
  std::size_t extent(int direction) const { return view_.extent(direction); }

  View<T>& view() { return view_; }
  View<const T> view() const { return view_; }

 private:
  View<T> view_;
};

// A vector at each node, one array for each direction.
template <int Dim>
using Field = std::array<NodeArray<double>, Dim>;

template <int Dim>
Point<Dim> point_at(const Field<Dim>& x, std::int64_t i) {
  Point<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = x[k](i);
  return p;
}

}  // namespace pnpbs

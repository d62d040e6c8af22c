// SPDX-License-Identifier: BSD-3-Clause
// What each element gives to the cells of its sites: a volume to each, and a part of the face
// between any two.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "voronoi/element_sites.hpp"
#include "voronoi/sphere_parts.hpp"

namespace pnpbs {

template <int Dim, std::size_t Corners>
class ElementParts {
 public:
  // own: rows of the first elements, which were made with their sites.
  ElementParts(const ElementSites<Dim>& all, ChunkedRows<double> own, std::int64_t owned)
      : owned_(owned), own_(std::move(own)) {
    arrived_.build("pnpbs::voronoi::parts", std::ssize(all.elements) - owned,
                   [&] { return Writer(all, owned); });
  }

  // See place_of_pair.
  std::span<const double> of(std::int32_t element) const {
    return element < owned_ ? own_.row(element) : arrived_.row(element - owned_);
  }

 private:
  class Writer {
   public:
    Writer(const ElementSites<Dim>& all, std::int64_t first)
        : all_(all), first_(first), rows_(all.sphere_radius) {}

    void operator()(std::int64_t row, std::vector<double>& out) {
      x_.clear();
      for (const std::int32_t s : all_.of(all_.elements[static_cast<std::size_t>(first_ + row)]))
        x_.push_back(all_.x[static_cast<std::size_t>(s)]);
      divided_.set(x_);
      divided_.divide_among_corners();
      rows_.append(divided_, out);
    }

   private:
    const ElementSites<Dim>& all_;
    std::int64_t first_;
    PartRows<Dim, Corners> rows_;
    DividedElement<Dim, Corners> divided_;
    std::vector<Point<Dim>> x_;  // of the sites
  };

  std::int64_t owned_;
  ChunkedRows<double> own_, arrived_;
};

}  // namespace pnpbs

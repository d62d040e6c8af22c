// SPDX-License-Identifier: BSD-3-Clause
// What each element gives to the cells of its sites: a volume to each, and a part of the face
// between any two.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/chunked_rows.hpp"
#include "voronoi/divided_element.hpp"
#include "voronoi/element_sites.hpp"

namespace pnpbs {

template <int Dim, std::size_t Corners>
class ElementParts {
 public:
  explicit ElementParts(const ElementSites<Dim>& all) : all_(all) {
    rows_.build("pnpbs::voronoi::parts", std::ssize(all.elements), [&] { return Writer(all); });
  }

  // By numbers of its sites.
  double volume(std::int32_t element, std::size_t site) const { return rows_.row(element)[site]; }
  double area(std::int32_t element, std::size_t site, std::size_t other) const {
    return rows_.row(element)[place_of_pair(sites_of(element), site, other)];
  }

 private:
  // A row has the volumes of all sites, then the areas of all pairs, each once.
  static std::size_t place_of_pair(std::size_t sites, std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    return sites + a * (2 * sites - a - 1) / 2 + (b - a - 1);
  }
  std::size_t sites_of(std::int32_t element) const {
    return static_cast<std::size_t>(all_.elements[static_cast<std::size_t>(element)].sites);
  }

  class Writer {
   public:
    explicit Writer(const ElementSites<Dim>& all) : all_(all) {}

    void operator()(std::int64_t element, std::vector<double>& out) {
      x_.clear();
      for (const std::int32_t s : all_.of(all_.elements[static_cast<std::size_t>(element)]))
        x_.push_back(all_.x[static_cast<std::size_t>(s)]);
      divided_.set(x_);
      const std::size_t sites = x_.size();
      row_.assign(sites + sites * (sites - 1) / 2, 0);
      for (std::size_t a = 0; a < sites; ++a)
        for (std::size_t b = a + 1; b < sites; ++b)
          row_[place_of_pair(sites, a, b)] = divided_.face(a, b).measure();
      for (std::size_t s = 0; s < sites; ++s)
        row_[s] = divided_.volume(
            s, [&](std::size_t other) { return row_[place_of_pair(sites, s, other)]; });
      out.insert(out.end(), row_.begin(), row_.end());
    }

   private:
    const ElementSites<Dim>& all_;
    DividedElement<Dim, Corners> divided_;
    std::vector<Point<Dim>> x_;  // of the sites
    std::vector<double> row_;
  };

  const ElementSites<Dim>& all_;
  ChunkedRows<double> rows_;
};

}  // namespace pnpbs

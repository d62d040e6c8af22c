// SPDX-License-Identifier: BSD-3-Clause
// The elements of which each node is a site.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/counting_sort.hpp"
#include "voronoi/element_sites.hpp"

namespace pnpbs {

// Of each owned node, and as which of their sites.
template <int Dim>
class ElementsOfSites {
 public:
  struct Entry {
    std::int32_t element, site;
  };

  ElementsOfSites(const ElementSites<Dim>& all, std::int64_t owned_nodes)
      : by_node_(static_cast<std::int64_t>(all.sites.size()),
                 static_cast<std::int32_t>(owned_nodes), key(all, owned_nodes)),
        entries_(static_cast<std::size_t>(by_node_.start().back())) {
    std::vector<Entry> entries(all.sites.size());
    for (std::size_t e = 0; e < all.elements.size(); ++e)
      for (std::int32_t s = 0; s < all.elements[e].sites; ++s)
        entries[static_cast<std::size_t>(all.elements[e].first_site + s)] = {
            static_cast<std::int32_t>(e), s};
    by_node_.for_places(key(all, owned_nodes), [&](std::int64_t s, std::int32_t place) {
      entries_[static_cast<std::size_t>(place)] = entries[static_cast<std::size_t>(s)];
    });
  }

  std::span<const Entry> at(std::int64_t node) const {
    const std::size_t n = static_cast<std::size_t>(node);
    const std::int32_t begin = by_node_.start()[n], end = by_node_.start()[n + 1];
    return std::span(entries_).subspan(static_cast<std::size_t>(begin),
                                       static_cast<std::size_t>(end - begin));
  }

 private:
  static auto key(const ElementSites<Dim>& all, std::int64_t owned_nodes) {
    return [&all, owned_nodes](std::int64_t s) {
      const std::int32_t node = all.sites[static_cast<std::size_t>(s)];
      return node < owned_nodes ? node : -1;
    };
  }

  CountingSort by_node_;
  std::vector<Entry> entries_;
};

}  // namespace pnpbs

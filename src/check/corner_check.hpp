// SPDX-License-Identifier: BSD-3-Clause
// The check that each simplex of a star is in the stars of its other corners, too, on whatever
// ranks these are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/message_text.hpp"
#include "check/node_check.hpp"
#include "comm/records.hpp"

namespace pnpbs {

// Others: how many other corners a simplex has. Where they are fewer than Dim, the stars are those
// of surfaces alone.
template <int Dim, std::size_t Others>
class CornerCheck {
 public:
  using Corners = std::array<std::int64_t, Others>;

  explicit CornerCheck(const NodeCheck<Dim>& check) : check_(check), level_(check.level()) {}

  // The star of this node must have the simplex with the others. Stars of other ranks are asked
  // later.
  void look_at(std::int64_t corner, const Corners& others) {
    const Corners key = key_of(others);
    if (!level_.nodes.owned(corner))
      elsewhere_.push_back({level_.nodes.id(corner), key, check_.owner_of(corner)});
    else if (!star_has(corner, key))
      fail(check_.name(corner), [&](std::size_t k) { return check_.name(others[k]); });
  }

  // Collective.
  void look_elsewhere() const {
    if (level_.comm->size() == 1) return;
    for (const Wanted& wanted : redistribute(*level_.comm, elsewhere_, [](const Wanted& sent) {
           return static_cast<int>(sent.owner);
         })) {
      const std::int64_t i = check_.owned_node(wanted.of);
      if (i < 0 || !star_has(i, wanted.others))
        fail(i < 0 ? MessageText(std::to_string(wanted.of)) : check_.name(i),
             [&](std::size_t k) { return std::to_string(wanted.others[k]); });
    }
  }

 private:
  struct Wanted {
    std::int64_t of;     // ids: the star of `of` must have
    Corners others;      // these
    std::int64_t owner;  // of `of`
  };

  // Ids: of a triangle in their order, which tells how it turns; of a tetrahedron increasing.
  template <class Index>
  Corners key_of(const std::array<Index, Others>& corners) const {
    Corners ids;
    for (std::size_t k = 0; k < Others; ++k) ids[k] = level_.nodes.id(corners[k]);
    if constexpr (Others == 3) std::ranges::sort(ids);
    return ids;
  }

  bool star_has(std::int64_t i, const Corners& key) const {
    bool found = false;
    const auto compare = [&](const auto& others) { found = found || key_of(others) == key; };
    if constexpr (Others == Dim)
      level_.stars.for_simplices(i, compare);
    else
      level_.stars.for_triangles(i, compare);
    return found;
  }

  template <class NameOf>
  [[noreturn]] static void fail(const MessageText& corner, const NameOf& name_of) {
    MessageText names = name_of(0);
    for (std::size_t k = 1; k < Others; ++k)
      names += (k + 1 < Others ? ", " : " and ") + name_of(k);
    fail_check("the star of node " + corner + " lacks the " +
               (Others == 2 ? "triangle" : "tetrahedron") + " with nodes " + names);
  }

  const NodeCheck<Dim>& check_;
  const Level<Dim>& level_;
  std::vector<Wanted> elsewhere_;
};

}  // namespace pnpbs

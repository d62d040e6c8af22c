// SPDX-License-Identifier: BSD-3-Clause
// The check that each simplex of a star is also in the stars of its other corners, which may be on
// other ranks.
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

// The check of one set of stars. `Others` is the number of other corners of a simplex. If it is
// less than Dim, the stars are those of surfaces alone.
template <int Dim, std::size_t Others>
class CornerCheck {
 public:
  using Corners = std::array<std::int64_t, Others>;

  explicit CornerCheck(const NodeCheck<Dim>& check) : check_(check), level_(check.level()) {}

  // Checks that the star of node `corner` has the simplex with the corners `others`. Stars of other
  // ranks are checked in check_on_other_ranks().
  void look_at(std::int64_t corner, const Corners& others) {
    const Corners key = key_of(others);
    if (!level_.nodes.owned(corner))
      elsewhere_.push_back(wanted_of(corner, others));
    else if (!star_has(corner, key))
      fail(check_.name(corner), [&](std::size_t k) { return check_.name(others[k]); });
  }

  // Checks the stars of other ranks. Collective.
  void check_on_other_ranks() const {
    if (!level_.distributed()) return;
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
    std::int64_t of;     // id of the node whose star must have the simplex
    Corners others;      // ids of the other corners
    std::int64_t owner;  // rank that owns `of`
  };

  // Returns the ids of the other corners: in their order for a triangle, whose orientation counts,
  // and sorted for a tetrahedron.
  template <class Index>
  Corners key_of(const std::array<Index, Others>& corners) const {
    Corners ids;
    for (std::size_t k = 0; k < Others; ++k) ids[k] = level_.nodes.id(corners[k]);
    if constexpr (Others == 3) std::ranges::sort(ids);
    return ids;
  }

  // Returns what the star of an image or of a node on another rank must have, with the ids that
  // nodes have where that node itself lies.
  Wanted wanted_of(std::int64_t corner, const Corners& others) const {
    const Nodes<Dim>& nodes = level_.nodes;
    const std::int64_t of = nodes.id(corner), shift = nodes.cell.home_id(of) - of;
    Corners ids;
    for (std::size_t k = 0; k < Others; ++k) ids[k] = nodes.id(others[k]) + shift;
    if constexpr (Others == 3) std::ranges::sort(ids);
    return {of + shift, ids, check_.owner_of(corner)};
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

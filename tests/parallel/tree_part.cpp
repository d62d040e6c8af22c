// SPDX-License-Identifier: BSD-3-Clause
// Tests a tree distributed over ranks against the complete tree: owners of leaves, copies of leaves
// beyond the border, and contacts of leaves.
#include "tree/tree_part.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "core/unit_box.hpp"
#include "rank_checks.hpp"

namespace {

using pnpbs::BackgroundTree;
using pnpbs::Box;
using pnpbs::LeafCell;
using pnpbs::Point;
using rank_checks::comm;
using rank_checks::expect;

template <int Dim>
using Width = std::function<double(const Point<Dim>& x)>;

template <int Dim>
BackgroundTree<Dim> whole_tree(const Width<Dim>& width) {
  BackgroundTree<Dim> tree;
  tree.build(unit_box<Dim>(), [&](const BackgroundTree<Dim>& grown, std::int32_t first,
                                  std::int32_t last, std::vector<char>& split) {
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] = grown.cell_side(c) > width(grown.cell_centre(c));
  });
  return tree;
}

template <int Dim>
LeafCell<Dim> cell_of(const BackgroundTree<Dim>& tree, std::int32_t leaf) {
  const auto& cell = tree.cell(tree.leaf_cell(leaf));
  return {cell.index, cell.depth};
}

// Returns whether two leaves have a corner, edge or side in common, by their boxes.
template <int Dim>
bool boxes_touch(const BackgroundTree<Dim>& tree, std::int32_t a, std::int32_t b) {
  const Box<Dim> x = tree.cell_box(tree.leaf_cell(a)), y = tree.cell_box(tree.leaf_cell(b));
  for (std::size_t k = 0; k < Dim; ++k)
    if (x.low[k] > y.high[k] + 1e-12 || y.low[k] > x.high[k] + 1e-12) return false;
  return true;
}

// Returns whether a leaf of the complete tree takes part in contacts. Every third leaf far from the
// origin does not.
bool is_live(std::int32_t leaf) { return leaf < 20 || leaf % 3 != 0; }

template <int Dim>
class Check {
 public:
  explicit Check(const Width<Dim>& width) : whole_(whole_tree<Dim>(width)) {
    for (std::int32_t leaf = 0; leaf < whole_.leaf_count(); ++leaf) {
      const LeafCell<Dim> cell = cell_of<Dim>(whole_, leaf);
      number_[{cell.first(), cell.depth}] = leaf;
    }
  }

  void run() {
    check_order();
    // All leaves start on one rank and are then spread evenly.
    std::vector<LeafCell<Dim>> own;
    if (comm->rank() == comm->size() / 2)
      for (std::int32_t leaf = 0; leaf < whole_.leaf_count(); ++leaf)
        own.push_back(cell_of<Dim>(whole_, leaf));
    pnpbs::spread_evenly(*comm, own);
    const auto share = static_cast<double>(whole_.leaf_count()) / comm->size();
    expect(std::fabs(static_cast<double>(own.size()) - share) <= 1, "equal numbers of leaves");
    std::vector<char> live;
    for (const LeafCell<Dim>& cell : own) live.push_back(is_live(number(cell)));
    cells_ = own;
    part_ = pnpbs::TreePart<Dim>(*comm, unit_box<Dim>(), std::move(own), std::move(live));
    name_copies();
    check_touching();
    check_points();
  }

 private:
  std::int32_t number(const LeafCell<Dim>& cell) const {
    return number_.at({cell.first(), cell.depth});
  }

  // Checks that the Morton order is the order of the tree.
  void check_order() const {
    for (std::int32_t leaf = 1; leaf < whole_.leaf_count(); ++leaf) {
      const LeafCell<Dim> before = cell_of<Dim>(whole_, leaf - 1),
                          here = cell_of<Dim>(whole_, leaf);
      expect(pnpbs::morton_before(before.last(), here.first()) &&
                 !pnpbs::morton_before(here.first(), before.last()),
             "leaf " + std::to_string(leaf) + " comes after the one before");
    }
  }

  // Sends the index of each leaf in the complete tree from its owner to the copies.
  void name_copies() {
    std::int64_t held = 0;
    for (const LeafCell<Dim>& cell : cells_) numbers_.push_back(number(cell));
    numbers_.resize(static_cast<std::size_t>(part_.count()), -1);
    pnpbs::fill_ghosts(*comm, part_.border(), numbers_);
    const std::set<std::int32_t> different(numbers_.begin(), numbers_.end());
    expect(different.size() == numbers_.size() && !different.count(-1), "every copy has a name");
    held = static_cast<std::int64_t>(
        comm->allreduce_sum(static_cast<std::uint64_t>(part_.own_count())));
    expect(held == whole_.leaf_count(), "each leaf is on one rank");
  }

  void check_touching() const {
    for (std::int64_t leaf = 0; leaf < part_.own_count(); ++leaf) {
      const std::int32_t here = numbers_[static_cast<std::size_t>(leaf)];
      std::set<std::int32_t> expected, found;
      for (std::int32_t other = 0; other < whole_.leaf_count(); ++other)
        if (other != here && is_live(here) && is_live(other) &&
            boxes_touch<Dim>(whole_, here, other))
          expected.insert(other);
      for (const std::int32_t other : part_.touching_leaves(leaf))
        found.insert(numbers_[static_cast<std::size_t>(other)]);
      expect(found == expected && found.size() == part_.touching_leaves(leaf).size(),
             "leaf " + std::to_string(here) + " touches " + std::to_string(expected.size()) +
                 ", found " + std::to_string(found.size()));
    }
    for (std::int64_t copy = part_.own_count(); copy < part_.count(); ++copy)
      for (const std::int32_t other : part_.touching_leaves(copy))
        expect(
            part_.owns(other) && boxes_touch<Dim>(whole_, numbers_[static_cast<std::size_t>(copy)],
                                                  numbers_[static_cast<std::size_t>(other)]),
            "copies touch own leaves");
  }

  // Checks that each point is found in the leaf of the complete tree, and that one rank owns it.
  void check_points() const {
    Random random(17);
    for (int trial = 0; trial < 2000; ++trial) {
      const Point<Dim> x = random.point<Dim>(unit_box<Dim>());
      const std::int64_t leaf = part_.leaf_at(x);
      expect(part_.owns(leaf) == (part_.rank_with(x) == comm->rank()), "one rank has the point");
      if (leaf >= 0)
        expect(numbers_[static_cast<std::size_t>(leaf)] == whole_.leaf_at(x),
               "the point is in its leaf");
    }
  }

  BackgroundTree<Dim> whole_;
  std::map<std::pair<pnpbs::FineIndex<Dim>, std::int32_t>, std::int32_t> number_;
  std::vector<LeafCell<Dim>> cells_;
  pnpbs::TreePart<Dim> part_;
  std::vector<std::int32_t> numbers_;
};

template <int Dim>
void check_trees(double fine) {
  Point<Dim> tip;
  tip.fill(0.3);
  Check<Dim>([](const Point<Dim>&) { return 2.0; }).run();  // one leaf, so most ranks have none
  Check<Dim>([](const Point<Dim>&) { return 0.13; }).run();
  Check<Dim>([&](const Point<Dim>& x) { return fine + 0.5 * pnpbs::distance<Dim>(x, tip); }).run();
}

}  // namespace

int main(int argc, char** argv) {
  return rank_checks::run_in_groups(argc, argv, [] {
    check_trees<2>(0.004);
    check_trees<3>(0.05);
  });
}

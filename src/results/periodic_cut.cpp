// SPDX-License-Identifier: BSD-3-Clause
#include "results/periodic_cut.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/index.hpp"
#include "results/copy_numbers.hpp"

namespace pnpbs {
namespace {

template <std::size_t n>
Image<3> in_space(const std::array<std::int32_t, n>& image) {
  Image<3> all{};
  std::ranges::copy(image, all.begin());
  return all;
}

}  // namespace

// Cuts the elements in steps. The owner of a node finds the copies that the elements around it
// need, numbers them, and sends the numbers to the owners of its neighbours, who have the elements
// and facets there.
template <int Dim>
class PeriodicCutMaker {
 public:
  explicit PeriodicCutMaker(Results<Dim>& results)
      : results_(results), level_(results.level()), comm_(results.communicator()) {}

  Cracks<Dim> make() {
    std::vector<CopiedNode> copied;
    collective_try(comm_, [&] {
      find_copies();
      for (const Copied& node : nodes_) copied.push_back({node.place, std::ssize(node.images) - 1});
    });
    cut_.all_ = number_copies(results_, copied);
    Outbox outbox;
    collective_try(comm_, [&] {
      for (std::size_t k = 0; k < nodes_.size(); ++k) nodes_[k].first = copied[k].first;
      list_own_copies();
      send_copies(outbox);
    });
    const std::vector<Record> arrived = deliver<Record>(comm_, outbox);
    collective_try(comm_, [&] {
      known_.insert(known_.end(), arrived.begin(), arrived.end());
      std::ranges::sort(known_, {}, key_of);
      list_copies_of_ghosts();
      assemble_elements();
      assemble_facets();
    });
    return std::move(cut_);
  }

 private:
  using Corners = typename Stars<Dim>::Corners;

  // An owned node that some element has beyond the cell.
  struct Copied {
    std::int64_t place;
    std::vector<Image<Dim>> images;  // where elements have it, the original first
    std::int64_t first = 0;          // number of the first copy
  };

  // A node beyond the cell.
  struct Record {
    std::int64_t id;  // of the node in the cell
    Image<Dim> image;
    std::int64_t number;  // kOriginal for a node that no element has in the cell
    std::int64_t index;   // in the list of copies of this rank
  };
  static std::pair<std::int64_t, Image<Dim>> key_of(const Record& record) {
    return {record.id, record.image};
  }

  const PeriodicCell<Dim>& cell() const { return level_.nodes.cell; }
  std::int64_t id(std::int64_t place) const { return level_.nodes.id(results_.node_at(place)); }

  Image<Dim> periods_of(std::int64_t i, const Corners& others) const {
    std::array<std::int64_t, Dim + 1> ids{level_.nodes.id(i)};
    for (std::size_t k = 0; k < Dim; ++k) ids[k + 1] = level_.nodes.id(others[k]);
    return periods_to_cell(cell(), ids);
  }

  void find_copies() {
    for (std::int64_t place = 0; place < results_.count(); ++place) {
      const std::int64_t i = results_.node_at(place);
      Copied node{place, {}};
      level_.stars.for_simplices(
          i, [&](const Corners& others) { node.images.push_back(periods_of(i, others)); });
      std::ranges::sort(node.images);
      node.images.erase(std::unique(node.images.begin(), node.images.end()), node.images.end());
      if (node.images.empty() || (node.images.size() == 1 && node.images[0] == Image<Dim>{}))
        continue;
      if (const auto home = std::ranges::find(node.images, Image<Dim>{}); home != node.images.end())
        std::rotate(node.images.begin(), home, home + 1);
      nodes_.push_back(std::move(node));
    }
  }

  void list_own_copies() {
    for (const Copied& node : nodes_) {
      if (node.images[0] != Image<Dim>{})
        cut_.moved_.push_back({node.place, kOriginal, in_space(node.images[0])});
      for (std::size_t k = 1; k < node.images.size(); ++k)
        cut_.copies_.push_back({node.place, number(node, k), in_space(node.images[k])});
    }
    cut_.owned_ = std::ssize(cut_.copies_);
  }

  static std::int64_t number(const Copied& node, std::size_t k) {
    return k == 0 ? kOriginal : node.first + static_cast<std::int64_t>(k) - 1;
  }

  void send_copies(Outbox& outbox) {
    std::int64_t copy = 0;
    for (const Copied& node : nodes_) {
      std::vector<int> ranks;
      level_.stars.for_neighbours(results_.node_at(node.place), [&](std::int64_t j) {
        if (!level_.nodes.owned(j)) ranks.push_back(results_.owner_of(j));
      });
      std::ranges::sort(ranks);
      ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
      for (std::size_t k = 0; k < node.images.size(); ++k) {
        if (node.images[k] == Image<Dim>{}) continue;
        Record record{id(node.place), node.images[k], number(node, k), kOriginal};
        for (const int rank : ranks)
          if (rank != comm_.rank()) pack(outbox.to(rank), record);
        if (k > 0) record.index = copy++;
        known_.push_back(record);
      }
    }
  }

  Record* find(std::int64_t id, const Image<Dim>& image) {
    const auto found = std::ranges::lower_bound(known_, std::pair(id, image), {}, key_of);
    return found != known_.end() && key_of(*found) == std::pair(id, image) ? &*found : nullptr;
  }

  // Returns for each corner the copy with these periods from the given node or image, or null.
  template <std::size_t n>
  std::array<Record*, n> copies_at(const std::array<std::int64_t, n>& places,
                                   const Image<Dim>& periods) {
    std::array<Record*, n> copies{};
    for (std::size_t c = 0; c < n; ++c) {
      const std::int64_t own = id(places[c]);
      Image<Dim> image = cell().image_of_id(own);
      for (std::size_t k = 0; k < Dim; ++k) image[k] += periods[k];
      if (image != Image<Dim>{}) copies[c] = find(cell().home_id(own), image);
    }
    return copies;
  }

  // Calls visit(corners, periods) for the elements and facets of this rank beside the cell.
  template <class Visit>
  void for_cells(const Visit& visit) {
    results_.for_elements([&](const std::array<std::int64_t, Dim + 1>& places) {
      std::array<std::int64_t, Dim + 1> ids;
      std::ranges::transform(places, ids.begin(), [this](auto place) { return id(place); });
      if (std::ranges::all_of(ids, [this](std::int64_t id) { return id == cell().home_id(id); }))
        return;
      visit(places, periods_to_cell(cell(), ids));
    });
    results_.for_facets_without_tags([&](const std::array<std::int64_t, Dim>& places) {
      const auto [front, back] = periods_beside(places);
      visit(places, front);
      if (back != front) visit(places, back);
    });
  }

  // Lists the copies of ghosts in the order of their numbers.
  void list_copies_of_ghosts() {
    std::vector<std::pair<Record*, std::int64_t>> used;
    for_cells([&](const auto& places, const Image<Dim>& periods) {
      const auto copies = copies_at(places, periods);
      for (std::size_t c = 0; c < places.size(); ++c)
        if (copies[c] && copies[c]->index == kOriginal && copies[c]->number != kOriginal)
          used.emplace_back(copies[c], places[c]);
    });
    std::ranges::sort(used, {},
                      [](const auto& one) { return std::pair(one.first->number, one.second); });
    for (const auto& [record, place] : used) {
      if (record->index != kOriginal) continue;
      record->index = std::ssize(cut_.copies_);
      cut_.copies_.push_back({place, record->number, in_space(record->image)});
    }
  }

  template <std::size_t n>
  std::array<std::int64_t, n> indices_at(const std::array<std::int64_t, n>& places,
                                         const Image<Dim>& periods) {
    std::array<std::int64_t, n> indices;
    std::ranges::transform(copies_at(places, periods), indices.begin(),
                           [](const Record* copy) { return copy ? copy->index : kOriginal; });
    return indices;
  }

  void assemble_elements() {
    for_cells(
        [&]<std::size_t n>(const std::array<std::int64_t, n>& places, const Image<Dim>& periods) {
          if constexpr (n == Dim + 1)
            cut_.elements_.push_back({places, indices_at(places, periods)});
        });
    std::ranges::sort(cut_.elements_, {}, &Cracks<Dim>::Element::places);
  }

  // Returns the periods of the elements on both sides of a facet, whose first node is owned. On the
  // side without an element they are those of the other side. Side 0 is left of an edge; from side
  // 0 a triangle is counter-clockwise.
  std::array<Image<Dim>, 2> periods_beside(const std::array<std::int64_t, Dim>& places) const {
    std::array<std::int64_t, Dim> nodes;
    std::ranges::transform(places, nodes.begin(), [this](auto p) { return results_.node_at(p); });
    std::array<Image<Dim>, 2> periods{};
    std::array<bool, 2> found{};
    level_.stars.for_simplices(nodes[0], [&](const Corners& others) {
      for (std::size_t side = 0; side < 2; ++side) {
        bool beside = false;
        if constexpr (Dim == 2)
          beside = others[side] == nodes[1];
        else
          for (std::size_t k = 0; k < 3; ++k)
            beside =
                beside || (others[k] == nodes[1 + side] && others[(k + 1) % 3] == nodes[2 - side]);
        if (!beside) continue;
        periods[side] = periods_of(nodes[0], others);
        found[side] = true;
      }
    });
    if (!found[0]) periods[0] = periods[1];
    if (!found[1]) periods[1] = periods[0];
    return periods;
  }

  // Returns the axis across which a facet lies on a flat side, where elements on both sides of the
  // facet have the given periods; -1 for other facets.
  int flat_axis(const std::array<std::int64_t, Dim>& places, const Image<Dim>& front,
                const Image<Dim>& back) const {
    for (int k = 0; k < Dim; ++k) {
      const auto axis = index(k);
      if (front[axis] == back[axis] || !results_.domain().is_flat(axis)) continue;
      const auto on_side = [&](std::int64_t place) {
        const Point<Dim> x = level_.nodes.position(results_.node_at(place));
        const Image<Dim> image = cell().image_of_id(id(place));
        return cell().seen_from(image, x)[axis] == cell().box().low[axis];
      };
      if (std::ranges::all_of(places, on_side)) return k;
    }
    return -1;
  }

  // A facet on a flat side is one of both sides. Any other facet between elements in different
  // places is that of one of them.
  void assemble_facets() {
    results_.for_facets_without_tags([&](const std::array<std::int64_t, Dim>& places) {
      const auto [front, back] = periods_beside(places);
      if (const int k = flat_axis(places, front, back); k >= 0) {
        const auto axis = index(k);
        cut_.facets_.push_back({places,
                                {indices_at(places, front), indices_at(places, back)},
                                0,
                                {in_space(front), in_space(back)},
                                {results_.domain().side_tag(axis, front[axis] > back[axis]),
                                 results_.domain().side_tag(axis, back[axis] > front[axis])}});
        return;
      }
      const Image<Dim> periods = std::min(front, back);
      const auto copies = indices_at(places, periods);
      if (periods == Image<Dim>{} && std::ranges::all_of(copies, [](auto c) { return c < 0; }))
        return;
      cut_.facets_.push_back({places, {copies, copies}, 0, {in_space(periods), in_space(periods)}});
    });
    std::ranges::sort(cut_.facets_, {}, &CrackFacet<Dim>::places);
  }

  Results<Dim>& results_;
  const Level<Dim>& level_;
  const Communicator& comm_;
  Cracks<Dim> cut_;
  std::vector<Copied> nodes_;  // in the order of their ids
  std::vector<Record> known_;  // ordered by key_of()
};

template <int Dim>
Cracks<Dim> make_periodic_cut(Results<Dim>& results) {
  results.prepare_stars();
  return PeriodicCutMaker<Dim>(results).make();
}

template Cracks<2> make_periodic_cut(Results<2>&);
template Cracks<3> make_periodic_cut(Results<3>&);

}  // namespace pnpbs

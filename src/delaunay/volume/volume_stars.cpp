// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/volume_stars.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "delaunay/listed_reach.hpp"
#include "delaunay/volume/agreed_triangles.hpp"
#include "delaunay/volume/domain_rule.hpp"
#include "delaunay/volume/volume_star.hpp"

namespace pnpbs {
namespace {

// The elements in the stars of a chunk found until now, for later nodes of the chunk: an element of
// one star belongs to the stars of all its corners.
class FoundElements {
 public:
  struct Element {
    // Nodes, in positive orientation with the node of the star.
    std::array<std::int32_t, 3> corners;
    bool in_domain;
  };

  FoundElements() { last_.fill(kNone); }

  void begin_at(std::int64_t first) { first_ = first; }
  // Adds an element of the star of node i to the later ones among its corners.
  void add(std::int64_t i, const std::array<std::int32_t, 3>& corners, bool in_domain) {
    const auto [a, b, c] = corners;
    const auto node = static_cast<std::int32_t>(i);
    add_to(i, a, {{node, c, b}, in_domain});
    add_to(i, b, {{node, a, c}, in_domain});
    add_to(i, c, {{node, b, a}, in_domain});
  }
  // Calls visit(element) for the known elements of the star of node i.
  template <class Visit>
  void for_elements(std::int64_t i, const Visit& visit) const {
    for (std::int32_t k = last_[place(i)]; k != kNone; k = all_[static_cast<std::size_t>(k)].before)
      visit(all_[static_cast<std::size_t>(k)].element);
  }

 private:
  static constexpr std::int32_t kNone = -1;
  struct Entry {
    Element element;
    std::int32_t before;  // Previous entry of the same node.
  };

  std::size_t place(std::int64_t i) const { return static_cast<std::size_t>(i - first_); }
  void add_to(std::int64_t i, std::int32_t corner, const Element& element) {
    if (corner <= i || corner >= first_ + VolumeStars::kChunk) return;
    std::int32_t& last = last_[place(corner)];
    all_.push_back({element, last});
    last = static_cast<std::int32_t>(all_.size() - 1);
  }

  std::int64_t first_ = 0;
  std::array<std::int32_t, VolumeStars::kChunk> last_;  // Last entry of each node of the chunk.
  std::vector<Entry> all_;
};

// Numbers nodes in the order of their addition. It is a hash table by the last bits of the index,
// which usually differ for nodes near each other.
class NodeNumbers {
 public:
  void clear() {
    count_ = 0;
    if (++round_ == 0) slots_.assign(slots_.size(), {});
  }
  // Returns the number of the node, or -1 if it has none.
  std::int32_t of(std::int32_t node) const {
    for (std::size_t k = first_slot(node); slots_[k].round == round_; k = next_slot(k))
      if (slots_[k].node == node) return slots_[k].place;
    return -1;
  }
  // Adds a node that has no number yet.
  void add(std::int32_t node) {
    if (4 * static_cast<std::size_t>(count_ + 1) > slots_.size()) grow();
    put(node, count_++);
  }

 private:
  struct Slot {
    std::uint32_t round = 0;
    std::int32_t node = 0, place = 0;
  };
  std::size_t first_slot(std::int32_t node) const {
    return static_cast<std::size_t>(node) & (slots_.size() - 1);
  }
  std::size_t next_slot(std::size_t k) const { return (k + 1) & (slots_.size() - 1); }
  void put(std::int32_t node, std::int32_t place) {
    std::size_t k = first_slot(node);
    while (slots_[k].round == round_) k = next_slot(k);
    slots_[k] = {round_, node, place};
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.round == round_) put(slot.node, slot.place);
  }

  std::uint32_t round_ = 1;
  std::int32_t count_ = 0;
  std::vector<Slot> slots_ = std::vector<Slot>(256);  // Slots of other rounds are free.
};

// Finds the stars of a chunk, one node after the other.
class StarWriter {
 public:
  StarWriter(const VolumeStarInput& input, std::vector<double>& needs)
      : in_(input),
        needs_(needs),
        reach_(input.nodes, input.tree, input.buckets, input.lists, input.known) {}

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    found_elements_.begin_at(i - i % VolumeStars::kChunk);
    const double needs = find_star(i);
    if (!needs_.empty()) needs_[static_cast<std::size_t>(i)] = needs;
    if (needs > 0) {
      out.push_back(VolumeStars::header(0, false));
      return;
    }
    star_.finish([&](const VolumeStar::Corners& corners) {
      const bool taken = in_domain(i, corners);
      found_elements_.add(i,
                          {candidates_[index(corners[0])], candidates_[index(corners[1])],
                           candidates_[index(corners[2])]},
                          taken);
      return taken;
    });
    write(out);
  }

 private:
  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }

  VolumeNode node(std::int64_t j) const {
    return {in_.nodes.position(j), in_.nodes.d(j), in_.nodes.id(j)};
  }

  void add(std::int64_t j) {
    star_.add(node(j));
    candidates_.push_back(static_cast<std::int32_t>(j));
    places_.add(static_cast<std::int32_t>(j));
  }

  std::int32_t place_with(std::int32_t j) {
    const std::int32_t place = places_.of(j);
    if (place >= 0) return place;
    add(j);
    return static_cast<std::int32_t>(candidates_.size() - 1);
  }
  void add_new(std::int64_t j) { place_with(static_cast<std::int32_t>(j)); }

  void add_known(std::int64_t i) {
    found_elements_.for_elements(i, [&](const FoundElements::Element& element) {
      VolumeStar::Corners places;
      for (std::size_t k = 0; k < 3; ++k) places[k] = place_with(element.corners[k]);
      star_.add_known(places, element.in_domain);
    });
  }

  // Returns 0, or the distance up to which nodes must be known.
  double find_star(std::int64_t i) {
    star_.start(node(i));
    candidates_.clear();
    places_.clear();
    add_known(i);
    if (star_.all_known()) return 0;
    double reach = in_.complete && !in_.complete(i) ? 0 : reach_.of(i);
    if (reach > 0) {
      add_listed(i);
    } else {
      reach = std::max(reach_.whatever_is_known(i), in_.nodes.d(i));
      if (!in_.known.covers(in_.tree, box_around<3>(in_.nodes.position(i), reach))) return reach;
      add_all_within(i, reach);
    }
    while (!star_.wrap(reach)) {
      if (!all_is_known()) return star_.search_reach();
      if (!add_what_may_matter()) break;
    }
    return 0;
  }

  void add_listed(std::int64_t i) {
    in_.lists.for_neighbours(i, [&](std::int64_t j) {
      if (squared_distance<3>(in_.nodes.position(i), in_.nodes.position(j)) > 0) add_new(j);
    });
  }

  void add_all_within(std::int64_t i, double reach) {
    const Point<3> x = in_.nodes.position(i);
    in_.tree.for_leaves_in(box_around<3>(x, reach), [&](std::int32_t leaf) {
      for (std::int32_t j = in_.buckets.begin(leaf); j < in_.buckets.end(leaf); ++j) {
        const double gap = squared_distance<3>(x, in_.nodes.position(j));
        if (gap > 0 && gap <= reach * reach) add_new(j);
      }
    });
  }

  bool may_matter_in(std::int32_t cell) const {
    return star_.may_matter_in(in_.tree.cell_box_with_room(cell));
  }
  Box<3> search_box() const { return box_around<3>(star_.centre().x, star_.search_reach()); }

  bool all_is_known() const {
    return in_.known.covers(in_.tree, search_box(),
                            [&](std::int32_t cell) { return may_matter_in(cell); });
  }

  // Examines n nodes from `first` on.
  void find_what_may_matter(std::int32_t first, std::int32_t n) {
    const auto& x = in_.nodes.x;
    std::uint64_t bits =
        star_.may_matter_bits({x[0].data() + first, x[1].data() + first, x[2].data() + first},
                              static_cast<std::size_t>(n));
    for (; bits != 0; bits &= bits - 1) {
      const std::int32_t j = first + std::countr_zero(bits);
      if (star_.may_matter(in_.nodes.position(j)) && places_.of(j) < 0) found_.push_back(j);
    }
  }

  // Returns whether there was any such node.
  bool add_what_may_matter() {
    constexpr std::int32_t kNodes = kWord;
    found_.clear();
    in_.tree.for_leaves_in(
        search_box(), [&](std::int32_t cell) { return may_matter_in(cell); },
        [&](std::int32_t leaf) {
          for (std::int32_t first = in_.buckets.begin(leaf); first < in_.buckets.end(leaf);
               first += kNodes)
            find_what_may_matter(first, std::min(kNodes, in_.buckets.end(leaf) - first));
        });
    for (const std::int32_t j : found_) add(j);
    return !found_.empty();
  }

  bool in_domain(std::int64_t i, const VolumeStar::Corners& corners) const {
    return pnpbs::in_domain(in_, {i, candidates_[index(corners[0])], candidates_[index(corners[1])],
                                  candidates_[index(corners[2])]});
  }

  void write(std::vector<std::int32_t>& out) const {
    const auto node_at = [&](std::int32_t place) {
      return candidates_[index(star_.neighbours()[index(place)])];
    };
    const std::size_t n = star_.neighbours().size();
    out.push_back(VolumeStars::header(n, star_.closed()));
    for (const std::int32_t k : star_.neighbours()) out.push_back(candidates_[index(k)]);
    for (const VolumeStar::Corners& triangle : star_.triangles()) {
      if (n <= index(VolumeStars::kMaxPlaces)) {
        out.push_back(VolumeStars::pack(triangle));
      } else {
        for (const std::int32_t place : triangle) out.push_back(node_at(place));
      }
    }
  }

  const VolumeStarInput& in_;
  std::vector<double>& needs_;
  ListedReach<3> reach_;
  VolumeStar star_;
  FoundElements found_elements_;
  std::vector<std::int32_t> candidates_, found_;  // Indices of nodes.
  NodeNumbers places_;                            // Numbers of the candidates.
};

}  // namespace

void VolumeStars::build(const VolumeStarInput& input) {
  on_surfaces_ = false;
  found_.clear();
  arrangement_ = input.nodes.arrangement();
  needs_.assign(input.known.is_everywhere() ? 0 : static_cast<std::size_t>(input.nodes.count), 0);
  rows_.build("pnpbs::VolumeStars::build", input.nodes.count,
              [&] { return StarWriter(input, needs_); });
}

namespace {

void write_none(std::int64_t, std::vector<std::int32_t>& out) {
  out.push_back(VolumeStars::header(0, false));
}

}  // namespace

void VolumeStars::build_none(const VolumeStarInput& input) {
  on_surfaces_ = false;
  found_.assign(static_cast<std::size_t>(input.nodes.count), 0);
  arrangement_ = input.nodes.arrangement();
  needs_.assign(input.known.is_everywhere() ? 0 : static_cast<std::size_t>(input.nodes.count), 0);
  rows_.build("pnpbs::VolumeStars::build_none", input.nodes.count, [] { return write_none; });
}

void VolumeStars::remove(const std::vector<char>& unwanted) {
  doubt(unwanted);
  rows_.rewrite(
      "pnpbs::VolumeStars::remove", std::ssize(unwanted),
      [&](std::int64_t i) { return unwanted[static_cast<std::size_t>(i)] != 0; },
      [] { return write_none; });
}

void VolumeStars::add(const VolumeStarInput& input, const std::vector<char>& wanted) {
  note_found(wanted);
  rows_.rewrite(
      "pnpbs::VolumeStars::add", input.nodes.count,
      [&](std::int64_t i) { return wanted[static_cast<std::size_t>(i)] != 0; },
      [&] { return StarWriter(input, needs_); });
}

void VolumeStars::doubt(const std::vector<char>& doubtful) {
  if (found_.empty()) found_.assign(doubtful.size(), 1);
  for (std::size_t i = 0; i < found_.size(); ++i) found_[i] = found_[i] && !doubtful[i];
}

// Stores the stars of surfaces alone as a header, the neighbours, and two nodes for each triangle.

namespace {

class SurfaceStarWriter {
 public:
  SurfaceStarWriter(const Nodes<3>& nodes, const SurfaceRings& rings)
      : nodes_(nodes), agreed_(nodes, rings) {}

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    agreed_.of(i, triangles_);
    neighbours_.clear();
    for (const AgreedTriangles::Others& others : triangles_)
      neighbours_.insert(neighbours_.end(), others.begin(), others.end());
    std::ranges::sort(neighbours_, {}, [this](std::int32_t j) { return nodes_.id(j); });
    const bool closed = each_comes_twice();
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    out.push_back(VolumeStars::header(neighbours_.size(), closed));
    out.insert(out.end(), neighbours_.begin(), neighbours_.end());
    for (const AgreedTriangles::Others& others : triangles_)
      out.insert(out.end(), others.begin(), others.end());
  }

 private:
  bool each_comes_twice() const {
    for (std::size_t k = 0; k < neighbours_.size(); k += 2)
      if (k + 1 == neighbours_.size() || neighbours_[k] != neighbours_[k + 1]) return false;
    return !neighbours_.empty();
  }

  const Nodes<3>& nodes_;
  AgreedTriangles agreed_;
  std::vector<AgreedTriangles::Others> triangles_;
  std::vector<std::int32_t> neighbours_;
};

}  // namespace

void VolumeStars::build(const SurfaceStarInput& input) {
  on_surfaces_ = true;
  SurfaceRings rings;
  rings.build(input);
  rows_.build("pnpbs::VolumeStars::build_on_surfaces", input.nodes.count,
              [&] { return SurfaceStarWriter(input.nodes, rings); });
  needs_ = rings.take_needs();
}

}  // namespace pnpbs

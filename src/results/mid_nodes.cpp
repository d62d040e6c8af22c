// SPDX-License-Identifier: BSD-3-Clause
#include "results/mid_nodes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "comm/id_blocks.hpp"
#include "comm/records.hpp"
#include "results/edge_middles.hpp"
#include "results/element_regions.hpp"

namespace pnpbs {
namespace {

constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();  // no tag has this value

// An edge as a rank reports it.
struct Report {
  std::array<std::int64_t, 2> ids;  // ascending
  std::int64_t tag, region;         // smallest ones that the rank knows; kNone if it knows none
};

// The data of an edge that all ranks together determine.
struct Merged {
  std::int64_t number, tag, region;
  bool first;
};

}  // namespace

std::int64_t MidNodes::between(std::int64_t a, std::int64_t b) const {
  const auto low = static_cast<std::size_t>(std::min(a, b));
  const auto first = nodes_.begin() + begin_[low], last = nodes_.begin() + begin_[low + 1];
  const auto found = std::lower_bound(first, last, std::max(a, b),
                                      [](const MidNode& m, auto end) { return m.ends[1] < end; });
  return found != last && found->ends[1] == std::max(a, b) ? found - nodes_.begin() : -1;
}

// Makes the mid nodes in steps. The edges are distributed over the ranks by the smaller id of their
// ends; the rank that an edge is assigned to numbers it and merges the reports of all ranks.
template <int Dim>
class MidNodeMaker {
 public:
  explicit MidNodeMaker(Results<Dim>& results)
      : results_(results), level_(results.level()), comm_(results.communicator()) {
    if (comm_.size() == 1) return;
    blocks_.emplace(comm_, results.count(), [&](std::int64_t place) { return id(place); });
  }

  MidNodes make() {
    collective_try(comm_, [this] { find_edges(); });
    report();
    collective_try(comm_, [this] { place(); });
    if (level_.nodes.cell.any()) make_images_equal();
    unfold();
    return std::move(mids_);
  }

 private:
  std::int64_t id(std::int64_t place) const { return level_.nodes.id(results_.node_at(place)); }

  // Returns the ids of the ends of an edge, in ascending order. In a periodic domain they are those
  // of its image with the first end in the cell.
  std::array<std::int64_t, 2> ids(const MidNode& mid) const {
    const PeriodicCell<Dim>& cell = level_.nodes.cell;
    const std::int64_t a = id(mid.ends[0]), b = id(mid.ends[1]);
    const std::int64_t least = std::min(a, b), home = cell.home_id(least);
    return {home, std::max(a, b) - (least - home)};
  }
  // Returns the translation of an edge to this image.
  Translation<Dim> to_cell(const MidNode& mid) const {
    const PeriodicCell<Dim>& cell = level_.nodes.cell;
    return {cell, cell.image_of_id(std::min(id(mid.ends[0]), id(mid.ends[1])))};
  }

  // Calls visit(corners) for all elements and facets of this rank.
  template <class Visit>
  void for_cells(const Visit& visit) const {
    if (results_.kind() != GeometryKind::surface) results_.for_elements(visit);
    results_.for_facets_without_tags(visit);
  }

  // Calls visit(corners) for the elements, which on surfaces alone are the facets.
  template <class Visit>
  void for_elements(const Visit& visit) const {
    if constexpr (Dim == 3)
      if (results_.kind() == GeometryKind::surface) return results_.for_open_facets(visit);
    results_.for_elements(visit);
  }

  void find_edges() {
    std::vector<std::array<std::int32_t, 2>> edges;
    for_cells([&]<std::size_t n>(const std::array<std::int64_t, n>& places) {
      for (std::size_t e = 0; e < edges_of(n); ++e) {
        const auto a = static_cast<std::int32_t>(places[kElementEdges[e][0]]);
        const auto b = static_cast<std::int32_t>(places[kElementEdges[e][1]]);
        edges.push_back({std::min(a, b), std::max(a, b)});
      }
    });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    mids_.begin_.assign(static_cast<std::size_t>(results_.held()) + 1, 0);
    for (const auto& ends : edges) {
      mids_.nodes_.push_back({ends, 0, {}, 0, 0, false, true});
      ++mids_.begin_[static_cast<std::size_t>(ends[0]) + 1];
    }
    for (std::size_t k = 1; k < mids_.begin_.size(); ++k) mids_.begin_[k] += mids_.begin_[k - 1];
  }

  // Stores number, tag and region of all edges. Collective.
  void report() {
    std::vector<Report> reports;
    collective_try(comm_, [&] { reports = own_reports(); });
    const std::vector<Merged> merged =
        answers<Merged>(reports, [this](const std::vector<Report>& all) { return merge(all); });
    for (std::size_t e = 0; e < merged.size(); ++e) {
      MidNode& mid = mids_.nodes_[e];
      mid.number = merged[e].number;
      mid.on_facet = merged[e].tag != kNone;
      if (mid.on_facet) mid.tag = static_cast<std::int32_t>(merged[e].tag);
      if (merged[e].region != kNone) mid.region = static_cast<std::int32_t>(merged[e].region);
      mid.first = merged[e].first;
    }
  }

  std::vector<Report> own_reports() const {
    std::vector<Report> reports;
    for (const MidNode& mid : mids_.nodes_) reports.push_back({ids(mid), kNone, kNone});
    const auto reduce = [&](const auto& places, std::int64_t Report::*member, std::int64_t value) {
      for (const std::int64_t e : mids_.of(places)) {
        std::int64_t& least = reports[static_cast<std::size_t>(e)].*member;
        least = std::min(least, value);
      }
    };
    results_.for_facets(
        [&](const auto& places, std::int32_t tag) { reduce(places, &Report::tag, tag); });
    ElementRegions<Dim> region_of(results_);
    if (region_of.any())
      results_.for_elements(
          [&](const auto& places) { reduce(places, &Report::region, region_of(places)); });
    return reports;
  }

  // Sends each question to the rank of the edge's smaller id, where respond(all questions) returns
  // the answers in their order, and returns the answers to this rank's. Collective.
  template <class Answer, class Question, class Respond>
  std::vector<Answer> answers(const std::vector<Question>& questions, const Respond& respond) {
    if (!blocks_) return respond(questions);
    const auto rank_of = [&](std::size_t e) { return blocks_->rank_of(ids(mids_.nodes_[e])[0]); };
    Outbox asked;
    for (std::size_t e = 0; e < questions.size(); ++e) pack(asked.to(rank_of(e)), questions[e]);
    const std::vector<Message> arrived = comm_.sparse_all_to_all(asked.messages());
    std::vector<Question> all;
    for (const Message& message : arrived)
      for_records<Question>(message.bytes, [&](const Question& one) { all.push_back(one); });
    const std::vector<Answer> found = respond(all);
    Outbox told;
    auto next = found.begin();
    for (const Message& message : arrived)
      for (std::size_t k = 0; k < message.bytes.size() / sizeof(Question); ++k)
        pack(told.to(message.rank), *next++);
    const std::vector<Message> returned = comm_.sparse_all_to_all(told.messages());
    RankIndices sources;
    for (const Message& message : returned) sources.add(message.rank);
    std::vector<std::size_t> at(returned.size());  // answers are in the order of the questions
    std::vector<Answer> mine(questions.size());
    for (std::size_t e = 0; e < mine.size(); ++e) {
      const auto k = static_cast<std::size_t>(sources.of(rank_of(e)));
      std::memcpy(&mine[e], returned[k].bytes.data() + at[k], sizeof(Answer));
      at[k] += sizeof(Answer);
    }
    return mine;
  }

  // Numbers the reported edges and merges the reports of each edge. Stores which reports belong to
  // the same edge. Collective.
  std::vector<Merged> merge(const std::vector<Report>& reports) {
    std::vector<std::size_t> order(reports.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return reports[k].ids; });
    edge_of_report_.resize(reports.size());
    std::vector<Merged> edges, merged(reports.size());
    std::vector<char> first(reports.size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Report& report = reports[order[k]];
      if (k == 0 || reports[order[k - 1]].ids != report.ids) {
        edges.push_back({0, kNone, kNone, false});
        first[order[k]] = 1;
      }
      Merged& edge = edges.back();
      edge.tag = std::min(edge.tag, report.tag);
      edge.region = std::min(edge.region, report.region);
      edge_of_report_[order[k]] = edges.size() - 1;
    }
    const RankSpan span = span_of(comm_, edges.size());
    mids_.all_ = span.total;
    assigned_ = edges.size();
    for (std::size_t k = 0; k < reports.size(); ++k) {
      merged[k] = edges[edge_of_report_[k]];
      merged[k].number = span.first + static_cast<std::int64_t>(edge_of_report_[k]);
      merged[k].first = first[k] != 0;
    }
    return merged;
  }

  // Returns the middle of the edge, on a sphere that of the arc.
  Point<3> straight_middle(const MidNode& mid) const {
    const Point<3> middle = chord_middle(mid);
    if (!results_.embedding().is_sphere()) return middle;
    return shifted({}, results_.embedding().radius(), unit_vector(middle));
  }
  Point<3> chord_middle(const MidNode& mid) const {
    return middle_of<3>(results_.point_in_space(results_.node_at(mid.ends[0])),
                        results_.point_in_space(results_.node_at(mid.ends[1])));
  }

  void place() {
    std::vector<EdgeMiddle<Dim>> middles;
    std::vector<std::size_t> on_facets;
    for (std::size_t e = 0; e < mids_.nodes_.size(); ++e) {
      MidNode& mid = mids_.nodes_[e];
      mid.x = straight_middle(mid);
      if (!mid.on_facet) continue;
      const std::int64_t i = results_.node_at(mid.ends[0]), j = results_.node_at(mid.ends[1]);
      middles.push_back(
          {{i, j}, middle_of<Dim>(level_.nodes.position(i), level_.nodes.position(j))});
      on_facets.push_back(e);
    }
    move_to_boundary(level_, middles);
    for (std::size_t k = 0; k < middles.size(); ++k)
      mids_.nodes_[on_facets[k]].x = results_.embedding().in_space(middles[k].x);
  }

  // Moves the mid nodes of images of an edge so that they differ exactly by the periods. They were
  // computed at different copies of the boundary. Collective.
  void make_images_equal() {
    struct Position {
      Image<Dim> image;
      Point<Dim> x;  // seen from this image
    };
    std::vector<Position> positions;
    collective_try(comm_, [&] {
      for (const MidNode& mid : mids_.nodes_) {
        const Translation<Dim> to = to_cell(mid);
        Point<Dim> x;
        std::copy_n(mid.x.begin(), Dim, x.begin());
        positions.push_back({to.image, to(mid.on_facet ? to.cell.rounded(x) : x)});
      }
    });
    positions = answers<Position>(positions, [&](const std::vector<Position>& reports) {
      std::vector<Position> first(assigned_), all;
      std::vector<char> known(assigned_, 0);
      for (std::size_t k = 0; k < reports.size(); ++k) {
        const std::size_t edge = edge_of_report_[k];
        if (known[edge] == 0 || reports[k].image < first[edge].image) first[edge] = reports[k];
        known[edge] = 1;
      }
      for (const std::size_t edge : edge_of_report_) all.push_back(first[edge]);
      return all;
    });
    for (std::size_t e = 0; e < positions.size(); ++e) {
      const Point<Dim> x = to_cell(mids_.nodes_[e]).back(positions[e].x);
      std::copy_n(x.begin(), Dim, mids_.nodes_[e].x.begin());
    }
  }

  // Returns for each edge whether an element of this rank at it would fold.
  std::vector<char> folding_edges() const {
    std::vector<char> folds(mids_.nodes_.size(), 0);
    for_elements([&]<std::size_t n>(std::array<std::int64_t, n> places) {
      // Corners in the order of ids give the same rounding on any number of ranks.
      std::ranges::sort(places, {}, [&](std::int64_t place) { return id(place); });
      const auto edges = mids_.of(places);
      std::array<Point<3>, n> x;
      for (std::size_t k = 0; k < n; ++k)
        x[k] = results_.point_in_space(results_.node_at(places[k]));
      std::array<Point<3>, edges_of(n)> ways;
      bool curved = false;
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const MidNode& mid = mids_.nodes_[static_cast<std::size_t>(edges[e])];
        ways[e] = difference(mid.x, chord_middle(mid));
        curved = curved || (mid.on_facet && ways[e] != Point<3>{});
      }
      if (!curved || stays_unfolded<n>(x, ways)) return;
      for (const std::int64_t e : edges) folds[static_cast<std::size_t>(e)] = 1;
    });
    return folds;
  }

  // Straightens the edges of facets at elements that would fold. Collective.
  void unfold() {
    std::vector<char> folds;
    collective_try(comm_, [&] { folds = folding_edges(); });
    folds = answers<char>(folds, [&](const std::vector<char>& reports) {
      std::vector<char> edges(assigned_, 0), all(reports.size());
      for (std::size_t k = 0; k < reports.size(); ++k) edges[edge_of_report_[k]] |= reports[k];
      for (std::size_t k = 0; k < reports.size(); ++k) all[k] = edges[edge_of_report_[k]];
      return all;
    });
    std::vector<std::int64_t> straight{0};
    for (std::size_t e = 0; e < folds.size(); ++e) {
      MidNode& mid = mids_.nodes_[e];
      if (folds[e] == 0 || !mid.on_facet) continue;
      const Point<3> middle = straight_middle(mid);
      if (mid.first && mid.x != middle) ++straight[0];
      mid.x = middle;
    }
    comm_.allreduce_sum(straight);
    mids_.straight_ = straight[0];
  }

  Results<Dim>& results_;
  const Level<Dim>& level_;
  const Communicator& comm_;
  std::optional<IdBlocks> blocks_;  // not set on a single rank
  MidNodes mids_;
  std::vector<std::size_t> edge_of_report_;  // of the edges that are assigned to this rank
  std::size_t assigned_ = 0;                 // their number
};

template <int Dim>
MidNodes make_mid_nodes(Results<Dim>& results) {
  results.prepare_stars();
  return MidNodeMaker<Dim>(results).make();
}

template MidNodes make_mid_nodes(Results<2>&);
template MidNodes make_mid_nodes(Results<3>&);

}  // namespace pnpbs

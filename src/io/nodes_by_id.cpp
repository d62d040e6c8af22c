// SPDX-License-Identifier: BSD-3-Clause
#include "io/nodes_by_id.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/leading_count.hpp"
#include "comm/records.hpp"
#include "io/rows.hpp"
#include "io/tag_groups.hpp"

namespace pnpbs::io {

namespace {

// A node, as ranks exchange it.
template <int Dim>
struct NodeRow {
  std::int64_t id;
  Point<3> x;  // the first `coordinates` of them are valid
  double d;
  std::int32_t tag, region;
};

// A component of a field at a node.
struct FieldValue {
  std::int64_t id, component;
  double value;
};

// A mid node, and a component of a field at it.
struct MidRow {
  std::int64_t number;
  Point<3> x;
  double d;
  std::int32_t tag, region;
};

struct MidFieldValue {
  std::int64_t number, component;
  double value;
};

// An element. Its corners are given by labels, see NodesById::label(), and its mid nodes by their
// numbers in the file.
template <int Dim, std::size_t mid_count>
struct ElementRow {
  std::array<std::int64_t, Dim + 1> corners;  // smallest label first
  std::array<std::int64_t, mid_count> mids;
  float quality;
  std::int32_t region;
};

template <int Dim, std::size_t mid_count>
struct FacetRow {
  std::array<std::int64_t, Dim> corners;  // smallest label first in space
  std::array<std::int64_t, mid_count> mids;
  std::int32_t tag;
  float quality;
  Side domain;  // in the plane only
};

Side side_of_domain(const BoundaryEdge& edge) {
  if (!edge.bounds()) return Side::both;
  return edge.left_inside ? Side::left : Side::right;
}

template <int Dim>
NodeRow<Dim> node_row(const Results<Dim>& results, std::int64_t i, std::int32_t region) {
  const Nodes<Dim>& nodes = results.level().nodes;
  return {nodes.id(i), results.point_in_space(i), results.spacing_at(i),
          static_cast<std::int32_t>(nodes.tag(i)), region};
}

template <int Dim>
NodeRows sorted_nodes(std::vector<NodeRow<Dim>> rows, int coordinates, bool with_regions) {
  std::ranges::sort(rows, {}, &NodeRow<Dim>::id);
  NodeRows sorted;
  for (const NodeRow<Dim>& row : rows) {
    sorted.ids.push_back(row.id);
    sorted.x.insert(sorted.x.end(), row.x.begin(), row.x.begin() + coordinates);
    sorted.spacing.push_back(row.d);
    sorted.tags.push_back(row.tag);
    if (with_regions) sorted.regions.push_back(row.region);
  }
  return sorted;
}

// Returns the rows with their corners, and appends their mid nodes.
template <int Dim, std::size_t n>
ElementRows sorted_elements(std::vector<ElementRow<Dim, n>> rows, bool with_regions,
                            std::vector<std::int64_t>& mids) {
  std::ranges::sort(rows, {}, &ElementRow<Dim, n>::corners);
  ElementRows sorted;
  for (const ElementRow<Dim, n>& row : rows) {
    sorted.nodes.insert(sorted.nodes.end(), row.corners.begin(), row.corners.end());
    mids.insert(mids.end(), row.mids.begin(), row.mids.end());
    sorted.quality.push_back(row.quality);
    if (with_regions) sorted.regions.push_back(row.region);
  }
  return sorted;
}

template <int Dim, std::size_t n>
FacetRows sorted_facets(std::vector<FacetRow<Dim, n>> rows, std::vector<std::int64_t>& mids) {
  std::ranges::sort(rows, {},
                    [](const FacetRow<Dim, n>& f) { return std::tuple(f.corners, f.tag); });
  FacetRows sorted;
  for (const FacetRow<Dim, n>& row : rows) {
    sorted.nodes.insert(sorted.nodes.end(), row.corners.begin(), row.corners.end());
    mids.insert(mids.end(), row.mids.begin(), row.mids.end());
    sorted.tags.push_back(row.tag);
    sorted.quality.push_back(row.quality);
    if constexpr (Dim == 2) sorted.domain.push_back(row.domain);
  }
  return sorted;
}

}  // namespace

template <int Dim>
NodesById<Dim>::NodesById(Results<Dim>& results, int order, const std::vector<OutputField>& fields)
    : results_(results), comm_(results.communicator()) {
  const bool elements = order > 0;
  prepare(results, elements);
  if (order == 2) mid_nodes_ = &results.mid_nodes();
  owned_ = results.count();
  contents_.dimension = Dim;
  contents_.coordinates = results.coordinates();
  contents_.with_elements = elements;
  contents_.cells = cells_of(results, elements);
  if (contents_.cells == Cells::elements) region_of_.emplace(results);
  if (region_of_ && !region_of_->any()) region_of_.reset();
  contents_.with_regions = region_of_.has_value();
  contents_.names = &results.domain().names();
  contents_.fields = &fields;
  std::vector<std::int64_t> counts{owned_, 0, 0};
  if (elements) {
    results.for_elements([&](const auto&) { ++counts[1]; });
    results.for_facets_without_tags([&](const auto&) { ++counts[2]; });
  }
  comm_.allreduce_sum(counts);
  node_count_ = contents_.nodes = counts[0];
  contents_.elements = counts[1];
  contents_.facets = counts[2];
  if (mid_nodes_) {
    contents_.order = 2;
    contents_.nodes += mid_nodes_->all();
    const std::vector<MidNode>& mids = mid_nodes_->nodes();
    for (std::size_t e = 0; e < mids.size(); ++e)
      if (mids[e].first) own_mids_.push_back(e);
    std::ranges::sort(own_mids_, {}, [&](std::size_t e) { return mids[e].number; });
  }
  if (comm_.size() == 1) return;
  const NodeArray<std::int64_t>& id = results.level().nodes.id;
  blocks_.emplace(comm_, owned_, [&](std::int64_t place) { return id(results.node_at(place)); });
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; number < node_count_; number += kWindow) numbers.push_back(number);
  bounds_ = blocks_->ids_at(numbers);
}

// ------------------------------------------------------------------ windows --------------------

// Returns the index of this rank's first node in this part or a later one.
template <int Dim>
std::int64_t NodesById<Dim>::first_place_in(std::size_t part) const {
  if (!blocks_) return std::min(static_cast<std::int64_t>(part) * kWindow, owned_);
  if (part >= bounds_.size()) return owned_;
  const NodeArray<std::int64_t>& id = results_.level().nodes.id;
  return leading_count(
      owned_, [&](std::int64_t place) { return id(results_.node_at(place)) < bounds_[part]; });
}

template <int Dim>
template <class Visit>
void NodesById<Dim>::for_windows(const Visit& visit) const {
  const auto ranks = static_cast<std::size_t>(comm_.size());
  const auto rank = static_cast<std::size_t>(comm_.rank());
  for (std::size_t part = 0; static_cast<std::int64_t>(part) * kWindow < node_count_; part += ranks)
    visit(Window{first_place_in(part), first_place_in(part + ranks),
                 static_cast<std::int64_t>(part + rank) * kWindow});
}

// Sends each row to the rank whose part of the window contains its first node. Collective.
template <int Dim>
template <class Row, class Label>
std::vector<Row> NodesById<Dim>::brought(std::vector<Row> rows, const Label& first_label) const {
  if (!blocks_) return rows;
  return redistribute<Row>(comm_, rows, [&](const Row& row) {
    const auto part = std::ranges::upper_bound(bounds_, first_label(row)) - bounds_.begin() - 1;
    return static_cast<int>(part % comm_.size());
  });
}

template <int Dim>
std::int64_t NodesById<Dim>::label(std::int64_t place) const {
  return blocks_ ? results_.level().nodes.id(results_.node_at(place)) : place;
}

template <int Dim>
template <std::size_t n>
std::array<std::int64_t, n> NodesById<Dim>::labels(
    const std::array<std::int64_t, n>& places) const {
  std::array<std::int64_t, n> all;
  std::ranges::transform(places, all.begin(), [this](std::int64_t place) { return label(place); });
  return all;
}

template <int Dim>
void NodesById<Dim>::label_by_numbers(std::vector<std::int64_t>& labels) const {
  if (blocks_) labels = blocks_->numbers_of(labels);
}

// Calls visit(first number, rows) for this rank's part of each window of mid nodes, which has the
// kWindow numbers from the first one. rows_of(mid node, rows) appends the rows of a mid node.
// Collective.
template <int Dim>
template <class Row, class RowsOf, class Visit>
void NodesById<Dim>::for_mid_windows(const RowsOf& rows_of, const Visit& visit) const {
  if (!mid_nodes_) return;
  auto next = own_mids_.begin();
  for (std::int64_t begin = 0; begin < mid_nodes_->all(); begin += kWindow * comm_.size()) {
    std::vector<Row> rows;
    for (; next != own_mids_.end(); ++next) {
      const MidNode& mid = mid_nodes_->nodes()[*next];
      if (mid.number >= begin + kWindow * comm_.size()) break;
      rows_of(mid, rows);
    }
    if (blocks_)
      rows = redistribute<Row>(comm_, rows, [&](const Row& row) {
        return static_cast<int>((row.number - begin) / kWindow);
      });
    visit(std::min(begin + kWindow * comm_.rank(), mid_nodes_->all()), std::move(rows));
  }
}

// ------------------------------------------------------------------ rows -----------------------

template <int Dim>
void NodesById<Dim>::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  for_windows([&](const Window& window) {
    std::vector<NodeRow<Dim>> own;
    for (std::int64_t place = window.begin; place < window.end; ++place) {
      const std::int64_t i = results_.node_at(place);
      own.push_back(node_row<Dim>(results_, i, region_of_ ? region_of_->at_node(i) : 0));
    }
    NodeRows rows =
        sorted_nodes<Dim>(brought(std::move(own), [](const NodeRow<Dim>& n) { return n.id; }),
                          contents_.coordinates, region_of_.has_value());
    rows.first = window.first;
    visit(rows);
  });
  const auto row_of = [&](const MidNode& mid, std::vector<MidRow>& rows) {
    const double d = 0.5 * (results_.spacing_at(results_.node_at(mid.ends[0])) +
                            results_.spacing_at(results_.node_at(mid.ends[1])));
    rows.push_back({mid.number, mid.x, d, mid.tag, mid.region});
  };
  for_mid_windows<MidRow>(row_of, [&](std::int64_t first, std::vector<MidRow> mids) {
    std::ranges::sort(mids, {}, &MidRow::number);
    NodeRows rows;
    rows.first = node_count_ + first;
    for (const MidRow& mid : mids) {
      rows.ids.push_back(-1);
      rows.x.insert(rows.x.end(), mid.x.begin(), mid.x.begin() + contents_.coordinates);
      rows.spacing.push_back(mid.d);
      rows.tags.push_back(mid.tag);
      if (region_of_) rows.regions.push_back(mid.region);
    }
    visit(rows);
  });
}

template <int Dim>
void NodesById<Dim>::for_field(std::size_t field,
                               const std::function<void(const FieldRows&)>& visit) const {
  const OutputField& of = (*contents_.fields)[field];
  const NodeArray<std::int64_t>& id = results_.level().nodes.id;
  for_windows([&](const Window& window) {
    std::vector<FieldValue> values;
    for (std::int64_t place = window.begin; place < window.end; ++place)
      for (std::int64_t c = 0; c < of.components; ++c)
        values.push_back({id(results_.node_at(place)), c,
                          of.values[static_cast<std::size_t>(place * of.components + c)]});
    values = brought(std::move(values), [](const FieldValue& v) { return v.id; });
    std::ranges::sort(values, {}, [](const FieldValue& v) { return std::pair(v.id, v.component); });
    FieldRows rows;
    rows.first = window.first;
    for (const FieldValue& value : values) rows.values.push_back(value.value);
    visit(rows);
  });
  const auto rows_of = [&](const MidNode& mid, std::vector<MidFieldValue>& rows) {
    for (std::int64_t c = 0; c < of.components; ++c) {
      const auto at_end = [&](std::size_t end) {
        return of.values[static_cast<std::size_t>(mid.ends[end] * of.components + c)];
      };
      rows.push_back({mid.number, c, 0.5 * (at_end(0) + at_end(1))});
    }
  };
  for_mid_windows<MidFieldValue>(
      rows_of, [&](std::int64_t first, std::vector<MidFieldValue> values) {
        std::ranges::sort(values, {},
                          [](const MidFieldValue& v) { return std::pair(v.number, v.component); });
        FieldRows rows;
        rows.first = node_count_ + first;
        for (const MidFieldValue& value : values) rows.values.push_back(value.value);
        visit(rows);
      });
}

// Returns the numbers of the mid nodes of an element or facet in the file.
template <int Dim>
template <std::size_t mids, std::size_t corners>
std::array<std::int64_t, mids> NodesById<Dim>::mids_of(
    const std::array<std::int64_t, corners>& places) const {
  std::array<std::int64_t, mids> numbers{};
  if constexpr (mids > 0) {
    numbers = mid_nodes_->of(places);
    for (std::int64_t& number : numbers)
      number = node_count_ + mid_nodes_->nodes()[static_cast<std::size_t>(number)].number;
  }
  return numbers;
}

// Replaces the labels of corners by numbers, inserts the mid nodes of each row after its corners,
// and numbers the rows after those of earlier windows. Collective.
template <int Dim>
template <class Rows>
void NodesById<Dim>::number_rows(Rows& rows, const std::vector<std::int64_t>& mids,
                                 std::size_t count, std::int64_t& before) const {
  label_by_numbers(rows.nodes);
  if (!mids.empty()) {
    const auto corners = static_cast<std::ptrdiff_t>(rows.nodes.size() / count);
    const auto each = static_cast<std::ptrdiff_t>(mids.size() / count);
    std::vector<std::int64_t> all;
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(count); ++k) {
      const auto corner = rows.nodes.begin() + corners * k;
      all.insert(all.end(), corner, corner + corners);
      all.insert(all.end(), mids.begin() + each * k, mids.begin() + each * (k + 1));
    }
    rows.nodes = std::move(all);
  }
  const RankSpan span = span_of(comm_, count);
  rows.first = before + span.first;
  before += span.total;
}

template <int Dim>
void NodesById<Dim>::for_elements(const std::function<void(const ElementRows&)>& visit) const {
  mid_nodes_ ? for_element_rows<edges_of(Dim + 1)>(visit) : for_element_rows<0>(visit);
}

template <int Dim>
template <std::size_t mid_count>
void NodesById<Dim>::for_element_rows(const std::function<void(const ElementRows&)>& visit) const {
  using Row = ElementRow<Dim, mid_count>;
  std::int64_t before = 0;
  for_windows([&](const Window& window) {
    std::vector<Row> own;
    results_.for_elements(window.begin, window.end, [&](const auto& places) {
      own.push_back({labels(places), mids_of<mid_count>(places), element_quality(results_, places),
                     region_of_ ? (*region_of_)(places) : 0});
    });
    std::vector<std::int64_t> mids;
    ElementRows rows = sorted_elements<Dim, mid_count>(
        brought(std::move(own), [](const Row& e) { return e.corners[0]; }), region_of_.has_value(),
        mids);
    number_rows(rows, mids, rows.quality.size(), before);
    visit(rows);
  });
}

template <int Dim>
void NodesById<Dim>::for_facets(const std::function<void(const FacetRows&)>& visit) const {
  mid_nodes_ ? for_facet_rows<edges_of(Dim)>(visit) : for_facet_rows<0>(visit);
}

template <int Dim>
template <std::size_t mid_count>
void NodesById<Dim>::for_facet_rows(const std::function<void(const FacetRows&)>& visit) const {
  using Row = FacetRow<Dim, mid_count>;
  std::int64_t before = 0;
  std::vector<Row> own;
  const auto first = [](const Row& f) { return f.corners[0]; };
  const auto pass_on = [&](std::vector<Row> arrived) {
    std::vector<std::int64_t> mids;
    FacetRows rows = sorted_facets<Dim, mid_count>(std::move(arrived), mids);
    number_rows(rows, mids, rows.tags.size(), before);
    visit(rows);
  };
  if constexpr (Dim == 2) {
    // All edges are one window, since every rank has the whole boundary in memory.
    results_.for_boundary_edges([&](const auto& places, const BoundaryEdge& edge) {
      own.push_back(
          {labels(places), mids_of<mid_count>(places), edge.tag, 0, side_of_domain(edge)});
    });
    if (blocks_)
      own = redistribute<Row>(comm_, own, [&](const Row& f) { return blocks_->rank_of(first(f)); });
    pass_on(std::move(own));
  } else {
    const auto keep = [&](const auto& places, std::int32_t tag) {
      own.push_back({labels(places), mids_of<mid_count>(places), tag,
                     facet_quality(results_, places), Side::both});
    };
    for_windows([&](const Window& window) {
      own.clear();
      results_.for_boundary_facets(window.begin, window.end, keep);
      results_.for_inner_facets(window.begin, window.end, keep);
      pass_on(brought(own, first));
    });
  }
}

template <int Dim>
std::vector<TagGroup> NodesById<Dim>::node_groups() const {
  const Nodes<Dim>& nodes = results_.level().nodes;
  TagGroups groups;
  for (std::int64_t place = 0; place < owned_; ++place) {
    const std::int64_t i = results_.node_at(place);
    const Point<3> x = results_.point_in_space(i);
    groups.add(static_cast<std::int32_t>(nodes.tag(i)), {&x, 1});
  }
  for (const std::size_t e : own_mids_) {
    const MidNode& mid = mid_nodes_->nodes()[e];
    groups.add(mid.tag, {&mid.x, 1});
  }
  return groups.of_all(comm_);
}

template <int Dim>
std::vector<TagGroup> NodesById<Dim>::facet_groups() const {
  TagGroups groups;
  results_.for_facets([&](const auto& places, std::int32_t tag) {
    groups.add(tag, places_in_space(results_, places));
  });
  return groups.of_all(comm_);
}

template <int Dim>
std::vector<TagGroup> NodesById<Dim>::region_groups() const {
  TagGroups groups;
  if (!region_of_) return {};
  results_.for_elements([&](const auto& places) {
    groups.add((*region_of_)(places), places_in_space(results_, places));
  });
  return groups.of_all(comm_);
}

template class NodesById<2>;
template class NodesById<3>;

}  // namespace pnpbs::io

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

// An element. Its nodes are given by labels, see NodesById::label().
template <int Dim>
struct ElementRow {
  std::array<std::int64_t, Dim + 1> corners;  // smallest label first
  float quality;
  std::int32_t region;
};

template <int Dim>
struct FacetRow {
  std::array<std::int64_t, Dim> corners;  // smallest label first in space
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

template <int Dim>
ElementRows sorted_elements(std::vector<ElementRow<Dim>> rows, bool with_regions) {
  std::ranges::sort(rows, {}, &ElementRow<Dim>::corners);
  ElementRows sorted;
  for (const ElementRow<Dim>& row : rows) {
    sorted.corners.insert(sorted.corners.end(), row.corners.begin(), row.corners.end());
    sorted.quality.push_back(row.quality);
    if (with_regions) sorted.regions.push_back(row.region);
  }
  return sorted;
}

template <int Dim>
FacetRows sorted_facets(std::vector<FacetRow<Dim>> rows) {
  std::ranges::sort(rows, {}, [](const FacetRow<Dim>& f) { return std::tuple(f.corners, f.tag); });
  FacetRows sorted;
  for (const FacetRow<Dim>& row : rows) {
    sorted.corners.insert(sorted.corners.end(), row.corners.begin(), row.corners.end());
    sorted.tags.push_back(row.tag);
    sorted.quality.push_back(row.quality);
    if constexpr (Dim == 2) sorted.domain.push_back(row.domain);
  }
  return sorted;
}

}  // namespace

template <int Dim>
NodesById<Dim>::NodesById(Results<Dim>& results, bool elements,
                          const std::vector<OutputField>& fields)
    : results_(results), comm_(results.communicator()) {
  prepare(results, elements);
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
  contents_.nodes = counts[0];
  contents_.elements = counts[1];
  contents_.facets = counts[2];
  if (comm_.size() == 1) return;
  const NodeArray<std::int64_t>& id = results.level().nodes.id;
  blocks_.emplace(comm_, owned_, [&](std::int64_t place) { return id(results.node_at(place)); });
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; number < contents_.nodes; number += kWindow)
    numbers.push_back(number);
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
  for (std::size_t part = 0; static_cast<std::int64_t>(part) * kWindow < contents_.nodes;
       part += ranks)
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
}

// Replaces labels by numbers, and numbers the rows after those of earlier windows. Collective.
template <int Dim>
template <class Rows>
void NodesById<Dim>::number_rows(Rows& rows, std::size_t count, std::int64_t& before) const {
  label_by_numbers(rows.corners);
  const RankSpan span = span_of(comm_, count);
  rows.first = before + span.first;
  before += span.total;
}

template <int Dim>
void NodesById<Dim>::for_elements(const std::function<void(const ElementRows&)>& visit) const {
  std::int64_t before = 0;
  for_windows([&](const Window& window) {
    std::vector<ElementRow<Dim>> own;
    results_.for_elements(window.begin, window.end, [&](const auto& places) {
      own.push_back({labels(places), element_quality(results_, places),
                     region_of_ ? (*region_of_)(places) : 0});
    });
    ElementRows rows = sorted_elements<Dim>(
        brought(std::move(own), [](const ElementRow<Dim>& e) { return e.corners[0]; }),
        region_of_.has_value());
    number_rows(rows, rows.quality.size(), before);
    visit(rows);
  });
}

template <int Dim>
void NodesById<Dim>::for_facets(const std::function<void(const FacetRows&)>& visit) const {
  std::int64_t before = 0;
  std::vector<FacetRow<Dim>> own;
  const auto first = [](const FacetRow<Dim>& f) { return f.corners[0]; };
  const auto pass_on = [&](std::vector<FacetRow<Dim>> arrived) {
    FacetRows rows = sorted_facets<Dim>(std::move(arrived));
    number_rows(rows, rows.tags.size(), before);
    visit(rows);
  };
  if constexpr (Dim == 2) {
    // All edges are one window, since every rank has the whole boundary in memory.
    results_.for_boundary_edges([&](const auto& places, const BoundaryEdge& edge) {
      own.push_back({labels(places), edge.tag, 0, side_of_domain(edge)});
    });
    if (blocks_)
      own = redistribute<FacetRow<Dim>>(
          comm_, own, [&](const FacetRow<Dim>& f) { return blocks_->rank_of(first(f)); });
    pass_on(std::move(own));
  } else {
    const auto keep = [&](const auto& places, std::int32_t tag) {
      own.push_back({labels(places), tag, facet_quality(results_, places), Side::both});
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

// SPDX-License-Identifier: BSD-3-Clause
#include "io/nodes_by_id.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/index.hpp"
#include "base/leading_count.hpp"
#include "comm/records.hpp"
#include "io/rows.hpp"
#include "io/tag_groups.hpp"
#include "results/periodic_cut.hpp"

namespace pnpbs::io {

namespace {

// A node, as ranks exchange it.
template <int Dim>
struct NodeRow {
  std::int64_t id;  // of the level
  Point<3> x;       // the first `coordinates` of them are valid
  double d;
  std::int32_t tag, region;
};

// A component of a field at a node.
struct FieldValue {
  std::int64_t id, component;
  double value;
};

// A mid node or a copy of a node, and a component of a field at it.
struct AddedRow {
  std::int64_t number, id;
  std::int64_t original;  // label of the node that it is a copy of
  Image<3> image;         // periods from that node
  Point<3> x;
  double d;
  std::int32_t tag, region;
};

struct AddedFieldValue {
  std::int64_t number, component;
  double value;
};

// An element. Its corners are given by labels, see NodesById::label(), and its mid nodes by their
// numbers in the file. With cracks, the number of a copy or -1 is given for each corner instead.
template <int Dim, std::size_t added_count>
struct ElementRow {
  std::array<std::int64_t, Dim + 1> corners;  // smallest label first
  std::array<std::int64_t, added_count> added;
  float quality;
  std::int32_t region;
};

template <int Dim, std::size_t added_count>
struct FacetRow {
  std::array<std::int64_t, Dim> corners;  // smallest label first in space
  std::array<std::int64_t, added_count> added;
  std::int32_t tag;
  float quality;
  Side domain;  // in the plane only
};

Side side_of_domain(const BoundaryEdge& edge) {
  if (!edge.bounds()) return Side::both;
  return edge.left_inside ? Side::left : Side::right;
}

template <int Dim>
NodeRow<Dim> node_row(const Results<Dim>& results, std::int64_t i, const Point<3>& x,
                      std::int32_t region) {
  const Nodes<Dim>& nodes = results.level().nodes;
  return {nodes.id(i), x, results.spacing_at(i), static_cast<std::int32_t>(nodes.tag(i)), region};
}

template <int Dim>
NodeRows sorted_nodes(std::vector<NodeRow<Dim>> rows, const PeriodicCell<Dim>& cell,
                      int coordinates, bool with_regions) {
  std::ranges::sort(rows, {}, &NodeRow<Dim>::id);
  NodeRows sorted;
  for (const NodeRow<Dim>& row : rows) {
    sorted.ids.push_back(cell.number_of(row.id));
    sorted.x.insert(sorted.x.end(), row.x.begin(), row.x.begin() + coordinates);
    sorted.spacing.push_back(row.d);
    sorted.tags.push_back(row.tag);
    if (with_regions) sorted.regions.push_back(row.region);
  }
  return sorted;
}

// Returns the rows with their corners, and appends their mid nodes or copies.
template <int Dim, std::size_t n>
ElementRows sorted_elements(std::vector<ElementRow<Dim, n>> rows, bool with_regions,
                            std::vector<std::int64_t>& added) {
  std::ranges::sort(rows, {}, &ElementRow<Dim, n>::corners);
  ElementRows sorted;
  for (const ElementRow<Dim, n>& row : rows) {
    sorted.nodes.insert(sorted.nodes.end(), row.corners.begin(), row.corners.end());
    added.insert(added.end(), row.added.begin(), row.added.end());
    sorted.quality.push_back(row.quality);
    if (with_regions) sorted.regions.push_back(row.region);
  }
  return sorted;
}

template <int Dim, std::size_t n>
FacetRows sorted_facets(std::vector<FacetRow<Dim, n>> rows, std::vector<std::int64_t>& added) {
  std::ranges::sort(
      rows, {}, [](const FacetRow<Dim, n>& f) { return std::tuple(f.corners, f.tag, f.added); });
  FacetRows sorted;
  for (const FacetRow<Dim, n>& row : rows) {
    sorted.nodes.insert(sorted.nodes.end(), row.corners.begin(), row.corners.end());
    added.insert(added.end(), row.added.begin(), row.added.end());
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
  if (elements && results.has_copies()) cracks_ = &results.cracks();
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
  const PeriodicCell<Dim>& cell = results.level().nodes.cell;
  contents_.is_periodic = elements && cell.any();
  if (contents_.is_periodic)
    for (std::size_t k = 0; k < Dim; ++k) {
      contents_.periods[k] = cell.period(static_cast<int>(k));
      for (std::size_t high = 0; high < 2 && results.domain().is_flat(k); ++high)
        contents_.flat_tags[2 * k + high] = results.domain().side_tag(k, high != 0);
    }
  std::vector<std::int64_t> counts{owned_, 0, 0};
  if (elements) {
    results.for_elements([&](const auto&) { ++counts[1]; });
    results.for_facets_without_tags([&](const auto&) { ++counts[2]; });
  }
  if (cracks_) counts[2] += std::ranges::count_if(cracks_->facets(), &CrackFacet<Dim>::is_open);
  comm_.allreduce_sum(counts);
  node_count_ = contents_.nodes = counts[0];
  contents_.elements = counts[1];
  contents_.facets = counts[2];
  list_added_nodes();
  if (comm_.size() == 1) return;
  const NodeArray<std::int64_t>& id = results.level().nodes.id;
  blocks_.emplace(comm_, owned_, [&](std::int64_t place) { return id(results.node_at(place)); });
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; number < node_count_; number += kWindow) numbers.push_back(number);
  bounds_ = blocks_->ids_at(numbers);
}

template <int Dim>
void NodesById<Dim>::list_added_nodes() {
  if (mid_nodes_) {
    contents_.order = 2;
    contents_.nodes += mid_nodes_->all();
    const std::vector<MidNode>& mids = mid_nodes_->nodes();
    for (std::size_t e = 0; e < mids.size(); ++e)
      if (mids[e].first) own_added_.push_back({mids[e].number, e});
    std::ranges::sort(own_added_, {}, &Added::number);
  }
  if (cracks_) {
    contents_.nodes += cracks_->all();
    for (std::int64_t k = 0; k < cracks_->owned(); ++k)
      own_added_.push_back({cracks_->copies()[index(k)].number, index(k)});
  }
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
  const Nodes<Dim>& nodes = results_.level().nodes;
  if (!blocks_ && place < owned_) return place;
  const std::int64_t id = nodes.cell.home_id(nodes.id(results_.node_at(place)));
  return blocks_ ? id : leading_count(owned_, [&](std::int64_t other) {
    return nodes.id(results_.node_at(other)) < id;
  });
}

// Returns the position of a node that is moved by whole periods.
template <int Dim>
Point<3> NodesById<Dim>::point(std::int64_t place, const Image<3>& periods) const {
  Point<3> x = results_.point_in_space(results_.node_at(place));
  if (contents_.is_periodic)
    for (std::size_t k = 0; k < 3; ++k) x[k] += periods[k] * contents_.periods[k];
  return x;
}

template <int Dim>
template <std::size_t n>
std::array<Point<3>, n> NodesById<Dim>::points(const std::array<std::int64_t, n>& places,
                                               const Image<3>& periods) const {
  std::array<Point<3>, n> x;
  std::ranges::transform(places, x.begin(), [&](auto place) { return point(place, periods); });
  return x;
}

// Returns the periods from the original node, which is owned, to its copy.
template <int Dim>
Image<3> NodesById<Dim>::periods_of_copy(const CrackCopy& copy) const {
  Image<3> periods = copy.periods;
  const Image<3> original = cracks_->periods(copy.node);
  for (std::size_t k = 0; k < 3; ++k) periods[k] -= original[k];
  return periods;
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

// Calls visit(first number, rows) for this rank's part of each window of added nodes, which has the
// kWindow numbers from the first one. rows_of(added node, rows) appends the rows of such a node.
// Collective.
template <int Dim>
template <class Row, class RowsOf, class Visit>
void NodesById<Dim>::for_added_windows(const RowsOf& rows_of, const Visit& visit) const {
  const std::int64_t all = contents_.nodes - node_count_;
  auto next = own_added_.begin();
  for (std::int64_t begin = 0; begin < all; begin += kWindow * comm_.size()) {
    std::vector<Row> rows;
    for (; next != own_added_.end(); ++next) {
      if (next->number >= begin + kWindow * comm_.size()) break;
      rows_of(*next, rows);
    }
    if (blocks_)
      rows = redistribute<Row>(comm_, rows, [&](const Row& row) {
        return static_cast<int>((row.number - begin) / kWindow);
      });
    visit(std::min(begin + kWindow * comm_.rank(), all), std::move(rows));
  }
}

// ------------------------------------------------------------------ rows -----------------------

template <int Dim>
void NodesById<Dim>::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  for_windows([&](const Window& window) {
    std::vector<NodeRow<Dim>> own;
    for (std::int64_t place = window.begin; place < window.end; ++place) {
      const std::int64_t i = results_.node_at(place);
      own.push_back(node_row<Dim>(results_, i,
                                  point(place, cracks_ ? cracks_->periods(place) : Image<3>{}),
                                  region_of_ ? region_of_->at_node(i) : 0));
    }
    NodeRows rows = sorted_nodes<Dim>(
        brought(std::move(own), [](const NodeRow<Dim>& n) { return n.id; }),
        results_.level().nodes.cell, contents_.coordinates, region_of_.has_value());
    rows.first = window.first;
    if (contents_.is_periodic) {
      rows.partners.resize(rows.ids.size());
      std::iota(rows.partners.begin(), rows.partners.end(), rows.first);
      rows.images.resize(rows.ids.size());
    }
    visit(rows);
  });
  const auto row_of = [&](const Added& added, std::vector<AddedRow>& rows) {
    if (cracks_) {
      const CrackCopy& copy = cracks_->copies()[added.index];
      const std::int64_t i = results_.node_at(copy.node);
      const NodeRow<Dim> row = node_row<Dim>(results_, i, point(copy.node, copy.periods),
                                             region_of_ ? region_of_->at_node(i) : 0);
      rows.push_back({added.number, results_.level().nodes.number(i), label(copy.node),
                      periods_of_copy(copy), row.x, row.d, row.tag, row.region});
      return;
    }
    const MidNode& mid = mid_nodes_->nodes()[added.index];
    const double d = 0.5 * (results_.spacing_at(results_.node_at(mid.ends[0])) +
                            results_.spacing_at(results_.node_at(mid.ends[1])));
    rows.push_back({added.number, -1, -1, {}, mid.x, d, mid.tag, mid.region});
  };
  for_added_windows<AddedRow>(row_of, [&](std::int64_t first, std::vector<AddedRow> added) {
    std::ranges::sort(added, {}, &AddedRow::number);
    NodeRows rows;
    rows.first = node_count_ + first;
    for (const AddedRow& one : added) {
      rows.ids.push_back(one.id);
      rows.x.insert(rows.x.end(), one.x.begin(), one.x.begin() + contents_.coordinates);
      rows.spacing.push_back(one.d);
      rows.tags.push_back(one.tag);
      if (region_of_) rows.regions.push_back(one.region);
      if (!contents_.is_periodic) continue;
      rows.partners.push_back(one.original);
      rows.images.push_back(one.image);
    }
    if (contents_.is_periodic) label_by_numbers(rows.partners);
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
  const auto rows_of = [&](const Added& added, std::vector<AddedFieldValue>& rows) {
    for (std::int64_t c = 0; c < of.components; ++c) {
      const auto at = [&](std::int64_t place) {
        return of.values[static_cast<std::size_t>(place * of.components + c)];
      };
      if (cracks_) {
        rows.push_back({added.number, c, at(cracks_->copies()[added.index].node)});
      } else {
        const MidNode& mid = mid_nodes_->nodes()[added.index];
        rows.push_back({added.number, c, 0.5 * (at(mid.ends[0]) + at(mid.ends[1]))});
      }
    }
  };
  for_added_windows<AddedFieldValue>(
      rows_of, [&](std::int64_t first, std::vector<AddedFieldValue> values) {
        std::ranges::sort(
            values, {}, [](const AddedFieldValue& v) { return std::pair(v.number, v.component); });
        FieldRows rows;
        rows.first = node_count_ + first;
        for (const AddedFieldValue& value : values) rows.values.push_back(value.value);
        visit(rows);
      });
}

// Returns the numbers of the mid nodes of an element or facet in the file, or those of the copies
// at the corners of an element, -1 for originals.
template <int Dim>
template <std::size_t added, std::size_t corners>
std::array<std::int64_t, added> NodesById<Dim>::added_to(
    const std::array<std::int64_t, corners>& places) const {
  std::array<std::int64_t, added> numbers;
  numbers.fill(-1);
  if constexpr (added == edges_of(corners))
    if (mid_nodes_) {
      numbers = mid_nodes_->of(places);
      for (std::int64_t& number : numbers)
        number = node_count_ + mid_nodes_->nodes()[index(number)].number;
    }
  if constexpr (added == corners && corners == Dim + 1)
    if (cracks_) numbers = copies_numbered(cracks_->copies_in(places));
  return numbers;
}

// Returns the numbers in the file of copies, given by their indices.
template <int Dim>
template <std::size_t n>
std::array<std::int64_t, n> NodesById<Dim>::copies_numbered(
    std::array<std::int64_t, n> copies) const {
  for (std::int64_t& copy : copies)
    if (copy >= 0) copy = node_count_ + cracks_->copies()[index(copy)].number;
  return copies;
}

// Appends a row for a facet, or one for each side of a crack, where it bounds the elements.
template <int Dim>
template <class Row>
void NodesById<Dim>::add_facet(const std::array<std::int64_t, Dim>& places, Row row,
                               std::vector<Row>& rows) const {
  const CrackFacet<Dim>* const facet = cracks_ ? cracks_->facet(places) : nullptr;
  if constexpr (std::tuple_size_v<decltype(row.added)> == Dim) {
    if (facet) {
      row.added = copies_numbered(facet->copies[1]);
      if (facet->is_open()) {
        Row front = row;
        if (facet->is_flat_side())
          std::tie(front.tag, row.tag) = std::tie(facet->side_tags[0], facet->side_tags[1]);
        front.added = copies_numbered(facet->copies[0]);
        if constexpr (Dim == 2) {
          front.domain = Side::left;
          row.domain = Side::right;
        } else {  // counter-clockwise as seen from outside of the elements in front
          std::swap(front.corners[1], front.corners[2]);
          std::swap(front.added[1], front.added[2]);
        }
        rows.push_back(front);
      }
    }
  }
  rows.push_back(row);
}

// Replaces the labels of corners by numbers, inserts the mid nodes of each row after its corners or
// replaces corners by copies, and numbers the rows after those of earlier windows. Collective.
template <int Dim>
template <class Rows>
void NodesById<Dim>::number_rows(Rows& rows, const std::vector<std::int64_t>& added,
                                 std::size_t count, std::int64_t& before) const {
  label_by_numbers(rows.nodes);
  if (cracks_) {
    for (std::size_t k = 0; k < added.size(); ++k)
      if (added[k] >= 0) rows.nodes[k] = added[k];
  } else if (!added.empty()) {
    const auto corners = static_cast<std::ptrdiff_t>(rows.nodes.size() / count);
    const auto each = static_cast<std::ptrdiff_t>(added.size() / count);
    std::vector<std::int64_t> all;
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(count); ++k) {
      const auto corner = rows.nodes.begin() + corners * k;
      all.insert(all.end(), corner, corner + corners);
      all.insert(all.end(), added.begin() + each * k, added.begin() + each * (k + 1));
    }
    rows.nodes = std::move(all);
  }
  const RankSpan span = span_of(comm_, count);
  rows.first = before + span.first;
  before += span.total;
}

template <int Dim>
void NodesById<Dim>::for_elements(const std::function<void(const ElementRows&)>& visit) const {
  if (cracks_)
    for_element_rows<Dim + 1>(visit);
  else
    mid_nodes_ ? for_element_rows<edges_of(Dim + 1)>(visit) : for_element_rows<0>(visit);
}

template <int Dim>
template <std::size_t added_count>
void NodesById<Dim>::for_element_rows(const std::function<void(const ElementRows&)>& visit) const {
  using Row = ElementRow<Dim, added_count>;
  std::int64_t before = 0;
  for_windows([&](const Window& window) {
    std::vector<Row> own;
    results_.for_elements(window.begin, window.end, [&](const auto& places) {
      own.push_back({labels(places), added_to<added_count>(places),
                     element_quality(results_, places), region_of_ ? (*region_of_)(places) : 0});
    });
    std::vector<std::int64_t> added;
    ElementRows rows = sorted_elements<Dim, added_count>(
        brought(std::move(own), [](const Row& e) { return e.corners[0]; }), region_of_.has_value(),
        added);
    number_rows(rows, added, rows.quality.size(), before);
    visit(rows);
  });
}

template <int Dim>
void NodesById<Dim>::for_facets(const std::function<void(const FacetRows&)>& visit) const {
  if (cracks_)
    for_facet_rows<Dim>(visit);
  else
    mid_nodes_ ? for_facet_rows<edges_of(Dim)>(visit) : for_facet_rows<0>(visit);
}

template <int Dim>
template <std::size_t added_count>
void NodesById<Dim>::for_facet_rows(const std::function<void(const FacetRows&)>& visit) const {
  using Row = FacetRow<Dim, added_count>;
  std::int64_t before = 0;
  std::vector<Row> own;
  const auto first = [](const Row& f) { return f.corners[0]; };
  const auto pass_on = [&](std::vector<Row> arrived) {
    std::vector<std::int64_t> added;
    FacetRows rows = sorted_facets<Dim, added_count>(std::move(arrived), added);
    number_rows(rows, added, rows.tags.size(), before);
    visit(rows);
  };
  if constexpr (Dim == 2) {
    // All edges are one window, since every rank has the whole boundary in memory.
    results_.for_boundary_edges([&](const auto& places, const BoundaryEdge& edge) {
      add_facet(
          places,
          Row{labels(places), added_to<added_count>(places), edge.tag, 0, side_of_domain(edge)},
          own);
    });
    if (blocks_)
      own = redistribute<Row>(comm_, own, [&](const Row& f) { return blocks_->rank_of(first(f)); });
    pass_on(std::move(own));
  } else {
    const auto keep = [&](const auto& places, std::int32_t tag) {
      add_facet(places,
                Row{labels(places), added_to<added_count>(places), tag,
                    facet_quality(results_, places), Side::both},
                own);
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
    const Point<3> x = point(place, cracks_ ? cracks_->periods(place) : Image<3>{});
    groups.add(static_cast<std::int32_t>(nodes.tag(i)), {&x, 1});
  }
  for (const Added& added : own_added_) {
    if (mid_nodes_) {
      const MidNode& mid = mid_nodes_->nodes()[added.index];
      groups.add(mid.tag, {&mid.x, 1});
    } else {
      const CrackCopy& copy = cracks_->copies()[added.index];
      const std::int64_t i = results_.node_at(copy.node);
      const Point<3> x = point(copy.node, copy.periods);
      groups.add(static_cast<std::int32_t>(nodes.tag(i)), {&x, 1});
    }
  }
  return groups.of_all(comm_);
}

template <int Dim>
std::vector<TagGroup> NodesById<Dim>::facet_groups() const {
  TagGroups groups;
  results_.for_facets([&](const auto& places, std::int32_t tag) {
    const CrackFacet<Dim>* const facet = cracks_ ? cracks_->facet(places) : nullptr;
    const auto add = [&](std::size_t side) {
      groups.add(facet->is_flat_side() ? facet->side_tags[side] : tag,
                 points(places, facet->periods[side]));
    };
    if (!facet) return groups.add(tag, points(places, {}));
    add(1);
    if (facet->is_open()) add(0);
  });
  return groups.of_all(comm_);
}

template <int Dim>
std::vector<TagGroup> NodesById<Dim>::region_groups() const {
  TagGroups groups;
  if (!region_of_) return {};
  results_.for_elements([&](const auto& places) {
    Image<3> periods{};
    if (contents_.is_periodic) {
      std::array<std::int64_t, Dim + 1> ids;
      std::ranges::transform(places, ids.begin(), [&](std::int64_t place) {
        return results_.level().nodes.id(results_.node_at(place));
      });
      std::ranges::copy(periods_to_cell(results_.level().nodes.cell, ids), periods.begin());
    }
    groups.add((*region_of_)(places), points(places, periods));
  });
  return groups.of_all(comm_);
}

template class NodesById<2>;
template class NodesById<3>;

}  // namespace pnpbs::io

// SPDX-License-Identifier: BSD-3-Clause
#include "io/own_piece.hpp"

#include <algorithm>

#include "io/rows.hpp"
#include "results/element_regions.hpp"

namespace pnpbs::io {

template <int Dim>
OwnPiece<Dim>::OwnPiece(const Results<Dim>& results, bool elements,
                        const std::vector<OutputField>& fields)
    : results_(results),
      owned_(results.count()),
      number_(static_cast<std::size_t>(results.level().nodes.count - owned_), -1) {
  contents_.dimension = Dim;
  contents_.coordinates = results.coordinates();
  contents_.is_piece = true;
  contents_.fields = &fields;
  contents_.with_elements = elements;
  contents_.cells = cells_of(results, elements);
  contents_.with_regions =
      contents_.cells == Cells::elements && results.level().ground.domain().regions();
  if (elements) {
    results.for_elements([&](const auto& places) {
      ++contents_.elements;
      for (const std::int64_t place : places) know(place);
    });
    results.for_facets_without_tags([&](const auto& places) {
      ++contents_.facets;
      for (const std::int64_t place : places) know(place);
    });
  }
  contents_.nodes = owned_ + static_cast<std::int64_t>(ghosts_.size());
}

template <int Dim>
void OwnPiece<Dim>::know(std::int64_t place) {
  if (place < owned_) return;
  std::int64_t& number = number_[static_cast<std::size_t>(place - owned_)];
  if (number >= 0) return;
  number = owned_ + static_cast<std::int64_t>(ghosts_.size());
  ghosts_.push_back(place);
}

template <int Dim>
void OwnPiece<Dim>::for_nodes(const std::function<void(const NodeRows&)>& visit) const {
  const Nodes<Dim>& nodes = results_.level().nodes;
  for (std::int64_t begin = 0; begin < contents_.nodes; begin += kWindow) {
    NodeRows rows;
    rows.first = begin;
    for (std::int64_t k = begin; k < std::min(begin + kWindow, contents_.nodes); ++k) {
      const std::int64_t i = results_.node_at(place_of_number(k));
      const Point<3> x = results_.place_in_space(i);
      rows.x.insert(rows.x.end(), x.begin(), x.begin() + contents_.coordinates);
      rows.ids.push_back(nodes.id(i));
      rows.tags.push_back(nodes.tag(i));
      rows.spacing.push_back(results_.spacing_at(i));
      rows.ghosts.push_back(k >= owned_);
    }
    visit(rows);
  }
}

template <int Dim>
void OwnPiece<Dim>::for_field(std::size_t field,
                              const std::function<void(const FieldRows&)>& visit) const {
  const OutputField& of = (*contents_.fields)[field];
  for (std::int64_t begin = 0; begin < contents_.nodes; begin += kWindow) {
    FieldRows rows;
    rows.first = begin;
    for (std::int64_t k = begin; k < std::min(begin + kWindow, contents_.nodes); ++k) {
      const auto values =
          of.values.begin() + place_of_number(k) * static_cast<std::ptrdiff_t>(of.components);
      rows.values.insert(rows.values.end(), values, values + of.components);
    }
    visit(rows);
  }
}

template <int Dim>
template <class Visit>
void OwnPiece<Dim>::for_windows(const Visit& visit) const {
  for (std::int64_t begin = 0; begin < owned_; begin += kWindow)
    visit(begin, std::min(begin + kWindow, owned_));
}

template <int Dim>
void OwnPiece<Dim>::for_elements(const std::function<void(const ElementRows&)>& visit) const {
  std::int64_t before = 0;
  ElementRegions<Dim> region_of(results_);
  for_windows([&](std::int64_t begin, std::int64_t end) {
    ElementRows rows;
    rows.first = before;
    results_.for_elements(begin, end, [&](const auto& places) {
      for (const std::int64_t place : places) rows.corners.push_back(number(place));
      rows.quality.push_back(element_quality(results_, places));
      if (contents_.with_regions) rows.regions.push_back(region_of(places));
    });
    before += static_cast<std::int64_t>(rows.quality.size());
    visit(rows);
  });
}

template <int Dim>
void OwnPiece<Dim>::for_facets(const std::function<void(const FacetRows&)>& visit) const {
  FacetRows rows;
  const auto add = [&](const auto& places, std::int32_t tag) {
    for (const std::int64_t place : places) rows.corners.push_back(number(place));
    rows.tags.push_back(tag);
    rows.quality.push_back(facet_quality(results_, places));
  };
  if constexpr (Dim == 2) {
    results_.for_boundary_facets(add);
    visit(rows);
  } else {
    std::int64_t before = 0;
    for_windows([&](std::int64_t begin, std::int64_t end) {
      rows = FacetRows();
      rows.first = before;
      results_.for_boundary_facets(begin, end, add);
      results_.for_inner_facets(begin, end, add);
      before += static_cast<std::int64_t>(rows.tags.size());
      visit(rows);
    });
  }
}

template class OwnPiece<2>;
template class OwnPiece<3>;

}  // namespace pnpbs::io

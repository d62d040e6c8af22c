// SPDX-License-Identifier: BSD-3-Clause
// One rank's own nodes, elements and facets, with the ghosts that these need; numbered by itself.
#pragma once

#include "io/node_source.hpp"
#include "results/results.hpp"

namespace pnpbs::io {

template <int Dim>
class OwnPiece : public NodeSource {
 public:
  // Local, after rows.hpp's prepare. fields: with values at ghosts.
  OwnPiece(const Results<Dim>& results, bool elements, const std::vector<OutputField>& fields);

  // Local.
  void for_nodes(const std::function<void(const NodeRows&)>& visit) const override;
  void for_field(std::size_t field,
                 const std::function<void(const FieldRows&)>& visit) const override;
  void for_elements(const std::function<void(const ElementRows&)>& visit) const override;
  void for_facets(const std::function<void(const FacetRows&)>& visit) const override;

 private:
  void know(std::int64_t place);
  std::int64_t number(std::int64_t place) const {
    return place < owned_ ? place : number_[static_cast<std::size_t>(place - owned_)];
  }
  std::int64_t place_of_number(std::int64_t number) const {
    return number < owned_ ? number : ghosts_[static_cast<std::size_t>(number - owned_)];
  }
  // Calls visit(begin, end) for windows of the own nodes.
  template <class Visit>
  void for_windows(const Visit& visit) const;

  const Results<Dim>& results_;
  std::int64_t owned_;
  // Ghosts in the order in which elements and facets ask for them.
  std::vector<std::int64_t> ghosts_;  // places
  std::vector<std::int64_t> number_;  // of each ghost, by its place among them; -1: not needed
};

extern template class OwnPiece<2>;
extern template class OwnPiece<3>;

}  // namespace pnpbs::io

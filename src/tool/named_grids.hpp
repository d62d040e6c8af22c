// SPDX-License-Identifier: BSD-3-Clause
// All grids that the user names, and what formulas have of them: their values, how steep they are,
// and d by the depth.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tool/arguments.hpp"
#include "tool/expression.hpp"
#include "tool/geo_file.hpp"
#include "tool/library.hpp"
#include "tool/named_grid.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

class NamedGrids {
 public:
  // dimension: of places. Throws BadInput.
  NamedGrids(const Arguments& arguments, int dimension);

  const NamedGrid& first() const { return *grids_[0]; }

  // What a formula mentions. This object must outlive them.
  std::vector<Expression::Field> fields_in(const std::string& formula) const;
  // Throws BadInput where none of the formulas has what a grid was given for. The first one is that
  // of --spacing, the others those of --field.
  void require_use_in(const std::vector<std::string>& formulas) const;

  // Before values are asked for: reads the grids where the domain is, in its projection. Local.
  // Throws Failure.
  void read(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo);

  // Once there are nodes: each grid has a value at some of them. Collective. Throws Failure.
  void require_values(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                      const Ranks& ranks) const;
  // Of grids that do not reach all nodes, unless the library warns of that, or have no data there;
  // on the first rank. Collective.
  std::vector<std::string> warnings(pnpbs_placement placement, pnpbs_domain domain,
                                    pnpbs_context context, const Ranks& ranks,
                                    bool library_warns) const;

 private:
  std::string option_of(const NamedGrid& grid) const;
  Expression::Field values_of(const NamedGrid& grid) const;
  Expression::Field slope_of(const NamedGrid& grid) const;
  Expression::Field spacing_by_depth() const;
  std::string extents_in_words(const NamedGrid& grid, pnpbs_domain domain,
                               pnpbs_context context) const;

  int dimension_;
  bool sphere_;
  std::vector<std::unique_ptr<NamedGrid>> grids_;
  std::optional<DepthRequest> depth_;  // on the last grid
};

}  // namespace pnpbs::tool

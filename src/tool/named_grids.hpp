// SPDX-License-Identifier: BSD-3-Clause
// All grids given on the command line, and what formulas use of them: their values, their slopes,
// and d by depth.
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
  // dimension: number of coordinates of a point. Throws BadInput.
  NamedGrids(const Arguments& arguments, int dimension);

  const NamedGrid& first() const { return *grids_[0]; }

  // Returns the fields that the formula mentions. This object must outlive them.
  std::vector<Expression::Field> fields_in(const std::string& formula) const;
  // Throws BadInput if no formula uses a grid. The first formula is that of --spacing, the others
  // those of --field and --open-boundary.
  void require_use_in(const std::vector<std::string>& formulas) const;

  // Reads the part of each grid that covers the domain, in the domain's projection. Must be called
  // before values are evaluated. `unit` is the unit of length, or empty. Local. Throws Failure.
  void read(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo,
            const std::string& unit);

  // Throws Failure if a grid has no value at any node. Collective.
  void require_values(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                      const Ranks& ranks) const;
  // Returns warnings about grids that do not cover all nodes, unless the library warns of that, or
  // have no data at some nodes. They are on the first rank. Collective.
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
  std::optional<DepthRequest> depth_;  // applies to the last grid
};

}  // namespace pnpbs::tool

// SPDX-License-Identifier: BSD-3-Clause
// The spacing the user asked for, in the form that suits the library best.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tool/arguments.hpp"
#include "tool/centred_nodes.hpp"
#include "tool/expression.hpp"
#include "tool/geo_file.hpp"
#include "tool/library.hpp"
#include "tool/named_grid.hpp"
#include "tool/ranks.hpp"
#include "tool/spacing_file.hpp"

namespace pnpbs::tool {

class Spacing {
 public:
  Spacing(const Arguments& arguments, int dimension);

  // Before anything else: reads the grids where the domain is, in its projection. Local. Throws
  // Failure.
  void read_grids(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo);

  // Leaves out of a domain in the plane what is finer than d. Local. Throws Failure.
  void simplify(pnpbs_domain domain, pnpbs_context context, double tolerance, double smallest);

  // Adds to an empty domain what lies in this band about the boundary of the body. This object must
  // outlive both. Local. Throws Failure.
  void add_band(pnpbs_domain domain, pnpbs_domain body, const Band& band, pnpbs_context context);

  // Makes the bubbles larger than d. Local.
  void multiply(double factor);

  // This object must outlive the placement, and the domain, whose shape a formula may ask for.
  // Collective. Throws Failure.
  void give_to(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
               const Ranks& ranks);

  // Once there are nodes: each grid in a formula has a value at some of them. Collective. Throws
  // Failure.
  void require_values_of_grids(pnpbs_placement placement, pnpbs_domain domain,
                               pnpbs_context context, const Ranks& ranks) const;

  // Of grids in a formula that do not reach all nodes, or have no data there; on the first rank.
  // Collective.
  std::vector<std::string> warnings(pnpbs_placement placement, pnpbs_domain domain,
                                    pnpbs_context context, const Ranks& ranks) const;

 private:
  // d times a factor, as a callback.
  struct Multiplied {
    pnpbs_spacing_fn d;
    void* user;
    double factor;
  };
  static std::int32_t call_multiplied(std::int64_t n, std::int32_t dim, const double* coordinates,
                                      double* d, void* user);

  Multiplied callback() const;  // not of a file, and not auto
  const Grid* grid() const;     // that the library takes as it is, or nullptr
  pnpbs_status set_grid(pnpbs_placement placement) const;

  std::vector<Expression::Field> fields_for(const std::string& formula, const Arguments& arguments);
  Expression::Field field_by_depth(const NamedGrid* grid);
  std::string extents_in_words(const NamedGrid& grid, pnpbs_domain domain,
                               pnpbs_context context) const;

  int dimension_;
  bool sphere_;
  double min_, max_;  // of auto, 0: none
  std::vector<std::unique_ptr<NamedGrid>> grids_;
  std::optional<DepthWish> depth_;
  std::unique_ptr<Expression> expression_;  // neither this nor a grid nor a file: auto
  std::optional<SpacingFile> file_;
  std::optional<Multiplied> bubbles_;  // if their spacing is not d
};

}  // namespace pnpbs::tool

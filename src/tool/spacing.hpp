// SPDX-License-Identifier: BSD-3-Clause
// The spacing the user asked for, in the form that suits the library best.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tool/arguments.hpp"
#include "tool/centred_nodes.hpp"
#include "tool/expression.hpp"
#include "tool/library.hpp"
#include "tool/named_grids.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// Which file --spacing names, if it is no formula: FILE or FILE:FIELD.
struct SpacingFile {
  std::string path;
  std::string field;  // empty: the only one
};

// By the ending of FILE: .vtu, .msh or .csv, in capitals or not. No formula has such.
std::optional<SpacingFile> spacing_file(const std::string& text);

class Spacing {
 public:
  // Of formulas in these grids, which must outlive this object. Throws BadInput.
  Spacing(const Arguments& arguments, int dimension, const NamedGrids& grids);

  const std::string& formula() const { return formula_; }  // "" if it is none
  // Then the library tells where it is not given.
  bool is_grid() const { return grid() != nullptr; }

  // As soon as the grids have been read: one alone is d, by a formula unless the library takes it
  // as it is. Local.
  void take_what_was_read(const NamedGrids& grids);

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

  int dimension_;
  double min_, max_;  // of auto, 0: none
  std::string formula_;
  const NamedGrid* grid_ = nullptr;         // that is d
  std::unique_ptr<Expression> expression_;  // neither this nor a grid nor a file: auto
  std::optional<SpacingFile> file_;
  std::optional<Multiplied> bubbles_;  // if their spacing is not d
};

}  // namespace pnpbs::tool

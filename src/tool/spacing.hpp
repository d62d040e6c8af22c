// SPDX-License-Identifier: BSD-3-Clause
// The spacing given on the command line, in the form that suits the library best.
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

// A file that --spacing names instead of a formula: FILE or FILE:FIELD.
struct SpacingFile {
  std::string path;
  std::string field;  // empty: the only field
};

// Recognizes the extensions .vtu, .msh and .csv in upper or lower case, which no formula ends in.
std::optional<SpacingFile> spacing_file(const std::string& text);

class Spacing {
 public:
  // Parses the spacing. The grids must outlive this object. Throws BadInput.
  Spacing(const Arguments& arguments, int dimension, const NamedGrids& grids);

  const std::string& formula() const { return formula_; }  // "" if d is not a formula
  // Returns whether d is a grid that the library takes. The library then reports where it has no
  // data.
  bool is_grid() const { return grid() != nullptr; }

  // Must be called after the grids have been read. A single grid that GDAL has read becomes a
  // formula; an ESRI ASCII grid is passed to the library as it is. Local.
  void use_read_grids(const NamedGrids& grids);

  // Removes details finer than d from a domain in the plane. Local. Throws Failure.
  void simplify(pnpbs_domain domain, pnpbs_context context, double tolerance, double smallest);

  // Adds to an empty domain the region in this band about the boundary of the body. This object
  // must outlive both domains. Local. Throws Failure.
  void add_band(pnpbs_domain domain, pnpbs_domain body, const Band& band, pnpbs_context context);

  // Multiplies the spacing of the bubbles by this factor. Local.
  void multiply(double factor);

  // Sets the spacing of the placement. This object must outlive the placement, and the domain if
  // the formula uses its shape. Collective. Throws Failure.
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

  void set_spacing(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                   const Ranks& ranks);
  Multiplied callback() const;  // neither for a file nor for auto
  const Grid* grid() const;     // that the library takes as it is, or nullptr
  pnpbs_status set_grid(pnpbs_placement placement) const;

  int dimension_;
  double min_, max_;  // for auto; 0: no bound
  std::string formula_;
  const NamedGrid* grid_ = nullptr;         // d, if it is a grid
  std::unique_ptr<Expression> expression_;  // null if d is a grid, a file or auto
  std::optional<SpacingFile> file_;
  std::vector<double> hints_;          // coordinates of points at which d is sampled as well
  std::optional<Multiplied> bubbles_;  // set if their spacing differs from d
};

}  // namespace pnpbs::tool

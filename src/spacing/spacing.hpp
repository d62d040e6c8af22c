// SPDX-License-Identifier: BSD-3-Clause
// The spacing function d(x) as the user specifies it. The spacing that the library places nodes
// with is a SizingField.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "domain/spacing_evaluator.hpp"
#include "spacing/growth_source.hpp"

namespace pnpbs {

// Points at which a spacing is known to be fine or steep. Samples of d in the cells of a tree may
// miss fine regions between them; these hints make up for it. They are the same on all ranks.
template <int Dim>
struct SpacingHints {
  // The growth of d over a part of space, with the point where it is measured.
  struct Slope {
    double growth, d;  // d: smallest d on that part
    Point<Dim> at;
    bool in_domain = false;  // true: `at` is known to lie in the domain; false: not known
  };

  // Values of d at the points that define the spacing; they may lie outside the domain.
  std::vector<GrowthSource<Dim>> values;
  std::vector<Slope> slopes;  // growth of d between these points
  // values known to lie in the domain; d is sampled there as well
  std::vector<GrowthSource<Dim>> in_domain;
};

// The part of space on which a spacing is given, and texts about it for messages: its name, such as
// "the grid of the spacing", and the definition of d outside.
template <int Dim>
struct GivenExtent {
  const char* name;
  const char* beyond;
  Box<Dim> box;  // bounding box; infinite in unbounded directions
  // The extent in words on a sphere, where there is no box: "from latitude 0 to latitude 60". May
  // be empty.
  std::string on_sphere = {};
};

// A spacing function that a placement can evaluate. Its values may be distributed over the ranks,
// so evaluation is collective; code that runs on one rank only requires a LocalSpacing.
template <int Dim>
class Spacing {
 public:
  virtual ~Spacing() = default;
  // Computes d[n] at x[n]. The values are not checked; evaluate_spacing() checks them. Throws Error
  // if the user's callback fails.
  // Collective. Each rank may pass a different number of points, including none.
  virtual void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const = 0;
  // Returns the hints of this spacing, which may be empty.
  virtual SpacingHints<Dim> spacing_hints() const { return {}; }
  // Returns this spacing with its sizes multiplied by the factor but its growth unchanged. Returns
  // null if the spacing has no growth of its own.
  virtual std::shared_ptr<const Spacing> with_sizes_multiplied(double) const { return nullptr; }
  // Returns the extent of the values if they are those of a mesh, a grid or points.
  virtual std::optional<GivenExtent<Dim>> extent() const { return std::nullopt; }
  // Computes the distance of each x from the extent, 0 inside. The default is the distance from the
  // box of extent(). Valid only if there is an extent.
  virtual void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distances) const;
};

// A spacing whose values every rank has. evaluate() is local.
template <int Dim>
class LocalSpacing : public Spacing<Dim> {};

// A spacing that is the same everywhere.
template <int Dim>
class ConstantSpacing : public LocalSpacing<Dim> {
 public:
  explicit ConstantSpacing(double d) : d_(d) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;

 private:
  double d_;
};

// A spacing that the user evaluates for batches of points. The callback must return 0 for success.
template <int Dim>
class CallbackSpacing : public LocalSpacing<Dim> {
 public:
  using Function = std::function<std::int32_t(std::int64_t n, const double* x, double* d)>;
  explicit CallbackSpacing(Function function) : function_(std::move(function)) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;

 private:
  Function function_;
};

// A spacing from values on a rectangular grid, with x varying fastest. It is linear in each
// direction between grid points and constant outside. The extent reaches half a step beyond the
// outer grid points, as for values of cells. In a direction with one grid point the value is the
// same everywhere.
template <int Dim>
class GridSpacing : public LocalSpacing<Dim> {
 public:
  GridSpacing(const std::array<std::int64_t, Dim>& size, const Point<Dim>& origin,
              const Point<Dim>& step, std::vector<double> values)
      : size_(size), origin_(origin), step_(step), values_(std::move(values)) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // Returns as hints the grid points between which d changes considerably, and the slopes there.
  // The smallest d of a cell is at one of its corners.
  SpacingHints<Dim> spacing_hints() const override;
  std::optional<GivenExtent<Dim>> extent() const override;

 private:
  double at(const Point<Dim>& x) const;
  Point<Dim> grid_point(std::int64_t index) const;

  std::array<std::int64_t, Dim> size_;
  Point<Dim> origin_, step_;
  std::vector<double> values_;
};

// Computes d[n] at x[n] and checks the values. `measure` is the area or volume of the domain.
// Throws Error(ErrorKind::spacing), which names the point, the value and the number of nodes that
// this value requires in the whole domain.
// Collective.
template <int Dim>
void evaluate_spacing(const Spacing<Dim>& spacing, double measure, std::int64_t n,
                      const Point<Dim>* x, double* d);

// Returns evaluate_spacing() of a local spacing as a function that one rank can call alone.
// `spacing` must outlive the result.
template <int Dim>
LocalSpacingEvaluator<Dim> local_evaluator(const LocalSpacing<Dim>& spacing, double measure) {
  return LocalSpacingEvaluator<Dim>(
      [&spacing, measure](std::int64_t n, const Point<Dim>* x, double* d) {
        evaluate_spacing<Dim>(spacing, measure, n, x, d);
      });
}

extern template class Spacing<2>;
extern template class Spacing<3>;
extern template class ConstantSpacing<2>;
extern template class ConstantSpacing<3>;
extern template class CallbackSpacing<2>;
extern template class CallbackSpacing<3>;
extern template class GridSpacing<2>;
extern template class GridSpacing<3>;

}  // namespace pnpbs

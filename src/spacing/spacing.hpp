// SPDX-License-Identifier: BSD-3-Clause
// The spacing function d(x) as the user gives it. What the library makes of it is a SizingField.
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

// Where a spacing has its values from, if from places of its own: samples of d in cells may miss
// what is fine between them. The same on all ranks.
template <int Dim>
struct SpacingHints {
  struct Slope {
    double growth, d;  // d at its lower end
    Point<Dim> at;
    bool in_domain = false;  // surely; else that is found out
  };

  std::vector<GrowthSource<Dim>> values;
  std::vector<Slope> slopes;                 // of what is linear between them
  std::vector<GrowthSource<Dim>> in_domain;  // surely there: d is sampled at these, too
};

// A part of space that d is given on, and what is said of it: "the grid of the spacing", and what d
// is beyond.
template <int Dim>
struct GivenExtent {
  const char* name;
  const char* beyond;
  Box<Dim> box;  // around it; infinite where it has no end
  // In words, on a sphere, which has no box: "from latitude 0 to latitude 60", or nothing.
  std::string on_sphere = {};
};

// As a placement asks for it. Values may be with other ranks: who asks on one rank alone takes a
// LocalSpacing.
template <int Dim>
class Spacing {
 public:
  virtual ~Spacing() = default;
  // Fills d[n] at x[n]. Throws Error if the user's callback fails. Values are as the user has
  // them: checked by evaluate_spacing. Collective: all ranks ask at the same time, as many points
  // as each wants.
  virtual void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const = 0;
  virtual SpacingHints<Dim> spacing_hints() const { return {}; }
  // With the sizes that it is made of multiplied, but its growth as it is, if there is a growth of
  // its own; others return nothing.
  virtual std::shared_ptr<const Spacing> with_sizes_multiplied(double) const { return nullptr; }
  // Where the values are, if they are those of a mesh, of a grid or of points.
  virtual std::optional<GivenExtent<Dim>> extent() const { return std::nullopt; }
  // How far each x is from there, 0 in it; as long as there is an extent, from its box unless the
  // spacing knows better.
  virtual void distance_to_extent(std::int64_t n, const Point<Dim>* x, double* distances) const;
};

// One of which every rank has all values: evaluate() is local.
template <int Dim>
class LocalSpacing : public Spacing<Dim> {};

template <int Dim>
class ConstantSpacing : public LocalSpacing<Dim> {
 public:
  explicit ConstantSpacing(double d) : d_(d) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;

 private:
  double d_;
};

// A batch callback; 0 is success.
template <int Dim>
class CallbackSpacing : public LocalSpacing<Dim> {
 public:
  using Function = std::function<std::int32_t(std::int64_t n, const double* x, double* d)>;
  explicit CallbackSpacing(Function function) : function_(std::move(function)) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;

 private:
  Function function_;
};

// Values on a rectangular grid, x fastest; linear in each direction between the grid points,
// constant beyond the border. Where values stand for cells, these reach half a step beyond their
// middles; a direction with one grid point has the same value everywhere.
template <int Dim>
class GridSpacing : public LocalSpacing<Dim> {
 public:
  GridSpacing(const std::array<std::int64_t, Dim>& size, const Point<Dim>& origin,
              const Point<Dim>& step, std::vector<double> values)
      : size_(size), origin_(origin), step_(step), values_(std::move(values)) {}
  void evaluate(std::int64_t n, const Point<Dim>* x, double* d) const override;
  // The ends of steps between grid points in which d changes by a part that matters, and their
  // slopes. The least d of a cell is at one of its corners.
  SpacingHints<Dim> spacing_hints() const override;
  std::optional<GivenExtent<Dim>> extent() const override;

 private:
  double at(const Point<Dim>& x) const;
  Point<Dim> grid_point(std::int64_t index) const;

  std::array<std::int64_t, Dim> size_;
  Point<Dim> origin_, step_;
  std::vector<double> values_;
};

// Evaluates d and checks it: an Error(ErrorKind::spacing) names the point, the value and the
// number of nodes that it would mean in a domain of this area (volume). Collective.
template <int Dim>
void evaluate_spacing(const Spacing<Dim>& spacing, double measure, std::int64_t n,
                      const Point<Dim>* x, double* d);

// The same of a spacing that outlives it, for who asks on one rank alone.
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

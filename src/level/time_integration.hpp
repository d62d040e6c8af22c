// SPDX-License-Identifier: BSD-3-Clause
// The time integration of a level (section 2.2): a step of the equation of motion, after which
// inner nodes keep their clearance from the boundary.
#pragma once

#include "dynamics/schemes.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// Steps of the nodes of one rank, with the memory that they need. Local.
template <int Dim>
class TimeIntegration {
 public:
  // Does a step of the scheme in the settings. The lists must be those for steps.
  void step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood, const SizedTree<Dim>& map,
            const LevelGeometry<Dim>& geometry, const Settings& settings);
  // Does a step of the classical Runge-Kutta scheme of fourth order, the last step in the paper.
  void runge_kutta_step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                        const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                        const Settings& settings);

  // Returns an array for other positions of the nodes, with the same padding.
  Field<Dim>& scratch(const Nodes<Dim>& nodes);

 private:
  enum class Scheme { damped, predictor_corrector, runge_kutta };
  void step(Scheme scheme, Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
            const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
            const Settings& settings);
  template <class Law>
  void move_by(const Law& law, Scheme scheme, Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
               const Settings& settings);
  void accept(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood, const SizedTree<Dim>& map,
              const LevelGeometry<Dim>& geometry, const Settings& settings);
  void hold_off_boundary(std::int64_t i, Nodes<Dim>& nodes, const NearBoundary<Dim>& near_boundary,
                         const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                         const Settings& settings);

  Field<Dim> next_;  // positions after the present step
  Stages<Dim> stages_;
  View<double> squares_;  // largest displacement in each chunk of nodes, squared
};

}  // namespace pnpbs

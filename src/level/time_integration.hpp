// SPDX-License-Identifier: BSD-3-Clause
// The time integration of a level (section 2.2): one step of the equation of motion, after which
// inner nodes are held off the boundary.
#pragma once

#include "dynamics/schemes.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

template <int Dim>
class TimeIntegration {
 public:
  // By the scheme of the settings. Lists must be made for it.
  void step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood, const SizedTree<Dim>& map,
            const LevelGeometry<Dim>& geometry, const Settings& settings);
  // One of the classical fourth order, the paper's last.
  void runge_kutta_step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                        const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                        const Settings& settings);

  // Room for other positions of the nodes, padded as theirs are.
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

  Field<Dim> next_;  // positions after the step in progress
  Stages<Dim> stages_;
  View<double> squares_;  // of the largest displacement in each chunk of nodes
};

}  // namespace pnpbs

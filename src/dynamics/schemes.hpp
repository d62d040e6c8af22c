// SPDX-License-Identifier: BSD-3-Clause
// Time steps of the equation of motion (1), m x'' + c x' = f, in scaled units: the variable is x /
// d with the local d, and m = 1, so that fine and coarse bubbles are equally stiff. Each scheme
// reads positions and velocities, writes the new positions to `next` and the new velocities to the
// nodes. Nodes that do not move keep their positions.
#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/bubble_force.hpp"

namespace pnpbs {

// Parameters of a time step.
struct Motion {
  double dt;        // time step in units of sqrt(m / k0)
  double damping;   // c in units of sqrt(k0 m)
  double max_move;  // maximum displacement in a step, in d
};

// Allocates n entries and one for the padding node if the field has fewer.
template <int Dim>
void reserve_field(Field<Dim>& field, const char* label, std::int64_t n) {
  for (int k = 0; k < Dim; ++k)
    if (static_cast<std::int64_t>(field[k].extent(0)) < n + 1)
      field[k] = make_view<double>(label, n + 1);
}

// Shortens a displacement to at most `max_length`, keeping its direction.
template <int Dim>
inline void clamp_move(std::array<double, Dim>& move, double max_length) {
  double square = 0;
  for (int k = 0; k < Dim; ++k) square += move[k] * move[k];
  const double factor = square > max_length * max_length ? max_length / std::sqrt(square) : 1.0;
  for (int k = 0; k < Dim; ++k) move[k] *= factor;
}

// Moves n consecutive nodes, beginning with `first`, under the given forces: writes velocities to v
// and positions to `next`. The result of a lane does not depend on n, not even by rounding.
template <int Dim, class Law>
inline void damped_move(const BlockVector<Dim>& force, const Motion& motion, std::int64_t first,
                        int n, const Positions<Dim>& x, const double* d, const Carrier* carrier,
                        Carrier moving, const PeriodicCell<Dim>& cell,
                        const std::array<double*, Dim>& v, const std::array<double*, Dim>& next) {
  const double slow = 1 / (1 + motion.damping * motion.dt);
  BlockVector<Dim> move;
  double too_far = 0;
#pragma omp simd reduction(max : too_far)
  for (int lane = 0; lane < n; ++lane) {
    const std::int64_t i = first + lane;
    const double mobile = carrier[i] == moving ? slow : 0.0;
    const double scale = Law::template acceleration_scale<Dim>(d[i]);
    double sum = 0;
    for (int k = 0; k < Dim; ++k) {
      move[k][lane] = motion.dt * (mobile * (v[k][i] + motion.dt * scale * force[k][lane]));
      sum += move[k][lane] * move[k][lane];
    }
    const double max = motion.max_move * d[i];
    too_far = std::max(too_far, sum - max * max);
  }
  // Few blocks have a node whose displacement must be shortened.
  for (int lane = 0; too_far > 0 && lane < n; ++lane) {
    std::array<double, Dim> of_lane;
    for (int k = 0; k < Dim; ++k) of_lane[k] = move[k][lane];
    clamp_move<Dim>(of_lane, motion.max_move * d[first + lane]);
    for (int k = 0; k < Dim; ++k) move[k][lane] = of_lane[k];
  }
  for (int k = 0; k < Dim; ++k)
    for (int lane = 0; cell.periodic(k) && lane < n; ++lane)
      move[k][lane] = cell.rounded(move[k][lane]);
  const double per_time = 1 / motion.dt;
#pragma omp simd
  for (int lane = 0; lane < n; ++lane)
    for (int k = 0; k < Dim; ++k) {
      v[k][first + lane] = per_time * move[k][lane];
      next[k][first + lane] = x[k][first + lane] + move[k][lane];
    }
}

// Performs a step with one force evaluation. Damping is implicit, and the new position follows from
// the new velocity (symplectic Euler for c = 0). First order; stable for dt below about 0.816
// sqrt(m/k0).
template <int Dim, class Law>
void damped_step(Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const Law& law,
                 const Motion& motion, Field<Dim>& next) {
  const Positions<Dim> x = positions_of<Dim>(nodes.x);
  const double* const d = nodes.d.data();
  std::array<double*, Dim> v, to;
  for (int k = 0; k < Dim; ++k) {
    v[k] = nodes.v[k].data();
    to[k] = next[k].data();
  }
  for_each("pnpbs::damped_step", lists.block_count(), [=, &nodes, &lists](std::int64_t b) {
    std::int64_t self[kLanes];
    block_nodes(b, nodes.count, self);
    BlockVector<Dim> force;
    block_force<Dim>(lists.block(b), law, x, d, self, force);
    const std::int64_t first = b * kLanes;
    const int n = static_cast<int>(std::min<std::int64_t>(kLanes, nodes.count - first));
    damped_move<Dim, Law>(force, motion, first, n, x, d, nodes.carrier.data(), nodes.moving,
                          nodes.cell, v, to);
  });
}

// Computes the accelerations of all nodes, scaled force minus c v, at positions at_x and velocities
// at_v.
template <int Dim, class Law>
void accelerations(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const Law& law,
                   const Motion& motion, const Field<Dim>& at_x, const Field<Dim>& at_v,
                   Field<Dim>& a) {
  const Positions<Dim> x = positions_of<Dim>(at_x);
  const double* const d = nodes.d.data();
  for_each("pnpbs::accelerations", lists.block_count(), [=, &nodes, &lists, &a](std::int64_t b) {
    std::int64_t self[kLanes];
    block_nodes(b, nodes.count, self);
    BlockVector<Dim> force;
    block_force<Dim>(lists.block(b), law, x, d, self, force);
    for (int lane = 0; lane < kLanes && self[lane] < nodes.count; ++lane) {
      const std::int64_t i = self[lane];
      const double scale = Law::template acceleration_scale<Dim>(d[i]);
      for (int k = 0; k < Dim; ++k)
        a[k](i) = nodes.moves(i) ? scale * force[k][lane] - motion.damping * at_v[k](i) : 0.0;
    }
  });
}

// Arrays of the schemes with several force evaluations per step, allocated on first use.
template <int Dim>
struct Stages {
  Field<Dim> x, v, a, sum_x, sum_v;

  void reserve(std::int64_t n) {
    for (Field<Dim>* field : {&x, &v, &a, &sum_x, &sum_v})
      reserve_field<Dim>(*field, "pnpbs::Stages", n);
    for (int k = 0; k < Dim; ++k) x[k](n) = kFarAway;
  }
};

// Computes the state x + h slope_x, v + h slope_v at which a stage evaluates the acceleration. The
// displacement is limited like that of the step itself, so that lists and ghosts suffice.
template <int Dim>
void stage_state(const Nodes<Dim>& nodes, double h, double max_move, const Field<Dim>& slope_x,
                 const Field<Dim>& slope_v, Field<Dim>& x, Field<Dim>& v) {
  for_each("pnpbs::stage_state", nodes.count, [&](std::int64_t i) {
    std::array<double, Dim> move;
    for (int k = 0; k < Dim; ++k) move[k] = h * slope_x[k](i);  // slope_x may be v itself
    clamp_move<Dim>(move, max_move * nodes.d(i));
    const Point<Dim> to = nodes.position_after(i, move);
    for (int k = 0; k < Dim; ++k) {
      x[k](i) = to[k];
      v[k](i) = nodes.v[k](i) + h * slope_v[k](i);
    }
  });
}

// Adds the weighted slopes of a stage to the sums. `first` starts new sums.
template <int Dim>
void add_slopes(const Nodes<Dim>& nodes, double weight, bool first, const Field<Dim>& slope_x,
                const Field<Dim>& slope_v, Stages<Dim>& stages) {
  for_each("pnpbs::add_slopes", nodes.count, [&](std::int64_t i) {
    for (int k = 0; k < Dim; ++k) {
      stages.sum_x[k](i) = (first ? 0.0 : stages.sum_x[k](i)) + weight * slope_x[k](i);
      stages.sum_v[k](i) = (first ? 0.0 : stages.sum_v[k](i)) + weight * slope_v[k](i);
    }
  });
}

// Completes a step with the weighted mean of the slopes in the sums.
template <int Dim>
void take_slopes(Nodes<Dim>& nodes, const Motion& motion, const Stages<Dim>& stages,
                 Field<Dim>& next) {
  for_each("pnpbs::take_slopes", nodes.count, [&](std::int64_t i) {
    const double mobile = nodes.moves(i) ? 1.0 : 0.0;
    std::array<double, Dim> move;
    for (int k = 0; k < Dim; ++k) move[k] = mobile * motion.dt * stages.sum_x[k](i);
    clamp_move<Dim>(move, motion.max_move * nodes.d(i));
    const Point<Dim> to = nodes.position_after(i, move);
    for (int k = 0; k < Dim; ++k) {
      nodes.v[k](i) = mobile * (nodes.v[k](i) + motion.dt * stages.sum_v[k](i));
      next[k](i) = to[k];
    }
  });
}

// Performs an Euler predictor and a trapezoidal corrector (section 2.2 of the paper). Second order.
template <int Dim, class Law>
void predictor_corrector_step(Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const Law& law,
                              const Motion& motion, Stages<Dim>& stages, Field<Dim>& next) {
  stages.reserve(nodes.count);
  accelerations<Dim>(nodes, lists, law, motion, nodes.x, nodes.v, stages.a);
  add_slopes<Dim>(nodes, 0.5, true, nodes.v, stages.a, stages);
  stage_state<Dim>(nodes, motion.dt, motion.max_move, nodes.v, stages.a, stages.x, stages.v);
  accelerations<Dim>(nodes, lists, law, motion, stages.x, stages.v, stages.a);
  add_slopes<Dim>(nodes, 0.5, false, stages.v, stages.a, stages);
  take_slopes<Dim>(nodes, motion, stages, next);
}

// Performs a classical fourth-order Runge-Kutta step, which the paper uses as the last iteration.
template <int Dim, class Law>
void runge_kutta_step(Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const Law& law,
                      const Motion& motion, Stages<Dim>& stages, Field<Dim>& next) {
  stages.reserve(nodes.count);
  accelerations<Dim>(nodes, lists, law, motion, nodes.x, nodes.v, stages.a);
  add_slopes<Dim>(nodes, 1.0 / 6, true, nodes.v, stages.a, stages);
  stage_state<Dim>(nodes, 0.5 * motion.dt, motion.max_move, nodes.v, stages.a, stages.x, stages.v);
  for (int stage = 0; stage < 3; ++stage) {
    accelerations<Dim>(nodes, lists, law, motion, stages.x, stages.v, stages.a);
    add_slopes<Dim>(nodes, stage < 2 ? 1.0 / 3 : 1.0 / 6, false, stages.v, stages.a, stages);
    if (stage < 2)
      stage_state<Dim>(nodes, stage == 0 ? 0.5 * motion.dt : motion.dt, motion.max_move, stages.v,
                       stages.a, stages.x, stages.v);
  }
  take_slopes<Dim>(nodes, motion, stages, next);
}

}  // namespace pnpbs

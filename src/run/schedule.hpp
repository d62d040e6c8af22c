// SPDX-License-Identifier: BSD-3-Clause
// The schedule of a level's simulation. Events happen at fixed step numbers.
#pragma once

#include <cstdint>

namespace pnpbs {

// The origin of the first nodes of a level.
enum class FirstNodes {
  laid,     // placed on the boundary and in lattices
  refined,  // refined from a coarser level
  // Refined from a level that the monitor stopped; they count as taken over, too.
  refined_unsettled,
  taken_over  // given by the user, or placed for another spacing
};

inline FirstNodes first_nodes_of(bool refined, bool taken_over) {
  if (refined) return taken_over ? FirstNodes::refined_unsettled : FirstNodes::refined;
  return taken_over ? FirstNodes::taken_over : FirstNodes::laid;
}

// The purpose of a level.
enum class LevelRole {
  result,    // its nodes are the result
  surfaces,  // its nodes on surfaces are the result; they settle before the inside is filled
  coarser    // the spacing, or that of its surfaces, is a multiple of the result's
};

enum class Progress {
  steps,
  at_event,  // restored in the middle of an event; the test for rest is still to be done
  ended
};

// The progress of a simulation and what it depends on.
struct Schedule {
  std::int64_t step = 0;
  FirstNodes first_nodes = FirstNodes::laid;
  LevelRole role = LevelRole::result;
  Progress progress = Progress::steps;
  bool population_settled = false;
  int quiet_events = 0;  // consecutive events with too few changes to continue population control
  double imbalance_reached = 1;  // imbalance after the last repartitioning

  bool refined() const {
    return first_nodes == FirstNodes::refined || first_nodes == FirstNodes::refined_unsettled;
  }
  bool taken_over() const {
    return first_nodes == FirstNodes::taken_over || first_nodes == FirstNodes::refined_unsettled;
  }
  bool ended() const { return progress == Progress::ended; }
  // Returns the schedule of a further run on the same nodes.
  Schedule again() const {
    Schedule next;
    if (first_nodes != FirstNodes::laid) next.first_nodes = FirstNodes::taken_over;
    return next;
  }
};

}  // namespace pnpbs

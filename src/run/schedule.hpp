// SPDX-License-Identifier: BSD-3-Clause
// Where the simulation of a level is. Events happen at step numbers of it.
#pragma once

#include <cstdint>

namespace pnpbs {

// Of the level: where its first nodes come from.
enum class FirstNodes {
  laid,               // in lattices, and on the boundary
  refined,            // of a coarser level
  refined_unsettled,  // of one whose bubbles the monitor stopped: they count as taken over, too
  taken_over          // given, or placed for another spacing
};

inline FirstNodes first_nodes_of(bool refined, bool taken_over) {
  if (refined) return taken_over ? FirstNodes::refined_unsettled : FirstNodes::refined;
  return taken_over ? FirstNodes::taken_over : FirstNodes::laid;
}

// What the level is for.
enum class LevelRole {
  result,    // its nodes are the placement's
  surfaces,  // so are its nodes on surfaces, which settle before the others come
  coarser    // its spacing, or that of its surfaces, is a multiple of the one that counts
};

enum class Progress {
  steps,
  at_event,  // restored in the middle of an event: it is still to be asked if all is at rest
  ended
};

struct Schedule {
  std::int64_t step = 0;
  FirstNodes first_nodes = FirstNodes::laid;
  LevelRole role = LevelRole::result;
  Progress progress = Progress::steps;
  bool population_settled = false;
  int quiet_events = 0;          // that changed too little to pay, in a row
  double imbalance_reached = 1;  // by the last rebalancing

  bool refined() const {
    return first_nodes == FirstNodes::refined || first_nodes == FirstNodes::refined_unsettled;
  }
  bool taken_over() const {
    return first_nodes == FirstNodes::taken_over || first_nodes == FirstNodes::refined_unsettled;
  }
  bool ended() const { return progress == Progress::ended; }
  // For nodes that are there already, where this one has ended.
  Schedule again() const {
    Schedule next;
    if (first_nodes != FirstNodes::laid) next.first_nodes = FirstNodes::taken_over;
    return next;
  }
};

}  // namespace pnpbs

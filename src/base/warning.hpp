// SPDX-License-Identifier: BSD-3-Clause
// Warnings as data. Programs decide by the code and the numbers, never by the text.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "base/message_text.hpp"

namespace pnpbs {

// Codes of warnings, equal to the constants PNPBS_WARNING_... of the public header. The hundreds
// stand for the domain (1), the spacing (2), the elements (3), and the options and the run (4).
enum class WarningCode : std::int32_t {
  unknown = 0,
  left_out_outside = 101,
  unused_vertices = 102,
  region_points = 103,
  simplified = 104,
  repaired = 105,
  triangles_left_out = 106,
  triangles_turned = 107,
  vertices_merged = 108,
  surfaces_touch = 109,
  pieces_left_out = 110,
  edges_rounded = 111,
  creases_ignored = 112,
  feature_angle = 113,
  curved_elements = 114,
  groups = 115,
  feature_unresolved = 201,
  fixed_nodes_close = 202,
  growth = 203,
  partial_extent = 204,
  spacing_coarse = 205,
  spacing_missed = 206,
  spacing_held = 207,
  boundary_not_followed = 301,
  not_conforming = 302,
  small_angles = 303,
  features_left_out = 304,
  option_without_effect = 401,
  options_changed = 402,
  depends_on_ranks = 403
};

// A warning with its code, message and numbers.
struct Warning {
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

  Warning(WarningCode of, MessageText text, std::int64_t how_many = 0, double number = kNoValue)
      : code(of), message(as_worded(std::move(text))), count(how_many), value(number) {}

  // Returns the first point that the message names, if any.
  std::optional<NamedPoint> point() const {
    if (message.points().empty()) return std::nullopt;
    return message.points().front();
  }

  WarningCode code;
  MessageText message;
  std::int64_t count;  // affected nodes, triangles, edges or points; 0 if not applicable
  double value;        // in the unit of the code; NaN if not applicable
};

}  // namespace pnpbs

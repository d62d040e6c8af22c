// SPDX-License-Identifier: BSD-3-Clause
// What a placement tells of its elements, and whether its nodes follow d.
#include <charconv>

#include "placement/placement_of.hpp"

namespace pnpbs {

namespace {

// With a point in every locale.
std::string text_of(double value, std::chars_format format, int digits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, format, digits);
  return {text, end.ptr};
}
std::string two_decimals(double value) { return text_of(value, std::chars_format::fixed, 2); }
std::string three_digits(double value) { return text_of(value, std::chars_format::general, 3); }

std::string warning_of(const EdgeBand& band) {
  const double mean = band.ratio.mean;
  return "the nodes do not follow the spacing where it is " + three_digits(band.from) + " to " +
         three_digits(band.to) + ": over " + std::to_string(band.ratio.edges) +
         " edges, the mean length is " + two_decimals(mean) + " of it, with too " +
         (mean > 1 ? "few" : "many") +
         " nodes; limit the growth of the spacing (option growth_limit), or allow more steps "
         "(option steps)";
}

}  // namespace

// By the edges at the end of a run; if so there is a warning.
bool Placement::spacing_missed() {
  const EdgeBand* worst = worst_missed_band(edge_bands_);
  if (worst) warnings_.push_back(warning_of(*worst));
  return worst != nullptr;
}

template <int Dim>
const ElementQuality& PlacementOf<Dim>::element_quality() {
  prepare_stars();
  if (quality_version_ != level_->version()) {
    quality_ = measure_elements<Dim>(*comm_, level_->nodes, level_->stars);
    quality_version_ = level_->version();
  }
  return quality_;
}

template const ElementQuality& PlacementOf<2>::element_quality();
template const ElementQuality& PlacementOf<3>::element_quality();

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
#include "picture/element_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "picture/lettering.hpp"

namespace pnpbs::picture {
namespace {

struct Name {
  std::string_view name;
  ElementColour colour;
};

constexpr std::array names{
    Name{"none", ElementColour::none}, Name{"quality", ElementColour::quality},
    Name{"edge", ElementColour::edge}, Name{"spacing", ElementColour::spacing}};

// Share of the elements that may lie beyond each limit of the scale, so that a few bad elements,
// such as those at sharp corners, do not take the contrast from the others. [1]
constexpr double share_beyond = 0.01;

// Returns the first candidate that includes all values except for share_beyond, or the last
// candidate. Candidates are ordered from narrow to wide. is_within(value, candidate) returns
// whether a candidate includes the value.
template <std::size_t Count, class IsWithin>
double narrowest(const ElementValues& values, const std::array<double, Count>& candidates,
                 const IsWithin& is_within) {
  std::array<std::size_t, Count> within{};
  for (std::size_t e = 0; e < values.count; ++e) {
    const double value = values.at(e);
    for (std::size_t k = Count; k-- > 0 && is_within(value, candidates[k]);) ++within[k];
  }
  for (std::size_t k = 0; k < Count; ++k) {
    const std::size_t beyond = values.count - within[k];
    if (static_cast<double>(beyond) <= share_beyond * static_cast<double>(values.count))
      return candidates[k];
  }
  return candidates.back();
}

void choose_quality_scale(const ElementValues& values, ColourScale& scale) {
  constexpr std::array ends{0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0};
  scale.palette = quality_palette;
  scale.high = 1;
  scale.low = narrowest(values, ends, [](double value, double low) { return value >= low; });
}

// Chooses a scale that is symmetric about 1 and at most from 0 to 2. It does not distinguish edges
// longer than 2 d, which are wrong anyway.
void choose_edge_scale(const ElementValues& values, ColourScale& scale) {
  constexpr std::array widths{0.05, 0.1, 0.2, 0.3, 0.5, 1.0};
  scale.palette = edge_palette;
  const double width = narrowest(
      values, widths, [](double value, double max) { return std::abs(value - 1) <= max; });
  scale.low = 1 - width;
  scale.high = 1 + width;
}

void choose_spacing_scale(double min, double max, ColourScale& scale) {
  scale.palette = spacing_palette;
  scale.logarithmic = max > 10 * min;
  scale.low = min;
  // The ticks have three digits, which could not distinguish the ends of a smaller range.
  scale.high = max < 1.02 * min ? min : max;
}

}  // namespace

std::vector<std::string> element_colour_names() {
  std::vector<std::string> result;
  for (const Name& entry : names) result.emplace_back(entry.name);
  return result;
}

std::optional<ElementColour> element_colour_called(std::string_view name) {
  const auto found = std::ranges::find(names, name, &Name::name);
  if (found == names.end()) return std::nullopt;
  return found->colour;
}

ValueScale scale_for(ElementColour by, const ElementValues& values) {
  ValueScale scale;
  if (values.count > 0) {
    scale.min = std::numeric_limits<double>::infinity();
    scale.max = -scale.min;
  }
  for (std::size_t e = 0; e < values.count; ++e) {
    const double value = values.at(e);
    scale.min = std::min(scale.min, value);
    scale.max = std::max(scale.max, value);
  }
  if (by == ElementColour::quality) choose_quality_scale(values, scale.colours);
  if (by == ElementColour::edge) choose_edge_scale(values, scale.colours);
  if (by == ElementColour::spacing) choose_spacing_scale(scale.min, scale.max, scale.colours);
  scale.colours.below = scale.min < scale.colours.low;
  scale.colours.above = scale.max > scale.colours.high;
  return scale;
}

std::string title_of(ElementColour by, const std::string& quality, const std::string& elements,
                     const ValueScale& scale, std::size_t count) {
  const std::string what = by == ElementColour::quality ? quality
                           : by == ElementColour::edge  ? "mean edge over d"
                                                        : "spacing d";
  if (count == 0) return what + ": no " + elements;
  return what + ": " + short_number(scale.min) + " to " + short_number(scale.max);
}

namespace {

// Returns the quality 2 r_in / R = (b + c - a) (c + a - b) (a + b - c) / (a b c).
double quality(const TriangleShape& triangle) {
  const auto [a, b, c] = triangle.edge;
  if (!(a > 0 && b > 0 && c > 0)) return 0;
  return std::clamp((b + c - a) / a * ((c + a - b) / b) * ((a + b - c) / c), 0.0, 1.0);
}

double edge_over_spacing(const TriangleShape& triangle) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += triangle.edge[k] / (0.5 * (triangle.spacing[k] + triangle.spacing[(k + 1) % 3]));
  return sum / 3;
}

double mean_spacing(const TriangleShape& triangle) {
  const auto [a, b, c] = triangle.spacing;
  return (a + b + c) / 3;
}

}  // namespace

double value_of(ElementColour by, const TriangleShape& triangle) {
  switch (by) {
    case ElementColour::quality:
      return quality(triangle);
    case ElementColour::edge:
      return edge_over_spacing(triangle);
    case ElementColour::spacing:
      return mean_spacing(triangle);
    case ElementColour::none:
      break;
  }
  return 0;
}

}  // namespace pnpbs::picture

// SPDX-License-Identifier: BSD-3-Clause
#include "picture/triangle_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "picture/lettering.hpp"

namespace pnpbs::picture {
namespace {

struct Name {
  std::string_view name;
  TriangleColour colour;
};

constexpr std::array names{
    Name{"none", TriangleColour::none}, Name{"quality", TriangleColour::quality},
    Name{"edge", TriangleColour::edge}, Name{"spacing", TriangleColour::spacing}};

// A few odd triangles, at sharp corners say, shall not take all contrast from the others: up to
// this share of them may lie beyond an end of the scale.
constexpr double share_beyond = 0.01;

struct Triangle {
  std::array<double, 3> edge;     // edge k is from corner k to the next
  std::array<double, 3> spacing;  // at the corners
};

Triangle triangle_of(const NodeSet& nodes, const std::array<std::size_t, 3>& corners) {
  Triangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = corners[k], b = corners[(k + 1) % 3];
    triangle.edge[k] =
        std::hypot(nodes.xy[2 * b] - nodes.xy[2 * a], nodes.xy[2 * b + 1] - nodes.xy[2 * a + 1]);
    triangle.spacing[k] = nodes.spacing[a];
  }
  return triangle;
}

// 2 r_in / R = (b + c - a) (c + a - b) (a + b - c) / (a b c)
double quality(const Triangle& triangle) {
  const auto [a, b, c] = triangle.edge;
  if (!(a > 0 && b > 0 && c > 0)) return 0;
  return std::clamp((b + c - a) / a * ((c + a - b) / b) * ((a + b - c) / c), 0.0, 1.0);
}

double edge_over_spacing(const Triangle& triangle) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += triangle.edge[k] / (0.5 * (triangle.spacing[k] + triangle.spacing[(k + 1) % 3]));
  return sum / 3;
}

double mean_spacing(const Triangle& triangle) {
  const auto [a, b, c] = triangle.spacing;
  return (a + b + c) / 3;
}

// The first of the candidates, which go from narrow to wide, that holds all values but a few; the
// last if none does. is_within(value, candidate) tells whether it holds that one.
template <std::size_t Count, class IsWithin>
double narrowest(const TriangleValues& values, const std::array<double, Count>& candidates,
                 const IsWithin& is_within) {
  std::array<std::size_t, Count> within{};
  const std::size_t count = values.count();
  for (std::size_t t = 0; t < count; ++t) {
    const double value = values.at(t);
    for (std::size_t k = Count; k-- > 0 && is_within(value, candidates[k]);) ++within[k];
  }
  for (std::size_t k = 0; k < Count; ++k) {
    const std::size_t beyond = count - within[k];
    if (static_cast<double>(beyond) <= share_beyond * static_cast<double>(count))
      return candidates[k];
  }
  return candidates.back();
}

}  // namespace

std::vector<std::string> triangle_colour_names() {
  std::vector<std::string> result;
  for (const Name& entry : names) result.emplace_back(entry.name);
  return result;
}

std::optional<TriangleColour> triangle_colour_called(std::string_view name) {
  const auto found = std::ranges::find(names, name, &Name::name);
  if (found == names.end()) return std::nullopt;
  return found->colour;
}

TriangleValues::TriangleValues(const NodeSet& nodes, TriangleColour by) : nodes_(nodes), by_(by) {
  if (count() > 0) {
    min_ = std::numeric_limits<double>::infinity();
    max_ = -min_;
  }
  for (std::size_t t = 0; t < count(); ++t) {
    const double value = at(t);
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }
  choose_scale();
}

std::array<std::size_t, 3> TriangleValues::corners(std::size_t triangle) const {
  const std::array<std::int64_t, 3>& ends = nodes_.triangles[triangle];
  return {static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1]),
          static_cast<std::size_t>(ends[2])};
}

double TriangleValues::at(std::size_t triangle) const {
  const Triangle shape = triangle_of(nodes_, corners(triangle));
  switch (by_) {
    case TriangleColour::quality:
      return quality(shape);
    case TriangleColour::edge:
      return edge_over_spacing(shape);
    case TriangleColour::spacing:
      return mean_spacing(shape);
    case TriangleColour::none:
      break;
  }
  return 0;
}

std::string TriangleValues::title() const {
  std::string what = by_ == TriangleColour::quality ? "quality 2 r_in / R"
                     : by_ == TriangleColour::edge  ? "mean edge over d"
                                                    : "spacing d";
  if (count() == 0) return what + ": no triangles";
  return what + ": " + short_number(min_) + " to " + short_number(max_);
}

void TriangleValues::choose_scale() {
  if (by_ == TriangleColour::quality) choose_quality_scale();
  if (by_ == TriangleColour::edge) choose_edge_scale();
  if (by_ == TriangleColour::spacing) choose_spacing_scale();
  scale_.below = min_ < scale_.low;
  scale_.above = max_ > scale_.high;
}

void TriangleValues::choose_quality_scale() {
  constexpr std::array ends{0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0};
  scale_.palette = quality_palette;
  scale_.high = 1;
  scale_.low = narrowest(*this, ends, [](double value, double low) { return value >= low; });
}

// About 1. At most from 0 to 2: what is longer is wrong whatever its number.
void TriangleValues::choose_edge_scale() {
  constexpr std::array widths{0.05, 0.1, 0.2, 0.3, 0.5, 1.0};
  scale_.palette = edge_palette;
  const double width =
      narrowest(*this, widths, [](double value, double max) { return std::abs(value - 1) <= max; });
  scale_.low = 1 - width;
  scale_.high = 1 + width;
}

void TriangleValues::choose_spacing_scale() {
  scale_.palette = spacing_palette;
  scale_.logarithmic = max_ > 10 * min_;
  scale_.low = min_;
  // Three digits could not tell the ends of a smaller range apart.
  scale_.high = max_ < 1.02 * min_ ? min_ : max_;
}

}  // namespace pnpbs::picture

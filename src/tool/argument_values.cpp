// SPDX-License-Identifier: BSD-3-Clause
#include "tool/argument_values.hpp"

#include <algorithm>
#include <charconv>

#include "tool/argument_rules.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {

void take_angle(const std::string& option, const std::string& text, std::optional<double>& angle) {
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 1 || numbers->front() < 0 || numbers->front() > 180)
    refuse(option + ": expected degrees from 0 to 180, found '" + text + "'");
  angle = numbers->front();
}

void take_sphere(const std::string& text, Arguments& arguments) {
  // Of Antarctica, the place farthest from any sea.
  constexpr Point<2> deep_in_land{55, -82};
  const auto numbers = numbers_between_commas(text);
  const bool fits = numbers && (numbers->size() == 1 || numbers->size() == 3) &&
                    (*numbers)[0] > 0 && (numbers->size() == 1 || std::fabs((*numbers)[2]) <= 90);
  if (!fits)
    refuse(
        "--sphere: expected RADIUS or RADIUS,LON,LAT with a radius greater than 0 and degrees, "
        "found '" +
        text + "'");
  arguments.sphere = SphereWish{(*numbers)[0], deep_in_land};
  if (numbers->size() == 3) arguments.sphere->outside = {(*numbers)[1], (*numbers)[2]};
}

void take_view(const std::string& text, Arguments& arguments) {
  if (text == "map") {
    arguments.view = ViewWish{true, {}};
    return;
  }
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 2 || !(std::fabs((*numbers)[1]) <= 90))
    refuse("--view: expected LON,LAT in degrees, or map, found '" + text + "'");
  arguments.view = ViewWish{false, {(*numbers)[0], (*numbers)[1]}};
}

void take_simplify(const std::string& text, Arguments& arguments) {
  const auto numbers = numbers_between_commas(text);
  const auto is_bad = [](double number) { return !(number >= 0); };
  if (!numbers || numbers->empty() || numbers->size() > 2 || std::ranges::any_of(*numbers, is_bad))
    refuse(
        "--simplify: expected TOLERANCE or TOLERANCE,EXTENT, both in d and not negative, found '" +
        text + "'");
  arguments.simplify = numbers->front();
  arguments.smallest = numbers->size() == 2 ? numbers->back() : 0;
}

void take_bound(const std::string& option, const std::string& text, std::optional<double>& bound) {
  const auto numbers = numbers_between_commas(text);
  if (!numbers || numbers->size() != 1 || !(numbers->front() > 0))
    refuse(option + ": expected a number greater than 0, found '" + text + "'");
  bound = numbers->front();
}

// An option of the library, but one that is a number of nodes: 1e6 will do.
void take_nodes(const std::string& text, Arguments& arguments) {
  std::optional<double> nodes;
  take_bound("--nodes", text, nodes);
  arguments.options.emplace_back("wanted_nodes", text);
}

void take_places(const std::string& text, Arguments& arguments) {
  arguments.in_walls = text == "walls";
  arguments.at_centres = arguments.in_walls || text == "centers" || text == "centres";
  if (!arguments.at_centres && text != "boundary")
    refuse("--nodes-at: unknown value '" + text + "' (known: boundary, centers, walls)");
}

// With one layer nodes would have to lie on a surface that is no body.
void take_wall_layers(const std::string& text, Arguments& arguments) {
  constexpr int most = 1000;  // more than any kernel reaches
  int layers = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, layers);
  if (read.ec != std::errc() || read.ptr != end || layers < 2 || layers > most)
    refuse("--wall-layers: expected a number of layers from 2 to " + std::to_string(most) +
           ", found '" + text + "'");
  arguments.wall_layers = layers;
}

namespace {

// 0 if it is none.
std::int32_t tag_in(std::string_view text) {
  std::int32_t tag = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, tag);
  return read.ec == std::errc() && read.ptr == end ? tag : 0;
}

}  // namespace

void take_name(const std::string& text, Arguments& arguments) {
  const std::size_t equals = text.find('=');
  const std::string name = equals == std::string::npos ? "" : text.substr(equals + 1);
  const std::int32_t tag = tag_in(text.substr(0, equals));
  if (name.empty() || tag == 0)
    refuse("--name: expected TAG=NAME with a tag other than 0, found '" + text + "'");
  arguments.names.emplace_back(tag, name);
}

void take_region(const std::string& text, Arguments& arguments) {
  const std::size_t colon = text.find(':');
  const auto point = numbers_between_commas(text.substr(0, colon));
  const std::int32_t tag = colon == std::string::npos ? 0 : tag_in(text.substr(colon + 1));
  if (!point || point->size() < 2 || point->size() > 3 || tag == 0)
    refuse("--region: expected X,Y:TAG or X,Y,Z:TAG with a tag other than 0, found '" + text + "'");
  arguments.regions.push_back({*point, tag, text});
}

void take_repair(const std::vector<std::string>& text, Arguments& arguments) {
  arguments.repair_if_needed = text == std::vector<std::string>{"auto"};
  if (arguments.repair_if_needed) return;
  arguments.repair = 0;
  if (text.empty() || text[0].empty()) return;
  const auto numbers = numbers_between_commas(text[0]);
  if (!numbers || numbers->size() != 1 || !((*numbers)[0] > 0))
    refuse("--repair: expected a positive resolution or auto, found '" + text[0] + "'");
  arguments.repair = (*numbers)[0];
}

void take_colour(const std::string& name, Arguments& arguments) {
  const std::vector<std::string> names = picture::element_colour_names();
  const auto colour = picture::element_colour_called(name);
  if (!colour) {
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
    refuse("--color: unknown value '" + name + "'" + did_you_mean(name, names) +
           " (known: " + known + ")");
  }
  arguments.colour = *colour;
}

void take_settings(const std::vector<std::string>& settings, Arguments& arguments) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      refuse("--set: expected KEY=VALUE, found '" + setting + "'");
    }
    arguments.options.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
}

}  // namespace pnpbs::tool

// SPDX-License-Identifier: BSD-3-Clause
#include "tool/depth_request.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "tool/argument_rules.hpp"
#include "tool/exit.hpp"
#include "tool/names.hpp"
#include "tool/numbers.hpp"

namespace pnpbs::tool {
namespace {

std::vector<std::string> parts_between_commas(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

void take_word(const std::string& word, DepthRequest& request) {
  if (word == "up") {
    request.elevations = true;
    return;
  }
  struct Key {
    std::string name;
    double* value;
    bool may_be_zero;
  };
  double metres = 0;
  const std::array<Key, 5> keys{{{"wave", &request.rule.wave, true},
                                 {"period", &request.rule.period, false},
                                 {"slope", &request.rule.slope, true},
                                 {"least", &request.rule.least, false},
                                 {"metres", &metres, false}}};
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string option = DepthRequest::option;
  for (const Key& key : keys) {
    if (key.name != name) continue;
    const auto numbers =
        numbers_between_commas(equals == std::string::npos ? "" : word.substr(equals + 1));
    if (!numbers || numbers->size() != 1 ||
        !(numbers->front() > 0 || (key.may_be_zero && numbers->front() == 0)))
      tool::refuse(option + ": " + name + ": expected " + name + "= and a number " +
                   (key.may_be_zero ? "that is not negative" : "greater than 0") + ", found '" +
                   word + "'");
    *key.value = numbers->front();
    if (metres > 0) request.metres = metres;
    return;
  }
  std::vector<std::string> known{"up"};
  for (const Key& key : keys) known.push_back(key.name);
  tool::refuse(option + ": unknown word '" + word + "'" + did_you_mean(name, known) +
               " (known: up, wave=NODES, period=SECONDS, slope=NODES, least=DEPTH, metres=NUMBER)");
}

}  // namespace

DepthRequest depth_request_in(const std::string& text) {
  const std::vector<std::string> parts = parts_between_commas(text);
  DepthRequest request;
  request.text = text, request.grid = parts[0];
  if (request.grid.empty())
    refuse(std::string(DepthRequest::option) + ": expected a file, found '" + text + "'");
  for (std::size_t k = 1; k < parts.size(); ++k) take_word(parts[k], request);
  if (request.rule.wave == 0 && request.rule.slope == 0)
    refuse(std::string(DepthRequest::option) + ": with wave=0 and no slope=NODES nothing gives d");
  return request;
}

double metres_per_unit(const DepthRequest& request, const std::string& unit) {
  double known = 0;
  for (const std::string_view name : {"metre", "meter", "m"})
    if (unit == name) known = 1;
  for (const std::string_view name : {"kilometre", "kilometer", "km"})
    if (unit == name) known = 1000;
  const std::string option = DepthRequest::option;
  if (!request.metres && known == 0)
    throw BadInput(option + ": depths are in metres, and the unit of length of the domain is " +
                   (unit.empty() ? "not known" : "'" + unit + "'") +
                   ": add ,metres=1000 if it is kilometres, ,metres=1 if it is metres");
  constexpr double rounding = 1e-9;
  if (request.metres && known > 0 && std::fabs(*request.metres - known) > rounding * known)
    throw BadInput(option + ": metres=" + number_text(*request.metres) +
                   ", but the unit of length of the domain is " + unit);
  return request.metres.value_or(known);
}

std::string formula_by_depth(const std::optional<double>& least,
                             const std::optional<double>& most) {
  std::string formula = DepthRequest::name;
  if (most) formula = "min(" + number_text(*most) + ", " + formula + ")";
  if (least) formula = "max(" + number_text(*least) + ", " + formula + ")";
  return formula;
}

}  // namespace pnpbs::tool

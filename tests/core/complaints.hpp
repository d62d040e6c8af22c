// SPDX-License-Identifier: BSD-3-Clause
// Helpers for tests that corrupt results by hand and examine the message of the result check.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "check/result_check.hpp"
#include "check_runner.h"
#include "placement/placement_impl.hpp"

template <std::size_t Dim>
std::string place_text(const std::array<double, Dim>& point) {
  return pnpbs::point_text(point).text();
}

// Returns the message of the result check, or an empty string if it finds no error.
template <int Dim>
std::string complaint_of(pnpbs::PlacementImpl<Dim>& placement) {
  try {
    const auto lacking = pnpbs::check_results(placement.results());
    return lacking ? lacking->text() : "";
  } catch (const pnpbs::Error& error) {
    ck_assert(error.kind() == pnpbs::ErrorKind::internal);
    return error.what();
  }
}

// Corrupts correct results with `spoil`, and expects that the message contains all words that
// `spoil` returns.
template <int Dim>
void expect_check_to_say(
    pnpbs::PlacementImpl<Dim>& placement,
    const std::function<std::vector<std::string>(pnpbs::PlacementImpl<Dim>&)>& spoil) {
  const std::string before = complaint_of(placement);
  ck_assert_str_eq(before.c_str(), "");
  const std::vector<std::string> words = spoil(placement);
  const std::string complaint = complaint_of(placement);
  for (const std::string& word : words)
    ck_assert_msg(complaint.find(word) != std::string::npos, "no \"%s\" in \"%s\"", word.c_str(),
                  complaint.c_str());
}

// SPDX-License-Identifier: BSD-3-Clause
// Collects the results of a run as text and compares two sets of results.

#include "results.hpp"

#include <cstdint>

#include "number_text.hpp"
#include "result_hashes.hpp"

namespace hunt {

namespace {

bool same_on_all(std::uint64_t value, MPI_Comm ranks) {
  std::uint64_t range[2] = {value, ~value}, least[2];
  MPI_Allreduce(range, least, 2, MPI_UINT64_T, MPI_MIN, ranks);
  return least[0] == ~least[1];
}

void add_warnings(pnpbs_placement placement, const std::string& prefix, Results& results) {
  std::int32_t count = 0;
  pnpbs_placement_warning_count(placement, &count);
  for (std::int32_t k = 0; k < count; ++k) {
    const char* text = "";
    pnpbs_placement_get_warning(placement, k, &text);
    results.emplace_back(prefix + "warning " + std::to_string(k), text);
  }
}

pnpbs_status add_statistics(pnpbs_placement placement, const std::string& prefix,
                            Results& results) {
  for (const char* key : {"nodes", "boundary_nodes", "steps", "levels", "inserted", "deleted",
                          "missing_faces", "unresolved_places"}) {
    std::int64_t value = 0;
    const pnpbs_status status = pnpbs_placement_get_int64(placement, key, &value);
    if (status < 0) return status;
    results.emplace_back(prefix + key, std::to_string(value));
  }
  for (const char* key :
       {"quality.mean", "quality.min", "edge.deviation", "d_error.mean", "speed.largest"}) {
    double value = 0;
    const pnpbs_status status = pnpbs_placement_get_double(placement, key, &value);
    if (status < 0) return status;
    results.emplace_back(prefix + key, exact_text(value));
  }
  for (const char* key : {"stop_reason", "hash"}) {
    const char* value = "";
    const pnpbs_status status = pnpbs_placement_get_string(placement, key, &value);
    if (status < 0) return status;
    results.emplace_back(prefix + key, value);
  }
  return PNPBS_OK;
}

}  // namespace

bool add_status(pnpbs_status status, pnpbs_context context, MPI_Comm ranks, const std::string& name,
                Results& results) {
  const std::string message = status < 0 ? pnpbs_last_error(context) : "";
  results.emplace_back(name, std::to_string(status));
  if (status < 0) results.emplace_back(kMessage, message);
  if (same_on_all(hash_of(results.back().second), ranks)) return true;
  results.emplace_back(name + " on all ranks", "not the same");
  return false;
}

bool add_results(pnpbs_placement placement, pnpbs_context context, MPI_Comm ranks,
                 const std::string& prefix, Results& results) {
  Results sums;
  const pnpbs_status told = for_result_hashes(placement, [&](const char* name, std::uint64_t sum) {
    std::uint64_t all = 0;
    MPI_Allreduce(&sum, &all, 1, MPI_UINT64_T, MPI_SUM, ranks);
    sums.emplace_back(prefix + "hash of " + name, hexadecimal(all));
  });
  if (told < 0) return add_status(told, context, ranks, prefix + "results", results) && false;
  const pnpbs_status status = add_statistics(placement, prefix, results);
  if (status < 0)
    return add_status(status, context, ranks, prefix + "statistics", results) && false;
  results.insert(results.end(), sums.begin(), sums.end());
  add_warnings(placement, prefix, results);
  // The message of the check names the first point that a rank finds, so only the status is
  // compared.
  const pnpbs_status check = pnpbs_placement_check(placement);
  results.emplace_back(prefix + "check", std::to_string(check));
  const bool same = same_on_all(hash_of(packed(results)), ranks);
  if (!same) results.emplace_back(prefix + "results on all ranks", "not the same");
  if (check < 0) results.emplace_back(kMessage, pnpbs_last_error(context));
  return same;
}

std::string packed(const Results& results) {
  std::string text;
  for (const auto& [name, value] : results) text += name + '\n' + value + '\0';
  return text;
}

Results unpacked(const std::string& text) {
  Results results;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t cut = text.find('\n', begin), end = text.find('\0', begin);
    results.emplace_back(text.substr(begin, cut - begin), text.substr(cut + 1, end - cut - 1));
    begin = end + 1;
  }
  return results;
}

std::string difference(const Results& expected, const Results& found) {
  std::string text;
  int named = 0;
  const auto tell = [&](const std::string& name, const std::string& here,
                        const std::string& there) {
    if (named++ < 3)
      text += (text.empty() ? "" : "; ") + name + ": " + here + " / " + there;
    else
      text += ", " + name;
  };
  for (std::size_t k = 0; k < std::max(expected.size(), found.size()); ++k) {
    if (k >= expected.size()) {
      tell(found[k].first, "nothing", found[k].second);
      break;
    }
    if (k >= found.size() || found[k].first != expected[k].first) {
      tell(expected[k].first, expected[k].second,
           k < found.size() ? found[k].first + " " + found[k].second : "nothing");
      break;  // the following entries no longer correspond
    }
    if (found[k].first != kMessage && found[k].second != expected[k].second)
      tell(found[k].first, expected[k].second, found[k].second);
  }
  return text;
}

}  // namespace hunt

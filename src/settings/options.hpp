// SPDX-License-Identifier: BSD-3-Clause
// The options: one table that sets, checks, documents and lists them all.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pnpbs {

enum class OptionType { integer, real, choice };

struct OptionRow {
  const char* name;
  OptionType type;
  const char* default_value;
  const char* paper_value;  // the default under method=paper; NULL where it is the same
  const char* best_value;   // the default under effort=best, likewise
  double min, max;          // range of numbers
  const char* choices;      // "a | b" for choices
  const char* help;
  std::string range() const;
};

const std::vector<OptionRow>& option_table();

class Options {
 public:
  // Throws Error(ErrorKind::key or ::argument).
  void set(const std::string& key, const std::string& value);
  void set_integer(const std::string& key, std::int64_t value);
  void set_real(const std::string& key, double value);

  // The value set, or else the default of the method chosen. Keys are literals of ours.
  // With the defaults for that dimension.
  Options in(int dimension) const;
  int dimension() const { return dimension_; }
  std::int64_t integer(const char* key) const;
  double real(const char* key) const;
  std::string choice(const char* key) const;
  // The same for the same options.
  std::size_t fingerprint() const;
  // Name and value of every option that decides on the nodes; the others only on where and how fast
  // they are found, or handed out.
  std::vector<std::pair<std::string, std::string>> deciding() const;
  bool is_set(const char* key) const { return values_.count(key) != 0; }
  // By itself, or by a preset that has been set and gives it a value.
  bool is_given(const char* key) const;

 private:
  std::string text(const char* key) const;
  bool chosen(const char* preset, const char* value) const;
  std::map<std::string, std::string, std::less<>> values_;  // checked texts
  int dimension_ = 2;
};

}  // namespace pnpbs

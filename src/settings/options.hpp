// SPDX-License-Identifier: BSD-3-Clause
// The options of a placement. One table sets, checks, documents and lists all of them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pnpbs {

enum class OptionType { integer, real, choice };

// The description of an option.
struct OptionRow {
  const char* name;
  OptionType type;
  const char* default_value;
  const char* paper_value;  // default under method=paper; NULL if it is the same
  const char* best_value;   // default under effort=best; NULL if it is the same
  double min, max;          // of integers and real numbers
  const char* choices;      // "a | b" for options of type choice
  const char* help;
  std::string range() const;
};

// Returns all options, in the order of the documentation.
const std::vector<OptionRow>& option_table();

// The values that a user has set, and the defaults of all other options.
class Options {
 public:
  // Sets an option after checking the value. All three functions throw Error(ErrorKind::key or
  // ::argument).
  void set(const std::string& key, const std::string& value);
  void set_integer(const std::string& key, std::int64_t value);
  void set_real(const std::string& key, double value);

  // Returns a copy whose defaults are those for bubbles in this dimension (2 or 3).
  Options in(int dimension) const;
  int dimension() const { return dimension_; }
  // Return the value that is set, or the default for the dimension and the presets. `key` must be
  // an existing option of the right type.
  std::int64_t integer(const char* key) const;
  double real(const char* key) const;
  std::string choice(const char* key) const;
  // Returns a hash of all values that are set, which is equal for equal options.
  std::size_t fingerprint() const;
  // Returns name and value of every option that influences the nodes. The other options influence
  // only the distribution and speed of the work, or the output.
  std::vector<std::pair<std::string, std::string>> deciding() const;
  bool is_set(const char* key) const { return values_.count(key) != 0; }
  // Returns true if the option is set, or if a preset that is set gives it a value.
  bool is_given(const char* key) const;

 private:
  std::string text(const char* key) const;
  bool chosen(const char* preset, const char* value) const;
  std::map<std::string, std::string, std::less<>> values_;  // values that are set, already checked
  int dimension_ = 2;
};

}  // namespace pnpbs

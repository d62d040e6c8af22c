// SPDX-License-Identifier: BSD-3-Clause
// A text file of numbers, field by field and line by line, in any locale. '#' begins a comment;
// lines with nothing else are skipped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pnpbs {

class TextFields {
 public:
  // `name` stands for the file in messages. Keeps a reference to the text.
  TextFields(std::string_view text, std::string name);

  // The next field of this line, or nothing at its end.
  std::optional<std::string_view> next();

  // Goes to the next line that has fields; false at the end of the text.
  bool next_line();

  // The next field as a number. `what` is what it should be, for the message if it is not: Error
  // with "name:line: found ..., expected what".
  std::int64_t integer(const std::string& what);
  double coordinate(const std::string& what);
  std::int32_t tag(const std::string& what);

  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view required(const std::string& what);
  [[noreturn]] void fail_found(std::string_view found, const std::string& what) const;

  std::string_view rest_;  // of the text
  std::string_view line_;  // what is left of this one
  std::string name_;
  std::int64_t line_number_ = 0;
};

}  // namespace pnpbs

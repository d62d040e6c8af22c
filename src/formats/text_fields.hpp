// SPDX-License-Identifier: BSD-3-Clause
// A text file of numbers and words, field by field and line by line, in any locale. '#' begins a
// comment; lines with nothing else are skipped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pnpbs {

// Where '#' begins a comment. Where names may hold it, at the beginning of a line only.
enum class Comments { anywhere, whole_lines };

class TextFields {
 public:
  // `name` stands for the file in messages. Keeps a reference to the text.
  TextFields(std::string_view text, std::string name, Comments comments = Comments::anywhere);

  // The next field of this line, or nothing at its end.
  std::optional<std::string_view> next();

  // Goes to the next line that has fields; false at the end of the text.
  bool next_line();

  // What is left of this line, without blanks around it.
  std::string_view rest_of_line() const;

  // The text after this line.
  std::string_view rest() const { return rest_; }

  // The next field. `what` is what it should be, for the message if there is none or it is not:
  // Error with "name:line: found ..., expected what".
  std::string_view required(std::string_view what);
  std::int64_t integer(std::string_view what);
  double coordinate(std::string_view what);
  std::int32_t tag(std::string_view what);

  // A part of a field as an integer.
  std::int64_t integer_in(std::string_view field, std::string_view what) const;

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_found(std::string_view found, std::string_view what) const;

 private:
  std::string_view rest_;  // of the text
  std::string_view line_;  // what is left of this one
  std::string name_;
  Comments comments_;
  std::int64_t line_number_ = 0;
};

// A field as a message can show it.
std::string shown_field(std::string_view field);

// Takes the whole field for a 32- or 64-bit integer or a double; false if it is none.
template <class Number>
bool parse_field(std::string_view field, Number& value);

// Throws Error "name: holds zero bytes, expected text in `format` format" if it does.
void expect_text(std::string_view text, const std::string& name, const std::string& format);

// "12 of 100" as messages about what ends too early have it.
std::string part_of(std::int64_t part, std::int64_t whole, const std::string& what);

// The bytes of a file. Throws Error(ErrorKind::file, "path: cannot be read: ...").
std::string read_whole_file(const std::string& path);

}  // namespace pnpbs

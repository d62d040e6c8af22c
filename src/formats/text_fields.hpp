// SPDX-License-Identifier: BSD-3-Clause
// Text files of numbers and words, read field by field and line by line, in any locale. '#' begins
// a comment. Lines without fields are skipped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pnpbs {

// Position at which '#' begins a comment. In formats whose names may contain '#', it is one at the
// beginning of a line only.
enum class Comments { anywhere, whole_lines };

// A reader of fields at a current position, which names the line in errors.
class TextFields {
 public:
  // `name` stands for the file in messages. `text` must outlive this object.
  TextFields(std::string_view text, std::string name, Comments comments = Comments::anywhere);

  // Returns the next field of this line, or nothing at its end.
  std::optional<std::string_view> next();

  // Goes to the next line that has fields. Returns false at the end of the text.
  bool next_line();

  // Returns the rest of this line without surrounding blanks.
  std::string_view rest_of_line() const;

  // Returns the text after this line.
  std::string_view rest() const { return rest_; }

  // Return the next field. `what` describes the expected field. Each throws Error "name:line: found
  // ..., expected what" if the field is missing or of another kind.
  std::string_view required(std::string_view what);
  std::int64_t integer(std::string_view what);
  double coordinate(std::string_view what);
  std::int32_t tag(std::string_view what);

  // Returns a part of a field as an integer.
  std::int64_t integer_in(std::string_view field, std::string_view what) const;

  // Throws Error at the current line.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_found(std::string_view found, std::string_view what) const;

 private:
  std::string_view rest_;  // text after the current line
  std::string_view line_;  // rest of the current line
  std::string name_;
  Comments comments_;
  std::int64_t line_number_ = 0;
};

// Returns the field in quotation marks, shortened and printable, for messages.
std::string shown_field(std::string_view field);

// Parses the whole field as a 32- or 64-bit integer or a double. Returns false if it is not one.
template <class Number>
bool parse_field(std::string_view field, Number& value);

// Throws Error "name: holds zero bytes, expected text in `format` format" if the text has zero
// bytes.
void expect_text(std::string_view text, const std::string& name, const std::string& format);

// Returns "12 of 100 ...", for messages about files that end too early.
std::string part_of(std::int64_t part, std::int64_t whole, const std::string& what);

// Returns the bytes of a file. Throws Error(ErrorKind::file, "path: cannot be read: ...").
std::string read_whole_file(const std::string& path);

}  // namespace pnpbs

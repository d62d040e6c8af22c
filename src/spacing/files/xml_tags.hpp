// SPDX-License-Identifier: BSD-3-Clause
// A pull parser for XML: returns the tags of a file one by one, with the text that follows them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace pnpbs {

inline constexpr std::string_view kXmlBlanks = " \t\r\n";

// The current tag of an XML file.
class XmlTags {
 public:
  // `bytes` must outlive this object. `name` is the name of the file in messages.
  XmlTags(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

  // Advances to the next tag, skipping comments and declarations. Returns false at the end. Throws
  // Error(ErrorKind::file).
  bool next();

  const std::string& tag() const { return tag_; }
  bool is_end() const { return is_end_; }
  bool is_whole() const { return is_whole_; }  // self-closing, without an end tag
  // Returns the text up to the next tag, trimmed.
  std::string_view text() const;
  // Returns the unread part of the file.
  std::string_view rest() const { return rest_; }

  // Returns the value of an attribute, or `otherwise` if the tag does not have it.
  std::string attribute(const std::string& name, const std::string& otherwise = "") const;
  // Returns the value of an attribute, which must be a non-negative integer. Returns `otherwise` if
  // the tag does not have it and `otherwise` is not negative. Throws Error(ErrorKind::file) in all
  // other cases.
  std::int64_t count(const std::string& name, std::int64_t otherwise) const;

 private:
  void skip_past(std::string_view end);
  void skip_blanks();
  std::string_view name_here(std::string_view ends);
  void read_tag();
  void read_attribute();
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_attribute(const std::string& name) const;

  std::string_view rest_;
  std::string name_;
  std::string tag_;
  bool is_end_ = false, is_whole_ = false;
  std::map<std::string, std::string> attributes_;
};

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
// The tags of an XML file, one by one, with the text that follows them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace pnpbs {

inline constexpr std::string_view kXmlBlanks = " \t\r\n";

class XmlTags {
 public:
  // Keeps a reference to the bytes. `name` stands for the file in messages.
  XmlTags(std::string_view bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}

  // To the next tag that is no comment or declaration; false at the end. Throws
  // Error(ErrorKind::file).
  bool next();

  const std::string& tag() const { return tag_; }
  bool is_end() const { return is_end_; }
  bool is_whole() const { return is_whole_; }  // it has no end tag
  // Up to the next tag, without the blanks around it.
  std::string_view text() const;
  std::string_view rest() const { return rest_; }

  std::string attribute(const std::string& name, const std::string& otherwise = "") const;
  // A number of 0 or more. If `otherwise` is below that, it must be there.
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

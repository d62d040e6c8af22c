// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/xml_tags.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "formats/text_fields.hpp"

namespace pnpbs {

namespace {

std::string without_entities(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
  std::string result;
  while (!text.empty()) {
    const auto entity = std::ranges::find_if(
        kEntities, [&](const auto& known) { return text.starts_with(known.first); });
    result += entity == kEntities.end() ? text.front() : entity->second;
    text.remove_prefix(entity == kEntities.end() ? 1 : entity->first.size());
  }
  return result;
}

}  // namespace

bool XmlTags::next() {
  while (true) {
    const std::size_t begin = rest_.find('<');
    if (begin == std::string_view::npos) return false;
    rest_.remove_prefix(begin + 1);
    if (rest_.starts_with("!--"))
      skip_past("-->");
    else if (rest_.starts_with("?") || rest_.starts_with("!"))
      skip_past(">");
    else
      break;
  }
  read_tag();
  return true;
}

std::string_view XmlTags::text() const {
  std::string_view text = rest_.substr(0, rest_.find('<'));
  text.remove_prefix(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kXmlBlanks) + 1);
}

std::string XmlTags::attribute(const std::string& name, const std::string& otherwise) const {
  const auto found = attributes_.find(name);
  return found == attributes_.end() ? otherwise : found->second;
}

std::int64_t XmlTags::count(const std::string& name, std::int64_t otherwise) const {
  const std::string text = attribute(name);
  if (text.empty() && otherwise >= 0) return otherwise;
  std::int64_t value = -1;
  if (!parse_field(text, value) || value < 0)
    fail("found " + name + "=" + shown_field(text) + " of " + tag_ +
         ", expected a number of 0 or more");
  return value;
}

void XmlTags::skip_past(std::string_view end) {
  const std::size_t at = rest_.find(end);
  if (at == std::string_view::npos) fail("the file ends, expected '" + std::string(end) + "'");
  rest_.remove_prefix(at + end.size());
}

void XmlTags::skip_blanks() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kXmlBlanks), rest_.size()));
}

std::string_view XmlTags::name_here(std::string_view ends) {
  const std::size_t end = std::min(rest_.find_first_of(ends), rest_.size());
  const std::string_view name = rest_.substr(0, end);
  rest_.remove_prefix(end);
  return name;
}

void XmlTags::read_tag() {
  attributes_.clear();
  is_whole_ = false;
  is_end_ = rest_.starts_with('/');
  if (is_end_) rest_.remove_prefix(1);
  tag_ = name_here(" \t\r\n/>");
  while (true) {
    skip_blanks();
    if (rest_.empty()) fail("the file ends within the tag " + shown_field(tag_));
    if (rest_.front() == '>') return rest_.remove_prefix(1);
    if (rest_.front() == '/') {
      is_whole_ = true;
      rest_.remove_prefix(1);
      continue;
    }
    read_attribute();
  }
}

void XmlTags::read_attribute() {
  const std::string name(name_here("= \t\r\n/>"));
  skip_blanks();
  if (!rest_.starts_with('=')) fail_attribute(name);
  rest_.remove_prefix(1);
  skip_blanks();
  if (!rest_.starts_with('"') && !rest_.starts_with('\'')) fail_attribute(name);
  const char quote = rest_.front();
  rest_.remove_prefix(1);
  const std::size_t end = rest_.find(quote);
  if (end == std::string_view::npos) fail_attribute(name);
  attributes_[name] = without_entities(rest_.substr(0, end));
  rest_.remove_prefix(end + 1);
}

void XmlTags::fail(const std::string& message) const {
  throw Error(ErrorKind::file, name_ + ": " + message);
}

void XmlTags::fail_attribute(const std::string& name) const {
  fail("found " + shown_field(name) + " in the tag " + shown_field(tag_) +
       ", expected name=\"value\"");
}

}  // namespace pnpbs

// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/vtu_arrays.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "domain/text_fields.hpp"
#include "spacing/files/inflate.hpp"

namespace pnpbs {

namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

std::string_view stripped(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kXmlBlanks) + 1);
}

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

constexpr std::array<std::pair<std::string_view, std::size_t>, 10> kVtkTypes{{{"Float64", 8},
                                                                              {"Float32", 4},
                                                                              {"Int8", 1},
                                                                              {"UInt8", 1},
                                                                              {"Int16", 2},
                                                                              {"UInt16", 2},
                                                                              {"Int32", 4},
                                                                              {"UInt32", 4},
                                                                              {"Int64", 8},
                                                                              {"UInt64", 8}}};

std::size_t size_of_type(std::string_view type) {
  const auto found =
      std::ranges::find(kVtkTypes, type, [](const auto& known) { return known.first; });
  return found == kVtkTypes.end() ? 0 : found->second;
}

void reverse_if_other(char* bytes, std::size_t size, std::endian order) {
  if (order != std::endian::native) std::reverse(bytes, bytes + size);
}

template <class Number>
double number_at(const char* bytes, std::endian order) {
  char copy[sizeof(Number)];
  std::memcpy(copy, bytes, sizeof copy);
  reverse_if_other(copy, sizeof copy, order);
  Number number;
  std::memcpy(&number, copy, sizeof number);
  return static_cast<double>(number);
}

using NumberAt = double (*)(const char* bytes, std::endian order);

NumberAt reader_of(std::string_view type) {
  if (type == "Float64") return number_at<double>;
  if (type == "Float32") return number_at<float>;
  if (type == "Int8") return number_at<std::int8_t>;
  if (type == "UInt8") return number_at<std::uint8_t>;
  if (type == "Int16") return number_at<std::int16_t>;
  if (type == "UInt16") return number_at<std::uint16_t>;
  if (type == "Int32") return number_at<std::int32_t>;
  if (type == "UInt32") return number_at<std::uint32_t>;
  if (type == "Int64") return number_at<std::int64_t>;
  return number_at<std::uint64_t>;
}

}  // namespace

// ------------------------------------------------------------------ tags ------------------------

// The tags of the file, one by one, with the text that follows them.
class VtuFile::Xml {
 public:
  Xml(std::string_view bytes, const VtuFile& file) : rest_(bytes), file_(file) {}

  // To the next tag that is no comment or declaration; false at the end.
  bool next() {
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

  const std::string& tag() const { return tag_; }
  bool is_end() const { return is_end_; }
  bool is_whole() const { return is_whole_; }  // it has no end tag
  // Up to the next tag.
  std::string_view text() const { return rest_.substr(0, rest_.find('<')); }
  std::string_view rest() const { return rest_; }

  std::string attribute(const std::string& name, const std::string& otherwise = "") const {
    const auto found = attributes_.find(name);
    return found == attributes_.end() ? otherwise : found->second;
  }
  std::int64_t count(const std::string& name, std::int64_t otherwise) const {
    const std::string text = attribute(name);
    if (text.empty() && otherwise >= 0) return otherwise;
    std::int64_t value = -1;
    if (!parse_field(text, value) || value < 0)
      file_.fail("found " + name + "=" + shown_field(text) + " of " + tag_ +
                 ", expected a number of 0 or more");
    return value;
  }

 private:
  void skip_past(std::string_view end) {
    const std::size_t at = rest_.find(end);
    if (at == std::string_view::npos)
      file_.fail("the file ends, expected '" + std::string(end) + "'");
    rest_.remove_prefix(at + end.size());
  }

  std::string_view name_here(std::string_view ends) {
    const std::size_t end = std::min(rest_.find_first_of(ends), rest_.size());
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return name;
  }

  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kXmlBlanks), rest_.size()));
  }

  void read_tag() {
    attributes_.clear();
    is_whole_ = false;
    is_end_ = rest_.starts_with('/');
    if (is_end_) rest_.remove_prefix(1);
    tag_ = name_here(" \t\r\n/>");
    while (true) {
      skip_blanks();
      if (rest_.empty()) file_.fail("the file ends within the tag " + shown_field(tag_));
      if (rest_.front() == '>') return rest_.remove_prefix(1);
      if (rest_.front() == '/') {
        is_whole_ = true;
        rest_.remove_prefix(1);
        continue;
      }
      read_attribute();
    }
  }

  void read_attribute() {
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

  [[noreturn]] void fail_attribute(const std::string& name) const {
    file_.fail("found " + shown_field(name) + " in the tag " + shown_field(tag_) +
               ", expected name=\"value\"");
  }

  std::string_view rest_;
  const VtuFile& file_;
  std::string tag_;
  bool is_end_ = false, is_whole_ = false;
  std::map<std::string, std::string> attributes_;
};

VtuFile::VtuFile(std::string_view bytes, std::string name) : name_(std::move(name)) {
  Xml xml(bytes, *this);
  if (!xml.next() || xml.tag() != "VTKFile")
    fail("expected a VTK XML file, which begins with <VTKFile>");
  take_header(xml);
  std::string section;
  VtuArray* open = nullptr;
  int below = 0;  // tags that are open within an array: what is said of it, with texts of their own
  while (xml.next()) {
    const std::string& tag = xml.tag();
    if (open && tag != "DataArray") {
      if (!xml.is_whole()) below += xml.is_end() ? -1 : 1;
    } else if (xml.is_end()) {
      open = nullptr;
      if (tag == section) section.clear();
      if (tag == "VTKFile") break;
    } else if (tag == "Piece") {
      pieces_.push_back({xml.count("NumberOfPoints", -1), xml.count("NumberOfCells", -1), {}});
    } else if (tag == "DataArray" && !section.empty() && !pieces_.empty()) {
      pieces_.back().arrays.push_back(array_of(xml, section));
      open = xml.is_whole() ? nullptr : &pieces_.back().arrays.back();
      below = 0;
    } else if (tag == "AppendedData") {
      take_appended(xml);
      break;
    } else if ((tag == "Points" || tag == "Cells" || tag == "PointData") && !xml.is_whole()) {
      section = tag;
    }
    if (open && below == 0 && open->content.empty()) open->content = stripped(xml.text());
  }
  if (pieces_.empty()) fail("found no <Piece>");
}

VtuArray VtuFile::array_of(const Xml& xml, const std::string& section) {
  VtuArray array;
  array.section = section;
  array.name = xml.attribute("Name");
  array.type = xml.attribute("type");
  array.components = xml.count("NumberOfComponents", 1);
  array.format = xml.attribute("format", "ascii");
  array.offset = static_cast<std::uint64_t>(xml.count("offset", 0));
  return array;
}

void VtuFile::take_appended(const Xml& xml) {
  appended_raw_ = xml.attribute("encoding", "base64") == "raw";
  appended_ = xml.rest();
  const std::size_t begin = appended_.find('_');
  if (begin == std::string_view::npos) fail("the appended data does not begin with '_'");
  appended_.remove_prefix(begin + 1);
}

void VtuFile::take_header(const Xml& xml) {
  if (const std::string type = xml.attribute("type"); type != "UnstructuredGrid")
    fail("found a VTK file of type " + shown_field(type) + ", expected UnstructuredGrid");
  const std::string order = xml.attribute("byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    fail("found byte_order " + shown_field(order) + ", expected LittleEndian or BigEndian");
  if (order == "BigEndian") order_ = std::endian::big;
  const std::string words = xml.attribute("header_type", "UInt32");
  if (words != "UInt32" && words != "UInt64")
    fail("found header_type " + shown_field(words) + ", expected UInt32 or UInt64");
  if (words == "UInt64") word_size_ = 8;
  const std::string compressor = xml.attribute("compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    fail("packed by " + shown_field(compressor) +
         ", expected vtkZLibDataCompressor or none: write it with another compressor (in "
         "ParaView's Save Data: Compressor Type)");
  packed_ = !compressor.empty();
}

const VtuArray* VtuFile::find(const VtuPiece& piece, std::string_view section,
                              std::string_view name) const {
  for (const VtuArray& array : piece.arrays)
    if (array.section == section && (section == "Points" || array.name == name)) return &array;
  return nullptr;
}

// ------------------------------------------------------------------ bytes -----------------------

// Bytes in a row, raw or as base64. Of the latter parts may be padded each for itself.
class VtuFile::ByteSource {
 public:
  ByteSource(std::string_view bytes, bool is_raw) : rest_(bytes), is_raw_(is_raw) {}

  // False if there are not so many.
  bool take(std::size_t count, std::string& bytes) {
    if (count > room()) return false;
    bytes.clear();
    bytes.reserve(count);
    if (is_raw_) {
      bytes = rest_.substr(0, count);
      rest_.remove_prefix(count);
      return true;
    }
    while (bytes.size() < count) {
      if (held_.empty() && !decode()) return false;
      const std::size_t part = std::min(count - bytes.size(), held_.size());
      bytes += held_.substr(0, part);
      held_.erase(0, part);
    }
    return true;
  }

  std::size_t room() const { return is_raw_ ? rest_.size() : held_.size() + rest_.size(); }

 private:
  static int value_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
  }

  // Four letters are up to three bytes.
  bool decode() {
    std::uint32_t bits = 0;
    int letters = 0, padding = 0;
    while (letters < 4) {
      if (rest_.empty()) return false;
      const char c = rest_.front();
      rest_.remove_prefix(1);
      if (kXmlBlanks.find(c) != std::string_view::npos) continue;
      const int value = value_of(c);
      if (c == '=')
        ++padding;
      else if (value < 0 || padding > 0)
        return false;
      bits = bits << 6 | static_cast<std::uint32_t>(std::max(value, 0));
      ++letters;
    }
    for (int k = 0; k < 3 - padding; ++k) held_ += static_cast<char>(bits >> (16 - 8 * k));
    return padding < 3;
  }

  std::string_view rest_;
  bool is_raw_;
  std::string held_;
};

std::string VtuFile::called(const VtuArray& array) const {
  return "array '" + array.name + "' of " + array.section;
}

std::uint64_t VtuFile::word(ByteSource& source, const VtuArray& array) const {
  std::string bytes;
  if (!source.take(word_size_, bytes)) fail(called(array) + " ends before its numbers begin");
  const auto number = word_size_ == 8 ? number_at<std::uint64_t> : number_at<std::uint32_t>;
  const double value = number(bytes.data(), order_);
  constexpr double kMax = 9007199254740992;  // 2^53
  if (value > kMax) fail(called(array) + " says that it has " + number_text(value) + " bytes");
  return static_cast<std::uint64_t>(value);
}

std::string VtuFile::read_plain(const VtuArray& array, ByteSource& source,
                                std::size_t bytes) const {
  const std::uint64_t told = word(source, array);
  if (told != bytes)
    fail(called(array) + " has " + std::to_string(told) + " bytes, expected " +
         std::to_string(bytes));
  std::string result;
  if (!source.take(bytes, result))
    fail(called(array) + " ends before its " + std::to_string(bytes) + " bytes do");
  return result;
}

std::string VtuFile::read_packed(const VtuArray& array, ByteSource& source,
                                 std::size_t bytes) const {
  const std::uint64_t blocks = word(source, array);
  const std::uint64_t size = word(source, array), last = word(source, array);
  if (blocks > source.room() / word_size_) fail(called(array) + " has more blocks than bytes");
  if (!may_inflate_to(source.room(), bytes))
    fail(called(array) + " ends before its " + std::to_string(bytes) + " bytes do");
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& block : packed) block = word(source, array);
  std::string result, block;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t unpacked = b + 1 == blocks && last != 0 ? last : size;
    if (unpacked > bytes - result.size())
      fail(called(array) + " unpacks to more than " + std::to_string(bytes) + " bytes");
    if (!source.take(packed[b], block)) fail(called(array) + " ends before its blocks do");
    const auto part = inflated(block, unpacked);
    if (!part)
      fail(called(array) + ": what zlib packed is damaged, in block " + std::to_string(b + 1) +
           " of " + std::to_string(blocks));
    result += *part;
  }
  if (result.size() != bytes)
    fail(called(array) + " unpacks to " + std::to_string(result.size()) + " bytes, expected " +
         std::to_string(bytes));
  return result;
}

std::string VtuFile::read_bytes(const VtuArray& array, std::size_t bytes) const {
  const bool is_appended = array.format == "appended";
  if (!is_appended && array.format != "binary")
    fail(called(array) + " is in format " + shown_field(array.format) +
         ", expected ascii, binary or appended");
  if (is_appended && array.offset > appended_.size())
    fail(called(array) + " has the offset " + std::to_string(array.offset) +
         ", behind the end of the file");
  ByteSource source(is_appended ? appended_.substr(array.offset) : array.content,
                    is_appended && appended_raw_);
  if (bytes == 0) return {};
  return packed_ ? read_packed(array, source, bytes) : read_plain(array, source, bytes);
}

std::vector<double> VtuFile::read_text(const VtuArray& array, std::size_t count) const {
  std::string_view rest = array.content;
  if (count > (rest.size() + 1) / 2)
    fail(called(array) + " ends before its " + std::to_string(count) + " numbers do");
  std::vector<double> values;
  values.reserve(count);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(kXmlBlanks), rest.size());
    double value = 0;
    if (!parse_field(rest.substr(0, end), value))
      fail(called(array) + ": found " + shown_field(rest.substr(0, end)) + ", expected a number");
    values.push_back(value);
    rest.remove_prefix(end);
    rest.remove_prefix(std::min(rest.find_first_not_of(kXmlBlanks), rest.size()));
  }
  if (values.size() != count)
    fail(called(array) + " has " + std::to_string(values.size()) + " numbers, expected " +
         std::to_string(count));
  return values;
}

std::vector<double> VtuFile::read(const VtuArray& array, std::int64_t tuples) const {
  const std::size_t size = size_of_type(array.type);
  if (size == 0)
    fail(called(array) + " is of type " + shown_field(array.type) + ", expected numbers");
  constexpr std::int64_t kMany = std::int64_t{1} << 50;
  if (array.components < 1 || array.components > 1024 || tuples > kMany / 1024)
    fail(called(array) + " would have " + std::to_string(tuples) + " times " +
         std::to_string(array.components) + " numbers");
  const auto count = static_cast<std::size_t>(tuples * array.components);
  if (array.format == "ascii") return read_text(array, count);
  const std::string bytes = read_bytes(array, count * size);
  std::vector<double> values(count);
  const NumberAt number = reader_of(array.type);
  for (std::size_t i = 0; i < count; ++i) values[i] = number(bytes.data() + i * size, order_);
  return values;
}

}  // namespace pnpbs

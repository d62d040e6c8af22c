// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/files/vtu_arrays.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/number_bytes.hpp"
#include "formats/text_fields.hpp"
#include "spacing/files/inflate.hpp"
#include "spacing/files/xml_tags.hpp"

namespace pnpbs {

// A stream of bytes, stored raw or as base64 (RFC 4648) with blanks anywhere. Base64 data may
// consist of parts with their own padding.
class ByteSource {
 public:
  // `bytes` must outlive this object.
  ByteSource(std::string_view bytes, bool is_raw) : rest_(bytes), is_raw_(is_raw) {}

  // Removes the next `count` bytes from the stream. Returns false if there are fewer.
  bool take(std::size_t count, std::string& bytes);
  // Returns an upper bound of the number of bytes left.
  std::size_t room() const { return is_raw_ ? rest_.size() : held_.size() + rest_.size(); }

 private:
  bool decode();

  std::string_view rest_;
  bool is_raw_;
  std::string held_;  // decoded bytes not removed yet
};

namespace {

// Returns the value of a base64 letter, or -1.
int value_in_base64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

template <class Number>
double number_at(const char* bytes, std::endian order) {
  return static_cast<double>(number_from_bytes<Number>(bytes, order));
}

struct VtkType {
  std::string_view name;
  std::size_t size;
  double (*number_at)(const char* bytes, std::endian order);
};

template <class Number>
constexpr VtkType vtk_type(std::string_view name) {
  return {name, sizeof(Number), number_at<Number>};
}

constexpr std::array kVtkTypes{vtk_type<double>("Float64"),     vtk_type<float>("Float32"),
                               vtk_type<std::int8_t>("Int8"),   vtk_type<std::uint8_t>("UInt8"),
                               vtk_type<std::int16_t>("Int16"), vtk_type<std::uint16_t>("UInt16"),
                               vtk_type<std::int32_t>("Int32"), vtk_type<std::uint32_t>("UInt32"),
                               vtk_type<std::int64_t>("Int64"), vtk_type<std::uint64_t>("UInt64")};

}  // namespace

bool ByteSource::take(std::size_t count, std::string& bytes) {
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

// Decodes the next four letters, which are up to three bytes. Returns false if there are not four
// valid ones.
bool ByteSource::decode() {
  std::uint32_t bits = 0;
  int letters = 0, padding = 0;
  while (letters < 4) {
    if (rest_.empty()) return false;
    const char c = rest_.front();
    rest_.remove_prefix(1);
    if (kXmlBlanks.find(c) != std::string_view::npos) continue;
    const int value = value_in_base64(c);
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

VtuFile::VtuFile(std::string_view bytes, std::string name) : name_(std::move(name)) {
  XmlTags xml(bytes, name_);
  if (!xml.next() || xml.tag() != "VTKFile")
    fail("expected a VTK XML file, which begins with <VTKFile>");
  take_header(xml);
  std::string section;
  VtuArray* open = nullptr;
  bool whole = false;
  int below = 0;  // depth of open tags within an array, which describe it and may contain text
  while (xml.next()) {
    const std::string& tag = xml.tag();
    if (open && tag != "DataArray") {
      if (!xml.is_whole()) below += xml.is_end() ? -1 : 1;
    } else if (xml.is_end()) {
      open = nullptr;
      if (tag == section) section.clear();
      whole = tag == "VTKFile";
      if (whole) break;
    } else if (tag == "Piece") {
      pieces_.push_back({xml.count("NumberOfPoints", -1), xml.count("NumberOfCells", -1), {}});
    } else if (tag == "DataArray" && !section.empty() && !pieces_.empty()) {
      pieces_.back().arrays.push_back(array_of(xml, section));
      open = xml.is_whole() ? nullptr : &pieces_.back().arrays.back();
      below = 0;
    } else if (tag == "AppendedData") {
      take_appended(xml);
      whole = true;  // reading an array detects truncated data
      break;
    } else if ((tag == "Points" || tag == "Cells" || tag == "PointData") && !xml.is_whole()) {
      section = tag;
    }
    if (open && below == 0 && open->content.empty()) open->content = xml.text();
  }
  if (!whole) fail("the file ends too early: its <VTKFile> is not closed");
  if (pieces_.empty()) fail("found no <Piece>");
}

VtuArray VtuFile::array_of(const XmlTags& xml, const std::string& section) {
  VtuArray array;
  array.section = section;
  array.name = xml.attribute("Name");
  array.type = xml.attribute("type");
  array.components = xml.count("NumberOfComponents", 1);
  array.format = xml.attribute("format", "ascii");
  array.offset = static_cast<std::uint64_t>(xml.count("offset", 0));
  return array;
}

void VtuFile::take_appended(const XmlTags& xml) {
  appended_raw_ = xml.attribute("encoding", "base64") == "raw";
  appended_ = xml.rest();
  const std::size_t begin = appended_.find('_');
  if (begin == std::string_view::npos) fail("the appended data does not begin with '_'");
  appended_.remove_prefix(begin + 1);
}

void VtuFile::take_header(const XmlTags& xml) {
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
    fail("found compressor " + shown_field(compressor) +
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

std::string VtuFile::called(const VtuArray& array) const {
  return "array '" + array.name + "' of " + array.section;
}

std::uint64_t VtuFile::word(ByteSource& source, const VtuArray& array) const {
  std::string bytes;
  if (!source.take(word_size_, bytes)) fail(called(array) + " ends in its header");
  const auto number = word_size_ == 8 ? number_at<std::uint64_t> : number_at<std::uint32_t>;
  const double value = number(bytes.data(), order_);
  constexpr double kMax = 9007199254740992;  // 2^53
  if (value > kMax)
    fail(called(array) + " has an impossible size, " + number_text(value) + " bytes");
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
      fail(called(array) + ": the compressed data are damaged in block " + std::to_string(b + 1) +
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
  const auto type = std::ranges::find(kVtkTypes, array.type, &VtkType::name);
  if (type == kVtkTypes.end())
    fail(called(array) + " is of type " + shown_field(array.type) + ", expected numbers");
  constexpr std::int64_t kMany = std::int64_t{1} << 50;
  if (array.components < 1 || array.components > 1024 || tuples > kMany / 1024)
    fail(called(array) + " would have " + std::to_string(tuples) + " times " +
         std::to_string(array.components) + " numbers");
  const auto count = static_cast<std::size_t>(tuples * array.components);
  if (array.format == "ascii") return read_text(array, count);
  const std::string bytes = read_bytes(array, count * type->size);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = type->number_at(bytes.data() + i * type->size, order_);
  return values;
}

}  // namespace pnpbs

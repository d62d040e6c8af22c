// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace pnpbs::io {

namespace {

constexpr std::int32_t kDimensions = 10, kVariables = 11, kAttributes = 12;  // tags of lists
constexpr std::int32_t kChar = 2, kInt = 4, kFloat = 5, kDouble = 6;         // types

std::int32_t type_of(NumberType type) {
  return type == NumberType::int32 ? kInt : type == NumberType::real32 ? kFloat : kDouble;
}

template <class Value>
void turn_over(std::vector<Value>& values) {
  if constexpr (std::endian::native == std::endian::big) return;
  for (Value& value : values) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    std::reverse(std::begin(bytes), std::end(bytes));
    std::memcpy(&value, bytes, sizeof value);
  }
}

// The text of a header.
class Head {
 public:
  // Composes the header. `begin`: offset of the first array. [bytes]
  Head(const NetcdfContents& contents, std::int64_t begin) {
    text_ = std::string("CDF\005", 4);
    number(std::int64_t{0});  // number of records
    list(kDimensions, contents.dimensions, [&](const NetcdfDimension& dimension) {
      name(dimension.name);
      number(dimension.size);
    });
    attributes(contents.attributes);
    list(kVariables, contents.variables, [&](const NetcdfVariable& variable) {
      const std::int64_t bytes = bytes_of(contents, variable);
      declare(variable, bytes, begin);
      begin += bytes;
    });
  }

  const std::string& text() const { return text_; }

 private:
  template <class Value>
  void number(Value value) {
    std::vector<Value> one{value};
    turn_over(one);
    text_.append(reinterpret_cast<const char*>(one.data()), sizeof value);
  }

  void pad() { text_.resize((text_.size() + 3) / 4 * 4, '\0'); }

  void name(const std::string& of) {
    number(static_cast<std::int64_t>(of.size()));
    text_ += of;
    pad();
  }

  template <class Entry, class Write>
  void list(std::int32_t tag, const std::vector<Entry>& entries, const Write& write) {
    number(entries.empty() ? std::int32_t{0} : tag);
    number(static_cast<std::int64_t>(entries.size()));
    for (const Entry& entry : entries) write(entry);
  }

  void attributes(const std::vector<NetcdfAttribute>& all) {
    list(kAttributes, all, [&](const NetcdfAttribute& attribute) {
      name(attribute.name);
      std::visit([&](const auto& value) { this->value(value); }, attribute.value);
    });
  }

  void value(const std::string& text) {
    number(kChar);
    name(text);
  }
  void value(double value) {
    number(kDouble);
    number(std::int64_t{1});
    number(value);
  }
  void value(std::int32_t value) {
    number(kInt);
    number(std::int64_t{1});
    number(value);
  }

  static std::int64_t bytes_of(const NetcdfContents& contents, const NetcdfVariable& variable) {
    auto bytes = static_cast<std::int64_t>(size_of(variable.type));
    for (const std::size_t d : variable.dimensions) bytes *= contents.dimensions[d].size;
    return bytes;
  }

  void declare(const NetcdfVariable& variable, std::int64_t bytes, std::int64_t begin) {
    name(variable.name);
    number(static_cast<std::int64_t>(variable.dimensions.size()));
    for (const std::size_t d : variable.dimensions) number(static_cast<std::int64_t>(d));
    attributes(variable.attributes);
    number(type_of(variable.type));
    number(bytes);
    number(begin);
  }

  std::string text_;
};

}  // namespace

std::string netcdf_head(const NetcdfContents& contents) {
  const auto size = static_cast<std::int64_t>(Head(contents, 0).text().size());
  return Head(contents, size).text();
}

void make_big_endian(std::vector<std::int32_t>& values) { turn_over(values); }
void make_big_endian(std::vector<double>& values) { turn_over(values); }
void make_big_endian(std::vector<float>& values) { turn_over(values); }

}  // namespace pnpbs::io

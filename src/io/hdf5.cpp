// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5.hpp"

#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/build_config.hpp"
#include "base/error.hpp"

#if PNPBS_HAVE_HDF5
#include "io/hdf5_library.hpp"
#endif

namespace pnpbs::io::hdf5 {

void require_signature(const std::string& path, const std::string& name) {
  constexpr std::array<char, 8> kSignature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> begin{};
  struct stat status;
  errno = 0;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file || ::fstat(::fileno(file), &status) != 0) {
    const std::string reason = std::strerror(errno);
    if (file) std::fclose(file);
    throw Error(ErrorKind::file, "cannot read " + name + ": " + reason);
  }
  const bool regular = S_ISREG(status.st_mode);
  const std::size_t got = regular ? std::fread(begin.data(), 1, begin.size(), file) : 0;
  std::fclose(file);
  if (got != begin.size() || begin != kSignature)
    throw Error(ErrorKind::file, name + " is no HDF5 file, as checkpoints are");
}

#if PNPBS_HAVE_HDF5

namespace {

std::string cannot_write(const std::string& name) {
  return "cannot write " + name + ": HDF5 has failed; is the disk full?";
}

// A property list for creating objects without time stamps, so that equal contents give equal
// files.
struct Creation : Owned {
  Creation(const Use& use, hid_t kind, const std::string& failure)
      : Owned(use->H5Pcreate(kind), use->H5Pclose, failure) {
    require(use->H5Pset_obj_track_times(*this, false), failure);
  }
};

void write_attribute(hid_t file, const std::string& name, const std::string& object,
                     const std::string& attribute, hid_t type, std::int64_t count,
                     const void* values) {
  const Use use;
  const std::string failure = cannot_write(name);
  const auto size = static_cast<hsize_t>(count);
  const Owned space(
      count < 0 ? use->H5Screate(H5S_SCALAR) : use->H5Screate_simple(1, &size, nullptr),
      use->H5Sclose, failure);
  const Owned made(use->H5Acreate_by_name(file, object.c_str(), attribute.c_str(), type, space,
                                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   use->H5Aclose, failure);
  require(use->H5Awrite(made, type, values), failure);
}

}  // namespace

void require_hdf5() { const Use use; }

// ------------------------------------------------------------------ writing --------------------

// Uses the file format of HDF5 1.8, which current readers support and whose metadata have
// checksums.
NewFile::NewFile(const std::string& path, const std::string& name) : name_(name) {
  const Use use;
  const std::string failure = cannot_write(name_);
  const Owned access(use->H5Pcreate(use->file_access), use->H5Pclose, failure);
  require(use->H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), failure);
  const Creation creation(use, use->file_creation, failure);
  file_ = use->H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
  if (file_ < 0) throw Error(ErrorKind::file, failure);
}

NewFile::~NewFile() {
  if (file_ < 0) return;
  const Use use;
  use->H5Fclose(file_);
}

void NewFile::close() {
  const Use use;
  const hid_t file = file_;
  file_ = -1;
  require(use->H5Fclose(file), cannot_write(name_));
}

void NewFile::add_group(const std::string& path) {
  const Use use;
  const std::string failure = cannot_write(name_);
  const Creation how(use, use->group_creation, failure);
  const Owned group(use->H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, how, H5P_DEFAULT),
                    use->H5Gclose, failure);
}

namespace {

hid_t native(Type type) {
  const Use use;
  return type_of(use, type);
}

}  // namespace

void NewFile::set(const std::string& object, const std::string& attribute, std::int64_t value) {
  write_attribute(file_, name_, object, attribute, native(Type::int64), -1, &value);
}

void NewFile::set(const std::string& object, const std::string& attribute, double value) {
  write_attribute(file_, name_, object, attribute, native(Type::real), -1, &value);
}

void NewFile::set(const std::string& object, const std::string& attribute,
                  const std::vector<std::int64_t>& values) {
  write_attribute(file_, name_, object, attribute, native(Type::int64),
                  static_cast<std::int64_t>(values.size()), values.data());
}

void NewFile::set(const std::string& object, const std::string& attribute,
                  const std::vector<double>& values) {
  write_attribute(file_, name_, object, attribute, native(Type::real),
                  static_cast<std::int64_t>(values.size()), values.data());
}

void NewFile::set(const std::string& object, const std::string& attribute,
                  const std::string& text) {
  hid_t type;
  {
    const Use use;
    type = use->H5Tcopy(use->text);
    require(use->H5Tset_size(type, text.empty() ? 1 : text.size()), cannot_write(name_));
  }
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  write_attribute(file_, name_, object, attribute, type, -1, padded.data());
  const Use use;
  use->H5Tclose(type);
}

std::int64_t NewFile::add(const Array& array) {
  const Use use;
  const std::string failure = cannot_write(name_);
  const std::array<hsize_t, 2> size{static_cast<hsize_t>(array.rows),
                                    static_cast<hsize_t>(array.columns)};
  const Owned space(use->H5Screate_simple(array.columns > 0 ? 2 : 1, size.data(), nullptr),
                    use->H5Sclose, failure);
  const Creation how(use, use->dataset_creation, failure);
  require(use->H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY), failure);
  require(use->H5Pset_fill_time(how, H5D_FILL_TIME_NEVER), failure);
  const Owned made(use->H5Dcreate2(file_, array.path.c_str(), type_of(use, array.type), space,
                                   H5P_DEFAULT, how, H5P_DEFAULT),
                   use->H5Dclose, failure);
  if (array.rows == 0) return 0;
  const haddr_t place = use->H5Dget_offset(made);
  if (place == HADDR_UNDEF) throw Error(ErrorKind::file, failure);
  return static_cast<std::int64_t>(place);
}

namespace {

template <class Number>
void add_numbers(hid_t file, const std::string& name, const std::string& path, Type given,
                 const std::vector<Number>& values) {
  const Use use;
  const std::string failure = cannot_write(name);
  const hsize_t size = values.size();
  const hid_t type = type_of(use, given);
  const Owned space(use->H5Screate_simple(1, &size, nullptr), use->H5Sclose, failure);
  const Creation how(use, use->dataset_creation, failure);
  const Owned made(use->H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
                   use->H5Dclose, failure);
  require(use->H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), failure);
}

}  // namespace

void NewFile::add(const std::string& path, const std::vector<std::int64_t>& values) {
  add_numbers(file_, name_, path, Type::int64, values);
}
void NewFile::add_reals(const std::string& path, const std::vector<double>& values) {
  add_numbers(file_, name_, path, Type::real, values);
}

// ------------------------------------------------------------------ reading --------------------

namespace {

std::string damaged(const std::string& name, const std::string& what) {
  return name + " is damaged, or no checkpoint of PNPBS: " + what;
}

}  // namespace

ExistingFile::ExistingFile(const std::string& path, const std::string& name) : name_(name) {
  struct stat status;
  if (::stat(path.c_str(), &status) == 0) size_ = status.st_size;
  const Use use;
  file_ = use->H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0)
    throw Error(ErrorKind::file, name_ +
                                     " is damaged: it begins as an HDF5 file, but HDF5 cannot "
                                     "open it");
}

ExistingFile::~ExistingFile() {
  if (file_ < 0) return;
  const Use use;
  use->H5Fclose(file_);
}

bool ExistingFile::has(const std::string& path) const {
  const Use use;
  return use->H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

namespace {

// An existing attribute with a single value.
class Attribute {
 public:
  // Throws unless there is such an attribute. `kind` names the kind of its value in messages.
  Attribute(hid_t file, const std::string& name, const char* kind, const std::string& object,
            const std::string& attribute)
      : failure_(damaged(name, std::string("it has no ") + kind + " \"" + attribute + "\" at \"" +
                                   object + "\"")),
        found_(
            use->H5Aopen_by_name(file, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
            use->H5Aclose, failure_),
        stored_(use->H5Aget_type(found_), use->H5Tclose, failure_) {
    const Owned space(use->H5Aget_space(found_), use->H5Sclose, failure_);
    expect(use->H5Sget_simple_extent_type(space) == H5S_SCALAR);
  }

  hid_t type() const { return stored_; }
  void expect(bool right) const {
    if (!right) throw Error(ErrorKind::file, failure_);
  }
  void read(void* value) const { require(use->H5Aread(found_, stored_, value), failure_); }

  const Use use;

 private:
  std::string failure_;
  Owned found_, stored_;
};

void read_number(hid_t file, const std::string& name, const std::string& object,
                 const std::string& attribute, Type type, void* value) {
  const Attribute number(file, name, "number", object, attribute);
  number.expect(number.use->H5Tequal(number.type(), type_of(number.use, type)) > 0);
  number.read(value);
}

}  // namespace

void ExistingFile::get(const std::string& object, const std::string& attribute,
                       std::int64_t& value) const {
  read_number(file_, name_, object, attribute, Type::int64, &value);
}

void ExistingFile::get(const std::string& object, const std::string& attribute,
                       double& value) const {
  read_number(file_, name_, object, attribute, Type::real, &value);
}

void ExistingFile::get(const std::string& object, const std::string& attribute,
                       std::string& text) const {
  constexpr std::size_t kMax = 60000;  // largest attribute in HDF5. [bytes]
  const Attribute found(file_, name_, "text", object, attribute);
  const std::size_t size = found.use->H5Tget_size(found.type());
  found.expect(found.use->H5Tget_class(found.type()) == H5T_STRING &&
               found.use->H5Tis_variable_str(found.type()) == 0 && size >= 1 && size <= kMax);
  text.assign(size, '\0');
  found.read(text.data());
  if (const std::size_t end = text.find('\0'); end != std::string::npos) text.resize(end);
}

std::int64_t ExistingFile::place_of(const Array& array) const {
  const Use use;
  const std::string failure = damaged(name_, "it has no array \"" + array.path + "\"");
  const std::string other =
      damaged(name_, "its array \"" + array.path +
                         "\" has another type or size, or was rewritten by another program");
  const Owned found(use->H5Dopen2(file_, array.path.c_str(), H5P_DEFAULT), use->H5Dclose, failure);
  const Owned stored(use->H5Dget_type(found), use->H5Tclose, failure);
  const Owned space(use->H5Dget_space(found), use->H5Sclose, failure);
  const Owned how(use->H5Dget_create_plist(found), use->H5Pclose, failure);
  std::array<hsize_t, 2> size{};
  const int dimensions = array.columns > 0 ? 2 : 1;
  if (use->H5Tequal(stored, type_of(use, array.type)) <= 0 ||
      use->H5Sget_simple_extent_ndims(space) != dimensions ||
      use->H5Sget_simple_extent_dims(space, size.data(), nullptr) != dimensions ||
      size[0] != static_cast<hsize_t>(array.rows) ||
      size[1] != static_cast<hsize_t>(array.columns) || use->H5Pget_layout(how) != H5D_CONTIGUOUS ||
      use->H5Pget_external_count(how) != 0)
    throw Error(ErrorKind::file, other);
  const haddr_t place = use->H5Dget_offset(found);
  const hsize_t bytes = use->H5Dget_storage_size(found);
  const auto end = static_cast<hsize_t>(size_);
  if (place == HADDR_UNDEF || place > end || bytes > end - place ||
      bytes != static_cast<hsize_t>(array.rows * array.row_size()))
    throw Error(ErrorKind::file, other);
  return static_cast<std::int64_t>(place);
}

std::int64_t ExistingFile::rows_of(const std::string& path) const {
  const Use use;
  const std::string failure = damaged(name_, "it has no array \"" + path + "\"");
  const Owned found(use->H5Dopen2(file_, path.c_str(), H5P_DEFAULT), use->H5Dclose, failure);
  const Owned space(use->H5Dget_space(found), use->H5Sclose, failure);
  hsize_t size = 0;
  if (use->H5Sget_simple_extent_ndims(space) != 1 ||
      use->H5Sget_simple_extent_dims(space, &size, nullptr) != 1 ||
      size > static_cast<hsize_t>(size_))
    throw Error(ErrorKind::file, failure);
  return static_cast<std::int64_t>(size);
}

#else

namespace {

[[noreturn]] void fail() {
  throw Error(ErrorKind::unsupported,
              "this library was built without HDF5, which writes and reads checkpoints and writes "
              ".vtkhdf, .xdmf and .hdf5 files: build it with -DPNPBS_WITH_HDF5=ON");
}

}  // namespace

void require_hdf5() { fail(); }
NewFile::NewFile(const std::string&, const std::string&) { fail(); }
NewFile::~NewFile() = default;
void NewFile::add_group(const std::string&) { fail(); }
void NewFile::set(const std::string&, const std::string&, std::int64_t) { fail(); }
void NewFile::set(const std::string&, const std::string&, double) { fail(); }
void NewFile::set(const std::string&, const std::string&, const std::string&) { fail(); }
void NewFile::set(const std::string&, const std::string&, const std::vector<std::int64_t>&) {
  fail();
}
void NewFile::set(const std::string&, const std::string&, const std::vector<double>&) { fail(); }
std::int64_t NewFile::add(const Array&) { fail(); }
void NewFile::add(const std::string&, const std::vector<std::int64_t>&) { fail(); }
void NewFile::add_reals(const std::string&, const std::vector<double>&) { fail(); }
void NewFile::close() { fail(); }
ExistingFile::ExistingFile(const std::string&, const std::string&) { fail(); }
ExistingFile::~ExistingFile() = default;
bool ExistingFile::has(const std::string&) const { fail(); }
void ExistingFile::get(const std::string&, const std::string&, std::int64_t&) const { fail(); }
void ExistingFile::get(const std::string&, const std::string&, double&) const { fail(); }
void ExistingFile::get(const std::string&, const std::string&, std::string&) const { fail(); }
std::int64_t ExistingFile::place_of(const Array&) const { fail(); }
std::int64_t ExistingFile::rows_of(const std::string&) const { fail(); }

#endif

}  // namespace pnpbs::io::hdf5

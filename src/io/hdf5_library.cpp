// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_config.hpp"

#if PNPBS_HAVE_HDF5

#include <dlfcn.h>

#include "base/opened_library.hpp"
#include "io/hdf5_library.hpp"

namespace pnpbs::io::hdf5 {

namespace {

void* open_hdf5() {
  if (void* library = open_library({PNPBS_HDF5_PATH, PNPBS_HDF5_NAME})) return library;
  const char* reason = dlerror();
  throw Error(
      ErrorKind::unsupported,
      std::string(
          "HDF5, which writes and reads checkpoints and writes .vtkhdf, .xdmf and .hdf5 files, "
          "cannot be opened: neither "
          "\"" PNPBS_HDF5_PATH "\" nor \"" PNPBS_HDF5_NAME "\" (") +
          (reason ? reason : "no reason given") +
          "): install it, or add its folder to LD_LIBRARY_PATH");
}

void* symbol(void* library, const char* name) {
  void* found = dlsym(library, name);
  if (!found)
    throw Error(ErrorKind::unsupported, std::string("the HDF5 that was opened has no ") + name +
                                            ": PNPBS was built with \"" PNPBS_HDF5_PATH "\"");
  return found;
}

Library opened_library() {
  void* library = open_hdf5();
  Library h{};
#define PNPBS_HDF5_LOOK_UP(name) \
  h.name = reinterpret_cast<decltype(h.name)>(symbol(library, #name));
  PNPBS_HDF5_FUNCTIONS(PNPBS_HDF5_LOOK_UP)
#undef PNPBS_HDF5_LOOK_UP
  unsigned major = 0, minor = 0, release = 0;
  if (h.H5get_libversion(&major, &minor, &release) < 0 || major != H5_VERS_MAJOR ||
      minor != H5_VERS_MINOR || h.H5open() < 0)
    throw Error(ErrorKind::unsupported, "the HDF5 that was opened is version " +
                                            std::to_string(major) + "." + std::to_string(minor) +
                                            ", not the " PNPBS_HDF5_TEXT
                                            " that PNPBS was built "
                                            "with: install that one");
  // Global variables with the identifiers of HDF5's types and property lists. H5open() has set
  // them.
  const auto identifier = [&](const char* name) {
    return *static_cast<const hid_t*>(symbol(library, name));
  };
  h.types = {identifier("H5T_NATIVE_DOUBLE_g"), identifier("H5T_NATIVE_FLOAT_g"),
             identifier("H5T_NATIVE_INT64_g"),  identifier("H5T_NATIVE_INT32_g"),
             identifier("H5T_NATIVE_INT8_g"),   identifier("H5T_NATIVE_UINT8_g")};
  h.text = identifier("H5T_C_S1_g");
  h.file_access = identifier("H5P_CLS_FILE_ACCESS_ID_g");
  h.file_creation = identifier("H5P_CLS_FILE_CREATE_ID_g");
  h.group_creation = identifier("H5P_CLS_GROUP_CREATE_ID_g");
  h.dataset_creation = identifier("H5P_CLS_DATASET_CREATE_ID_g");
  return h;
}

}  // namespace

std::mutex& Use::mutex() {
  static std::mutex the;
  return the;
}

const Library& Use::library() {
  static const Library the = opened_library();
  return the;
}

}  // namespace pnpbs::io::hdf5

#endif

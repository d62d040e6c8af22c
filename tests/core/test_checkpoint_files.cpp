// SPDX-License-Identifier: BSD-3-Clause
// Well-formed HDF5 files that are not checkpoints of this version.
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "geometry/run_suite.hpp"
#include "io/checkpoint.hpp"
#include "io/checkpoint_layout.hpp"
#include "io/file_seal.hpp"
#include "placement/placement_impl.hpp"

using namespace pnpbs;

namespace {

const char* const file_name = "test_checkpoint_files.vtkhdf";

void make_file(const std::function<void(io::hdf5::NewFile&)>& fill, bool sealed = true) {
  if (std::FILE* file = std::fopen(file_name, "w")) std::fclose(file);
  io::hdf5::NewFile file(file_name, file_name);
  fill(file);
  file.close();
  if (sealed) io::add_seal(file_name, file_name, {});
}

void expect_refusal(const std::string& words) {
  PlacementImpl<2> placement(serial_communicator(), std::make_shared<PlaneDomain>(), Options());
  try {
    io::read_checkpoint(placement, file_name);
    ck_abort_msg("it was read");
  } catch (const Error& error) {
    ck_assert_msg(error.kind() == ErrorKind::file, "%s", error.what());
    ck_assert_msg(std::string(error.what()).find(words) != std::string::npos, "%s", error.what());
    ck_assert_msg(std::string(error.what()).find(file_name) != std::string::npos, "%s",
                  error.what());
  }
  std::remove(file_name);
}

// Writes the state of four nodes without any array.
void add_state(io::hdf5::NewFile& file, std::int64_t nodes = 4,
               std::int64_t format = io::kCheckpointFormat) {
  SavedState state;
  state.dimension = 2;
  state.nodes = nodes;
  file.add_group(io::kOwn);
  file.set(io::kOwn, "format", format);
  for_fields(state, [&](const char* field, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::uint64_t>)
      file.set(io::kOwn, field, static_cast<std::int64_t>(value));
    else
      file.set(io::kOwn, field, value);
  });
  file.add_group(io::kVtk);
}

START_TEST(other_hdf5_files) {
  make_file([](io::hdf5::NewFile& file) { file.add_group("/mine"); }, false);
  expect_refusal("no checkpoint of PNPBS");
  make_file([](io::hdf5::NewFile& file) { file.add_group("/mine"); });
  expect_refusal("not of PNPBS");
}
END_TEST

START_TEST(other_formats) {
  make_file([](io::hdf5::NewFile& file) { add_state(file, 4, 5); });
  expect_refusal("format 5, and this PNPBS reads format 4: a newer one reads it");
  make_file([](io::hdf5::NewFile& file) { file.add_group(io::kOwn); });
  expect_refusal("\"format\"");
  make_file([](io::hdf5::NewFile& file) {
    file.add_group(io::kOwn);
    file.set(io::kOwn, "format", 1.0);
  });
  expect_refusal("\"format\"");
}
END_TEST

START_TEST(arrays_that_are_missing_or_others) {
  make_file([](io::hdf5::NewFile& file) { add_state(file, 0); });
  expect_refusal("no nodes");
  make_file([](io::hdf5::NewFile& file) { add_state(file); });
  expect_refusal("no array \"/VTKHDF/Points\"");
  for (const io::hdf5::Array& points :
       {io::hdf5::Array{"/VTKHDF/Points", io::hdf5::Type::real, 5, 3},
        io::hdf5::Array{"/VTKHDF/Points", io::hdf5::Type::real, 4, 2},
        io::hdf5::Array{"/VTKHDF/Points", io::hdf5::Type::real, 12},
        io::hdf5::Array{"/VTKHDF/Points", io::hdf5::Type::int64, 4, 3}}) {
    make_file([&](io::hdf5::NewFile& file) {
      add_state(file);
      file.add(points);
    });
    expect_refusal("another type or size");
  }
}
END_TEST

}  // namespace

TEST_SUITE(test_checkpoint_files) {
  return run_suite("checkpoint_files",
                   {other_hdf5_files, other_formats, arrays_that_are_missing_or_others});
}

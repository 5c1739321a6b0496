// Checksums of datasets: recorded where they are written, compared where they are read.
#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <span>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis::hdf5 {
namespace {

// HDF5's constants are macros with C-style casts.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
constexpr hid_t plain = H5P_DEFAULT;
constexpr hid_t all_values = H5S_ALL;
#pragma GCC diagnostic pop

constexpr std::uint64_t rows_at_once = 65536;

std::optional<std::uint64_t> recorded_checksum(Id dataset, const char* checksum_name) {
  if (H5Aexists(dataset, checksum_name) <= 0) return {};
  const Handle attribute(H5Aopen(dataset, checksum_name, plain));
  std::uint64_t value = 0;
  H5Aread(attribute.get(), H5T_NATIVE_UINT64, &value);
  return value;
}

[[noreturn]] void throw_damage(const std::filesystem::path& file, const std::string& dataset) {
  throw OutputError(
      file, "read " + dataset,
      "its bytes are not those that were written: the checksum differs. The values of "
      "this dataset are lost; a copy of the file may have them");
}

FileDescriptor open_to_read(const std::filesystem::path& file) {
  FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened) throw OutputError(file, "open the file", std::strerror(errno));
  return opened;
}

}  // namespace

void File::write_series(const std::string& dataset, const std::string& old, std::uint64_t kept,
                        std::span<const double> values, Stored stored) {
  const hsize_t rows = kept + values.size();
  const Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.get(), 1);
  const Handle space(H5Screate_simple(1, &rows, nullptr));
  const Id type = stored == Stored::whole ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE;
  const Handle made(checked(
      H5Dcreate2(handle_.get(), dataset.c_str(), type, space.get(), links.get(), plain, plain),
      "make", dataset));
  Xxh3 checksum;
  const auto add = [&](std::span<const double> some) {
    if (stored == Stored::real) return checksum.add(std::as_bytes(some));
    const std::vector<std::int32_t> integers(some.begin(), some.end());
    checksum.add(std::as_bytes(std::span(integers)));
  };
  for (std::uint64_t at = 0; at < kept; at += rows_at_once) {
    const std::uint64_t count = std::min(rows_at_once, kept - at);
    std::vector<double> rows_there(count);
    read_rows(old, H5T_NATIVE_DOUBLE, at, count, rows_there.data());
    add(rows_there);
    write_rows(made.get(), dataset, at, rows_there);
  }
  if (kept > 0) {
    const Handle source(checked(H5Dopen2(handle_.get(), old.c_str(), plain), "open", old));
    if (kept == size_of(old))
      require_as_written(source.get(), old, checksum.value());
    else
      require_as_written(source.get(), old);
  }
  write_rows(made.get(), dataset, kept, values);
  add(values);
  if (rows > 0) set_attribute(dataset, checksum_attribute, checksum.value());
}

// Of those without a checksum nothing is known.
void File::require_as_written(Id dataset, const std::string& name, std::uint64_t checksum) const {
  if (const auto written = recorded_checksum(dataset, checksum_attribute);
      written && *written != checksum)
    throw_damage(path_, name);
}

void File::require_as_written(Id dataset, const std::string& name) const {
  if (!is_as_written(dataset)) throw_damage(path_, name);
}

bool File::is_as_written(Id dataset) const {
  const std::optional<std::uint64_t> written = recorded_checksum(dataset, checksum_attribute);
  if (!written) return true;
  const Handle type(H5Dget_type(dataset)), space(H5Dget_space(dataset));
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get()));
  std::vector<std::byte> bytes(count * H5Tget_size(type.get()));
  return H5Dread(dataset, type.get(), all_values, all_values, plain, bytes.data()) >= 0 &&
         xxh3(bytes) == *written;
}

std::vector<std::string> File::damaged_datasets() const {
  std::vector<std::string> damaged;
  for (const std::string& name : datasets_below("/")) {
    const std::string dataset = "/" + name;
    const Handle found(H5Dopen2(handle_.get(), dataset.c_str(), plain));
    if (found.get() < 0 || !is_as_written(found.get())) damaged.push_back(dataset);
  }
  return damaged;
}

void File::record_checksum(const std::string& dataset, std::uint64_t begin) {
  const Handle found(checked(H5Dopen2(handle_.get(), dataset.c_str(), plain), "open", dataset));
  const FileDescriptor file(open_to_read(path_));
  std::vector<std::byte> piece(std::size_t{1} << 20);
  Xxh3 checksum;
  std::uint64_t left = H5Dget_storage_size(found.get());
  while (left > 0) {
    const ssize_t got = pread(file.get(), piece.data(), std::min<std::uint64_t>(piece.size(), left),
                              static_cast<off_t>(begin));
    if (got <= 0) throw OutputError(path_, "read " + dataset, std::strerror(errno));
    checksum.add(std::span(piece).first(static_cast<std::size_t>(got)));
    begin += static_cast<std::uint64_t>(got);
    left -= static_cast<std::uint64_t>(got);
  }
  set_attribute(dataset, checksum_attribute, checksum.value());
}

}  // namespace pulvis::hdf5

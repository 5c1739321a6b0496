#include "engine/files/hdf5_journal.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <system_error>

#include "engine/files/journaled_file.hpp"

namespace pulvis::hdf5 {
namespace {

struct Driven : H5FD_t {
  JournaledFile file;
  haddr_t end_of_addresses = 0;
  bool is_broken = false;
  explicit Driven(JournaledFile opened) : H5FD_t{}, file(std::move(opened)) {}
};

Driven& driven(H5FD_t* file) { return *static_cast<Driven*>(file); }
const Driven& driven(const H5FD_t* file) { return *static_cast<const Driven*>(file); }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
// In the format that HDF5's own driver uses for system errors.
herr_t failure_told(const std::system_error& error) {
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_VFL, H5E_WRITEERROR,
           "journaled file: %s: error message = '%s'", error.what(),
           std::strerror(error.code().value()));
  return -1;
}
constexpr haddr_t max_addresses = (haddr_t{1} << 62U) - 1;
#ifdef H5FD_CLASS_VERSION
// Below it are those of HDF5's own drivers.
constexpr H5FD_class_value_t first_value_of_others = H5_VFD_RESERVED;
#endif
#pragma GCC diagnostic pop

template <class Action>
herr_t attempt(const Action& action) {
  try {
    action();
    return 0;
  } catch (const std::system_error& error) {
    return failure_told(error);
  } catch (const std::bad_alloc&) {
    return failure_told(std::system_error(ENOMEM, std::generic_category(), "memory"));
  }
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
  Driven* opened = nullptr;
  attempt([&] {
    const bool empty = (flags & H5F_ACC_TRUNC) != 0;
    opened = new Driven(
        JournaledFile(name, empty ? JournaledFile::Open::empty : JournaledFile::Open::existing));
  });
  return opened;
}

// Data that HDF5 could not write completely is never committed.
template <class Action>
herr_t attempt_change(H5FD_t* file, const Action& action) {
  const herr_t result = attempt(action);
  if (result < 0) driven(file).is_broken = true;
  return result;
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<Driven> owned(&driven(file));
  return attempt([&] {
    if (!owned->is_broken) owned->file.commit();
    owned->file.close();
  });
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  struct stat left {
  }, right{};
  fstat(driven(a).file.descriptor(), &left);
  fstat(driven(b).file.descriptor(), &right);
  const auto key = [](const struct stat& s) { return std::pair(s.st_dev, s.st_ino); };
  return key(left) < key(right) ? -1 : key(right) < key(left) ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return driven(file).end_of_addresses; }
herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  driven(file).end_of_addresses = end;
  return 0;
}
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return driven(file).file.size(); }

herr_t handle(H5FD_t* file, hid_t, void** handle) {
  *handle = driven(file).file.descriptor_address();
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* buffer) {
  return attempt([&] { driven(file).file.read(at, {static_cast<std::byte*>(buffer), size}); });
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size,
                   const void* buffer) {
  return attempt_change(file, [&] {
    driven(file).file.write(at, {static_cast<const std::byte*>(buffer), size});
  });
}

herr_t flush(H5FD_t* file, hid_t, hbool_t) {
  // No partial frame either, if the file is closed after a full disk.
  return attempt_change(file, [&] {
    if (driven(file).is_broken) throw std::system_error(EIO, std::generic_category(), "commit");
    driven(file).file.commit();
  });
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  driven(file).file.resize(driven(file).end_of_addresses);
  return 0;
}

H5FD_class_t description() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // from HDF5 1.14
  driver.version = H5FD_CLASS_VERSION;
  driver.value = first_value_of_others;
#endif
  driver.name = "pulvis_journal";
  driver.maxaddr = max_addresses;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = end_of_file;
  driver.get_handle = handle;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.flush = flush;
  driver.truncate = truncate;
  const H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
  return driver;
}

}  // namespace

hid_t journal_driver() {
  static const H5FD_class_t driver = description();
  static const hid_t id = H5FDregister(&driver);
  return id;
}

}  // namespace pulvis::hdf5

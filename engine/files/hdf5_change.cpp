// Atomic changes: how File deals with HDF5's metadata cache, with the first page of the file, and with other processes that
// write into it.
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "engine/files/hdf5.hpp"
#include "engine/files/hdf5_api.hpp"
#include "engine/files/hdf5_journal.hpp"
#include "engine/files/output_error.hpp"

namespace pulvis::hdf5 {
namespace {

constexpr std::size_t min_cache_bytes = 1024;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
constexpr hid_t usual_properties = H5P_DEFAULT;
#pragma GCC diagnostic pop

}  // namespace

int File::descriptor() const {
  void* descriptor = nullptr;
  checked(H5Fget_vfd_handle(handle_.get(), usual_properties, &descriptor), "find",
          "the file's descriptor");
  return *static_cast<int*>(descriptor);
}

std::uint64_t File::size_on_disk() const {
  struct stat status {};
  if (fstat(descriptor(), &status) != 0)
    throw OutputError(path_, "measure the file", std::strerror(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

std::optional<std::uint64_t> File::make_room(const std::string& dataset, Number number,
                                             const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Handle links(H5Pcreate(H5P_LINK_CREATE)), layout(H5Pcreate(H5P_DATASET_CREATE)),
      space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
  H5Pset_create_intermediate_group(links.get(), 1);
  H5Pset_alloc_time(layout.get(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(layout.get(), H5D_FILL_TIME_NEVER);
  const Id type = number == Number::byte ? H5T_NATIVE_UINT8 : H5T_NATIVE_DOUBLE;
  Handle made(checked(H5Dcreate2(handle_.get(), dataset.c_str(), type, space.get(), links.get(),
                                 layout.get(), usual_properties),
                      "make room for", dataset));
  if (std::ranges::find(extent, hsize_t{0}) != extent.end()) return 0;
  const std::uint64_t begin = H5Dget_offset(made.get());
  if (begin != HADDR_UNDEF && begin >= committed_) return begin;
  made.close();
  remove(dataset);
  return {};
}

void File::commit_change() {
  H5O_info_t root{};
  checked(H5Oget_info2(handle_.get(), &root, H5O_INFO_HDR), "measure", "/");
  if (root.hdr.nchunks != 1 || root.addr + root.hdr.space.total > page_bytes)
    throw std::logic_error(path_.string() +
                           ": \"/\" has outgrown the page that changes with one write");
  flush();
  committed_ = size_on_disk();
}

// HDF5 reuses a heap as long as it is in its metadata cache: flush the cache by shrinking it for a moment.
void File::begin_change() {
  H5AC_cache_config_t usual{};
  usual.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  checked(H5Fget_mdc_config(handle_.get(), &usual), "prepare", "the file");
  H5AC_cache_config_t small = usual;
  small.set_initial_size = true;
  small.initial_size = small.min_size = small.max_size = min_cache_bytes;
  small.incr_mode = H5C_incr__off;
  small.flash_incr_mode = H5C_flash_incr__off;
  small.decr_mode = H5C_decr__off;
  checked(H5Fset_mdc_config(handle_.get(), &small), "prepare", "the file");
  contains("/mesh");  // the next access evicts the excess entries
  usual.set_initial_size = true;
  checked(H5Fset_mdc_config(handle_.get(), &usual), "prepare", "the file");
}

}  // namespace pulvis::hdf5

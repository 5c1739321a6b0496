// Atomic changes: how File deals with HDF5's metadata cache, and with the first page of the file.
#include <hdf5.h>

#include <stdexcept>

#include "engine/files/hdf5.hpp"
#include "engine/files/hdf5_journal.hpp"

namespace pulvis::hdf5 {
namespace {

constexpr std::size_t min_cache_bytes = 1024;

}  // namespace

void File::commit_change() {
  H5O_info_t root{};
  checked(H5Oget_info2(handle_.get(), &root, H5O_INFO_HDR), "measure", "/");
  if (root.hdr.nchunks != 1 || root.addr + root.hdr.space.total > page_bytes)
    throw std::logic_error(path_.string() +
                           ": \"/\" has outgrown the page that changes with one write");
  flush();
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

#include "engine/files/hdf5.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "engine/files/hdf5_api.hpp"
#include "engine/files/hdf5_journal.hpp"
#include "engine/files/input_file.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis::hdf5 {
namespace {

static_assert(sizeof(Id) == sizeof(hid_t));

// HDF5's constants are macros with C-style casts.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
constexpr hid_t defaults = H5P_DEFAULT;
constexpr hid_t whole = H5S_ALL;
constexpr hid_t error_stack = H5E_DEFAULT;
constexpr std::size_t variable_length = H5T_VARIABLE;
#pragma GCC diagnostic pop

constexpr std::uint64_t max_chunk_rows = 65536;
constexpr std::uint64_t superblock_bytes = 96;  // of the default file version
// Room for the links and attributes of "/" in its first page (2.5 kB; a run needs 0.9).
constexpr unsigned root_links = 60;
constexpr unsigned root_name_bytes = 12;

// Each global heap for strings is then one page, which changes with one write.
void align_to_pages(const Handle& access) {
  H5Pset_alignment(access.get(), page_bytes, page_bytes);
}

// A group keeps its names in a heap, unless it tracks creation order: that heap loses space with each name
// removed, and grows into other pages. A group that tracks it stores links next to its attributes.
void keep_links_with_attributes(const Handle& creation) {
  H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED);
  H5Pset_link_phase_change(creation.get(), root_links, 0);
  H5Pset_est_link_info(creation.get(), root_links, root_name_bytes);
}

// HDF5 prints nothing, and closes nothing at program exit: after a full disk its own clean-up
// would write to the incomplete file again and crash. Every File closes itself.
void prepare_library() {
  [[maybe_unused]] static const herr_t before_anything_else = H5dont_atexit();
  H5Eset_auto2(error_stack, nullptr, nullptr);
}

// "... error message = 'No space left on device', ..." contains the system's message: extract it.
std::string system_words(const std::string& text) {
  static constexpr std::string_view lead = "error message = '";
  const auto begin = text.find(lead);
  if (begin == std::string::npos) return text;
  const auto first = begin + lead.size();
  return text.substr(first, text.find('\'', first) - first);
}

herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* out) {
  if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

std::string reason() {
  std::string innermost;
  H5Ewalk2(error_stack, H5E_WALK_UPWARD, keep_innermost, &innermost);
  return innermost.empty() ? "HDF5 gave no reason" : system_words(innermost);
}

// A named pipe would make HDF5 wait for a writer.
void refuse_what_is_no_file(const std::filesystem::path& path) {
  try {
    require_regular_file(path);
  } catch (const UnfitInput& unfit) {
    throw OutputError(path, "open the file", unfit.what());
  }
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), variable_length);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle with_groups_on_the_way() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

Handle packed_in_chunks(const Shape& shape) {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  for (auto& extent : chunk) extent = std::min<hsize_t>(extent, max_chunk_rows);
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), 1);
  return properties;
}

Handle space_of(const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
}

Handle rows_of(hid_t dataset, hsize_t first, hsize_t count) {
  Handle space(H5Dget_space(dataset));
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr);
  return space;
}

std::uint64_t product(const Shape& shape) {
  std::uint64_t count = 1;
  for (const auto extent : shape) count *= extent;
  return count;
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t add_dataset(hid_t, const char* name, const H5O_info_t* info, void* names) {
  if (info->type == H5O_TYPE_DATASET) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  }
  return 0;
}

}  // namespace

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    close();
    id_ = other.release();
  }
  return *this;
}

void Handle::close() noexcept {
  if (id_ >= 0) H5Idec_ref(release());
}

File::File(std::filesystem::path path, Handle handle)
    : path_(std::move(path)), handle_(std::move(handle)) {}

File File::create(const std::filesystem::path& path, std::uint64_t user_block) {
  return create(path, user_block, Layout::plain);
}

File File::create_to_change(const std::filesystem::path& path, std::uint64_t user_block) {
  return create(path, user_block, Layout::to_change);
}

File File::create(const std::filesystem::path& path, std::uint64_t user_block, Layout layout) {
  prepare_library();
  const Handle properties(H5Pcreate(H5P_FILE_CREATE)), access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_userblock(properties.get(), user_block);
  if (layout == Layout::to_change) {
    keep_links_with_attributes(properties);
    H5Pset_meta_block_size(access.get(), page_bytes - superblock_bytes);
    align_to_pages(access);
  }
  const Id id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties.get(), access.get());
  if (id < 0) throw OutputError(path, "create the file", reason());
  return {path, Handle(id)};
}

File File::open(const std::filesystem::path& path) {
  prepare_library();
  refuse_what_is_no_file(path);
  const Id id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, defaults);
  if (id < 0) throw OutputError(path, "open the file", reason());
  return {path, Handle(id)};
}

File File::open_to_change(const std::filesystem::path& path) {
  prepare_library();
  refuse_what_is_no_file(path);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_driver(access.get(), journal_driver(), nullptr);
  align_to_pages(access);
  const Id id = H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get());
  if (id < 0) throw OutputError(path, "open the file", reason());
  File file(path, Handle(id));
  file.committed_ = file.size_on_disk();
  return file;
}

Id File::checked(Id result, std::string_view verb, const std::string& object) const {
  if (result < 0) throw OutputError(path_, std::string(verb) + " " + object, reason());
  return result;
}

void File::flush() {
  checked(H5Fflush(handle_.get(), H5F_SCOPE_GLOBAL), "flush", "the file");
  if (fsync(descriptor()) != 0) throw OutputError(path_, "flush the file", std::strerror(errno));
}

void File::close() {
  if (handle_.get() >= 0) checked(H5Fclose(handle_.release()), "close", "the file");
}

void File::make_group(const std::string& object) {
  const Handle links = with_groups_on_the_way();
  Handle group(checked(H5Gcreate2(handle_.get(), object.c_str(), links.get(), defaults, defaults),
                       "make", object));
}

void File::write(const std::string& dataset, std::span<const double> values, const Shape& shape,
                 Packing packing) {
  write_any(dataset, H5T_NATIVE_DOUBLE, values.data(), values.size(), shape, packing);
}

void File::write(const std::string& dataset, std::span<const std::int32_t> values,
                 const Shape& shape, Packing packing) {
  write_any(dataset, H5T_NATIVE_INT32, values.data(), values.size(), shape, packing);
}

void File::write(const std::string& dataset, std::span<const std::byte> bytes) {
  write_any(dataset, H5T_NATIVE_UINT8, bytes.data(), bytes.size(), {bytes.size()}, Packing::none);
}

void File::write_any(const std::string& dataset, Id type, const void* values, std::size_t count,
                     const Shape& shape, Packing packing) {
  if (shape.empty() || product(shape) != count) {
    throw std::invalid_argument(dataset + ": the values do not fill the shape");
  }
  const Handle links = with_groups_on_the_way();
  const Handle space = space_of(shape);
  const bool pack = packing == Packing::shuffle_gzip && count > 0;  // empty chunks are not allowed
  const Handle layout = pack ? packed_in_chunks(shape) : Handle(H5Pcreate(H5P_DATASET_CREATE));
  const Handle made(checked(H5Dcreate2(handle_.get(), dataset.c_str(), type, space.get(),
                                       links.get(), layout.get(), defaults),
                            "write", dataset));
  if (count == 0) return;
  checked(H5Dwrite(made.get(), type, whole, whole, defaults, values), "write", dataset);
  if (type == H5T_NATIVE_UINT8) return;
  set_attribute(dataset, checksum_attribute,
                xxh3({static_cast<const std::byte*>(values), count * H5Tget_size(type)}));
}

void File::write_rows(Id dataset, const std::string& name, std::uint64_t first,
                      std::span<const double> values) {
  const hsize_t count = values.size();
  if (count == 0) return;
  const Handle target = rows_of(dataset, first, count),
               source(H5Screate_simple(1, &count, nullptr));
  checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, source.get(), target.get(), defaults, values.data()),
          "write", name);
}

void File::read_rows(const std::string& dataset, Id type, std::uint64_t first, std::uint64_t rows,
                     void* values) const {
  const hsize_t count = rows;
  const Handle found(checked(H5Dopen2(handle_.get(), dataset.c_str(), defaults), "open", dataset));
  const Handle source = rows_of(found.get(), first, count),
               target(H5Screate_simple(1, &count, nullptr));
  checked(H5Dread(found.get(), type, target.get(), source.get(), defaults, values), "read",
          dataset);
}

void File::link(const std::string& object, const std::string& name) {
  checked(H5Lcreate_hard(handle_.get(), object.c_str(), handle_.get(), name.c_str(), defaults,
                         defaults),
          "link", name);
}

void File::rename(const std::string& object, const std::string& name) {
  checked(H5Lmove(handle_.get(), object.c_str(), handle_.get(), name.c_str(), defaults, defaults),
          "rename", object);
}

void File::remove(const std::string& object) {
  checked(H5Ldelete(handle_.get(), object.c_str(), defaults), "remove", object);
}

void File::remove_attribute(const std::string& object, const std::string& name) {
  checked(H5Adelete_by_name(handle_.get(), object.c_str(), name.c_str(), defaults),
          "remove the attribute " + name + " of", object);
}

void File::set_attribute(const std::string& object, const std::string& name, double value) {
  set_any(object, name, H5T_NATIVE_DOUBLE, &value);
}

void File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  set_any(object, name, H5T_NATIVE_INT64, &value);
}

void File::set_attribute(const std::string& object, const std::string& name, std::uint64_t value) {
  set_any(object, name, H5T_NATIVE_UINT64, &value);
}

void File::set_attribute(const std::string& object, const std::string& name,
                         std::string_view value) {
  const std::string copy(value);
  const char* const text = copy.c_str();
  const Handle type = text_type();
  set_any(object, name, type.get(), static_cast<const void*>(&text));
}

void File::set_any(const std::string& object, const std::string& name, Id type, const void* value) {
  set_any(object, name, type, Handle(H5Screate(H5S_SCALAR)), value);
}

void File::set_any(const std::string& object, const std::string& name, Id type, const Handle& space,
                   const void* value) {
  const Handle owner(checked(H5Oopen(handle_.get(), object.c_str(), defaults), "open", object));
  const Handle made(
      checked(H5Acreate2(owner.get(), name.c_str(), type, space.get(), defaults, defaults),
              "write the attribute " + name + " of", object));
  checked(H5Awrite(made.get(), type, value), "write the attribute " + name + " of", object);
}

bool File::contains(const std::string& object) const {
  for (auto end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string part = object.substr(0, end);  // H5Lexists fails if a parent is missing
    if (part != "/" && H5Lexists(handle_.get(), part.c_str(), defaults) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool File::is_group(const std::string& object) const {
  const Handle found(checked(H5Oopen(handle_.get(), object.c_str(), defaults), "open", object));
  return H5Iget_type(found.get()) == H5I_GROUP;
}

std::vector<std::string> File::children(const std::string& group) const {
  std::vector<std::string> names;
  checked(H5Literate_by_name(handle_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
                             add_name, &names, defaults),
          "list", group);
  return names;
}

std::vector<std::string> File::datasets_below(const std::string& group) const {
  std::vector<std::string> names;
  checked(H5Ovisit_by_name2(handle_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, add_dataset,
                            &names, H5O_INFO_BASIC, defaults),
          "list", group);
  return names;
}

Shape File::shape(const std::string& dataset) const {
  const Handle found(checked(H5Dopen2(handle_.get(), dataset.c_str(), defaults), "open", dataset));
  const Handle space(checked(H5Dget_space(found.get()), "measure", dataset));
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

std::uint64_t File::size_of(const std::string& dataset) const { return product(shape(dataset)); }

void File::read_any(const std::string& dataset, Id type, void* values) const {
  const Handle found(checked(H5Dopen2(handle_.get(), dataset.c_str(), defaults), "open", dataset));
  checked(H5Dread(found.get(), type, whole, whole, defaults, values), "read", dataset);
  const Handle stored(H5Dget_type(found.get()));
  if (H5Tequal(stored.get(), type) > 0)
    require_as_written(
        found.get(), dataset,
        xxh3({static_cast<const std::byte*>(values), size_of(dataset) * H5Tget_size(type)}));
  else
    require_as_written(found.get(), dataset);
}

std::vector<double> File::read_doubles(const std::string& dataset) const {
  std::vector<double> values(size_of(dataset));
  if (!values.empty()) read_any(dataset, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<std::int32_t> File::read_integers(const std::string& dataset) const {
  std::vector<std::int32_t> values(size_of(dataset));
  if (!values.empty()) read_any(dataset, H5T_NATIVE_INT32, values.data());
  return values;
}

std::vector<std::byte> File::read_bytes(const std::string& dataset) const {
  std::vector<std::byte> bytes(size_of(dataset));
  if (!bytes.empty()) read_any(dataset, H5T_NATIVE_UINT8, bytes.data());
  return bytes;
}

std::vector<std::byte> File::read_bytes(const std::string& dataset, std::uint64_t first,
                                        std::uint64_t count) const {
  std::vector<std::byte> bytes(count);
  if (count > 0) read_rows(dataset, H5T_NATIVE_UINT8, first, count, bytes.data());
  return bytes;
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(handle_.get(), object.c_str(), name.c_str(), defaults) > 0;
}

void File::read_attribute(const std::string& object, const std::string& name, Id type,
                          void* value) const {
  const Handle found(
      checked(H5Aopen_by_name(handle_.get(), object.c_str(), name.c_str(), defaults, defaults),
              "open the attribute " + name + " of", object));
  checked(H5Aread(found.get(), type, value), "read the attribute " + name + " of", object);
}

double File::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0;
  read_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::uint64_t File::unsigned_attribute(const std::string& object, const std::string& name) const {
  std::uint64_t value = 0;
  read_attribute(object, name, H5T_NATIVE_UINT64, &value);
  return value;
}

std::string File::text_attribute(const std::string& object, const std::string& name) const {
  char* text = nullptr;
  const Handle type = text_type();
  read_attribute(object, name, type.get(), static_cast<void*>(&text));
  const std::string copy = text == nullptr ? "" : text;
  H5free_memory(text);
  return copy;
}

}  // namespace pulvis::hdf5

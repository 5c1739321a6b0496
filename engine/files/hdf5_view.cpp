// What files for VTK consist of: views of datasets of another file, constants, indices and plain attributes.
#include "engine/files/hdf5.hpp"
#include "engine/files/hdf5_api.hpp"

namespace pulvis::hdf5 {
namespace {

// HDF5's constants are macros with C-style casts.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
constexpr hid_t none_of_these = H5P_DEFAULT;
#pragma GCC diagnostic pop

Handle extent_of(const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
}

Handle with_parents() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

Id type_of(Viewed number) {
  if (number == Viewed::reals) return H5T_NATIVE_DOUBLE;
  return number == Viewed::integers ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
}

std::uint64_t values_in(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) count *= extent;
  return count;
}

void select(const Handle& space, const Piece& piece, std::size_t rank) {
  std::vector<hsize_t> first(rank, 0), count(piece.shape.begin(), piece.shape.end());
  first.front() = piece.first;
  if (rank == 1) count = {values_in(piece.shape)};
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr);
}

}  // namespace

void File::write(const std::string& dataset, std::span<const std::int64_t> values,
                 const Shape& shape, Packing packing) {
  write_any(dataset, H5T_NATIVE_INT64, values.data(), values.size(), shape, packing);
}

void File::write_constant(const std::string& dataset, std::uint8_t value, std::uint64_t rows) {
  const Handle links = with_parents(), space = extent_of({rows}),
               layout(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_fill_value(layout.get(), H5T_NATIVE_UINT8, &value);
  H5Pset_alloc_time(layout.get(), H5D_ALLOC_TIME_LATE);
  const Handle made(checked(H5Dcreate2(handle_.get(), dataset.c_str(), H5T_NATIVE_UINT8,
                                       space.get(), links.get(), layout.get(), none_of_these),
                            "write", dataset));
}

void File::write_view(const std::string& dataset, Viewed number, const Shape& shape,
                      const std::string& of, std::span<const Piece> pieces) {
  const Handle links = with_parents(), space = extent_of(shape),
               layout(H5Pcreate(H5P_DATASET_CREATE));
  for (const Piece& piece : pieces) {
    if (values_in(piece.shape) == 0) continue;
    select(space, piece, shape.size());
    checked(H5Pset_virtual(layout.get(), space.get(), of.c_str(), piece.source.c_str(),
                           extent_of(piece.shape).get()),
            "view", piece.source);
  }
  H5Sselect_all(space.get());
  const Handle made(checked(H5Dcreate2(handle_.get(), dataset.c_str(), type_of(number), space.get(),
                                       links.get(), layout.get(), none_of_these),
                            "write", dataset));
}

void File::set_attribute(const std::string& object, const std::string& name,
                         std::span<const std::int64_t> values) {
  set_any(object, name, H5T_NATIVE_INT64, extent_of({values.size()}), values.data());
}

void File::set_plain_text(const std::string& object, const std::string& name,
                          std::string_view value) {
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), value.size());
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  set_any(object, name, type.get(), std::string(value).data());
}

}  // namespace pulvis::hdf5

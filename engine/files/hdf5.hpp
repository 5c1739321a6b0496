// A thin RAII wrapper of the HDF5 C library: only what the recorder, the checkpoint and the report
// need. The C header is included only in hdf5*.cpp, so that its macros do not leak out.
//
// Every failing call throws OutputError with the file, the operation and HDF5's innermost
// error message; HDF5's own printing to stderr is off. Paths inside a file are absolute
// ("/frames/000000/position"); missing parent groups are created. The default file version is
// kept: files with newer ones cannot be opened by plain readers after a crash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pulvis::hdf5 {

using Id = std::int64_t;  // hid_t
using Shape = std::vector<std::uint64_t>;

// Owns one HDF5 identifier of any kind. A failure to close it cannot be handled in any useful way,
// except for a file, which File::close() handles.
class Handle {
 public:
  Handle() = default;
  explicit Handle(Id id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { close(); }

  Id get() const { return id_; }
  Id release() { return std::exchange(id_, -1); }
  void close() noexcept;

 private:
  Id id_ = -1;
};

enum class Packing { none, shuffle_gzip };  // the latter for meshes: about a hundred times smaller

enum class Number { real, byte };  // of a dataset that is filled later

enum class Stored { real, whole };  // for numbers passed as doubles

enum class Viewed { reals, integers, indices };  // double, 32 and 64 bits

// Rows of a view, from `first` on, that are those of a dataset of another file. In a view with one column that has more, each
// of its values is a row.
struct Piece {
  std::uint64_t first = 0;
  std::string source;
  Shape shape;  // of the source
};

class File {
 public:
  // Replaces an existing file. The first `user_block` bytes (0, or a power of two from 512) are left
  // to the caller.
  static File create(const std::filesystem::path& path, std::uint64_t user_block = 0);
  // The same, but links and attributes of "/" are placed in the 4096 bytes after the user block (which has
  // 4096 bytes, too): with open_to_change() they change atomically (engine/files/journaled_file.hpp).
  static File create_to_change(const std::filesystem::path& path, std::uint64_t user_block);
  static File open(const std::filesystem::path& path);  // read only
  // Changes reach the file as a whole at a flush, or not at all, and others may read meanwhile; see
  // engine/files/journaled_file.hpp. Opening repairs the file after a killed program.
  static File open_to_change(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  void flush();  // to disk: H5Fflush and fsync
  void close();  // throws if the last bytes cannot be written; the destructor does not

  // What is written next goes to new places, strings too: HDF5 would otherwise put them into heaps that it has
  // cached, and enlarge those, although committed data refers to them.
  void begin_change();
  // Flushes the change. std::logic_error if "/" is not in one page, as readers might see a partial change.
  void commit_change();

  // Writing. `object` is the path of a group or dataset.
  void make_group(const std::string& object);
  void write(const std::string& dataset, std::span<const double> values, const Shape& shape,
             Packing packing = Packing::none);
  void write(const std::string& dataset, std::span<const std::int32_t> values, const Shape& shape,
             Packing packing = Packing::none);
  void write(const std::string& dataset, std::span<const std::int64_t> values, const Shape& shape,
             Packing packing = Packing::none);
  void write(const std::string& dataset, std::span<const std::byte> bytes);
  // So many rows of the same byte, which takes one.
  void write_constant(const std::string& dataset, std::uint8_t value, std::uint64_t rows);
  // A dataset without values of its own ("virtual"): those of datasets of the file `of` beside this one, and zeros where
  // there is no piece, or where a piece has fewer columns.
  void write_view(const std::string& dataset, Viewed number, const Shape& shape,
                  const std::string& of, std::span<const Piece> pieces);
  // A dataset whose values other processes write straight to the file, and where they begin, in bytes from its start; 0 if
  // it is empty. Nothing, and no dataset, if the only free space is within what was committed before: bytes there change only
  // with a commit.
  std::optional<std::uint64_t> make_room(const std::string& dataset, Number number,
                                         const Shape& shape);
  // Records the checksum of a dataset that others have filled, once their bytes are in the file.
  void record_checksum(const std::string& dataset, std::uint64_t begin);
  // A 1-D series: the first `kept` rows of another one (none: 0 rows), then `values`.
  void write_series(const std::string& dataset, const std::string& old, std::uint64_t kept,
                    std::span<const double> values, Stored stored = Stored::real);
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, std::uint64_t value);
  void set_attribute(const std::string& object, const std::string& name, std::string_view value);
  void set_attribute(const std::string& object, const std::string& name,
                     std::span<const std::int64_t> values);
  // Text of fixed length, in ASCII, for readers that understand no other.
  void set_plain_text(const std::string& object, const std::string& name, std::string_view value);

  void link(const std::string& object,
            const std::string& name);  // a second name for the same object
  void rename(const std::string& object, const std::string& name);
  void remove(const std::string& object);
  void remove_attribute(const std::string& object, const std::string& name);

  // Reading. Every dataset of numbers has its XXH3 as attribute "xxh3" (those of checkpoints, whose files have one, do
  // not). One that differs is an OutputError, wherever the dataset is read as a whole or continued.
  bool contains(const std::string& object) const;
  bool is_group(const std::string& object) const;
  std::vector<std::string> children(const std::string& group) const;        // sorted by name
  std::vector<std::string> datasets_below(const std::string& group) const;  // "tool/top/force_y"
  Shape shape(const std::string& dataset) const;
  // Those with other bytes than were written: reads the whole file.
  std::vector<std::string> damaged_datasets() const;
  std::vector<double> read_doubles(const std::string& dataset) const;
  std::vector<std::int32_t> read_integers(const std::string& dataset) const;
  std::vector<std::byte> read_bytes(const std::string& dataset) const;
  std::vector<std::byte> read_bytes(const std::string& dataset, std::uint64_t first,
                                    std::uint64_t count) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::uint64_t unsigned_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;

 private:
  enum class Layout { plain, to_change };
  File(std::filesystem::path path, Handle handle);
  static File create(const std::filesystem::path& path, std::uint64_t user_block, Layout layout);
  static constexpr const char* checksum_attribute = "xxh3";
  bool is_as_written(Id dataset) const;
  void require_as_written(Id dataset, const std::string& name) const;
  void require_as_written(Id dataset, const std::string& name, std::uint64_t checksum) const;
  void write_rows(Id dataset, const std::string& name, std::uint64_t first,
                  std::span<const double> values);
  void read_rows(const std::string& dataset, Id type, std::uint64_t first, std::uint64_t rows,
                 void* values) const;
  void write_any(const std::string& dataset, Id type, const void* values, std::size_t count,
                 const Shape& shape, Packing packing);
  void set_any(const std::string& object, const std::string& name, Id type, const void* value);
  void set_any(const std::string& object, const std::string& name, Id type, const Handle& space,
               const void* value);
  void read_any(const std::string& dataset, Id type, void* values) const;
  void read_attribute(const std::string& object, const std::string& name, Id type,
                      void* value) const;
  std::uint64_t size_of(const std::string& dataset) const;
  Id checked(Id result, std::string_view verb, const std::string& object) const;

  int descriptor() const;
  std::uint64_t size_on_disk() const;

  std::filesystem::path path_;
  Handle handle_;
  std::uint64_t committed_ = 0;  // end of the last commit, if changes are committed
};

}  // namespace pulvis::hdf5

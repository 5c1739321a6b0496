#include "engine/files/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <set>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t head_bytes = 512;
constexpr std::size_t kept = 2;
using Head = std::array<char, head_bytes>;

[[noreturn]] void fail(const fs::path& file, const char* operation) {
  throw OutputError(file, operation, std::strerror(errno));
}

struct Content {
  std::uint64_t bytes = 0, checksum = 0;
};

// Checksum and size of everything after the head.
Content content_of(const FileDescriptor& file, const fs::path& path) {
  std::vector<std::byte> piece(std::size_t{1} << 20);
  Xxh3 checksum;
  Content content;
  while (true) {
    const ssize_t got = pread(file.get(), piece.data(), piece.size(),
                              static_cast<off_t>(head_bytes + content.bytes));
    if (got < 0) fail(path, "read the checkpoint");
    if (got == 0) break;
    content.bytes += static_cast<std::uint64_t>(got);
    checksum.add(std::span(piece).first(static_cast<std::size_t>(got)));
  }
  content.checksum = checksum.value();
  return content;
}

Head head_of(const Content& content) {
  Head head{};
  const std::string text =
      fmt::format("pulvis checkpoint 2\nbytes {}\nxxh3 {:016x}\n", content.bytes, content.checksum);
  std::ranges::copy(text, head.begin());
  return head;
}

bool is_of_format_1(const Head& head) {
  const std::string_view text(head.data(), head.size());
  return text.starts_with("pulvis checkpoint 1\n") && text.find("\nfnv1a of words ") != text.npos;
}

void sign(const fs::path& path) {
  const FileDescriptor file(open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (!file) fail(path, "open the checkpoint");
  const Head head = head_of(content_of(file, path));
  if (pwrite(file.get(), head.data(), head.size(), 0) != static_cast<ssize_t>(head.size()))
    fail(path, "write the checkpoint");
  if (fsync(file.get()) != 0) fail(path, "flush the checkpoint to disk");
}

hdf5::File opened_unverified(const fs::path& path) {
  try {
    return hdf5::File::open(path);
  } catch (const OutputError& error) {
    throw DamagedCheckpoint(error.reason());
  }
}

hdf5::File verified(const fs::path& path) {
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) throw DamagedCheckpoint(std::string("cannot be opened: ") + std::strerror(errno));
  Head head{};
  if (pread(file.get(), head.data(), head.size(), 0) != static_cast<ssize_t>(head.size()))
    throw DamagedCheckpoint("it is truncated");
  if (is_of_format_1(head))
    throw OtherFormat("it was written by an older pulvis in format 1; allowed: format 2");
  const Content content = content_of(file, path);
  if (head != head_of(content))
    throw DamagedCheckpoint(
        fmt::format("its {} bytes are not those that were written: the checksum differs",
                    head_bytes + content.bytes));
  return opened_unverified(path);
}

std::string column_name(const ColumnBase& column) {
  return "/columns/" + column.entity + "/" + column.info.name;
}

// Calls take(name, bytes) for everything in a world that must be saved, or room(name, bytes) if others write it.
template <class Take, class Room>
void for_each_part(const World& world, const Take& take, const Room& room,
                   const ColumnVisit& visit) {
  for (const ColumnBase* column : world.columns()) {
    if (column->declared_transient) continue;
    const auto make_room = [&](std::uint64_t bytes) { return room(column_name(*column), bytes); };
    if (visit.write && visit.write(*column, make_room)) continue;
    if (visit.fetch) visit.fetch(*column);
    take(column_name(*column), std::span<const std::byte>(column->data(), column->bytes()));
    if (visit.leave) visit.leave(*column);
  }
  for (const World::SavedResource& resource : world.saved_resources())
    take("/resources/" + resource.name, std::span<const std::byte>(resource.state()));
}

template <class Take, class Room>
void for_each_part(const StateParts& parts, const Take& take, const Room&, const ColumnVisit&) {
  for (const auto& [name, bytes] : parts) take(name, std::span<const std::byte>(bytes));
}

template <class State>
void write_content(const fs::path& path, const CheckpointInfo& info, const State& world,
                   const StateParts& run, const ColumnVisit& visit) {
  hdf5::File file = hdf5::File::create(path, head_bytes);
  write_head(path, "pulvis checkpoint, not finished\n");
  file.set_attribute("/", "version", std::string_view(info.version));
  file.set_attribute("/", "commit", std::string_view(info.commit));
  file.set_attribute("/", "scene_hash", std::string_view(info.scene_hash));
  file.set_attribute("/", "powder_hash", std::string_view(info.powder_hash));
  file.set_attribute("/", "run", std::string_view(info.run));
  file.set_attribute("/", "step", info.step);
  file.set_attribute("/", "time", info.time);
  for_each_part(
      world,
      [&](const std::string& name, std::span<const std::byte> bytes) { file.write(name, bytes); },
      [&](const std::string& name, std::uint64_t bytes) {
        return FileRoom{fs::absolute(path).string(),
                        file.make_room(name, hdf5::Number::byte, {bytes}).value()};
      },
      visit);
  for (const auto& [name, bytes] : run) file.write("/run/" + name, bytes);
  file.close();
  if (visit.flush) visit.flush();
}

template <class State>
void write_state(const fs::path& path, const CheckpointInfo& info, const State& world,
                 const StateParts& run, const ColumnVisit& visit) {
  const fs::path temporary = path.string() + ".new";
  std::error_code ignored;
  require_own_or_none(path, role::run);
  require_own_or_none(temporary, role::run);
  try {
    write_content(temporary, info, world, run, visit);
    sign(temporary);
    if (rename(temporary.c_str(), path.c_str()) != 0)
      fail(path, "move the checkpoint to its final name");
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
  sync_folder(path.parent_path());
}

template <class State>
void write_next(const fs::path& folder, const CheckpointInfo& info, const State& world,
                const StateParts& run, const ColumnVisit& visit) {
  write_state(folder / fmt::format("checkpoint-{:012}.h5", info.step), info, world, run, visit);
  const std::vector<fs::path> all = checkpoints_in(folder);
  for (std::size_t i = kept; i < all.size(); ++i) remove_own(all[i], role::run);
}

}  // namespace

StateParts state_of(const World& world) {
  StateParts parts;
  for_each_part(
      world,
      [&](const std::string& name, std::span<const std::byte> bytes) {
        parts[name].assign(bytes.begin(), bytes.end());
      },
      [](const std::string&, std::uint64_t) { return FileRoom(); }, {});
  return parts;
}

void write_checkpoint(const fs::path& folder, const CheckpointInfo& info, const World& world,
                      const StateParts& run, const ColumnVisit& visit) {
  write_next(folder, info, world, run, visit);
}

void write_checkpoint(const fs::path& folder, const CheckpointInfo& info, const StateParts& world,
                      const StateParts& run) {
  write_next(folder, info, world, run, {});
}

void write_state_file(const fs::path& file, const CheckpointInfo& info, const World& world,
                      const ColumnVisit& visit) {
  write_state(file, info, world, {}, visit);
}

std::vector<fs::path> checkpoints_in(const fs::path& folder, const char* ending) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("checkpoint-") && name.ends_with(ending)) found.push_back(entry.path());
  }
  std::ranges::sort(found, std::greater());  // all names have the same number of digits
  return found;
}

void remove_checkpoints(const fs::path& folder) {
  for (const fs::path& file : checkpoints_in(folder)) remove_own(file, role::run);
  remove_unfinished_checkpoints(folder);
}

void remove_unfinished_checkpoints(const fs::path& folder) {
  for (const fs::path& file : checkpoints_in(folder, ".h5.new")) remove_own(file, role::run);
}

Checkpoint::Checkpoint(const fs::path& file) : Checkpoint(pulvis::verified(file)) {}
Checkpoint Checkpoint::verified(const fs::path& file) {
  return Checkpoint(opened_unverified(file));
}

Checkpoint::Checkpoint(hdf5::File file) : file_(std::move(file)) {
  try {
    info_.version = file_.text_attribute("/", "version");
    info_.commit = file_.text_attribute("/", "commit");
    info_.scene_hash = file_.text_attribute("/", "scene_hash");
    info_.powder_hash = file_.text_attribute("/", "powder_hash");
    info_.run = file_.text_attribute("/", "run");
    info_.step = static_cast<std::int64_t>(file_.unsigned_attribute("/", "step"));
    info_.time = file_.number_attribute("/", "time");
  } catch (const OutputError& error) {
    throw DamagedCheckpoint(error.what());
  }
}

bool is_restored(const ColumnBase& column, const std::set<std::string>& left_alone) {
  return !column.declared_transient && !left_alone.contains(column.entity + "/" + column.info.name);
}

void Checkpoint::require_same_parts(const World& world,
                                    const std::set<std::string>& left_alone) const {
  std::set<std::string> unused;
  for (const std::string group : {"/columns/", "/resources/"})
    if (file_.contains(group.substr(0, group.size() - 1)))
      for (const std::string& name : file_.datasets_below(group))
        if (!left_alone.contains(name)) unused.insert(group + name);
  const auto use = [&](const std::string& name) {
    if (unused.erase(name) == 0) throw BadState("it has no " + name);
  };
  for (const ColumnBase* column : world.columns())
    if (is_restored(*column, left_alone)) use(column_name(*column));
  for (const World::SavedResource& resource : world.saved_resources())
    if (!left_alone.contains(resource.name)) use("/resources/" + resource.name);
  if (!unused.empty()) throw BadState("the scene has no " + *unused.begin());
}

void Checkpoint::restore(World& world, const std::set<std::string>& left_alone) const {
  require_same_parts(world, left_alone);
  for (const ColumnBase* column : world.columns())
    if (is_restored(*column, left_alone))
      world.set_column(*column, file_.read_bytes(column_name(*column)));
  for (const World::SavedResource& r : world.saved_resources())
    if (!left_alone.contains(r.name)) r.set_state(resource(r.name));
}

std::vector<std::byte> Checkpoint::column(const std::string& name) const {
  return file_.read_bytes("/columns/" + name);
}
std::uint64_t Checkpoint::column_bytes(const std::string& name) const {
  return file_.shape("/columns/" + name).front();
}
std::vector<std::byte> Checkpoint::column(const std::string& name, std::uint64_t first,
                                          std::uint64_t bytes) const {
  return file_.read_bytes("/columns/" + name, first, bytes);
}
std::vector<std::byte> Checkpoint::resource(const std::string& name) const {
  return file_.read_bytes("/resources/" + name);
}

std::vector<std::byte> Checkpoint::run(const std::string& name) const {
  return file_.read_bytes("/run/" + name);
}

}  // namespace pulvis

#include "engine/files/own_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <sstream>
#include <system_error>
#include <vector>

#include "engine/files/file_descriptor.hpp"
#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = ".pulvis-files";
constexpr std::size_t marker_bytes = 32;

struct Line {
  std::string state, role, name;
  std::uint64_t checksum = 0, bytes = 0;
};

[[noreturn]] void fail_to(const fs::path& file, const char* operation) {
  throw OutputError(file, operation, std::strerror(errno));
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::uint64_t checksum_of(std::string_view bytes) { return xxh3(std::as_bytes(std::span(bytes))); }

std::string text_of(const Line& line) {
  return fmt::format("{} {:016x} {} {} {}\n", line.state, line.checksum, line.bytes, line.role,
                     line.name);
}

Line line_in(std::istream& words) {
  Line line;
  words >> line.state >> std::hex >> line.checksum >> std::dec >> line.bytes >> line.role;
  std::getline(words >> std::ws, line.name);
  return line;
}

bool is_state(std::string_view word) {
  return word == "next" || word == "whole" || word == "start";
}

// What may be in the file: the last valid line, and what was about to be written since.
std::vector<Line> lines_of(const fs::path& file, std::string_view of) {
  std::ifstream list(folder_of(file) / list_name);
  std::vector<Line> lines;
  for (std::string text; std::getline(list, text);) {
    std::istringstream words(text);
    const Line line = line_in(words);
    if (!words || line.role != of || line.name != file.filename().string()) continue;
    if (line.state != "next") lines.clear();
    lines.push_back(line);
  }
  return lines;
}

// Opens a regular file, without following links.
FileDescriptor open_regular(const fs::path& file, std::uint64_t& bytes) {
  FileDescriptor opened(open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!opened || fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  bytes = static_cast<std::uint64_t>(status.st_size);
  return opened;
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

// Whether a list was written by Pulvis: it has a line of it. A full disk may have cut its only line short.
bool is_own_list(const fs::path& list) {
  std::uint64_t bytes = 0;
  if (!open_regular(list, bytes)) return false;
  std::ifstream stream(list);
  int lines = 0;
  bool is_cut = false;
  for (std::string text; std::getline(stream, text); ++lines) {
    std::istringstream words(text);
    const Line line = line_in(words);
    if (words && is_state(line.state)) return true;
    is_cut = is_state(line.state) && stream.eof();
  }
  return lines == 0 || (lines == 1 && is_cut);
}

void require_own_list(const fs::path& list) {
  if (!is_there(list) || is_own_list(list)) return;
  throw ForeignFile(list, "list the files of the folder in it",
                    "there is already a file of this name that was not written by Pulvis; allowed: "
                    "another folder, or moving the file away");
}

// A full disk may have cut the last line short: it is left alone, and ignored.
std::string_view ending_of(const FileDescriptor& list) {
  const off_t bytes = lseek(list.get(), 0, SEEK_END);
  char last = '\n';
  if (bytes > 0 && pread(list.get(), &last, 1, bytes - 1) != 1) return "";
  return last == '\n' ? "" : "\n";
}

void add_line(const fs::path& file, const Line& line) {
  const fs::path list = folder_of(file) / list_name;
  require_own_list(list);
  const FileDescriptor opened(
      open(list.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!opened) fail_to(list, "write");
  const std::string text = std::string(ending_of(opened)) + text_of(line);
  errno = ENOSPC;  // of a write that is cut short
  if (write(opened.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    fail_to(list, "write");
}

bool begins_with(const FileDescriptor& file, const Line& line) {
  std::vector<std::byte> piece(std::size_t{1} << 16);
  Xxh3 checksum;
  for (std::uint64_t at = 0; at < line.bytes;) {
    const std::size_t wanted = std::min<std::uint64_t>(piece.size(), line.bytes - at);
    const ssize_t got = pread(file.get(), piece.data(), wanted, static_cast<off_t>(at));
    if (got <= 0) return false;
    checksum.add(std::span(piece).first(static_cast<std::size_t>(got)));
    at += static_cast<std::uint64_t>(got);
  }
  return checksum.value() == line.checksum;
}

bool fits(const FileDescriptor& file, std::uint64_t bytes, const Line& line) {
  const bool long_enough = line.state == "start" ? bytes >= line.bytes : bytes == line.bytes;
  return long_enough && begins_with(file, line);
}

// The first bytes of files that identify themselves; empty: the list decides.
std::string_view own_beginning(const std::string& name) {
  if (name == "run.h5" || name == "run.h5.new" || name == "run.vtkhdf" || name == "tools.vtkhdf")
    return "pulvis run";
  if (name == "run.h5.journal") return "PLVJNL";
  const bool state = name.starts_with("checkpoint-") || name.starts_with("state-");
  if (state && (name.ends_with(".h5") || name.ends_with(".h5.new"))) return "pulvis checkpoint";
  return {};
}

// A program that was killed at once, or met a full disk, leaves a file that is empty or not yet marked: zeros.
bool may_be_unmarked(const std::string& name) {
  return name.ends_with(".new") || name.ends_with(".journal");
}

constexpr const char* new_suffix = ".pulvis-new";

fs::path beside(const fs::path& file) {
  return folder_of(file) / fmt::format(".{}{}", file.filename().string(), new_suffix);
}

bool is_half_written(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('.') && name.ends_with(new_suffix);
}

void write_beside(const fs::path& new_file, const fs::path& file, std::string_view text) {
  errno = 0;
  std::ofstream stream(new_file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail_to(file, "write");
}

void put_in_place(const fs::path& file) {
  if (::rename(beside(file).c_str(), file.c_str()) != 0) fail_to(file, "move it to its final name");
}

Line line_of(const fs::path& file, std::string_view of, std::string_view bytes, const char* state) {
  return {state, std::string(of), file.filename().string(), checksum_of(bytes), bytes.size()};
}

}  // namespace

bool is_own(const fs::path& file, std::string_view of) {
  std::uint64_t bytes = 0;
  const FileDescriptor opened = open_regular(file, bytes);
  if (!opened) return false;
  const std::string name = file.filename().string();
  const std::string_view beginning = own_beginning(name);
  if (beginning.empty())
    return std::ranges::any_of(lines_of(file, of),
                               [&](const Line& line) { return fits(opened, bytes, line); });
  std::array<char, marker_bytes> head{};
  if (pread(opened.get(), head.data(), head.size(), 0) < 0) return false;
  const std::string_view start(head.data(), head.size());
  return start.starts_with(beginning) ||
         (may_be_unmarked(name) && start.find_first_not_of('\0') == std::string_view::npos);
}

void require_own_list_in(const fs::path& folder) { require_own_list(folder / list_name); }

void require_own_or_none(const fs::path& file, std::string_view of) {
  if (!is_there(file) || is_own(file, of)) return;
  if (!is_there(file))
    return;  // its folder was removed between the two checks: whoever writes will report that
  throw ForeignFile(
      file, "write it",
      fmt::format(
          "there is already a file that was not written by Pulvis as a file of a {}, or that has "
          "been changed since; allowed: another folder or name, or moving the file away",
          of));
}

void require_another(const fs::path& read, const fs::path& file) {
  std::error_code ignored;
  if (fs::equivalent(read, file, ignored))
    throw ForeignFile(
        file, "write it",
        fmt::format("it is {}, which is an input; allowed: another folder or name", read.string()));
}

void note_own(const fs::path& file, std::string_view of, std::string_view bytes, Extent extent) {
  add_line(file, line_of(file, of, bytes, extent == Extent::whole ? "whole" : "start"));
}

void note_own(const fs::path& file, std::string_view of, std::uint64_t checksum,
              std::uint64_t bytes) {
  add_line(file, {"whole", std::string(of), file.filename().string(), checksum, bytes});
}

fs::path begin_own(const fs::path& file, std::string_view of, std::string_view start) {
  require_own_or_none(file, of);
  add_line(file, line_of(file, of, start, "next"));
  return fresh_beside(file);
}

fs::path fresh_beside(const fs::path& file) {
  std::error_code ignored;
  fs::remove(beside(file), ignored);
  return beside(file);
}

void end_own(const fs::path& file, std::string_view of, std::string_view start, Extent extent) {
  put_in_place(file);
  note_own(file, of, start, extent);
}

void write_own(const fs::path& file, std::string_view of, std::string_view text, Extent extent) {
  write_beside(begin_own(file, of, text), file, text);
  end_own(file, of, text, extent);
}

void replace_own(const fs::path& file, std::string_view of, std::string_view text) {
  require_own_or_none(file, of);
  write_beside(fresh_beside(file), file, text);
  put_in_place(file);
}

void write_head(const fs::path& file, std::string_view text) {
  const FileDescriptor opened(open(file.c_str(), O_WRONLY | O_CLOEXEC));
  if (!opened ||
      pwrite(opened.get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    fail_to(file, "write");
}

void remove_own(const fs::path& file, std::string_view of) {
  std::error_code error;
  if (is_own(file, of)) fs::remove(file, error);
  if (error) throw OutputError(file, "remove the old file", error.message());
}

void remove_own_below(const fs::path& folder, std::string_view of) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  for (const auto& entry : fs::directory_iterator(folder, error))
    is_half_written(entry.path()) ? void(fs::remove(entry.path(), error))
                                  : remove_own(entry.path(), of);
  const auto left = std::distance(fs::directory_iterator(folder, error), fs::directory_iterator());
  if (left == 1 && is_own_list(folder / list_name)) fs::remove(folder / list_name, error);
  fs::remove(folder, error);  // only removes an empty folder
}

}  // namespace pulvis

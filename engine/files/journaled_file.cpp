#include "engine/files/journaled_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "engine/files/xxh3.hpp"

namespace pulvis {
namespace {

constexpr std::uint64_t journal_mark = 0x32304c4e4a564c50U;  // "PLVJNL02"

void require_done(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

// Reads as many bytes as there are.
std::size_t read_some(int file, std::uint64_t at, std::span<std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    require_done(got >= 0, "read");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::uint64_t size_on_disk(int file) {
  struct stat status {};
  require_done(fstat(file, &status) == 0, "stat");
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace

// The journal: this head, then number and bytes of each page, then the XXH3 of everything before.
struct JournalHead {
  std::uint64_t mark = journal_mark;
  std::uint64_t end = 0;   // of the bytes that pages may change
  std::uint64_t size = 0;  // of the file after the commit
  std::uint64_t pages = 0;
};

JournaledFile::JournaledFile(const std::filesystem::path& path, Open how)
    : path_(std::filesystem::absolute(path)),
      file_(::open(path.c_str(),
                   how == Open::empty ? O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC : O_RDWR | O_CLOEXEC,
                   0666)),
      number_(file_.get()) {
  require_done(static_cast<bool>(file_), "open");
  if (how == Open::existing)
    recover();
  else
    unlink(journal_path().c_str());
  size_ = committed_ = size_on_disk(file_.get());
}

void JournaledFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
  const std::size_t got = read_some(file_.get(), at, bytes);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(got), bytes.end(), std::byte{});
  const std::uint64_t end = std::min(at + bytes.size(), committed_);
  if (at >= end) return;
  auto changed = changed_.lower_bound(at / page_bytes);
  for (; changed != changed_.end() && changed->first * page_bytes < end; ++changed) {
    const std::uint64_t first = std::max(at, changed->first * page_bytes);
    const std::uint64_t last = std::min(end, (changed->first + 1) * page_bytes);
    std::memcpy(bytes.data() + (first - at),
                changed->second.data() + (first - changed->first * page_bytes), last - first);
  }
}

JournaledFile::Page& JournaledFile::page(std::uint64_t index) {
  const auto [found, is_new] = changed_.try_emplace(index);
  if (is_new) read_some(file_.get(), index * page_bytes, found->second);
  return found->second;
}

void JournaledFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
  size_ = std::max(size_, at + bytes.size());
  while (!bytes.empty() && at < committed_) {
    const std::uint64_t index = at / page_bytes, inside = at % page_bytes;
    const std::size_t count =
        std::min({bytes.size(), page_bytes - inside, static_cast<std::size_t>(committed_ - at)});
    std::memcpy(page(index).data() + inside, bytes.data(), count);
    bytes = bytes.subspan(count);
    at += count;
  }
  require_done(write_all(file_.get(), at, bytes), "write");
}

void JournaledFile::put_in_place(std::uint64_t index, const Page& page, std::uint64_t end) const {
  const std::uint64_t first = index * page_bytes;
  if (first >= end) return;
  require_done(write_all(file_.get(), first,
                         std::span(page).first(std::min<std::size_t>(page_bytes, end - first))),
               "write");
}

void JournaledFile::write_journal() const {
  const JournalHead head{journal_mark, committed_, size_, changed_.size()};
  std::vector<std::byte> bytes;
  const auto put = [&](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  put(std::as_bytes(std::span(&head, 1)));
  for (const auto& [index, page] : changed_) {
    put(std::as_bytes(std::span(&index, 1)));
    put(page);
  }
  const std::uint64_t checksum = xxh3(bytes);
  const FileDescriptor journal(
      ::open(journal_path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  require_done(static_cast<bool>(journal), "open the journal");
  require_done(write_all(journal.get(), 0, bytes), "write");
  require_done(write_all(journal.get(), bytes.size(), std::as_bytes(std::span(&checksum, 1))),
               "write");
  require_done(fsync(journal.get()) == 0, "flush the journal");
}

bool JournaledFile::is_on_disk(std::uint64_t index, const Page& page) const {
  Page there{};
  read_some(file_.get(), index * page_bytes, there);
  return there == page;
}

// The lowest page, which makes the change effective, is written last.
void JournaledFile::put_pages_in_place(std::uint64_t end) {
  for (auto page = changed_.rbegin(); page != changed_.rend(); ++page) {
    if (page->first == changed_.begin()->first) require_done(fsync(file_.get()) == 0, "flush");
    put_in_place(page->first, page->second, end);
  }
  changed_.clear();
}

void JournaledFile::commit() {
  if (size_on_disk(file_.get()) < size_)
    require_done(ftruncate(file_.get(), static_cast<off_t>(size_)) == 0, "extend");
  require_done(fsync(file_.get()) == 0, "flush");
  std::erase_if(changed_, [&](const auto& one) { return is_on_disk(one.first, one.second); });
  if (!changed_.empty()) {
    write_journal();
    put_pages_in_place(committed_);
  }
  if (size_on_disk(file_.get()) > size_)
    require_done(ftruncate(file_.get(), static_cast<off_t>(size_)) == 0, "shorten");
  require_done(fsync(file_.get()) == 0, "flush");
  committed_ = size_;
}

void JournaledFile::recover() {
  const FileDescriptor journal(::open(journal_path().c_str(), O_RDONLY | O_CLOEXEC));
  if (!journal) return;
  constexpr std::size_t entry = sizeof(std::uint64_t) + page_bytes;
  std::vector<std::byte> bytes(size_on_disk(journal.get()));
  bytes.resize(read_some(journal.get(), 0, bytes));
  JournalHead head;
  std::uint64_t checksum = 0;
  if (bytes.size() < sizeof head + sizeof checksum) return;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::size_t content = bytes.size() - sizeof checksum;
  std::memcpy(&checksum, bytes.data() + content, sizeof checksum);
  if (head.mark != journal_mark || (content - sizeof head) % entry != 0 ||
      head.pages != (content - sizeof head) / entry ||
      checksum != xxh3(std::span(bytes).first(content)))
    return;
  if (size_on_disk(file_.get()) < head.size) return;  // the journal belongs to another file
  for (std::size_t at = sizeof head; at < content; at += entry) {
    std::uint64_t index = 0;
    std::memcpy(&index, bytes.data() + at, sizeof index);
    std::memcpy(changed_[index].data(), bytes.data() + at + sizeof index, page_bytes);
  }
  put_pages_in_place(head.end);
  require_done(ftruncate(file_.get(), static_cast<off_t>(head.size)) == 0, "shorten");
  require_done(fsync(file_.get()) == 0, "flush");
}

void JournaledFile::close() {
  // A commit that failed half way leaves its journal for whoever opens the file next.
  if (file_ && changed_.empty()) unlink(journal_path().c_str());
  changed_.clear();
  file_ = FileDescriptor();
}

}  // namespace pulvis

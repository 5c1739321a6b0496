#include "engine/files/shared_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/files/output_error.hpp"

namespace pulvis {
namespace {

constexpr std::size_t most_waiting = std::size_t{1} << 20;  // bytes

}  // namespace

bool has_one_view(const std::filesystem::path& folder) {
  struct statfs status {};
  if (statfs(folder.c_str(), &status) != 0) return false;
  constexpr std::uint32_t fuse_magic = 0x65735546;  // not in linux/magic.h: sshfs and others
  const auto kind = static_cast<std::uint32_t>(status.f_type);
  for (const std::uint32_t one :
       {std::uint32_t{NFS_SUPER_MAGIC}, std::uint32_t{SMB_SUPER_MAGIC},
        std::uint32_t{CIFS_SUPER_MAGIC}, std::uint32_t{SMB2_SUPER_MAGIC}, std::uint32_t{V9FS_MAGIC},
        std::uint32_t{AFS_SUPER_MAGIC}, fuse_magic})
    if (kind == one) return false;
  return true;
}

SharedFile::SharedFile(std::filesystem::path file)
    : path_(std::move(file)), file_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (!file_) throw OutputError(path_, "open the file", std::strerror(errno));
  survive_a_full_quota();
}

template <class Action>
void SharedFile::attempt(const char* operation, const Action& action) {
  if (failure_.empty() && !action()) failure_ = std::strerror(errno);
  if (!failure_.empty()) throw OutputError(path_, operation, failure_);
}

void SharedFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
  if (at != waiting_at_ + waiting_.size() || waiting_.size() + bytes.size() > most_waiting)
    pass_on();
  if (waiting_.empty()) waiting_at_ = at;
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

void SharedFile::pass_on() {
  attempt("write its part", [&] { return write_all(file_.get(), waiting_at_, waiting_); });
  waiting_.clear();
}

void SharedFile::flush() {
  pass_on();
  attempt("flush its part to disk", [&] { return fsync(file_.get()) == 0; });
}

}  // namespace pulvis

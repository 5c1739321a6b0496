#include "engine/machine_memory.hpp"

#include <fmt/format.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t remainder(std::uint64_t maximum, std::uint64_t used) {
  return maximum > used ? maximum - used : 0;
}

std::uint64_t of_machine() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::uint64_t kilobytes = 0;
    if (name == "MemAvailable:" && file >> kilobytes) return kilobytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return unlimited;
}

std::uint64_t number_in(const fs::path& path) {
  std::uint64_t number = unlimited;
  std::ifstream file(path);
  return file >> number ? number : unlimited;  // "max": no limit
}

// Bytes of the group in droppable file caches: counted as used, but reclaimed when needed.
std::uint64_t reclaimable_in(const fs::path& folder, const std::string& key) {
  std::ifstream file(folder / "memory.stat");
  std::string name;
  for (std::uint64_t bytes = 0; file >> name >> bytes;)
    if (name == key) return bytes;
  return 0;
}

struct Version {
  const char *maximum, *used, *reclaimable;
};
constexpr Version version_1{"memory.limit_in_bytes", "memory.usage_in_bytes",
                            "total_inactive_file"};
constexpr Version version_2{"memory.max", "memory.current", "inactive_file"};

std::uint64_t left_in(const fs::path& folder, const Version& version) {
  const std::uint64_t maximum = number_in(folder / version.maximum);
  const std::uint64_t used = number_in(folder / version.used);
  if (maximum == unlimited || used == unlimited) return maximum;
  return remainder(maximum, remainder(used, reclaimable_in(folder, version.reclaimable)));
}

// Minimum over a group and all its parents. In a container the path may be that of the host, while only
// the mount point itself exists.
std::uint64_t left_in_all(const fs::path& mount, const fs::path& group, const Version& version) {
  std::uint64_t minimum = left_in(mount, version);
  fs::path folder = mount;
  for (const fs::path& part : group.relative_path()) {
    folder /= part;
    minimum = std::min(minimum, left_in(folder, version));
  }
  return minimum;
}

bool has_memory(std::string controllers) {
  controllers = "," + controllers + ",";
  return controllers.find(",memory,") != std::string::npos;
}

}  // namespace

// A line is "4:memory:/group" in version 1, "0::/group" in version 2; both may be present.
std::uint64_t left_by_control_groups(const fs::path& table, const fs::path& root) {
  std::uint64_t minimum = unlimited;
  std::ifstream file(table);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (has_memory(controllers))
      minimum = std::min(minimum, left_in_all(root / "memory", group, version_1));
    if (!controllers.empty()) continue;
    minimum = std::min(minimum, left_in_all(root, group, version_2));
    minimum = std::min(minimum, left_in_all(root / "unified", group, version_2));
  }
  return minimum;
}

std::uint64_t left_by_machine() {
  return std::min(of_machine(), left_by_control_groups("/proc/self/cgroup", "/sys/fs/cgroup"));
}

std::uint64_t left_by_shell() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return remainder(limit.rlim_cur, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

std::uint64_t available_memory() { return std::min(left_by_machine(), left_by_shell()); }

std::string bytes_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value >= 1e9) return fmt::format("{:.3g} GB", value * 1e-9);
  return fmt::format("{:.3g} MB", value * 1e-6);
}

}  // namespace pulvis

#include "engine/ranks/machine_name.hpp"

#include <unistd.h>

#include <array>
#include <fstream>

namespace pulvis {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string machine_name() {
  std::string name;
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::getline(file, name);
  return name.empty() ? host_name() : name;
}

}  // namespace pulvis

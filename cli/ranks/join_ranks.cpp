#include "cli/ranks/join_ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string_view>

#include "cli/ranks/mpi_plugin.hpp"
#include "cli/shell_word.hpp"
#include "engine/instruction_set.hpp"
#include "engine/ranks/machine_name.hpp"

namespace pulvis {
namespace {

constexpr std::size_t most_bytes_at_once = std::size_t{1} << 30;

// An integer from the environment; 0 if not set.
int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  int number = 0;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

const MpiPlugin& mpi_plugin() {
  void* library =
      dlopen(MpiPlugin::library, RTLD_NOW | RTLD_LOCAL);  // stays loaded: MPI cannot be unloaded
  if (library == nullptr)
    throw NoMpi(
        fmt::format("several ranks need MPI: install the package pulvis-mpi, or build with "
                    "-DPULVIS_MPI=ON ({})",
                    dlerror()));
  void* entry = dlsym(library, MpiPlugin::entry);
  const MpiPlugin* plugin = nullptr;
  if (entry != nullptr) plugin = reinterpret_cast<const MpiPlugin* (*)()>(entry)();
  if (plugin == nullptr || plugin->build != build_identity())
    throw NoMpi(fmt::format("{} is from another build, {}; this program is {}: reinstall both",
                            MpiPlugin::library, plugin == nullptr ? "unknown" : plugin->build,
                            build_identity()));
  return *plugin;
}

Ranks::Bytes bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string text_of(const Ranks::Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string own_words() {  // of the command line, without the program's path
  std::ifstream file("/proc/self/cmdline");
  std::string words = "pulvis", word;
  std::getline(file, word, '\0');
  while (std::getline(file, word, '\0')) words += ' ' + shell_word(word);
  return words;
}

struct Place {
  std::string machine;
  cpu_set_t processors;
};

Place place_of(const Ranks::Bytes& bytes) {
  Place place;
  std::memcpy(&place.processors, bytes.data(), sizeof place.processors);
  place.machine = text_of({bytes.begin() + sizeof place.processors, bytes.end()});
  return place;
}

// Of one rank, among all places.
int threads_at(const Place& own, const std::vector<Place>& places) {
  double share = 0;
  for (std::size_t i = 0; i < CPU_SETSIZE; ++i) {
    if (!CPU_ISSET(i, &own.processors)) continue;
    const auto sharing = std::ranges::count_if(places, [&](const Place& other) {
      return other.machine == own.machine && CPU_ISSET(i, &other.processors);
    });
    share += 1 / static_cast<double>(sharing);
  }
  constexpr double rounding = 1e-9;  // thirds do not add up to exactly one
  return std::max(1, static_cast<int>(share + rounding));
}

}  // namespace

// A batch script has SLURM_NTASKS and SLURM_PROCID, too; only tasks of a step have what is checked here.
bool started_as_rank() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) return number_in("OMPI_COMM_WORLD_SIZE") > 1;
  const bool has_process_manager =
      std::getenv("PMIX_RANK") != nullptr || std::getenv("PMI_RANK") != nullptr;
  return has_process_manager && number_in("SLURM_STEP_NUM_TASKS") > 1;
}

bool started_by_mpirun() {
  const bool only_one =
      std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr && std::getenv("PMIX_RANK") != nullptr;
  return only_one || started_as_rank();
}

void require_mpi() { mpi_plugin(); }

void require_alike(Ranks& ranks, const std::string& own, const std::string& rule) {
  const auto all = ranks.gather(bytes_of(host_name() + '\n' + own));
  const auto told = [](const Ranks::Bytes& bytes) {
    const std::string text = text_of(bytes);
    const auto end = text.find('\n');
    return std::array{text.substr(end + 1), text.substr(0, end)};
  };
  Ranks::Bytes refusal;
  for (std::size_t i = 0; i < all.size() && refusal.empty(); ++i) {
    const auto [first, first_host] = told(all[0]);
    const auto [other, other_host] = told(all[i]);
    if (other != first)
      refusal = bytes_of(fmt::format("{}: rank 0 on {}: {}, rank {} on {}: {}", rule, first_host,
                                     first, i, other_host, other));
  }
  ranks.broadcast(refusal);
  if (!refusal.empty()) throw UnlikeRanks(ranks.is_root() ? text_of(refusal) : "");
}

std::unique_ptr<Ranks> join_ranks() {
  if (!started_as_rank()) return nullptr;
  std::unique_ptr<Ranks> ranks(mpi_plugin().join(most_bytes_at_once));
  if (ranks->count() == 1) {
    ranks.reset();
    throw NoMpi(
        "this process was started as one of several ranks, but Open MPI sees only this one: start "
        "the ranks with mpirun or srun --mpi=pmix");
  }
  try {
    require_alike(*ranks, build_identity() + " with " + instruction_set(),
                  "all ranks of a run must be the same program on the same kind of processor");
    require_alike(*ranks, own_words(), "all ranks of a run must get the same command");
  } catch (const UnlikeRanks& refusal) {
    const std::string what = refusal.what();
    ranks.reset();
    throw UnlikeRanks(what);
  }
  return ranks;
}

MachineShare machine_share_of(Ranks& ranks) {
  cpu_set_t own;
  CPU_ZERO(&own);
  if (sched_getaffinity(0, sizeof own, &own) != 0) CPU_SET(0, &own);
  Ranks::Bytes place(sizeof own);
  std::memcpy(place.data(), &own, sizeof own);
  const Ranks::Bytes machine = bytes_of(machine_name());
  place.insert(place.end(), machine.begin(), machine.end());

  std::vector<Place> places;
  for (const Ranks::Bytes& bytes : ranks.gather(place)) places.push_back(place_of(bytes));
  std::vector<MachineShare> shares(static_cast<std::size_t>(ranks.count()));
  if (ranks.is_root())
    std::ranges::transform(places, shares.begin(), [&](const Place& one) {
      const auto here = std::ranges::count(places, one.machine, &Place::machine);
      return MachineShare{threads_at(one, places), static_cast<int>(here)};
    });
  Ranks::Bytes bytes(shares.size() * sizeof(MachineShare));
  std::memcpy(bytes.data(), shares.data(), bytes.size());
  ranks.broadcast(bytes);
  std::memcpy(shares.data(), bytes.data(), bytes.size());
  return shares[static_cast<std::size_t>(ranks.rank())];
}

}  // namespace pulvis

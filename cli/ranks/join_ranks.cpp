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
#include "engine/machine_memory.hpp"
#include "engine/ranks/machine_name.hpp"
#include "engine/state_bytes.hpp"

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

// Where a rank runs.
struct Place {
  std::string machine = machine_name(), host = host_name();
  std::uint64_t left_by_machine = pulvis::left_by_machine(),
                left_by_shell = pulvis::left_by_shell();
  std::vector<std::uint8_t> processors;  // [CPU_SETSIZE], those that it may use

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(machine, host, left_by_machine, left_by_shell, processors);
  }
};

Place own_place() {
  cpu_set_t own;
  CPU_ZERO(&own);
  if (sched_getaffinity(0, sizeof own, &own) != 0) CPU_SET(0, &own);
  Place place;
  for (std::size_t i = 0; i < CPU_SETSIZE; ++i)
    place.processors.push_back(CPU_ISSET(i, &own) ? 1 : 0);
  return place;
}

std::vector<MachineMemory> machines_of(const std::vector<Place>& places) {
  std::vector<MachineMemory> machines;
  std::vector<std::string> names;
  for (const Place& place : places) {
    const auto at =
        static_cast<std::size_t>(std::ranges::find(names, place.machine) - names.begin());
    if (at == names.size()) {
      names.push_back(place.machine);
      machines.push_back({place.host, 0, place.left_by_machine, place.left_by_shell});
    }
    MachineMemory& machine = machines[at];
    machine.ranks += 1;
    machine.left = std::min(machine.left, place.left_by_machine);
    machine.left_to_each = std::min(machine.left_to_each, place.left_by_shell);
  }
  return machines;
}

// Of one rank, among all places.
int threads_at(const Place& own, const std::vector<Place>& places) {
  double share = 0;
  for (std::size_t i = 0; i < CPU_SETSIZE; ++i) {
    if (own.processors[i] == 0) continue;
    const auto sharing = std::ranges::count_if(places, [&](const Place& other) {
      return other.machine == own.machine && other.processors[i] != 0;
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
  StateWriter writer;
  own_place().state(writer);
  std::vector<Place> places;
  for (const Ranks::Bytes& bytes : ranks.gather(writer.bytes())) {
    StateReader reader(bytes);
    places.emplace_back().state(reader);
  }
  std::vector<std::int64_t> threads(static_cast<std::size_t>(ranks.count()));
  std::ranges::transform(places, threads.begin(),
                         [&](const Place& one) { return threads_at(one, places); });
  ranks.sum(threads);  // only the root has any
  return {static_cast<int>(threads[static_cast<std::size_t>(ranks.rank())]), machines_of(places)};
}

}  // namespace pulvis

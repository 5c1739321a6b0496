// All that a run leaves, and one that was stopped and resumed must leave, too.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/files/hdf5.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {

struct Left {
  std::string history, xdmf, state_hash;
  nlohmann::json summary;  // but for what the machine has a say in
  std::map<std::string, std::vector<std::uint64_t>> numbers;  // as bits: 0 is not -0
};

inline Left left_in(const std::filesystem::path& folder) {
  auto summary = nlohmann::json::parse(text_of(folder / "summary.json"));
  for (const char* of_machine :
       {"wall_seconds", "peak_memory_bytes", "element_updates_per_second", "cost", "threads"})
    summary.erase(of_machine);
  Left left{text_of(folder / "history.csv"),
            text_of(folder / "run.xdmf"),
            summary.at("state_hash"),
            summary,
            {}};
  const auto file = hdf5::File::open(folder / "run.h5");
  for (const std::string group : {"/history", "/cracks", "/frames", "/images"}) {
    if (!file.contains(group)) continue;
    for (const std::string& name : file.datasets_below(group)) {
      std::vector<std::uint64_t>& bits = left.numbers[group + "/" + name];
      for (const double value : file.read_doubles(group + "/" + name))
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  }
  return left;
}

inline void expect_same(const Left& a, const Left& b) {
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.summary, b.summary);
  EXPECT_TRUE(a.history == b.history) << "history.csv differs";
  EXPECT_TRUE(a.xdmf == b.xdmf) << "run.xdmf differs";
  ASSERT_EQ(a.numbers.size(), b.numbers.size());
  for (const auto& [name, bits] : a.numbers) {
    ASSERT_TRUE(b.numbers.contains(name)) << name << " is missing";
    EXPECT_TRUE(bits == b.numbers.at(name)) << name << " differs";
  }
}

}  // namespace pulvis

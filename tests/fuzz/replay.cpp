// Plays the kept corpus back: replay CORPUS_DIR. Every input also comes shortened, and with bytes flipped, so
// that readers are shaken in every test run, with any compiler.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "targets.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string content = text.str();
  return {content.begin(), content.end()};
}

constexpr int changes_an_input = 20;

int replay(const pulvis::fuzz::Target& target, const std::filesystem::path& folder) {
  int inputs = 0;
  std::mt19937 random(1);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Bytes right = bytes_of(entry.path());
    target.run(right);
    ++inputs;
    for (int i = 0; i < changes_an_input && !right.empty(); ++i) {
      Bytes wrong = right;
      if (i % 4 == 0) wrong.resize(random() % right.size());
      for (int k = 0; k < i % 4 && !wrong.empty(); ++k)
        wrong[random() % wrong.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
      target.run(wrong);
      ++inputs;
    }
  }
  return inputs;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (const auto& target : pulvis::fuzz::targets()) {
    const int inputs = replay(target, std::filesystem::path(argv[1]) / target.name);
    std::printf("%s: %d inputs\n", target.name, inputs);
    if (inputs == 0) return 1;
  }
  return 0;
}

#include "scenes/scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>

#include "engine/files/xxh3.hpp"
#include "scenes/language/named_files.hpp"
#include "scenes/read.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using document::Table;

// At most this many bytes of `name`, cut between characters: the result must fit in a file name.
std::string shortened(std::string name) {
  constexpr std::size_t longest = 100;
  if (name.size() <= longest) return name;
  std::size_t length = longest;
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U) --length;
  name.resize(length);
  return name;
}

std::string marked(const std::string& name, std::uint64_t hash) {
  const std::string mark = fmt::format("-{:08x}", hash >> 32U);
  return name.ends_with(mark) ? name : shortened(name) + mark;
}

class InputKeeper {
 public:
  InputKeeper(const fs::path& folder, const OtherScenes& others)
      : folder_(folder), others_(others) {}

  void keep(schema::Kind kind, std::string& path) {
    if (kind == schema::Kind::file) path = keep_file(folder_ / path).string();
    const auto other = others_.find(folder_ / path);
    if (kind == schema::Kind::scene && other != others_.end())
      path = keep_scene(other->first, other->second).string();
  }

  std::vector<InputFile> inputs;

 private:
  fs::path keep_file(const fs::path& source) {
    const std::uint64_t hash = file_hash(source);
    const std::string name = marked(source.stem().string(), hash);
    return add({source, "inputs" / fs::path(name + source.extension().string()), {}, hash});
  }

  // In a separate folder, with the files that it refers to.
  fs::path keep_scene(const fs::path& source, const LoadedScene& other) {
    const bool is_copy = source.filename() == "scene.toml" && source.has_parent_path();
    const fs::path name = is_copy ? source.parent_path().filename() : source.stem();
    const fs::path folder = "inputs" / fs::path(marked(name.string(), other.hash));
    for (InputFile input : other.inputs) {
      input.copy = folder / input.copy;
      add(input);
    }
    return add({source, folder / "scene.toml", other.text, other.hash});
  }

  fs::path add(const InputFile& input) {
    if (std::ranges::find(inputs, input.copy, &InputFile::copy) == inputs.end())
      inputs.push_back(input);
    return input.copy;
  }

  const fs::path& folder_;
  const OtherScenes& others_;
};

}  // namespace

std::vector<InputFile> keep_inputs(Table& root, const fs::path& folder, const OtherScenes& others,
                                   const schema::Language& language) {
  InputKeeper keeper(folder, others);
  for_each_path(root, language,
                [&](schema::Kind kind, std::string& path) { keeper.keep(kind, path); });
  return keeper.inputs;
}

std::string name_before_copying(const fs::path& path) {
  const std::string folder = path.parent_path().filename().string();
  const std::size_t end =
      folder.size() < 9 ? 0 : folder.size() - 9;  // of the name, before -5f0c2a91
  const bool is_copy = end > 0 && folder[end] == '-' && path.filename() == "scene.toml" &&
                       path.parent_path().parent_path() == "inputs";
  return is_copy ? folder.substr(0, end) + ".toml" : path.string();
}

std::uint64_t file_hash(const fs::path& file) {
  Xxh3 hash;
  if (!fs::is_regular_file(file)) return hash.value();
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1U << 16U> piece{};
  while (stream) {
    stream.read(piece.data(), piece.size());
    const auto length = static_cast<std::size_t>(stream.gcount());
    hash.add(std::as_bytes(std::span(piece).first(length)));
  }
  return hash.value();
}

std::uint64_t hash_with_inputs(const std::vector<InputFile>& inputs, std::uint64_t hash) {
  // A saved scene names its files in a different order from the original.
  std::vector<std::uint64_t> hashes;
  for (const InputFile& input : inputs) hashes.push_back(input.hash);
  std::ranges::sort(hashes);
  for (const std::uint64_t& of_file : hashes)
    hash = xxh3(std::as_bytes(std::span(&of_file, 1)), hash);
  return hash;
}

}  // namespace pulvis

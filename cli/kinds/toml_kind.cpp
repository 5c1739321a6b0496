#include "cli/kinds/toml_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/campaigns/fit/declare_fit.hpp"
#include "cli/campaigns/probe/declare_probe.hpp"
#include "cli/campaigns/study/declare_study.hpp"
#include "cli/laboratory/lab_settings.hpp"
#include "engine/printable.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/read.hpp"

namespace pulvis {
namespace {

struct FileKind {
  const char* command;
  const char* name;
  const schema::Language& (*language)();
};

constexpr std::array<FileKind, 5> file_kinds{{{"run", "a scene", schema::scene_language},
                                              {"study", "a study", schema::study_language},
                                              {"probe", "a probe", schema::probe_language},
                                              {"fit", "a fit", schema::fit_language},
                                              {"reduce", "settings of records", lab::language}}};

const FileKind& kind_read_by(const std::string& command) {
  const auto found = std::ranges::find(file_kinds, command, &FileKind::command);
  return found == file_kinds.end() ? file_kinds.front() : *found;  // check, plan, pack, preview
}

bool knows_all(const FileKind& kind, const document::Table& root) {
  const schema::Language& language = kind.language();
  const std::vector<std::string> words = schema::known_words(language.front(), language);
  return std::ranges::all_of(root, [&](const document::Entry& entry) {
    return std::ranges::find(words, entry.key) != words.end();
  });
}

}  // namespace

std::optional<std::string> other_kind(const std::string& command,
                                      const std::filesystem::path& file) {
  try {
    const document::Table root = document::parse(toml_file_text(file));
    const FileKind& own = kind_read_by(command);
    if (root.empty() || knows_all(own, root)) return std::nullopt;
    for (const FileKind& kind : file_kinds)
      if (knows_all(kind, root)) {
        const document::Entry& first = root.front();
        return fmt::format("{0}:{1}:{2}: {3}: the file is {4}, not {5}, allowed: pulvis {6} {0}",
                           printable(file.string()), first.origin.mark.line,
                           first.origin.mark.column, printable(first.key), kind.name, own.name,
                           kind.command);
      }
  } catch (const std::exception&) {  // not TOML, and refused as such
  }
  return std::nullopt;
}

}  // namespace pulvis

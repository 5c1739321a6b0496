// docs/series.md: every series, field and column of the shipped scenes, from the rows of results.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "scenes/lever/afm_series.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/results/history_series.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using namespace testing;

struct Row {
  std::string name, in, unit, label, meaning;
  bool describes_same(const Row& other) const {
    return unit == other.unit && label == other.label && meaning == other.meaning;
  }
};

// One list of the page: a row for each name, or two where the dimensions differ.
class Rows {
 public:
  void add(const char* in, const auto& infos) {
    for (const auto& info : infos) add({info.name, in, info.unit, info.label, info.meaning});
  }
  std::string text() const {
    std::string text = "| name | in | unit | label | meaning |\n|---|---|---|---|---|\n";
    for (const Row& row : rows_)
      text += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.name, row.in, row.unit, row.label,
                          row.meaning);
    return text;
  }

 private:
  void add(Row row) {
    EXPECT_THAT(row.label, Not(IsEmpty())) << row.name;
    if (row.name.starts_with("tool/")) call_tool(row);
    const auto known = [&](const Row& r) {
      return r.name == row.name && r.in.find(row.in) != std::string::npos;
    };
    if (std::ranges::any_of(rows_, known)) return;
    const auto same = std::ranges::find_if(
        rows_, [&](const Row& r) { return r.name == row.name && r.describes_same(row); });
    if (same == rows_.end())
      rows_.push_back(std::move(row));
    else
      same->in += ", " + row.in;
  }
  static void call_tool(Row& row) {
    const std::string tool = row.name.substr(5, row.name.rfind('/') - 5);
    for (std::string* text : {&row.name, &row.label})
      text->replace(text->find(tool, text == &row.name ? 5 : 0), tool.size(), "NAME");
  }

  std::vector<Row> rows_;
};

struct Lists {
  Rows history, momentum, fields, cracks, lever;
  void add(const std::string& file, const std::vector<std::string>& changes) {
    const Scene scene = read_scene(paths::source_dir() + "/scenes/" + file, changes);
    const char* in = scene.in_space() ? "3D" : "2D";
    history.add(in, history_series(scene));
    momentum.add(in, momentum_series(scene));
    fields.add(in, frame_fields(scene).infos());
    for (const TableInfo& table : bond_tables(scene)) cracks.add(in, table.columns);
  }
};

std::string page() {
  Lists all;
  all.fields.add("2D", Experiment("compaction/unit-cell.toml").results.fields());
  all.fields.add("3D", Experiment("compaction-3d/unit-cell-sc.toml").results.fields());
  const std::string contacts = "output.contacts=true", stress = "output.particle_stress=true";
  all.add("compaction/unit-cell.toml", {contacts, stress, "output.density_cells=[2,2]"});
  all.add("compaction-3d/unit-cell-sc.toml", {contacts, stress, "output.density_cells=[2,2,2]"});
  all.add("basic/damped-strut.toml", {});
  all.add("compaction/biaxial.toml", {});
  all.add("periodic/shear.toml", {contacts});
  all.add("periodic/spheres-shear.toml", {contacts});
  all.add("shear/flat-16.toml", {contacts});
  all.add("bonds/pulled-blocks.toml", {});
  all.add("compaction-3d/tablet-bonded.toml", {});
  all.lever.add("lever", afm_series());
  return fmt::format(
      "# Series and fields\n\n"
      "What a run records, with the `unit`, `label` and `meaning` that `run.h5` has for each. Made "
      "from the rows of results\n"
      "(`scenes/results`, `scenes/lever/afm_series.cpp`) by the test `SeriesPage`; details are in "
      "[results.md](results.md) and\n"
      "[afm.md](afm.md). A run has those that its scene asks for.\n\n"
      "## Over time: `/history`, `history.csv`\n\n{}\n"
      "Only for `[[expect]]`:\n\n{}\n"
      "## In frames: `/frames/N`\n\n{}\n"
      "## Breaking bonds: `/cracks`\n\n{}\n"
      "## Levers, over actions completed: `/history`, `history.csv`\n\n{}",
      all.history.text(), all.momentum.text(), all.fields.text(), all.cracks.text(),
      all.lever.text());
}

TEST(SeriesPage, IsWhatTheRowsSay) {
  const std::string made = page();
  std::stringstream there;
  there << std::ifstream(paths::source_dir() + "/docs/series.md").rdbuf();
  const auto renewed = std::filesystem::temp_directory_path() / "series.md";
  if (there.str() != made) std::ofstream(renewed) << made;
  EXPECT_TRUE(there.str() == made) << "docs/series.md is not current: copy " << renewed;
}

}  // namespace
}  // namespace pulvis

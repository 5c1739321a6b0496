// A study: one or several scenes, run with a table of variations, and what must hold across them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/language/document.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct StudySetting {  // one key of the scene set to one value, as --set does
  std::string path;    // "contact.friction"
  document::Value value;
  document::Origin origin;

  std::string text() const;  // "contact.friction=0.1"
};

struct StudyAxis {  // one line of [grid]
  std::string path;
  std::vector<StudySetting> settings;
};

struct VariationSpec {  // [[variation]]
  std::string name, scene;
  std::vector<StudySetting> settings;
  SourceMark mark;
};

struct StudyCurve {  // [[curve]]
  std::string title, x = "relative_density", y;
  SourceMark mark;
};

struct StudyQuantity {  // one number per run
  using Bound = ExpectSpec::Bound;
  enum class When { end, max, min, mean, roughness };
  std::string series, against;
  std::optional<When> when;
  std::optional<Bound> at, from, until;  // of `against`
};

struct StudyBounds {
  std::optional<ExpectSpec::Bound> above, below, equals;
  std::optional<double> within;
};

struct StudyExpect : StudyQuantity, StudyBounds {  // [[expect]]
  enum class Trend { increasing, decreasing };
  std::vector<std::string> order, ratio, effect, exceeds;
  std::optional<Trend> trend;
  double by = 0, factor = 1;
  std::string of;
  SourceMark mark;
};

struct StudyFit : StudyQuantity, StudyBounds {  // [[fit]], of a strength or a value
  enum class Law { weibull, ryshkewitch_duckworth, power };
  std::string title;
  Law law = Law::weibull;
  std::optional<double> area;                // m^2, by which the force is divided
  std::string disc;                          // class of the crushed particle
  std::string density = "relative_density";  // series
  std::vector<std::string> by;               // keys whose values divide the runs into groups
  std::string key;                           // of the scene; its power law is fitted
  SourceMark mark;
};

struct StudySpec {
  std::string title, scene;
  std::vector<std::int64_t> seeds;
  std::vector<std::string> overrides;  // as for --set
  std::vector<StudySetting> common;    // [set]
  std::vector<StudyAxis> grid;
  std::vector<VariationSpec> list;
  std::vector<StudyCurve> curves;
  std::vector<StudyExpect> expects;
  std::vector<StudyFit> fits;
};

// One run of a study. Runs that differ only in their seed form one variation.
struct StudyRun {
  std::string name;       // of its folder: "friction=0.1", "friction=0.1,seed=2"
  std::string variation;  // "friction=0.1"
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::vector<StudySetting> varied;  // what distinguishes it from the others, without the seed
  std::optional<std::int64_t> seed;
  Scene scene;
  std::uint64_t hash = 0;  // of the scene as it will be run
};

struct Study {
  StudySpec spec;
  std::filesystem::path file;
  std::string text;  // of the file
  std::vector<std::string> overrides;
  std::set<std::filesystem::path> files;  // that the scenes have read
  std::vector<StudyRun> runs;
  std::vector<std::string> variations;  // in the order of the runs
};

}  // namespace pulvis

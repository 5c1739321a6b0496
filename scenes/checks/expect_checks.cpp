#include "scenes/checks/expect_checks.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>

#include "scenes/language/units.hpp"
#include "scenes/lever/afm_figures.hpp"
#include "scenes/results/results.hpp"

namespace pulvis {
namespace {

using When = ExpectSpec::When;

const SeriesInfo* find_series(const std::vector<SeriesInfo>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &SeriesInfo::name);
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> known_series(const Scene& scene) {
  std::vector<std::string> names;
  for (const SeriesInfo& series : expectable_series(scene)) names.push_back(series.name);
  if (!scene.afm)
    names.insert(names.end(), std::begin(figures_of_a_run), std::end(figures_of_a_run));
  return names;
}

class ExpectChecks {
 public:
  ExpectChecks(Scene& scene, const std::function<Scene(const std::filesystem::path&)>& read_other,
               const schema::Origins& origins, Problems& problems)
      : scene_(scene), read_other_(read_other), origins_(origins), problems_(problems) {}

  void run() {
    for (std::size_t i = 0; i < scene_.expects.size(); ++i) {
      path_ = fmt::format("expect[{}]", i);
      ExpectSpec& expect = scene_.expects[i];
      if (expect.series.empty() == !expect.stops)
        refuse("", "neither or both of `series` and `outcome` are given, allowed: one of them");
      else if (expect.stops)
        outcome(expect, i);
      else
        series(expect);
    }
  }

 private:
  void refuse(const std::string& key, const std::string& message) {
    auto found = origins_.find(schema::joined_path(path_, key));
    if (key.empty() || found == origins_.end()) found = origins_.find(path_);
    problems_.add(found->second, key.empty() ? path_ : schema::joined_path(path_, key), message);
  }

  void outcome(const ExpectSpec& expect, std::size_t i) {
    const auto first = std::ranges::find(scene_.expects, true, &ExpectSpec::stops);
    if (first - scene_.expects.begin() < static_cast<std::ptrdiff_t>(i))
      refuse("outcome", "is the second one of the scene, allowed: one, since a run ends only once");
    if (expect.message.empty())
      refuse("message",
             "required key is missing, allowed: a regular expression that matches part of the "
             "message of the stopped run");
    if (const re2::RE2 pattern(expect.message, re2::RE2::Quiet); !pattern.ok())
      refuse("message", fmt::format("not a regular expression ({}), allowed: the syntax of RE2, "
                                    "with \\ before literal special characters",
                                    pattern.error()));
  }

  void series(ExpectSpec& expect) {
    const std::vector<std::string> known = known_series(scene_);
    if (std::ranges::find(known, expect.series) == known.end()) {
      refuse("series", fmt::format("the run has no such series{}, allowed: {}",
                                   suggestion(expect.series, known), listed(known)));
      return;
    }
    const std::vector<SeriesInfo> all = expectable_series(scene_);
    const SeriesInfo* info = find_series(all, expect.series);
    bounds(expect, info == nullptr ? "-" : info->unit);
    window(expect);
    if (!expect.like.empty() && scene_.afm)
      refuse("like", "AFM scenes are not compared with others, allowed: bounds or `equals`");
    else if (!expect.like.empty())
      other(expect);
  }

  void convert(std::optional<ExpectSpec::Bound>& bound, const std::string& key,
               const std::string& unit) {
    if (const std::string fault = settle_bound(bound, unit); !fault.empty()) refuse(key, fault);
  }

  void bounds(ExpectSpec& expect, const std::string& unit) {
    convert(expect.above, "above", unit);
    convert(expect.below, "below", unit);
    convert(expect.equals, "equals", unit);
    const bool range = expect.above || expect.below, like = !expect.like.empty();
    const int kinds = int{range} + int{expect.equals.has_value()} + int{like};
    if (kinds != 1)
      refuse("series", fmt::format("{} of bounds, `equals` and `like` given, allowed: `above` and "
                                   "`below`, or `equals`, or `like`",
                                   kinds == 0 ? "none" : "more than one"));
    if (expect.above && expect.below && expect.above->number > expect.below->number)
      refuse("above", fmt::format("{:g} is above the other bound, {:g}, allowed: above <= below",
                                  expect.above->number, expect.below->number));
    if (kinds == 1 && !range && !expect.within)
      refuse("within", "required key is missing, allowed: a number >= 0");
    if (kinds == 1 && range && expect.within)
      refuse("within", "has no effect on bounds, allowed: with `equals` or `like`");
  }

  void window(const ExpectSpec& expect) {
    const When when = expect.when.value_or(expect.like.empty() ? When::end : When::always);
    if (when != When::end && is_figure_of_a_run(expect.series))
      refuse("when", "this is one value of the whole run, allowed: when = \"end\"");
    if (when != When::end && when != When::always && !expect.like.empty())
      refuse("when", "scenes are compared sample by sample, allowed: \"always\" or \"end\"");
    for (const auto& [key, share] : {std::pair{"from", expect.from}, {"until", expect.until}})
      if (when == When::end && share)
        refuse(key, "has no effect on the last sample, allowed: with another `when`");
    if (expect.from.value_or(0) >= expect.until.value_or(1))
      refuse("from", "is not before `until`, allowed: from < until");
  }

  void other(const ExpectSpec& expect) {
    try {
      const Scene other = read_other_(other_scene(scene_, expect));
      const std::vector<std::string> known = known_series(other);
      if (std::ranges::find(known, expect.series) == known.end())
        refuse("like", fmt::format("a run of '{}' has no series '{}', allowed: a scene with it",
                                   expect.like, expect.series));
    } catch (const SceneError& error) {
      refuse("like", fmt::format("{}, allowed: a valid scene", error.what()));
    }
  }

  Scene& scene_;
  const std::function<Scene(const std::filesystem::path&)>& read_other_;
  const schema::Origins& origins_;
  Problems& problems_;
  std::string path_;
};

}  // namespace

bool is_figure_of_a_run(const std::string& name) {
  const auto afm = afm_figures();
  return std::ranges::find(figures_of_a_run, name) != std::end(figures_of_a_run) ||
         std::ranges::find(afm, name, &SeriesInfo::name) != afm.end();
}

std::vector<SeriesInfo> expectable_series(const Scene& scene) {
  if (scene.afm) return afm_expectable_series(scene);
  std::vector<SeriesInfo> all = history_series(scene);
  const std::vector<SeriesInfo> momentum = momentum_series(scene);
  all.insert(all.end(), momentum.begin(), momentum.end());
  return all;
}

std::string settle_bound(std::optional<ExpectSpec::Bound>& bound, const std::string& unit) {
  if (!bound || bound->quantity.empty()) return "";
  if (unit == "-") return "is compared with a dimensionless series, allowed: a number";
  try {
    bound->number = parse_quantity(bound->quantity, unit);
  } catch (const UnitError& error) {
    return fmt::format("{}, allowed: a number in {}, or a quantity of that dimension", error.what(),
                       unit);
  }
  return "";
}

std::filesystem::path other_scene(const Scene& scene, const ExpectSpec& expect) {
  return scene.file.parent_path() / expect.like;
}

void complete_and_check_expectations(
    Scene& scene, const std::function<Scene(const std::filesystem::path&)>& read_other,
    const schema::Origins& origins, Problems& problems) {
  ExpectChecks(scene, read_other, origins, problems).run();
}

}  // namespace pulvis

#include "cli/campaigns/study/analysis/study_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/campaigns/study/analysis/study_fits.hpp"
#include "cli/campaigns/study/analysis/study_power.hpp"
#include "cli/campaigns/study/analysis/study_series.hpp"
#include "scenes/checks/expect_checks.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/seed_list.hpp"
#include "scenes/spec/dimension_words.hpp"

namespace pulvis {
namespace {

const SeriesInfo* find_series(const std::vector<SeriesInfo>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &SeriesInfo::name);
  return found == all.end() ? nullptr : &*found;
}

std::string unit_in(const std::vector<SeriesInfo>& all, const std::string& name) {
  const SeriesInfo* series = find_series(all, name);
  return series == nullptr ? "-" : series->unit;
}

std::vector<std::string> names_of(const std::vector<SeriesInfo>& all) {
  std::vector<std::string> names;
  for (const SeriesInfo& series : all) names.push_back(series.name);
  return names;
}

class StudyChecks {
 public:
  StudyChecks(Study& study, const schema::Origins& origins, Problems& problems)
      : study_(study), origins_(origins), problems_(problems) {}

  void run() {
    seeds();
    curves();
    for (std::size_t i = 0; i < study_.spec.fits.size(); ++i) {
      path_ = fmt::format("fit[{}]", i);
      fit(study_.spec.fits[i]);
    }
    for (std::size_t i = 0; i < study_.spec.expects.size(); ++i) {
      path_ = fmt::format("expect[{}]", i);
      expect(study_.spec.expects[i]);
    }
  }

 private:
  void refuse(const std::string& key, const std::string& message) {
    const std::string path = schema::joined_path(path_, key);
    auto found = origins_.find(path);
    if (key.empty() || found == origins_.end()) found = origins_.find(path_);
    problems_.add(found->second, path, message);
  }

  void seeds() {
    if (repeats_a_seed(study_.spec.seeds)) refuse("seeds", repeated_seed);
  }

  void curves() {
    for (std::size_t i = 0; i < study_.spec.curves.size(); ++i) {
      path_ = fmt::format("curve[{}]", i);
      const StudyCurve& curve = study_.spec.curves[i];
      drawn("x", curve.x);
      drawn("y", curve.y);
    }
    if (study_.spec.curves.empty()) usual_curves();
  }

  // A curve is drawn from the runs that have its series: one is enough.
  void drawn(const std::string& key, const std::string& name) {
    std::vector<std::string> known;
    for (const StudyRun& run : study_.runs) {
      known = names_of(study_series(run.scene));
      std::erase_if(known, is_figure_of_a_run);  // a single number, not a curve
      if (std::ranges::find(known, name) != known.end()) return;
    }
    refuse(key, fmt::format("no run has the series '{}'{}, allowed: {}", name,
                            suggestion(name, known), listed(known)));
  }

  void usual_curves() {
    const std::vector<SeriesInfo> all = study_series(study_.runs.front().scene);
    const auto add = [&](const std::string& y, const std::string& x) {
      if (find_series(all, x) != nullptr && find_series(all, y) != nullptr)
        study_.spec.curves.push_back({"", x, y, {}});
    };
    add("stress_ratio/axial", "relative_density");
    const std::string_view axes = words_of(study_.runs.front().scene).axes;
    add(std::string("tool/top/force_") + axes.back(), "travel/top");
    const bool by_study = find_series(all, "transmission") != nullptr;
    add(by_study ? "transmission" : "stress/transmission", "relative_density");
    if (study_.spec.curves.empty()) add("energy/external", "time");
    add("probe/force_y", "scanner/y");
    add("probe/force_z", "scanner/z");
  }

  void expect(StudyExpect& expect) {
    const bool bounds = expect.above || expect.below || expect.equals;
    const int kinds = int{!expect.order.empty()} + int{!expect.ratio.empty()} +
                      int{!expect.effect.empty()} + int{!expect.of.empty()};
    if (kinds != 1)
      refuse("", fmt::format("{} of `order`, `ratio`, `effect` and `of` given, allowed: one",
                             kinds == 0 ? "none" : "more than one"));
    if (!expect.order.empty()) order(expect);
    if (!expect.ratio.empty() && expect.ratio.size() != 2)
      refuse("ratio", "allowed: two variations, [\"a\", \"b\"]");
    if (!expect.effect.empty()) effect(expect);
    const bool bounded = !expect.ratio.empty() || !expect.of.empty();
    if (kinds == 1 && bounds && !bounded)
      refuse("",
             "bounds have no effect here, allowed: `above`, `below` and `equals` of `ratio` and "
             "`of`");
    if (kinds == 1 && bounded) one_kind_of_bound(expect);
    names(expect);
  }

  void order(const StudyExpect& expect) {
    if (expect.order.size() < 2) refuse("order", "one variation is given, allowed: two or more");
    if (!expect.trend)
      refuse("trend", "required key is missing, allowed: \"increasing\", \"decreasing\"");
  }

  void effect(const StudyExpect& expect) {
    if (expect.effect.size() != 2) refuse("effect", "allowed: two variations, [\"a\", \"b\"]");
    if (expect.exceeds.size() != 2)
      refuse("exceeds", "allowed: the two variations that `effect` is compared with");
  }

  void one_kind_of_bound(const StudyBounds& expect) {
    const bool range = expect.above || expect.below, equals = expect.equals.has_value();
    if (range == equals)
      refuse("", fmt::format("{}, allowed: `above` and `below`, or `equals` with `within`",
                             range ? "both bounds and `equals` given" : "no bound given"));
    if (equals && !expect.within)
      refuse("within", "required key is missing, allowed: a number >= 0");
  }

  void names(StudyExpect& expect) {
    std::vector<std::string> named = expect.order;
    for (const auto* more : {&expect.ratio, &expect.effect, &expect.exceeds})
      named.insert(named.end(), more->begin(), more->end());
    if (!expect.of.empty()) named.push_back(expect.of);
    const StudyRun* first = nullptr;
    for (const std::string& name : named) {
      const StudyRun* run = first_run_of(study_, name);
      if (run == nullptr) {
        refuse(key_of(expect, name),
               fmt::format("no variation is called '{}'{}, allowed: {}", name,
                           suggestion(name, study_.variations), listed(study_.variations)));
        return;
      }
      if (!has_series(expect, *run)) return;
      if (first == nullptr) first = run;
    }
    if (first != nullptr) units(expect, first->scene);
  }

  static std::string key_of(const StudyExpect& expect, const std::string& name) {
    const auto in = [&](const std::vector<std::string>& list) {
      return std::ranges::find(list, name) != list.end();
    };
    return in(expect.order)     ? "order"
           : in(expect.ratio)   ? "ratio"
           : in(expect.effect)  ? "effect"
           : in(expect.exceeds) ? "exceeds"
                                : "of";
  }

  bool has_series(const StudyQuantity& quantity, const StudyRun& run) {
    const std::vector<SeriesInfo> all = study_series(run.scene);
    for (const auto& [key, name] :
         {std::pair{"series", quantity.series}, {"against", abscissa(quantity, run.scene)}})
      if (find_series(all, name) == nullptr) {
        const bool said = std::string(key) == "series" || !quantity.against.empty();
        refuse(said ? key : "",
               fmt::format("a run of '{}' has no series '{}'{}, allowed: {}", run.variation, name,
                           suggestion(name, names_of(all)), listed(names_of(all))));
        return false;
      }
    return true;
  }

  // Without a position on it the abscissa does not matter.
  static std::string abscissa(const StudyQuantity& quantity, const Scene& scene) {
    const bool placed = quantity.at || quantity.from || quantity.until;
    return quantity.against.empty() ? study_abscissa(scene, placed) : quantity.against;
  }

  void place(StudyQuantity& quantity, const Scene& scene) {
    const std::vector<SeriesInfo> all = study_series(scene);
    if (is_figure_of_a_run(quantity.series))
      for (const auto& [key, given] : {std::pair{"when", quantity.when.has_value()},
                                       {"at", quantity.at.has_value()},
                                       {"from", quantity.from.has_value()},
                                       {"until", quantity.until.has_value()}})
        if (given)
          refuse(key, fmt::format("has no effect: '{}' is one value of the whole run, allowed: "
                                  "`series` alone",
                                  quantity.series));
    if (quantity.at && quantity.when)
      refuse("when", "has no effect together with `at`, allowed: only one of them");
    if (!quantity.against.empty() && !quantity.at && !quantity.from && !quantity.until)
      refuse("against",
             "has no effect without `at`, `from` or `until`, allowed: together with one of them");
    if (quantity.at && (quantity.from || quantity.until))
      refuse(quantity.from ? "from" : "until",
             "has no effect together with `at`, allowed: with `when`");
    quantity.against = abscissa(quantity, scene);
    const std::string unit = unit_in(all, quantity.against);
    convert(quantity.at, "at", unit);
    convert(quantity.from, "from", unit);
    convert(quantity.until, "until", unit);
  }

  void units(StudyExpect& expect, const Scene& scene) {
    place(expect, scene);
    const std::vector<SeriesInfo> all = study_series(scene);
    const bool share = expect.of.empty() || expect.when == StudyExpect::When::roughness;
    const std::string unit = share ? "-" : unit_in(all, expect.series);
    bounds(expect, unit);
  }

  void bounds(StudyBounds& given, const std::string& unit) {
    convert(given.above, "above", unit);
    convert(given.below, "below", unit);
    convert(given.equals, "equals", unit);
    if (given.above && given.below && given.above->number > given.below->number)
      refuse("above", "is above the other bound, allowed: above <= below");
  }

  void fit(StudyFit& fit) {
    const bool power = fit.law == StudyFit::Law::power;
    const StudyRun* first = nullptr;
    for (const StudyRun& run : study_.runs) {
      if (power && !sets_key(run, fit.key)) continue;
      if (!has_series(fit, run) || !fits_run(fit, run)) return;
      if (first == nullptr) first = &run;
    }
    if (first == nullptr) return varied("key", fit.key);
    const std::vector<SeriesInfo> all = study_series(first->scene);
    if (power) this->power(fit);
    if (fit.area && !fit.disc.empty())
      refuse("disc", "has no effect together with `area`, allowed: only one of them");
    if ((fit.area || !fit.disc.empty()) && unit_in(all, fit.series) != "N")
      refuse("series",
             fmt::format(
                 "'{}' is not a force, allowed: a series in N, which `{}` converts to a strength",
                 fit.series, fit.area ? "area" : "disc"));
    for (const std::string& key : fit.by) varied("by", key);
    enough(fit);
    place(fit, first->scene);
  }

  void power(StudyFit& fit) {
    bounds(fit, "-");
    if (fit.above || fit.below || fit.equals) one_kind_of_bound(fit);
    std::set<std::pair<std::string, double>> met;
    for (const FitRuns& group : groups_of(study_, fit))
      for (const StudyRun* run : group.runs) {
        const std::optional<double> number = number_of_key(*run, fit.key);
        if (!number || !(*number > 0)) {
          refuse("key", fmt::format("'{}' is not a number above 0 in a run of '{}', allowed: a key "
                                    "whose values are numbers or quantities above 0",
                                    fit.key, run->variation));
          return;
        }
        if (!met.emplace(group.name, *number).second) {
          refuse("key", fmt::format("'{}' has the same value in two runs of '{}', allowed: "
                                    "different ones, without `seeds`",
                                    fit.key, group.name));
          return;
        }
      }
  }

  // Requirements of a fit on every run besides the series.
  bool fits_run(const StudyFit& fit, const StudyRun& run) {
    if (fit.law == StudyFit::Law::ryshkewitch_duckworth) {
      const std::vector<SeriesInfo> all = study_series(run.scene);
      const SeriesInfo* density = find_series(all, fit.density);
      if (density == nullptr || density->unit != "-") {
        refuse("density",
               density == nullptr
                   ? fmt::format("a run of '{}' has no series '{}'{}, allowed: {}", run.variation,
                                 fit.density, suggestion(fit.density, names_of(all)),
                                 listed(names_of(all)))
                   : fmt::format("'{}' is not a relative density, allowed: a dimensionless series",
                                 fit.density));
        return false;
      }
    }
    if (fit.disc.empty() || disc_diameter(run.scene, fit.disc)) return true;
    refuse("disc", fmt::format("'{}' is not a class of discs in a run of '{}', allowed: the name "
                               "of a particle whose outline is a disc",
                               fit.disc, run.variation));
    return false;
  }

  void varied(const std::string& where, const std::string& key) {
    std::vector<std::string> known;
    for (const StudyRun& run : study_.runs)
      for (const StudySetting& setting : run.varied)
        if (std::ranges::find(known, setting.path) == known.end()) known.push_back(setting.path);
    if (std::ranges::find(known, key) == known.end())
      refuse(where, fmt::format("the study does not vary '{}'{}, allowed: {}", key,
                                suggestion(key, known), listed(known)));
  }

  void enough(const StudyFit& fit) {
    for (const FitRuns& group : groups_of(study_, fit))
      if (group.runs.size() < fewest_runs(fit.law))
        refuse("law",
               fmt::format("{} of '{}' can be fitted, allowed: at least {}{}",
                           counted(group.runs.size(), "run"), group.name, fewest_runs(fit.law),
                           fit.law == StudyFit::Law::weibull ? " (`seeds`)" : ""));
  }

  void convert(std::optional<StudyExpect::Bound>& bound, const std::string& key,
               const std::string& unit) {
    if (const std::string fault = settle_bound(bound, unit); !fault.empty()) refuse(key, fault);
  }

  Study& study_;
  const schema::Origins& origins_;
  Problems& problems_;
  std::string path_;
};

}  // namespace

const StudyRun* first_run_of(const Study& study, const std::string& variation) {
  const auto found = std::ranges::find(study.runs, variation, &StudyRun::variation);
  return found == study.runs.end() ? nullptr : &*found;
}

void complete_and_check_study(Study& study, const schema::Origins& origins, Problems& problems) {
  StudyChecks(study, origins, problems).run();
}

}  // namespace pulvis

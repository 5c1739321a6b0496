#include "cli/laboratory/volts/volts_reduction.hpp"

#include <stdexcept>

#include "scenes/language/problem.hpp"

namespace pulvis::volts {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& file, const char* key,
                              const std::string& what) {
  throw SceneError({{file.string(), 1, 1, "", key, what}});
}

CurveSet curves_in(const std::filesystem::path& file, const char* signal, const char* key,
                   const CurveWindow& window) {
  CurveSet set{file, read_curves(file, signal), {}, {}};
  try {
    for (const ForceCurve& curve : set.curves) set.figures.push_back(figures_of(curve, window));
  } catch (const std::runtime_error& error) {
    refuse_file(file, key, error.what());
  }
  set.mean = mean_over(set.figures);
  return set;
}

std::optional<lab::Mean> chosen_crosstalk(const VoltsSpec& spec, const Sensitivity& hard) {
  switch (spec.crosstalk.method) {
    case CrosstalkMethod::force_curves:
      return hard.crosstalk;
    case CrosstalkMethod::given:
      return lab::Mean{spec.crosstalk.coefficient, spec.crosstalk.error};
    case CrosstalkMethod::none:
      break;
  }
  return std::nullopt;
}

}  // namespace

Reduced reduce(const VoltsSpec& spec, const WedgeLoops& wedge, const std::filesystem::path& folder,
               double confidence) {
  const ForceCurvesSpec& files = spec.force_curves;
  const CurveWindow window{files.free, files.from, files.until, true};
  Reduced all;
  all.hard = curves_in(folder / files.hard, "normal", "force_curves.hard", window);
  if (!files.sample.empty())
    all.sample = curves_in(folder / files.sample, "normal", "force_curves.sample", window);
  Measured& measured = all.measured;
  measured.lever = lever_of(spec.lever, folder);
  measured.hard = all.hard.mean;
  measured.sample = all.sample ? all.sample->mean : all.hard.mean;
  measured.crosstalk = chosen_crosstalk(spec, all.hard.mean);
  measured.known = wedge.known;
  measured.loops = read_loops(folder / spec.afm.loops, false, wedge.skip);
  if (spec.lateral() == LateralMethod::wedge) {
    measured.wedge = read_loops(wedge.file, true, wedge.skip);
  } else {
    CurveWindow side = window;
    side.needs_return = false;
    all.side = curves_in(folder / spec.test_probe.contacts, "lateral", "test_probe.contacts", side);
    measured.side = all.side->mean.slope;
  }
  const Model model(measured, spec);
  all.inputs = model.inputs();
  all.groups = model.groups();
  all.slopes = model.slopes();
  const DrawSpec draws{spec.afm.draws, static_cast<std::uint64_t>(spec.afm.seed), confidence};
  try {
    all.result = propagate(model, draws);
    if (all.slopes && (all.slopes->choice == wedge::Choice::undecided ||
                       all.slopes->choice == wedge::Choice::meeting))
      all.other_root = propagate(Model(measured, spec, true), draws);
  } catch (const std::runtime_error& error) {
    refuse_file(measured.wedge ? wedge.file : folder / spec.afm.loops, "afm", error.what());
  }
  return all;
}

}  // namespace pulvis::volts

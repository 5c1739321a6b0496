// Declarations of a target surface's relief: keys of [[tool]] with shape = "profile".
#include "scenes/keys/declare_profile.hpp"

namespace pulvis::schema {
namespace {

template <class Member>
auto relief_to(Member ProfileSpec::*member) {
  return [member](ToolSpec& spec, const Decoded& value) { spec.relief.*member = value.number; };
}

Key<ToolSpec> relief_length_key(const char* name, double minimum, auto member, const char* doc,
                                const char* fallback_doc) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(minimum, largest_size),
           .only_for = "profile",
           .doc = doc,
           .fallback_doc = fallback_doc},
          relief_to(member)};
}

Key<ToolSpec> relief_key() {
  return {{.name = "relief",
           .kind = Kind::choice,
           .choices = words_of<ProfileSpec::Kind>(
               {{"flat", "a plane, or a surface that slides along its grooves"},
                {"triangle", "grooves with straight flanks, sharp crests and valleys"},
                {"sine", "a sine wave"},
                {"trapezoid", "grooves with straight flanks, flat crests and valleys"},
                {"rough",
                 "random heights with a Gaussian autocorrelation, generated from the scene's "
                 "`seed`"},
                {"file", "measured: heights versus x from `file`"}}),
           .required = true,
           .only_for = "profile",
           .doc = "Shape of the surface. `point` lies on a crest. The relief extends to the left "
                  "and right as far as the powder can pass over it while the tool moves. For "
                  "rough and measured profiles, the highest crest is at the height of `point` "
                  "and the first station at its x."},
          [](ToolSpec& spec, const Decoded& value) {
            spec.relief.kind = value_for<ProfileSpec::Kind>(value);
          }};
}

Key<ToolSpec> profile_file_key() {
  return {{.name = "file",
           .kind = Kind::file,
           .only_for = {"polyline", "profile"},
           .doc = "Path relative to the folder of the scene. Polyline (instead of `points`): a "
                  "drawing (SVG, DXF) with a single open line of straight segments, arcs and "
                  "curves that forms the face of the tool; `normal` indicates the side of the "
                  "powder. Profile: a CSV file with the columns `x` and `height`, each with its "
                  "unit in the header: `x [mm], height [um]`. x must increase from row to row. A "
                  "tilt is removed by least squares. A surface that slides along its grooves is "
                  "flat: relief = \"flat\".",
           .fallback_doc = "`points`; required for a measured profile"},
          to(&ToolSpec::file)};
}

}  // namespace

std::vector<Key<ToolSpec>> profile_keys() {
  std::vector<Key<ToolSpec>> all{
      relief_key(),
      relief_length_key("pitch", smallest_size, &ProfileSpec::pitch,
                        "Distance from crest to crest.", "required for periodic profiles"),
      relief_length_key("depth", smallest_size, &ProfileSpec::depth,
                        "Height difference from crest to valley.",
                        "from `ra`; periodic profiles require one of the two"),
      relief_length_key("ra", smallest_size, &ProfileSpec::ra,
                        "Arithmetic mean roughness: mean absolute deviation from the mean line.",
                        "from `depth`; required for a rough profile"),
      relief_length_key(
          "correlation_length", smallest_size, &ProfileSpec::correlation_length,
          "Correlation length of a rough surface: distance over which the "
          "autocorrelation of the heights, exp(-(x/length)^2), falls to 1/e. The surface "
          "repeats after 64 correlation lengths; this period is doubled until the run "
          "does not reach it.",
          "required for a rough profile"),
      {{.name = "flat_share",
        .kind = Kind::number,
        .range = between(0, 0.5),
        .only_for = "profile",
        .doc = "Fraction of the pitch taken by the crest of a trapezoid, and by its valley.",
        .fallback_doc = "0.25"},
       relief_to(&ProfileSpec::flat_share)}};
  all.push_back(profile_file_key());
  return all;
}

}  // namespace pulvis::schema

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
  return {
      {.name = "relief",
       .kind = Kind::choice,
       .choices = {{"flat", "a plane, or a surface that slides along its grooves"},
                   {"triangle", "grooves with straight flanks, sharp crests and valleys"},
                   {"sine", "a wave"},
                   {"trapezoid", "grooves with straight flanks, flat crests and valleys"},
                   {"rough",
                    "random heights with a Gaussian autocorrelation, by the scene's `seed`"},
                   {"file", "measured: heights against x from `file`"}},
       .required = true,
       .only_for = "profile",
       .doc =
           "Form of the surface. `point` stands on a crest; to its left and right the relief "
           "goes on as far as the powder can come over it while the tool moves. Of a rough and a "
           "measured one the highest crest lies at the height of `point`, and its first station "
           "at its x."},
      [](ToolSpec& spec, const Decoded& value) {
        spec.relief.kind = static_cast<ProfileSpec::Kind>(value.index);
      }};
}

Key<ToolSpec> profile_file_key() {
  return {
      {.name = "file",
       .kind = Kind::file,
       .only_for = {"polyline", "profile"},
       .doc =
           "Relative to the scene. Of a polyline, instead of `points`: a drawing (SVG, DXF) with "
           "one open line of straight parts, arcs and curves, the face of the tool; `normal` "
           "says on which side the powder is. Of a profile: a CSV file with the columns `x` and "
           "`height` and the unit of each in the header: `x [mm], height [um]`. x must rise "
           "from row to row. A tilt is taken off (least squares). Along its grooves a surface "
           "is flat: relief = \"flat\".",
       .fallback_doc = "`points`; required of a measured profile"},
      to(&ToolSpec::file)};
}

}  // namespace

std::vector<Key<ToolSpec>> profile_keys() {
  std::vector<Key<ToolSpec>> all{
      relief_key(),
      relief_length_key("pitch", smallest_size, &ProfileSpec::pitch, "From crest to crest.",
                        "required of those that repeat"),
      relief_length_key("depth", smallest_size, &ProfileSpec::depth, "From crest to valley.",
                        "by `ra`; of those that repeat one of the two is required"),
      relief_length_key("ra", smallest_size, &ProfileSpec::ra,
                        "Arithmetic mean roughness: mean distance from the mean line.",
                        "by `depth`; required of a rough one"),
      relief_length_key(
          "correlation_length", smallest_size, &ProfileSpec::correlation_length,
          "Of a rough surface: distance in which the autocorrelation of the heights, "
          "exp(-(x/length)^2), falls to 1/e. The surface repeats after 64 of them, or "
          "that doubled until it need not.",
          "required of a rough one"),
      {{.name = "flat_share",
        .kind = Kind::number,
        .range = between(0, 0.5),
        .only_for = "profile",
        .doc = "Share of the pitch that a trapezoid's crest takes, and its valley.",
        .fallback_doc = "0.25"},
       relief_to(&ProfileSpec::flat_share)}};
  all.push_back(profile_file_key());
  return all;
}

}  // namespace pulvis::schema

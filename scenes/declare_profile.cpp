// Declarations of a target surface's relief: keys of [[tool]] with shape = "profile".
#include "scenes/declare_profile.hpp"

namespace pulvis::schema {
namespace {

template <class Member>
auto relief_to(Member ProfileSpec::*member) {
  return [member](ToolSpec& spec, const Decoded& value) { spec.relief.*member = value.number; };
}

Key<ToolSpec> length_key(const char* name, double least, auto member, const char* doc,
                         const char* fallback_doc) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(least, largest_size),
           .only_for = "profile",
           .doc = doc,
           .fallback_doc = fallback_doc},
          relief_to(member)};
}

Key<ToolSpec> relief_key() {
  return {
      {.name = "relief",
       .kind = Kind::choice,
       .choices = {{"flat", "a plane, or a profile seen along its lay"},
                   {"triangle", "grooves with straight flanks, sharp crests and valleys"},
                   {"sine", "a wave"},
                   {"trapezoid", "grooves with straight flanks, flat crests and valleys"}},
       .required = true,
       .only_for = "profile",
       .doc = "Form of the surface. `point` stands on a crest; to its left and right the relief "
              "goes on as far as the powder can come over it while the tool moves."},
      [](ToolSpec& spec, const Decoded& value) {
        spec.relief.kind = static_cast<ProfileSpec::Kind>(value.index);
      }};
}

}  // namespace

std::vector<Key<ToolSpec>> profile_keys() {
  return {relief_key(),
          length_key("pitch", smallest_size, &ProfileSpec::pitch, "From crest to crest.",
                     "required, but of a flat one"),
          length_key("depth", smallest_size, &ProfileSpec::depth, "From crest to valley.",
                     "by `ra`; one of the two is required, but of a flat one"),
          length_key("ra", smallest_size, &ProfileSpec::ra,
                     "Arithmetic mean roughness: mean distance from the mean line.", "by `depth`"),
          {{.name = "flat_share",
            .kind = Kind::number,
            .range = between(0, 0.5),
            .only_for = "profile",
            .doc = "Share of the pitch that a trapezoid's crest takes, and its valley.",
            .fallback_doc = "0.25"},
           relief_to(&ProfileSpec::flat_share)}};
}

}  // namespace pulvis::schema

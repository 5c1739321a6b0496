// Declarations of plastic flow: hardening and rate laws.
#include "scenes/keys/declare.hpp"
#include "systems/laws/flow_law.hpp"

namespace pulvis::schema {
namespace {

// The words of `law` are in the order of the variant.
template <std::size_t... I, class Law>
void choose(Law& law, std::size_t index, std::index_sequence<I...>) {
  ((I == index ? void(law.template emplace<I>()) : void()), ...);
}
template <class Law>
void choose(Law& law, int index) {
  choose(law, static_cast<std::size_t>(index),
         std::make_index_sequence<std::variant_size_v<Law>>());
}

template <class Selected, class Law>
void set_in(Selected& selected, double Law::*constant, double number) {
  if (Law* law = std::get_if<Law>(&selected)) law->*constant = number;
}
// A constant of the selected law. A key of several laws names that of each.
template <class... Law>
auto hardening_to(double Law::*... constant) {
  return [=](FlowLaw& flow, const Decoded& value) {
    (set_in(flow.hardening, constant, value.number), ...);
  };
}
template <class... Law>
auto rate_to(double Law::*... constant) {
  return [=](FlowLaw& flow, const Decoded& value) {
    (set_in(flow.rate, constant, value.number), ...);
  };
}

Key<FlowLaw> exponent_of_hardening() {
  return {{.name = "exponent",
           .kind = Kind::number,
           .range = within(1e-3, 1),
           .required = true,
           .only_for = {"swift", "ludwik"},
           .doc = "Exponent n of the power law."},
          hardening_to(&kernels::SwiftHardening::n, &kernels::LudwikHardening::n)};
}

}  // namespace

const TableDeclaration<FlowLaw>& hardening() {
  using namespace kernels;
  static const TableDeclaration<FlowLaw> declaration{
      {"material.hardening", false, "law",
       "Evolution of the flow stress from the yield stress with the accumulated "
       "plastic strain e.",
       every_family, true},
      {{{.name = "law",
         .kind = Kind::choice,
         .choices = {{"linear", "yield_stress + modulus e"},
                     {"voce", "yield_stress + saturation (1 - exp(-saturation_rate e))"},
                     {"swift",
                      "yield_stress (1 + e / reference_strain)^exponent, which is K (e_0 + "
                      "e)^n with K = yield_stress / e_0^n"},
                     {"ludwik", "yield_stress + strength e^exponent"},
                     {"table", "linear interpolation between the points of a file"}},
         .required = true,
         .doc = "Hardening law."},
        [](FlowLaw& flow, const Decoded& value) { choose(flow.hardening, value.index); }},
       {{.name = "modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .required = true,
         .only_for = "linear",
         .doc = "Hardening modulus; replaces `hardening_modulus` of the material."},
        hardening_to(&LinearHardening<double>::H)},
       {{.name = "saturation",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .required = true,
         .only_for = "voce",
         .doc = "Q: total increase of the flow stress."},
        hardening_to(&VoceHardening::Q)},
       {{.name = "saturation_rate",
         .kind = Kind::number,
         .range = within(1e-3, 1e6),
         .required = true,
         .only_for = "voce",
         .doc = "b: 63% of the increase is reached at a plastic strain of 1/b."},
        hardening_to(&VoceHardening::b)},
       {{.name = "reference_strain",
         .kind = Kind::number,
         .range = within(1e-9, 1e3),
         .required = true,
         .only_for = "swift",
         .doc = "e_0: reference strain (prestrain) of the law."},
        hardening_to(&SwiftHardening::eps_0)},
       {{.name = "strength",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .required = true,
         .only_for = "ludwik",
         .doc = "K: increase of the flow stress at a plastic strain of 1 (B of the "
                "Johnson-Cook law, whose A is the yield stress)."},
        hardening_to(&LudwikHardening::K)},
       exponent_of_hardening(),
       {{.name = "file",
         .kind = Kind::file,
         .required = true,
         .only_for = "table",
         .doc = "CSV file with the columns `plastic_strain` and `stress [MPa]` (or another "
                "unit). Strains increase from 0, stresses must not decrease. The first stress "
                "is the yield stress, which the material must then omit; beyond the last point "
                "the stress is constant."},
        to(&FlowLaw::file)}}};
  return declaration;
}

const TableDeclaration<FlowLaw>& rate() {
  using namespace kernels;
  static const TableDeclaration<FlowLaw> declaration{
      {"material.rate", false, "law",
       "Strain-rate dependence of the flow stress. Not for levers, whose solution is "
       "static.",
       every_family, true},
      {{{.name = "law",
         .kind = Kind::choice,
         .choices =
             {{"cowper-symonds",
               "the flow stress from hardening times 1 + (rate / reference_rate)^(1/exponent)"}},
         .required = true,
         .doc = "Rate law."},
        [](FlowLaw& flow, const Decoded& value) {
          choose(flow.rate, value.index + 1);  // without a word: none
        }},
       {{.name = "reference_rate",
         .kind = Kind::quantity,
         .unit = "1/s",
         .range = within(1e-9, 1e15),
         .required = true,
         .only_for = "cowper-symonds",
         .doc = "C: rate at which the flow stress is twice the quasi-static one."},
        rate_to(&CowperSymonds::C)},
       {{.name = "exponent",
         .kind = Kind::number,
         .range = within(1, 100),
         .required = true,
         .only_for = "cowper-symonds",
         .doc = "p."},
        rate_to(&CowperSymonds::p)}}};
  return declaration;
}

}  // namespace pulvis::schema

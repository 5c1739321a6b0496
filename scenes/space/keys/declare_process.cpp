// Declarations of the top level, the process and the settings of a run, where they differ from those
// in two dimensions.
#include "engine/portable_math.hpp"
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {
namespace {

std::vector<Key<Scene>> keys_of_top() {
  std::vector<Key<Scene>> keys;
  for (const Key<Scene>& key : schema::top_level().keys)
    if (key.info.name != "thickness" && key.info.name != "initial_state") keys.push_back(key);
  return keys;
}

Key<BodySpec> body_vector(const char* name, const char* unit, double largest, const char* zero,
                          Vec3 BodySpec::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::vector,
           .unit = unit,
           .range = within(-largest, largest),
           .dimensions = 3,
           .fallback = triple_of(zero, zero, zero),
           .doc = doc},
          to(member)};
}

std::vector<Key<BodySpec>> turn_keys() {
  return {{{.name = "angle",
            .kind = Kind::quantity,
            .unit = "rad",
            .range = within(-1000, 1000),
            .doc = "Rotation about `axis`, counter-clockwise when the axis points towards the "
                   "viewer.",
            .fallback_doc = "`\"0 deg\"`"},
           [](BodySpec& spec, const Decoded& value) {
             const double half = value.number / 2;
             spec.rotation = Rotation(portable::cos(half), 0, 0, portable::sin(half));
           }},
          {{.name = "axis",
            .kind = Kind::direction,
            .dimensions = 3,
            .needs = "angle",
            .doc = "Rotation axis, of any length.",
            .fallback_doc = "`[0, 0, 1]`"},
           // The preceding key has set the angle, about z.
           [](BodySpec& spec, const Decoded& value) {
             const Vec3 part = spec.rotation.z() * value.vector3.normalized();
             spec.rotation = Rotation(spec.rotation.w(), part.x(), part.y(), part.z());
           }}};
}

TableDeclaration<BodySpec> declared_body() {
  TableDeclaration<BodySpec> table;
  table.info = schema::body().info;
  table.keys.push_back({{.name = "particle",
                         .kind = Kind::reference,
                         .refers_to = "particle",
                         .required = true,
                         .doc = "Particle class."},
                        schema::index_to(&BodySpec::particle)});
  table.keys.push_back({{.name = "position",
                         .kind = Kind::vector,
                         .unit = "m",
                         .range = within(-largest_size, largest_size),
                         .dimensions = 3,
                         .required = true,
                         .doc = "Centre of volume."},
                        to(&BodySpec::position)});
  for (auto& key : turn_keys()) table.keys.push_back(std::move(key));
  table.keys.push_back(body_vector("velocity", "m/s", 1e5, "0 m/s", &BodySpec::velocity,
                                   "Initial velocity of the centre."));
  table.keys.push_back(body_vector("angular_velocity", "rad/s", 1e12, "0 rad/s",
                                   &BodySpec::angular_velocity,
                                   "Initial angular velocity, in the axes of the scene."));
  return table;
}

// As in two dimensions, but with setters for a different struct.
template <class Spec>
schema::KeyInfo as_in_the_plane(const TableDeclaration<Spec>& table, const char* name) {
  for (const Key<Spec>& key : table.keys)
    if (key.info.name == name) return key.info;
  return {.name = name};
}
template <class Set>
Key<MoveSpec> move_key(const char* name, Set set) {
  return {as_in_the_plane(schema::move(), name), set};
}

std::vector<Key<MoveSpec>> move_keys() {
  Key<MoveSpec> drive = move_key("stiffness", to(&MoveSpec::stiffness));
  drive.info.doc =
      "Stiffness of a compliant drive along the displacement. The displacement then "
      "applies to the far end of the spring, and the tool follows as a mass on the "
      "spring. In the next stage the tool keeps its last position unless that stage "
      "also drives it through a spring. If that one has another direction, only "
      "the motion along it continues.";
  return {{{.name = "tool",
            .kind = Kind::reference,
            .refers_to = "tool",
            .required = true,
            .doc = "Tool that moves."},
           schema::index_to(&MoveSpec::tool)},
          {{.name = "displacement",
            .kind = Kind::vector,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .dimensions = 3,
            .required = true,
            .doc = "Displacement over the stage."},
           to(&MoveSpec::displacement)},
          {{.name = "ramp",
            .kind = Kind::number,
            .range = above(0, 0.5),
            .fallback = value_of(0.1),
            .doc = "Fraction of the stage over which the speed rises smoothly, and falls again at "
                   "the end."},
           to(&MoveSpec::ramp)},
          drive,
          move_key("mass", to(&MoveSpec::mass)),
          move_key("damping", to(&MoveSpec::damping))};
}

template <class Set>
Key<ServoSpec> servo_key(const char* name, Set set) {
  return {as_in_the_plane(schema::servo(), name), set};
}

std::vector<Key<ServoSpec>> servo_keys() {
  Key<ServoSpec> force = servo_key("force", to(&ServoSpec::force));
  force.info.doc = "Target force.";
  Key<ServoSpec> tool = servo_key("tool", schema::index_to(&ServoSpec::tool));
  tool.info.doc = "Force-controlled tool.";
  Key<ServoSpec> direction = servo_key("direction", to(&ServoSpec::direction));
  direction.info.dimensions = 3;
  direction.info.fallback_doc = "the normal of a plane or punch; required for other tools";
  return {tool,
          force,
          direction,
          servo_key("rise", to(&ServoSpec::rise)),
          servo_key("rate", to(&ServoSpec::rate)),
          servo_key("response", to(&ServoSpec::response)),
          servo_key("max_speed", to(&ServoSpec::max_speed)),
          servo_key("tolerance", to(&ServoSpec::tolerance))};
}

}  // namespace

const TableDeclaration<Scene>& top_level() {
  static const TableDeclaration<Scene> declaration = [] {
    TableDeclaration<Scene> table{schema::top_level().info, keys_of_top()};
    schema::KeyInfo& family = key_of(table, "family").info;
    family.choices = {{"compaction", "deformable particles in a rigid die"}};
    schema::KeyInfo& dimension = key_of(table, "dimension").info;
    dimension.range = within(3, 3);
    dimension.required = true;
    dimension.doc = "Two-dimensional scenes have their own language: docs/scene.md.";
    dimension.fallback_doc = "";
    return table;
  }();
  return declaration;
}

const TableDeclaration<BodySpec>& body() {
  static const TableDeclaration<BodySpec> declaration = declared_body();
  return declaration;
}

const TableDeclaration<StageSpec>& stage() {
  static const TableDeclaration<StageSpec> declaration = [] {
    TableDeclaration<StageSpec> table = without(schema::stage(), {"keep_state"});
    std::erase_if(key_of(table, "kind").info.choices,
                  [](const schema::Choice& choice) { return choice.word == "shear"; });
    return table;
  }();
  return declaration;
}

const TableDeclaration<MoveSpec>& move() {
  static const TableDeclaration<MoveSpec> declaration{schema::move().info, move_keys()};
  return declaration;
}

const TableDeclaration<ServoSpec>& servo() {
  static const TableDeclaration<ServoSpec> declaration{schema::servo().info, servo_keys()};
  return declaration;
}

const TableDeclaration<UntilSpec>& until() {
  static const TableDeclaration<UntilSpec> declaration = [] {
    TableDeclaration<UntilSpec> table = schema::until();
    table.info.doc =
        "Ends the preceding stage before its duration is over, at a displacement, relative "
        "density or force. Its tools come to rest as smoothly as they started. At a "
        "displacement or relative density they are then at rest, as they begin to slow down "
        "before it. A force is not known in advance: they begin to slow down where it is "
        "reached, it rises further, and [[stage.servo]] holds one. If the condition is not "
        "met within the duration of the stage, the run stops. Exactly one of `force`, "
        "`displacement` and `relative_density` is given.";
    key_of(table, "force").info.doc =
        "Force of the powder on the tool from which on the stage slows down: against the "
        "normal of a plane or punch, the magnitude for other tools.";
    key_of(table, "relative_density").info.doc =
        "Relative density of the powder between six planes, or in a round die between "
        "two planes or punches, after they have come to rest.";
    return table;
  }();
  return declaration;
}

const TableDeclaration<ContactSpec>& contact() {
  static const TableDeclaration<ContactSpec> declaration = [] {
    TableDeclaration<ContactSpec> table = schema::contact();
    key_of(table, "stiffness").info.doc =
        "Contact stiffness, as a multiple of bulk modulus times face area divided by "
        "the volume of the element behind the face. The default is 10 if no material "
        "yields. The elastic response of metals (springback, residual stress, moduli) needs 10 "
        "as well; the run reports the resulting errors.";
    key_of(table, "skin").info.doc =
        "Skin distance of the contact search, as a fraction of the smallest face: how "
        "far surfaces may approach each other before the search is repeated. It "
        "affects run time, not results.";
    return table;
  }();
  return declaration;
}

const TableDeclaration<SpaceScene>& element() {
  static const TableDeclaration<SpaceScene> declaration{
      {"element", false, "", "Finite elements of all particles: 8-node hexahedra."},
      {{{.name = "formulation",
         .kind = Kind::choice,
         .choices =
             {{"one-point",
               "one Gauss point with hourglass modes stabilised by elastic-plastic bending; "
               "faster"},
              {"eight-point",
               "2x2x2 Gauss points with a single dilatation (mean dilatation): the reference"}},
         .fallback = value_of("one-point"),
         .doc = "Element formulation."},
        [](SpaceScene& spec, const Decoded& value) { spec.full_integration = value.index == 1; }}}};
  return declaration;
}

const TableDeclaration<TimeSpec>& time() {
  static const TableDeclaration<TimeSpec> declaration = without(schema::time(), {"estimate"});
  return declaration;
}

const TableDeclaration<OutputSpec>& output() {
  static const TableDeclaration<OutputSpec> declaration = [] {
    TableDeclaration<OutputSpec> table = schema::output();
    Key<OutputSpec>& cells = key_of(table, "density_cells");
    cells.info.dimensions = 3;
    cells.info.range = within(1, 200);
    cells.info.doc =
        "Number of cells along x, y and z of a grid between the tools in which local "
        "relative densities are recorded: in every frame, and their minimum, maximum "
        "and standard deviation over time. Requires an enclosed region: six planes "
        "along the axes, or a round die along one axis between two planes or punches.";
    cells.set = [](OutputSpec& spec, const Decoded& value) { spec.density_cells3 = value.counts3; };
    key_of(table, "contacts").info.doc =
        "Record the contact network: forces, normals and areas of all touching pairs "
        "and force chains in every frame; coordination number, fabric and mean forces "
        "over time.";
    return table;
  }();
  return declaration;
}

// As in two dimensions, for the series that exist here.
const TableDeclaration<ExpectSpec>& expect() {
  static const TableDeclaration<ExpectSpec> declaration = [] {
    TableDeclaration<ExpectSpec> table = schema::expect();
    key_of(table, "series").info.doc =
        "A series of `history.csv`; `momentum/x`, `momentum/y`, `momentum/z`, "
        "`momentum/angular_x`, "
        "`momentum/angular_y` or `momentum/angular_z` "
        "(about the origin) of the whole powder; or a value of the whole run: "
        "`energy_balance_error`, `kinetic_ratio`.";
    return table;
  }();
  return declaration;
}

}  // namespace pulvis::space::language

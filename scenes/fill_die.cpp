#include "scenes/fill_die.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scenes/keys/declare.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

using document::Array;
using document::Entry;
using document::Origin;
using document::Table;
using document::Value;

struct Wall {
  const char* name;
  std::size_t axis;
  int normal;  // its component along that axis: +1 or -1
};
constexpr std::array<Wall, 4> walls_in_plane{
    {{"left", 0, 1}, {"right", 0, -1}, {"bottom", 1, 1}, {"top", 1, -1}}};
constexpr std::array<Wall, 6> walls_of_box{{{"left", 0, 1},
                                            {"right", 0, -1},
                                            {"front", 1, 1},
                                            {"back", 1, -1},
                                            {"bottom", 2, 1},
                                            {"top", 2, -1}}};
constexpr std::array<Wall, 2> punches_of_cylinder{{{"bottom", 2, 1}, {"top", 2, -1}}};

Value length_of(double metres, const Origin& origin) {
  return {fmt::format("{} m", metres), origin};
}
Value word_of(const char* word, const Origin& origin) { return {std::string(word), origin}; }

// An array of tables; null if it is anything else, which the reader refuses.
Array* elements_of(Table& root, const char* key) {
  Entry* entry = document::find(root, key);
  if (entry == nullptr || !document::is_array_of_tables(entry->value)) return nullptr;
  return &entry->value.get<Array>();
}

bool is_kind(const Table& packing, std::initializer_list<const char*> kinds) {
  const std::string* kind = document::find_text(packing, "kind");
  return kind != nullptr &&
         std::ranges::any_of(kinds, [&](const char* one) { return *kind == one; });
}

// The size of a die, as far as it is known.
using Lengths = std::array<std::optional<double>, 2>;  // m, along x, y; in the plane only the first
constexpr std::array length_keys{"width", "depth"};

class DieFiller {
 public:
  DieFiller(Table& root, Value die, const Origin& origin, Problems& problems)
      : root_(root),
        origin_(origin),
        problems_(problems),
        dimension_(dimension_of(root)),
        language_(language_of(root)) {
    const Table nothing;
    schema::TableReader(nothing, problems, language_).read(schema::die(), die, "die", "", spec_);
    lengths_ = {spec_.width, spec_.depth};
  }

  std::optional<MissingWidth> fill() {
    refuse_two_shapes();
    packings_ = elements_of(root_, "packing");
    if (packings_ != nullptr && packings_->size() == 1) take_over(packings_->front().get<Table>());
    if (!lengths_[0] && !spec_.diameter && wrong_) return std::nullopt;
    if (!lengths_[0] && !spec_.diameter) stand_somewhere();
    if (!lengths_[1]) lengths_[1] = lengths_[0];
    for (std::size_t i = 0; packings_ != nullptr && i < packings_->size(); ++i)
      fill_packing((*packings_)[i].get<Table>(), fmt::format("packing[{}]", i));
    stand_tools();
    return missing_;
  }

 private:
  bool in_space() const { return dimension_ == 3; }
  bool is_round() const { return spec_.diameter.has_value(); }

  void refuse_two_shapes() {
    if (!is_round() || !(spec_.width || spec_.depth)) return;
    problems_.add(
        origin_, "die.diameter",
        "has no effect together with width or depth, allowed: a cylindrical die, or a box");
    wrong_ = true;
  }

  // The rest of the scene is still read, with walls that its stages can refer to: what the packing gets wrong is the
  // mistake, and the missing width its consequence.
  void stand_somewhere() {
    missing_ = {origin_, fmt::format("required key is missing, allowed: a quantity in m{}; {}",
                                     in_space() ? ", or the diameter of a cylindrical die" : "",
                                     why_no_width())};
    lengths_[0] = 1;
  }

  std::string why_no_width() const {
    if (packings_ == nullptr || packings_->empty())
      return "there is no [[packing]] that it could follow from";
    if (packings_->size() > 1)
      return fmt::format("it follows from an only packing, and there are {}", packings_->size());
    const std::string* kind = document::find_text(packings_->front().get<Table>(), "kind");
    if (kind != nullptr && *kind == "random") return "here, or as width of the random packing";
    return kind != nullptr && *kind == "csv"
               ? "a packing of kind = \"csv\" has none"
               : fmt::format(
                     "a lattice has one if `{}`, and `spacing` or the `diameter` of its particle, "
                     "are given",
                     in_space() ? "cells" : "columns");
  }

  // The value of a key as declared; nothing if it is missing. An invalid one is reported here: without it
  // there are no tools, and the reader's message about that would be misleading.
  std::optional<schema::Decoded> value_in(const Table& table, const char* declared, const char* key,
                                          const std::string& path) {
    const Entry* entry = document::find(table, key);
    const schema::KeyInfo* info = schema::find_key(*schema::find_table(declared, language_), key);
    if (entry == nullptr || info == nullptr) return std::nullopt;
    try {
      return schema::decode(*info, entry->value, {});
    } catch (const schema::Refusal& refusal) {
      problems_.add(refusal.origin, schema::joined_path(path, key), refusal.what());
      wrong_ = true;
      return std::nullopt;
    }
  }
  std::optional<schema::Decoded> in_packing(const Table& packing, const char* key) {
    return value_in(packing, "packing", key, "packing[0]");
  }

  // What [die] leaves unspecified and the only packing specifies.
  void take_over(const Table& packing) {
    if (!spec_.corner)
      if (const auto corner = in_packing(packing, "corner")) spec_.corner = corner->vector3;
    if (is_round() || spec_.width) return;
    if (const auto diameter = in_packing(packing, "diameter")) {
      spec_.diameter = diameter->number;
      return;
    }
    for (std::size_t k = 0; k < length_keys.size(); ++k)
      if (const auto length = in_packing(packing, length_keys[k])) lengths_[k] = length->number;
    if (const auto size = lattice_in(packing)) lengths_ = {size->x(), size->y()};
  }

  // m, of a lattice that says how many particles it has.
  std::optional<Vec3> lattice_in(const Table& packing) {
    PackingSpec lattice;
    const auto kind = in_packing(packing, "kind");
    const auto rows = in_packing(packing, "rows"), columns = in_packing(packing, "columns"),
               cells = in_packing(packing, "cells");
    if (!kind || !(columns || cells)) return std::nullopt;
    lattice.kind = schema::value_for<PackingSpec::Kind>(*kind);
    if (columns) lattice.cells[0] = static_cast<int>(columns->integer);
    if (rows) lattice.cells[1] = static_cast<int>(rows->integer);
    if (cells) lattice.cells = cells->counts3;
    const auto spacing = spacing_in(packing, lattice.kind);
    if (!is_lattice(lattice) || !spacing) return std::nullopt;
    lattice.spacing = *spacing;
    return size_of_lattice(lattice);
  }

  std::optional<double> spacing_in(const Table& packing, PackingSpec::Kind kind) {
    if (const auto spacing = in_packing(packing, "spacing")) return spacing->number;
    const std::string* name = document::find_text(packing, "particle");
    const Array* particles = elements_of(root_, "particle");
    for (std::size_t i = 0; name != nullptr && particles != nullptr && i < particles->size(); ++i) {
      const Table& particle = (*particles)[i].get<Table>();
      const std::string* own = document::find_text(particle, "name");
      if (own == nullptr || *own != *name) continue;
      if (const auto diameter =
              value_in(particle, "particle", "diameter", fmt::format("particle[{}]", i)))
        return touching_spacing(kind) * diameter->number;
    }
    return std::nullopt;
  }

  Vec3 corner() const { return spec_.corner.value_or(Vec3::Zero()); }
  double size() const { return is_round() ? *spec_.diameter : *lengths_[0]; }
  bool differs(double a, double b) const { return std::abs(a - b) > 1e-9 * size(); }

  Value place_of(const Vec3& place) const {
    Array components;
    for (int k = 0; k < dimension_; ++k) components.push_back(length_of(place[k], origin_));
    return {std::move(components), origin_};
  }

  void fill_packing(Table& packing, const std::string& path) {
    if (is_kind(packing, {"random"})) {
      if (is_round())
        fill_length(packing, "diameter", *spec_.diameter, path);
      else
        for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(dimension_); ++k)
          fill_length(packing, length_keys[k], *lengths_[k], path);
    }
    if (spec_.corner && !is_kind(packing, {"csv"}) && document::find(packing, "corner") == nullptr)
      packing.push_back({"corner", origin_, place_of(corner())});
  }

  void fill_length(Table& packing, const char* key, double length, const std::string& path) {
    const auto given = value_in(packing, "packing", key, path);
    if (document::find(packing, key) == nullptr)
      packing.push_back({key, origin_, length_of(length, origin_)});
    else if (given && differs(given->number, length))
      problems_.add(document::find(packing, key)->origin, schema::joined_path(path, key),
                    fmt::format("is {:g} m, but that of the die is {:g} m, allowed: only one of "
                                "the two",
                                given->number, length));
  }

  void stand_tools() {
    if (!in_space())
      for (const Wall& wall : walls_in_plane) stand(wall);
    else if (!is_round())
      for (const Wall& wall : walls_of_box) stand(wall);
    else
      stand_round_die();
  }

  void stand_round_die() {
    if (find_tool("die") == nullptr)
      add_tool({{"name", origin_, word_of("die", origin_)},
                {"shape", origin_, word_of("die", origin_)},
                {"point", origin_, place_of(corner())},
                {"diameter", origin_, length_of(*spec_.diameter, origin_)}});
    for (const Wall& punch : punches_of_cylinder) stand(punch);
  }

  const Table* find_tool(const char* name) const {
    const Array* tools = elements_of(root_, "tool");
    for (std::size_t i = 0; tools != nullptr && i < tools->size(); ++i) {
      const Table& tool = (*tools)[i].get<Table>();
      const std::string* own = document::find_text(tool, "name");
      if (own != nullptr && *own == name) return &tool;
    }
    return nullptr;
  }

  bool is_upright(const Wall& wall) const {
    return wall.axis + 1 < static_cast<std::size_t>(dimension_);
  }

  void stand(const Wall& wall) {
    const bool rests = !is_upright(wall) && wall.normal < 0;
    if (rests && !missing_ && (packings_ == nullptr || packings_->empty())) return;
    if (const Table* tool = find_tool(wall.name)) return compare(wall, *tool);
    Array normal;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
      normal.push_back({std::int64_t{k == wall.axis ? wall.normal : 0}, origin_});
    Value point = place_of(place_of_wall(wall));
    if (rests) point.get<Array>().back().data = std::string("packing top");
    add_tool({{"name", origin_, word_of(wall.name, origin_)},
              {"shape", origin_, word_of("plane", origin_)},
              {"point", origin_, std::move(point)},
              {"normal", origin_, {std::move(normal), origin_}}});
  }

  void add_tool(Table tool) {
    Entry* entry = document::find(root_, "tool");
    if (entry == nullptr) {
      root_.push_back({"tool", origin_, {Array{}, origin_}});
      entry = &root_.back();
    }
    if (Array* all = entry->value.as<Array>()) all->push_back({std::move(tool), origin_});
  }

  Vec3 place_of_wall(const Wall& wall) const {
    Vec3 place = corner();
    if (is_upright(wall) && wall.normal < 0)
      place[static_cast<Eigen::Index>(wall.axis)] += *lengths_[wall.axis];
    return place;
  }

  // A wall defined in the scene itself must coincide with the die's; punches may be anywhere.
  void compare(const Wall& wall, const Table& tool) {
    const std::string* shape = document::find_text(tool, "shape");
    if (!is_upright(wall) || shape == nullptr || *shape != "plane") return;
    const Array& tools = *elements_of(root_, "tool");
    std::size_t number = 0;
    while (&tools[number].get<Table>() != &tool) ++number;
    const std::string path = fmt::format("tool[{}]", number);
    const auto point = value_in(tool, "tool", "point", path);
    if (!point) return;
    const auto axis = static_cast<Eigen::Index>(wall.axis);
    const double at = place_of_wall(wall)[axis];
    if (differs(point->vector3[axis], at))
      problems_.add(document::find(tool, "point")->origin, path + ".point",
                    fmt::format("is at {} = {:g} m, but this side of the die is at {:g} m, "
                                "allowed: the same position, or no tool '{}'",
                                "xyz"[wall.axis], point -> vector3[axis], at, wall.name));
  }

  Table& root_;
  Origin origin_;
  Problems& problems_;
  int dimension_;
  const schema::Language& language_;
  DieSpec spec_;
  Lengths lengths_;
  bool wrong_ = false;  // a value that the die depends on
  std::optional<MissingWidth> missing_;
  Array* packings_ = nullptr;
};

// In the plane a random packing needs a width, or a die.
void require_widths(Table& root, Problems& problems) {
  if (dimension_of(root) == 3) return;
  const Array* packings = elements_of(root, "packing");
  const schema::TableView& view = *schema::find_table("packing", schema::scene_language(2));
  for (std::size_t i = 0; packings != nullptr && i < packings->size(); ++i) {
    const Table& packing = (*packings)[i].get<Table>();
    if (is_kind(packing, {"random"}) && document::find(packing, "width") == nullptr)
      problems.add((*packings)[i].origin, fmt::format("packing[{}].width", i),
                   fmt::format("required key is missing, allowed: {}, here or in [die]",
                               schema::allowed(*schema::find_key(view, "width"))));
  }
}

}  // namespace

std::optional<MissingWidth> fill_die(Table& root, Problems& problems) {
  const auto entry = std::ranges::find(root, "die", &Entry::key);
  if (entry == root.end()) {
    require_widths(root, problems);
    return std::nullopt;
  }
  const std::string* family = document::find_text(root, "family");
  if (family != nullptr && *family == "afm") return std::nullopt;  // refused by the reader
  const auto tool = std::ranges::find(root, "tool", &Entry::key);
  if (tool != root.end() && tool->value.as<Table>() != nullptr) {  // as by --set tool.left.friction
    problems.add(tool->origin, "tool",
                 "the walls and punches of [die] cannot be set one by one, allowed: keys of [die], "
                 "[[friction]] between a material and one of them, or [[tool]] tables instead of "
                 "[die]");
    return std::nullopt;
  }
  const Origin origin = entry->origin;
  Value die = std::move(entry->value);
  root.erase(entry);
  return DieFiller(root, std::move(die), origin, problems).fill();
}

}  // namespace pulvis

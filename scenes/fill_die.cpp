#include "scenes/fill_die.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scenes/keys/tables.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {
namespace {

using document::Array;
using document::Entry;
using document::Origin;
using document::Table;
using document::Value;

struct Wall {
  const char* name;
  int normal_x, normal_y;
};
constexpr std::array<Wall, 4> walls{
    {{"left", 1, 0}, {"right", -1, 0}, {"bottom", 0, 1}, {"top", 0, -1}}};

Value length_of(double metres, const Origin& origin) {
  return {fmt::format("{} m", metres), origin};
}
Value place_of(const Vec2& place, const Origin& origin) {
  return {Array{length_of(place.x(), origin), length_of(place.y(), origin)}, origin};
}

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

class DieFiller {
 public:
  DieFiller(Table& root, Value die, const Origin& origin, Problems& problems)
      : root_(root), origin_(origin), problems_(problems) {
    const Table nothing;
    schema::TableReader(nothing, problems, schema::scene_language(2))
        .read(schema::die(), die, "die", "", spec_);
  }

  std::optional<MissingWidth> fill() {
    packings_ = elements_of(root_, "packing");
    if (packings_ != nullptr && packings_->size() == 1) take_over(packings_->front().get<Table>());
    if (!spec_.width && wrong_) return std::nullopt;
    if (!spec_.width) stand_somewhere();
    for (std::size_t i = 0; packings_ != nullptr && i < packings_->size(); ++i)
      fill_packing((*packings_)[i].get<Table>(), fmt::format("packing[{}]", i));
    for (const Wall& wall : walls)
      if (wall.normal_y >= 0 || missing_ || (packings_ != nullptr && !packings_->empty()))
        stand(wall);
    return missing_;
  }

 private:
  // The rest of the scene is still read, with walls that its stages can refer to: what the packing gets wrong is the
  // mistake, and the missing width its consequence.
  void stand_somewhere() {
    missing_ = {origin_, fmt::format("required key is missing, allowed: a quantity in m; {}",
                                     why_no_width())};
    spec_.width = 1;
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
               : "a lattice has one if `columns`, and `spacing` or the `diameter` of its particle, "
                 "are given";
  }

  // The value of a key as declared; nothing if it is missing. An invalid one is reported here: without it
  // there are no tools, and the reader's message about that would be misleading.
  std::optional<schema::Decoded> value_in(const Table& table, const char* declared, const char* key,
                                          const std::string& path) {
    const Entry* entry = document::find(table, key);
    if (entry == nullptr) return std::nullopt;
    const schema::TableView& view = *schema::find_table(declared, schema::scene_language(2));
    try {
      return schema::decode(*schema::find_key(view, key), entry->value, {});
    } catch (const schema::Refusal& refusal) {
      problems_.add(refusal.origin, schema::joined_path(path, key), refusal.what());
      wrong_ = true;
      return std::nullopt;
    }
  }

  // What [die] leaves unspecified and the only packing specifies.
  void take_over(const Table& packing) {
    if (!spec_.corner)
      if (const auto corner = value_in(packing, "packing", "corner", "packing[0]"))
        spec_.corner = corner->vector;
    if (spec_.width) return;
    if (const auto width = value_in(packing, "packing", "width", "packing[0]"))
      spec_.width = width->number;
    const auto columns = value_in(packing, "packing", "columns", "packing[0]");
    const std::optional<double> spacing = spacing_in(packing);
    if (columns && spacing) spec_.width = static_cast<double>(columns->integer) * *spacing;
  }

  std::optional<double> spacing_in(const Table& packing) {
    if (const auto spacing = value_in(packing, "packing", "spacing", "packing[0]"))
      return spacing->number;
    const std::string* name = document::find_text(packing, "particle");
    const Array* particles = elements_of(root_, "particle");
    for (std::size_t i = 0; name != nullptr && particles != nullptr && i < particles->size(); ++i) {
      const Table& particle = (*particles)[i].get<Table>();
      const std::string* own = document::find_text(particle, "name");
      if (own == nullptr || *own != *name) continue;
      if (const auto diameter =
              value_in(particle, "particle", "diameter", fmt::format("particle[{}]", i)))
        return diameter->number;
    }
    return std::nullopt;
  }

  Vec2 corner() const { return spec_.corner.value_or(Vec2::Zero()); }
  bool differs(double a, double b) const { return std::abs(a - b) > 1e-9 * *spec_.width; }

  void fill_packing(Table& packing, const std::string& path) {
    if (is_kind(packing, {"random"})) {
      const auto width = value_in(packing, "packing", "width", path);
      if (document::find(packing, "width") == nullptr)
        packing.push_back({"width", origin_, length_of(*spec_.width, origin_)});
      else if (width && differs(width->number, *spec_.width))
        problems_.add(
            document::find(packing, "width")->origin, path + ".width",
            fmt::format("is {:g} m, but the die is {:g} m wide, allowed: only one of the two",
                        width->number, *spec_.width));
    }
    if (spec_.corner && is_kind(packing, {"random", "square", "hexagonal"}) &&
        document::find(packing, "corner") == nullptr)
      packing.push_back({"corner", origin_, place_of(corner(), origin_)});
  }

  void stand(const Wall& wall) {
    if (Array* tools = elements_of(root_, "tool"))
      for (std::size_t i = 0; i < tools->size(); ++i) {
        const Table& tool = (*tools)[i].get<Table>();
        const std::string* name = document::find_text(tool, "name");
        if (name != nullptr && *name == wall.name)
          return compare(wall, tool, fmt::format("tool[{}]", i));
      }
    const auto name_it = [&](const char* key, Value value) {
      return Entry{key, origin_, {std::move(value.data), origin_}};
    };
    const Array normal{{std::int64_t{wall.normal_x}, origin_},
                       {std::int64_t{wall.normal_y}, origin_}};
    Table tool{name_it("name", {std::string(wall.name), origin_}),
               name_it("shape", {std::string("plane"), origin_}), name_it("point", point_of(wall)),
               name_it("normal", {normal, origin_})};
    Entry* entry = document::find(root_, "tool");
    if (entry == nullptr) {
      root_.push_back({"tool", origin_, {Array{}, origin_}});
      entry = &root_.back();
    }
    if (Array* all = entry->value.as<Array>()) all->push_back({std::move(tool), origin_});
  }

  Value point_of(const Wall& wall) const {
    const double x = wall.normal_x < 0 ? corner().x() + *spec_.width : corner().x();
    Value point = place_of({x, corner().y()}, origin_);
    if (wall.normal_y < 0) point.get<Array>()[1].data = std::string("packing top");
    return point;
  }

  // A wall defined in the scene itself must coincide with the die's; punches may be anywhere.
  void compare(const Wall& wall, const Table& tool, const std::string& path) {
    const std::string* shape = document::find_text(tool, "shape");
    if (wall.normal_x == 0 || shape == nullptr || *shape != "plane") return;
    const auto point = value_in(tool, "tool", "point", path);
    if (!point) return;
    const double x = corner().x() + (wall.normal_x < 0 ? *spec_.width : 0);
    if (differs(point->vector.x(), x))
      problems_.add(document::find(tool, "point")->origin, path + ".point",
                    fmt::format("is at x = {:g} m, but this side of the die is at {:g} m, allowed: "
                                "the same position, or no tool '{}'",
                                point->vector.x(), x, wall.name));
  }

  Table& root_;
  Origin origin_;
  Problems& problems_;
  DieSpec spec_;
  bool wrong_ = false;  // a value that the die depends on
  std::optional<MissingWidth> missing_;
  Array* packings_ = nullptr;
};

// A random packing needs a width, or a die.
void require_widths(Table& root, Problems& problems) {
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

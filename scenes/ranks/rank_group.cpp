#include "scenes/ranks/rank_group.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "components/bond.hpp"
#include "components/contact.hpp"
#include "components/ranks.hpp"
#include "components/run_state.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "engine/state_bytes.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/spec/scene.hpp"
#include "systems/ranks/restore.hpp"

namespace pulvis {
namespace {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

// Name of a column, as RankGroup::numbers_of expects it.
template <class C>
std::string name_of() {
  return fmt::format("{}/{}", C::Entity::name, C::info.name);
}

bool shears(const Scene& scene) {
  return std::ranges::any_of(
      scene.stages, [](const StageSpec& stage) { return stage.kind == StageSpec::Kind::shear; });
}
bool looks_at_motion(const Scene& scene) {
  return shears(scene) || scene.output.density() || !scene.expects.empty();
}
bool has_round_die(const Scene& scene) {
  return std::ranges::find(scene.tools, ToolSpec::Shape::die, &ToolSpec::shape) !=
         scene.tools.end();
}

}  // namespace

RankGroup::RankGroup(World& share, std::unique_ptr<World> whole, const Scene& scene,
                     std::vector<ParticleValues> fields, std::vector<ParticleValues> hashed)
    : share_(share),
      whole_(std::move(whole)),
      ranks_(*share.resource<RankLink>().ranks),
      values_(std::move(fields)),
      fields_(values_.size()),
      balance_(share),
      output_(share),
      needs_motion_(looks_at_motion(scene)),
      needs_tool_rows_(shears(scene)),
      needs_die_wall_(has_round_die(scene)) {
  std::ranges::move(hashed, std::back_inserter(values_));
}

RankGroup::~RankGroup() {
  if (leads()) tell({Command::Kind::leave});
  await_outlines(share_);
}

void RankGroup::tell(Command command) {
  StateWriter writer;
  command.state(writer);
  Ranks::Bytes bytes = writer.bytes();
  ranks_.broadcast(bytes);
}

Command RankGroup::listen() {
  Ranks::Bytes bytes;
  ranks_.broadcast(bytes);
  Command command;
  StateReader reader(bytes);
  command.state(reader);
  return command;
}

RankGroup::Next RankGroup::next(bool root_stops) {
  const Next of_root = root_stops ? Next::stop : balance_.is_due() ? Next::balance : Next::step;
  Ranks::Bytes bytes(1, static_cast<std::byte>(of_root));
  ranks_.broadcast(bytes);
  return static_cast<Next>(bytes.front());
}

void RankGroup::fetch(const Command& command) {
  Gatherer gathering(share_, whole_.get());
  for (const std::uint64_t number : command.columns)
    gathering.column(static_cast<std::size_t>(number));
  if (command.rows) gathering.row_index();
  gathering.common();
}

void RankGroup::total() {
  bytes_of_all_ = bytes_;
  ranks_.sum(std::span(&bytes_of_all_, 1));
  memory_.assign(static_cast<std::size_t>(ranks_.count()), 0);
  memory_[static_cast<std::size_t>(ranks_.rank())] = peak_memory();
  ranks_.maximum(memory_);
  balance_.tell_costs();
  Gatherer(share_, whole_.get()).common();
}

void RankGroup::visit_particles(const Command& command, const ValueSink& take) {
  Gatherer(share_, whole_.get()).particles(values_.at(command.field), take);
}

void RankGroup::write(const Command& command) {
  if (command.kind == Command::Kind::write_field)
    output_.field(values_.at(command.field), command.room);
  else if (command.kind == Command::Kind::write_column)
    output_.column(static_cast<std::size_t>(command.columns.front()), command.room.at);
  else
    output_.flush();
}

// The ranges of triangles count from the start of each rank's own list.
std::optional<std::uint64_t> RankGroup::bytes_written_in(const std::filesystem::path& folder,
                                                         const ColumnBase& column) const {
  const bool is_range =
      whole_->has<space::TriangleLists>() && &column == &whole_->column<space::TriangleRange>();
  if (is_range || !output_.can_write_in(folder)) return {};
  if (is_by_chunk(column)) return column.owner().rows * column.row_bytes;
  if (!is_of_contacts(column)) return {};
  const ContactIndex& index = whole_->resource<ContactIndex>();
  const auto& begin = is_with_tools(column.entity) ? index.tool_begin : index.sampled_begin;
  return static_cast<std::uint64_t>(begin.back()) * column.row_bytes;
}

std::vector<std::uint64_t> RankGroup::numbers_of(const std::vector<std::string>& names) const {
  std::vector<std::uint64_t> numbers;
  const auto& columns = share_.columns();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = columns[i]->entity + "/" + columns[i]->info.name;
    const bool contacts = is_of_contacts(*columns[i]);
    const bool asked = std::ranges::any_of(names, [&](const std::string& wanted) {
      return wanted == name || wanted == columns[i]->entity + "/*" ||
             (contacts && wanted == columns[i]->info.name);
    });
    if (asked && (contacts || is_by_chunk(*columns[i]))) numbers.push_back(i);
  }
  return numbers;
}

// The index of the rows is derived from their pairs.
Command RankGroup::fetch_sample(const std::vector<std::string>& looks) const {
  std::vector<std::string> names{"particle/*"};
  if (needs_motion_) names.insert(names.end(), {"node/position", "node/velocity"});
  if (needs_tool_rows_) names.push_back(name_of<ContactTouches<ToolContact>>());
  if (needs_die_wall_)
    names.insert(names.end(),
                 {name_of<space::SurfacePosition>(), name_of<PointForce<FaceToolContact>>(),
                  name_of<ContactTouches<FaceToolContact>>()});
  if (whole_->has<BondTotals>())
    names.insert(names.end(), {name_of<CurvePosition>(), name_of<space::SurfacePosition>(), "law",
                               "bond_law", "bonded", "bond_damage"});
  names.insert(names.end(), looks.begin(), looks.end());
  const bool needs_rows = std::ranges::any_of(numbers_of(names), [&](std::uint64_t number) {
    return is_of_contacts(*share_.columns()[number]);
  });
  if (needs_rows) names.emplace_back("pair");
  return {Command::Kind::observe, 0, numbers_of(names), needs_rows};
}
Command RankGroup::fetch_rows() const {
  return {Command::Kind::fetch, 0, numbers_of({"pair"}), true};
}
Command RankGroup::fetch_start() const {
  if (!whole_->has<BondTotals>()) return {Command::Kind::fetch, 0, numbers_of({"node/position"})};
  return {Command::Kind::fetch, 0, numbers_of({"node/position", "pair", "bonded", "bond_law"}),
          true};
}
Command RankGroup::hashed(std::size_t number) const {
  Command command{Command::Kind::particles};
  command.field = fields_ + number;
  return command;
}

void RankGroup::restore_findings(const Checkpoint& checkpoint) {
  for (const World::SavedResource& resource : whole_->saved_resources())
    resource.set_state(checkpoint.resource(resource.name));
}

void RankGroup::drop() {
  for (const ColumnBase* column : whole_->columns()) drop(*column);
}

void RankGroup::drop(const ColumnBase& column) {
  const bool small = column.entity == "particle";
  if ((is_by_chunk(column) || is_of_contacts(column)) && !small) whole_->drop_column(column);
}

std::size_t RankGroup::number_of(const ColumnBase& column) const {
  const auto& columns = whole_->columns();
  return static_cast<std::size_t>(std::ranges::find(columns, &column) - columns.begin());
}

void require_ranks_can_run(const Scene& scene) {
  if (!scene.afm) return;
  SceneProblem problem;
  problem.file = scene.file.string();
  problem.line = problem.column = 1;
  problem.key = "afm";
  problem.message =
      "ranks divide the particles among them, and a lever is a single body, allowed: --ranks 1";
  throw SceneError({problem});
}

}  // namespace pulvis

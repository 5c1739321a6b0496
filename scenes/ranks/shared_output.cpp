#include "scenes/ranks/shared_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "components/contact.hpp"
#include "components/ranks.hpp"
#include "components/shape.hpp"
#include "engine/files/output_error.hpp"
#include "engine/files/xdmf.hpp"
#include "engine/ranks/machine_name.hpp"
#include "engine/state_bytes.hpp"
#include "scenes/ranks/columns.hpp"

namespace pulvis {
namespace {

Ranks::Bytes bytes_of_text(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

bool are_on_one_machine(Ranks& ranks) {
  const std::vector<Ranks::Bytes> all = ranks.gather(bytes_of_text(machine_name()));
  return std::ranges::all_of(all, [&](const Ranks::Bytes& name) { return name == all.front(); });
}

struct Failure {
  std::string path, operation, reason;  // empty: none
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(path, operation, reason);
  }
};

}  // namespace

SharedOutput::SharedOutput(World& share)
    : share_(share),
      ranks_(*share.resource<RankLink>().ranks),
      is_on_one_machine_(are_on_one_machine(ranks_)) {}

bool SharedOutput::can_write_in(const std::filesystem::path& folder) const {
  return !is_left_to_root_ && (is_on_one_machine_ || has_one_view(folder));
}

SharedFile& SharedOutput::opened(const std::string& file) {
  if (file_ && file_->path() != file) flush_own();
  if (!file_) file_.emplace(file);
  return *file_;
}

template <class Action>
void SharedOutput::attempt(const Action& action) {
  Failure own;
  try {
    action();
  } catch (const OutputError& error) {
    own = {error.path().string(), error.operation(), error.reason()};
  }
  StateWriter writer;
  own.state(writer);
  const std::vector<Ranks::Bytes> all = ranks_.gather(writer.bytes());
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    Failure failure;
    StateReader reader(all[rank]);
    failure.state(reader);
    if (!failure.reason.empty())
      throw OutputError(failure.path, fmt::format("{} on rank {}", failure.operation, rank),
                        failure.reason);
  }
}

void SharedOutput::field(const ParticleValues& values, const FieldRoom& room) {
  attempt([&] {
    const Bodies& bodies = share_.resource<Bodies>();
    const std::uint64_t row_bytes = static_cast<std::uint64_t>(room.stored) * sizeof(double);
    std::uint64_t at = room.at.begin;
    std::vector<double> of_one;
    for (const int slot : bodies.slot_of_number) {
      const std::uint64_t begin = at;
      at += row_bytes * places_in(share_, slot, room.place);
      if (!bodies.owns(slot)) continue;
      of_one.clear();
      values(share_, slot, of_one);
      if (room.stored != room.components) of_one = with_zero_third(of_one);
      opened(room.at.file).write(begin, bytes_of(of_one));
    }
  });
}

void SharedOutput::column(std::size_t number, const FileRoom& room) {
  const ColumnBase& column = *share_.columns()[number];
  const Bodies& bodies = share_.resource<Bodies>();
  const std::vector<std::int32_t> begin =
      is_by_chunk(column) ? std::vector<std::int32_t>() : row_begins_in(share_, column.entity);
  std::vector<std::int64_t> bytes(static_cast<std::size_t>(bodies.chunks()));
  for (const int chunk : bodies.own_chunks)
    entry(bytes, chunk) = std::ssize(rows_of_chunk(column, chunk, begin));
  ranks_.sum(bytes);
  std::exclusive_scan(bytes.begin(), bytes.end(), bytes.begin(), std::int64_t{0});  // before each
  attempt([&] {
    for (const int chunk : bodies.own_chunks)
      opened(room.file).write(room.begin + static_cast<std::uint64_t>(entry(bytes, chunk)),
                              rows_of_chunk(column, chunk, begin));
  });
}

// Closed, since another file may get its name. After a failure it stays, and goes on failing.
void SharedOutput::flush_own() {
  if (!file_) return;
  file_->flush();
  file_.reset();
}

void SharedOutput::flush() {
  attempt([&] { flush_own(); });
}

}  // namespace pulvis

// send_outlines, receive_outlines: positions of the outlines that the rows of another rank need.
// send_contacts, receive_contacts (in three dimensions send_loads, receive_loads): effects of touching rows on particles of
// another rank.
//
// Runs     outlines are sent as soon as they have moved, at the end of a step, and awaited when the bodies of the next one
//          have been processed; contacts are sent after the narrow phase and the bonds between particles, and awaited after
//          those of tools
// Active   when the run has several ranks
#include <cstring>

#include "systems/ranks/border.hpp"
#include "systems/ranks/systems.hpp"

namespace pulvis {
namespace {

std::vector<int> ranks_that_send(const std::vector<RankLink::Neighbour>& all) {
  std::vector<int> ranks;
  for (const RankLink::Neighbour& near : all)
    if (!near.receive.empty()) ranks.push_back(near.rank);
  return ranks;
}

// Messages serialised from numbers, and deserialised.
class Writer {
 public:
  template <class T>
  void put(const T* first, std::size_t count) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + count * sizeof(T));
    if (count > 0) std::memcpy(bytes_.data() + at, first, count * sizeof(T));
  }
  Ranks::Bytes taken() { return std::move(bytes_); }

 private:
  Ranks::Bytes bytes_;
};
class Reader {
 public:
  explicit Reader(const Ranks::Bytes& bytes) : left_(bytes) {}
  bool at_end() const { return left_.empty(); }
  template <class T>
  void take(T* first, std::size_t count) {
    if (count > 0) std::memcpy(first, left_.data(), count * sizeof(T));
    left_ = left_.subspan(count * sizeof(T));
  }

 private:
  std::span<const std::byte> left_;
};

}  // namespace

// ---- outlines ---------------------------------------------------------------------------------------
template <class D>
void send_outlines<D>::operator()() const {
  const std::vector<Outlines> columns = outlines.all();
  std::vector<Ranks::Message> messages;
  for (const RankLink::Neighbour& near : link->outlines)
    if (!near.send.empty()) messages.push_back({near.rank, packed(near.send, columns)});
  link->ranks->send(Ranks::Kind::outlines, std::move(messages));
  link->outlines_sent = true;
}

template <class D>
void receive_outlines<D>::operator()(SmallTasks) const {
  if (!link->outlines_sent) return;
  link->outlines_sent = false;
  const std::vector<Outlines> columns = outlines.all();
  const std::vector<int> from = ranks_that_send(link->outlines);
  const std::vector<Ranks::Message> messages = link->ranks->receive(Ranks::Kind::outlines, from);
  auto message = messages.begin();
  for (const RankLink::Neighbour& near : link->outlines)
    if (!near.receive.empty()) unpack((message++)->bytes, near.receive, columns);
}

template struct send_outlines<TwoD>;
template struct send_outlines<ThreeD>;
template struct receive_outlines<TwoD>;
template struct receive_outlines<ThreeD>;

// ---- contacts -----------------------------------------------------------------------------------------
// For every touching row: its position among the shared ones, forces, closest points, slope loads.
void send_contacts::operator()() const {
  std::vector<Ranks::Message> messages;
  for (const RankLink::Neighbour& near : link->rows) {
    if (near.send.empty()) continue;
    Writer writer;
    for (std::size_t i = 0; i < near.send.size(); ++i) {
      const Row<Contact> row(near.send[i]);
      if (rows.touches(row) == 0) continue;
      const auto position = static_cast<std::int32_t>(i);
      writer.put(&position, 1);
      writer.put(&rows.force(row), PointForce<Contact>::count);
      writer.put(&rows.closest(row), ClosestPoint::count);
      if (rows.slope_load) writer.put(&(*rows.slope_load)(row), SlopeLoad::count);
    }
    messages.push_back({near.rank, writer.taken()});
  }
  link->ranks->send(Ranks::Kind::contacts, std::move(messages));
}

void receive_contacts::operator()(SmallTasks) const {
  const std::vector<int> from = ranks_that_send(link->rows);
  const std::vector<Ranks::Message> messages = link->ranks->receive(Ranks::Kind::contacts, from);
  auto message = messages.begin();
  for (const RankLink::Neighbour& near : link->rows) {
    if (near.receive.empty()) continue;
    for (const int row : near.receive) rows.touches(Row<Contact>(row)) = 0;
    for (Reader reader((message++)->bytes); !reader.at_end();) {
      std::int32_t position = 0;
      reader.take(&position, 1);
      const Row<Contact> row(entry(near.receive, position));
      rows.touches(row) = 1;
      reader.take(&rows.force(row), PointForce<Contact>::count);
      reader.take(&rows.closest(row), ClosestPoint::count);
      if (rows.slope_load) reader.take(&(*rows.slope_load)(row), SlopeLoad::count);
    }
  }
}

// For every touching pair: its position among the shared ones, the number of loaded faces, these and their loads.
void send_loads::operator()() const {
  std::vector<Ranks::Message> messages;
  for (const RankLink::Neighbour& near : link->rows) {
    if (near.send.empty()) continue;
    Writer writer;
    for (std::size_t i = 0; i < near.send.size(); ++i) {
      const space::PairLoads::Pair& pair = entry(loads->pairs, near.send[i]);
      if (pair.face.empty()) continue;
      const std::array<std::int32_t, 2> head{static_cast<std::int32_t>(i),
                                             static_cast<std::int32_t>(pair.face.size())};
      writer.put(head.data(), head.size());
      writer.put(pair.face.data(), pair.face.size());
      for (const space::PairLoads::Load& load : pair.load)
        writer.put(load.force.data(), load.force.size());
    }
    messages.push_back({near.rank, writer.taken()});
  }
  link->ranks->send(Ranks::Kind::contacts, std::move(messages));
}

void receive_loads::operator()(SmallTasks) const {
  const std::vector<int> from = ranks_that_send(link->rows);
  const std::vector<Ranks::Message> messages = link->ranks->receive(Ranks::Kind::contacts, from);
  auto message = messages.begin();
  for (const RankLink::Neighbour& near : link->rows) {
    if (near.receive.empty()) continue;
    for (const int pair : near.receive) entry(loads->pairs, pair).clear();
    for (Reader reader((message++)->bytes); !reader.at_end();) {
      std::array<std::int32_t, 2> head{};
      reader.take(head.data(), head.size());
      space::PairLoads::Pair& pair = entry(loads->pairs, entry(near.receive, head[0]));
      pair.face.resize(static_cast<std::size_t>(head[1]));
      pair.load.resize(pair.face.size());
      reader.take(pair.face.data(), pair.face.size());
      for (space::PairLoads::Load& load : pair.load)
        reader.take(load.force.data(), load.force.size());
    }
  }
}

}  // namespace pulvis

#include "systems/sparse/supernodes.hpp"

#include <algorithm>
#include <numeric>

#include "engine/entry.hpp"

namespace pulvis::sparse {
namespace {

using List = std::vector<std::int32_t>;
using Lists = std::vector<List>;

constexpr int widest = 16;  // blocks: the entries of a supernode fit into the cache

// Rows below the diagonal by columns, in the order of elimination.
Lists lower_rows(const BlockGraph& graph, const List& position) {
  Lists rows(position.size());
  for (int c = 0; c < graph.columns(); ++c)
    for (const int r : graph.rows_of(c)) {
      const auto [low, high] = std::minmax(entry(position, r), entry(position, c));
      if (low != high) entry(rows, low).push_back(high);
    }
  return rows;
}

// Parents in the elimination tree; -1: none (J. W. H. Liu, ACM Transactions on Mathematical Software 12 (1986) 127).
List elimination_tree(const Lists& lower) {
  const int size = static_cast<int>(lower.size());
  Lists upper(lower.size());
  for (int c = 0; c < size; ++c)
    for (const int r : entry(lower, c)) entry(upper, r).push_back(c);
  List parent(lower.size(), -1), ancestor(lower.size(), -1);
  for (int r = 0; r < size; ++r)
    for (int c : entry(upper, r))
      while (c != -1 && c != r) {
        const int next = std::exchange(entry(ancestor, c), r);
        if (next == -1) entry(parent, c) = r;
        c = next;
      }
  return parent;
}

// Places in which every parent follows its descendants at once.
List postorder(const List& parent) {
  const int size = static_cast<int>(parent.size());
  List descendants(parent.size(), 1), place(parent.size());
  for (int c = 0; c < size; ++c)
    if (const int p = entry(parent, c); p != -1) entry(descendants, p) += entry(descendants, c);
  int roots = 0;
  List begin(parent.size());  // where the next child's descendants start
  for (int c = size; c-- > 0;) {
    const int p = entry(parent, c);
    int& next = p == -1 ? roots : entry(begin, p);
    entry(begin, c) = next;
    next += entry(descendants, c);
    entry(place, c) = next - 1;
  }
  return place;
}

struct Node {
  int first = 0, end = 0;
  List rows;         // below `end`
  double zeros = 0;  // blocks that are stored although they are zero

  int columns() const { return end - first; }
  double blocks() const {
    const double width = columns();
    return width * (width + 1) / 2 + width * static_cast<double>(rows.size());
  }
};

// Columns whose rows are the same but for their own.
std::vector<Node> fundamental(const Lists& lower, const List& parent) {
  const int size = static_cast<int>(lower.size());
  Lists rows(lower.size()), children(lower.size());
  List seen_by(lower.size(), -1);
  std::vector<Node> nodes;
  for (int c = 0; c < size; ++c) {
    List& all = entry(rows, c);
    const auto take = [&](const List& list) {
      for (const int r : list)
        if (r > c && std::exchange(entry(seen_by, r), c) != c) all.push_back(r);
    };
    take(entry(lower, c));
    for (const int child : entry(children, c)) {
      take(entry(rows, child));
      List().swap(entry(rows, child));
    }
    std::ranges::sort(all);
    const bool continues =
        c > 0 && entry(parent, c - 1) == c && nodes.back().rows.size() == all.size() + 1;
    if (!continues) nodes.push_back({.first = c, .rows = {}});
    nodes.back().end = c + 1;
    nodes.back().rows = all;
    if (entry(parent, c) != -1) entry(children, entry(parent, c)).push_back(c);
  }
  return nodes;
}

// Few columns are worth many zeros, many are worth few (as in CHOLMOD: Y. Chen, T. A. Davis, W. W. Hager &
// S. Rajamanickam, ACM Transactions on Mathematical Software 35 (2008) 22).
bool are_worth(double zeros, double blocks, int columns) {
  if (columns <= 2) return true;
  if (columns <= 5) return zeros < 0.5 * blocks;
  if (columns <= widest) return zeros < 0.1 * blocks;
  return zeros < 0.05 * blocks;
}

// Joins a supernode with the parent that follows it.
std::vector<Node> amalgamated(std::vector<Node> nodes) {
  std::vector<Node> joined;
  for (Node& node : nodes) {
    while (!joined.empty()) {
      const Node& child = joined.back();
      if (child.rows.empty() || child.rows.front() >= node.end) break;
      Node both{.first = child.first, .end = node.end, .rows = node.rows};
      both.zeros = both.blocks() - (child.blocks() - child.zeros) - (node.blocks() - node.zeros);
      if (!are_worth(both.zeros, both.blocks(), both.columns())) break;
      node = std::move(both);
      joined.pop_back();
    }
    joined.push_back(std::move(node));
  }
  return joined;
}

void add(Supernodes& all, const Node& node) {
  const int parts = (node.columns() + widest - 1) / widest;
  for (int part = 0; part < parts; ++part) {
    const int first = node.first + node.columns() * part / parts,
              end = node.first + node.columns() * (part + 1) / parts;
    const int number = all.size();
    all.first.push_back(end);
    all.of_column.insert(all.of_column.end(), static_cast<std::size_t>(end - first), number);
    for (int r = end; r < node.end; ++r) all.row.push_back(r);
    all.row.insert(all.row.end(), node.rows.begin(), node.rows.end());
    all.row_begin.push_back(all.row.size());
  }
}

}  // namespace

std::span<const std::int32_t> BlockGraph::rows_of(int column) const {
  const auto begin = static_cast<std::size_t>(entry(column_begin, column));
  return row.subspan(begin, static_cast<std::size_t>(entry(column_begin, column + 1)) - begin);
}

int Supernodes::columns_of(int s) const { return entry(first, s + 1) - entry(first, s); }

std::span<const std::int32_t> Supernodes::rows_of(int s) const {
  const std::size_t begin = entry(row_begin, s);
  return std::span(row).subspan(begin, entry(row_begin, s + 1) - begin);
}

Supernodes supernodes_of(const BlockGraph& graph, std::vector<std::int32_t> position) {
  const List place = postorder(elimination_tree(lower_rows(graph, position)));
  for (std::int32_t& p : position) p = entry(place, p);
  const Lists lower = lower_rows(graph, position);
  Supernodes all{
      .position = std::move(position), .first = {0}, .row_begin = {0}, .row = {}, .of_column = {}};
  for (const Node& node : amalgamated(fundamental(lower, elimination_tree(lower)))) add(all, node);
  return all;
}

}  // namespace pulvis::sparse

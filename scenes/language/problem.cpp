#include "scenes/language/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "engine/printable.hpp"
#include "engine/shortened.hpp"

namespace pulvis {
namespace {

constexpr std::size_t longest_word = 64;  // nothing longer can be declared or named
constexpr std::size_t longest_message = 3000;
constexpr std::size_t longest_path = 4096;  // that a system opens

std::string all_lines(const std::vector<SceneProblem>& problems) {
  std::vector<std::string> lines;
  for (const SceneProblem& problem : problems) lines.push_back(problem.text());
  return fmt::format("{}", fmt::join(lines, "\n"));
}

// Ignoring case.
bool same_letters(const std::string& a, const std::string& b) {
  const auto small = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(a, b, {}, small, small);
}

// Insertions, deletions, substitutions and swaps of neighbours that turn one word into another (optimal string
// alignment).
std::size_t distance(const std::string& from, const std::string& to) {
  std::array<std::size_t, longest_word + 1> before{}, last{}, row{};
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[to.size()];
}

}  // namespace

std::string SceneProblem::text() const {
  const std::string what = printable_lines(shortened(message, longest_message));
  const std::string named = printable(shortened(key));
  if (!override_text.empty())
    return fmt::format("--set {}: {}: {}", printable(shortened(override_text)), named, what);
  return fmt::format("{}:{}:{}: {}: {}", printable(shortened(file, longest_path)), line, column,
                     named, what);
}

SceneError::SceneError(std::vector<SceneProblem> problems)
    : std::runtime_error(all_lines(problems)), problems_(std::move(problems)) {}

void Problems::add(const document::Origin& origin, const std::string& key,
                   const std::string& message) {
  const SourceMark& mark = origin.mark;
  SceneProblem problem{file_of(mark).string(), mark.line, mark.column, "", key, message};
  if (origin.override_index >= 0) {
    problem.line = problem.column = 0;
    problem.override_text = overrides_.at(static_cast<std::size_t>(origin.override_index));
  }
  problems_.push_back(std::move(problem));
}

void Problems::throw_if_any() const {
  if (problems_.empty()) return;
  std::vector<SceneProblem> sorted = problems_;
  const auto place = [&](const SceneProblem& problem) {
    const auto file = std::ranges::find(files_, std::filesystem::path(problem.file));
    return std::tuple(file - files_.begin(), problem.line, problem.column);
  };
  std::ranges::stable_sort(sorted, std::less(), place);
  throw SceneError(std::move(sorted));
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > longest_word) return "";
  const std::string* best = nullptr;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_word) continue;
    if (same_letters(word, candidate)) return fmt::format(", did you mean '{}'?", candidate);
    const std::size_t d = distance(word, candidate);
    if (d < best_distance && d < candidate.size()) {
      best = &candidate;
      best_distance = d;
    }
  }
  return best == nullptr ? "" : fmt::format(", did you mean '{}'?", *best);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t maximum = 20;  // keep messages short
  if (words.empty()) return "none";
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), maximum); ++i)
    text += (i == 0 ? "" : ", ") + shortened(words[i]);
  return words.size() > maximum ? text + ", ..." : text;
}

}  // namespace pulvis

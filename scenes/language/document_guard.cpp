// Looks over the text of a scene before the TOML library does. toml++ 3.3 walks into an unreachable
// statement at a non-ASCII bare key, and recurses for every level of nesting.
#include "scenes/language/document_guard.hpp"

#include "scenes/language/document.hpp"

#include <fmt/format.h>

namespace pulvis::document {
namespace {

constexpr int deepest_nesting = 16;  // scenes need five

// Length of the UTF-8 sequence at the front of `text`, 0 when it is none (RFC 3629: no surrogates,
// no overlong forms, nothing above U+10FFFF).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i])) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool overlong = first == 0xE0 && second < 0xA0;
    const bool surrogate = first == 0xED && second > 0x9F;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool overlong = first == 0xF0 && second < 0x90;
    const bool beyond = first == 0xF4 && second > 0x8F;
    return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

class Guard {
 public:
  explicit Guard(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte order mark
  }

  void run() {
    while (!rest_.empty()) {
      if (rest_.front() == '#')
        skip_comment();
      else if (rest_.front() == '"' || rest_.front() == '\'')
        skip_string();
      else
        plain();
    }
  }

 private:
  void skip_comment() {
    while (!rest_.empty() && rest_.front() != '\n') advance();
  }

  void skip_string() {
    const SourceMark start = mark_;
    const char quote = rest_.front();
    const bool escapes = quote == '"';
    const std::string triple(3, quote);
    const bool long_form = rest_.starts_with(triple);
    for (int i = 0; i < (long_form ? 3 : 1); ++i) advance();
    while (!(long_form ? rest_.starts_with(triple) : rest_.starts_with(quote))) {
      if (rest_.empty() || (!long_form && rest_.front() == '\n'))
        throw SyntaxError(start, "a string is not closed, allowed: a quote at its end");
      if (escapes && rest_.front() == '\\' && rest_.size() > 1 && rest_[1] != '\n') advance();
      advance();
    }
    for (int i = 0; i < (long_form ? 3 : 1); ++i) advance();
  }

  void plain() {
    const char c = rest_.front();
    if (static_cast<unsigned char>(c) >= 0x80)
      fail("a character outside of ASCII needs quotes, allowed: letters, digits, '_' and '-'");
    if (c == '[' || c == '{') ++depth_;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    if (c == '.') ++dots_;
    if (c == ',' || c == '=' || c == '[' || c == '{' || c == '\n') dots_ = 0;
    if (depth_ > deepest_nesting || dots_ > deepest_nesting)
      fail(fmt::format("nested too deeply, allowed: {} levels", deepest_nesting));
    advance();
  }

  void advance() {
    if (rest_.front() == '\0') fail("a NUL byte, allowed: text in UTF-8");
    const std::size_t length = sequence_length(rest_);
    if (length == 0) fail("bytes that are no UTF-8, allowed: text in UTF-8");
    const bool new_line = rest_.front() == '\n';
    rest_.remove_prefix(length);
    mark_ = new_line ? SourceMark{mark_.line + 1, 1} : SourceMark{mark_.line, mark_.column + 1};
  }

  [[noreturn]] void fail(const std::string& message) const { throw SyntaxError(mark_, message); }

  std::string_view rest_;
  SourceMark mark_{1, 1};
  int depth_ = 0;  // of brackets and braces
  int dots_ = 0;   // in the key being read
};

}  // namespace

void guard(std::string_view text) { Guard(text).run(); }

}  // namespace pulvis::document

// Checks the text of a scene before the TOML library reads it. toml++ 3.3 reaches an unreachable
// statement at a non-ASCII bare key, and recurses for every level of nesting.
#include "scenes/language/document_guard.hpp"

#include "scenes/language/document.hpp"
#include "scenes/language/encoding.hpp"

#include <fmt/format.h>

namespace pulvis::document {
namespace {

constexpr int deepest_nesting = 16;  // scenes need five

class Guard {
 public:
  explicit Guard(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte order mark
  }

  void run() {
    if (is_utf16(rest_)) fail("the file is UTF-16, allowed: text in UTF-8; save it as UTF-8");
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
    for (const char* quote : {"\u201C", "\u201D", "\u201E", "\u2018", "\u2019"})
      if (rest_.starts_with(quote))
        fail(fmt::format("a typographic quote, {}, allowed: the straight quotes \" and '", quote));
    if (static_cast<unsigned char>(c) >= 0x80)
      fail("a non-ASCII character needs quotes, allowed: letters, digits, '_' and '-'");
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
    if (length == 0)
      fail(fmt::format(
          "bytes that are not UTF-8 ({}), allowed: text in UTF-8; save the file as UTF-8",
          latin1_text(rest_.front())));
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

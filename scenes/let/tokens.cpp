#include "scenes/let/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scenes/let/dimension.hpp"

namespace pulvis::let {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool in_name(char c) { return is_letter(c) || is_digit(c); }
bool in_unit(char c) { return is_letter(c) || c == '%' || static_cast<unsigned char>(c) >= 0x80; }

class Cutter {
 public:
  Cutter(std::string_view text, const IsKnown& is_known) : text_(text), is_known_(is_known) {}

  std::vector<Token> cut() {
    std::vector<Token> tokens;
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) tokens.push_back(next());
    return tokens;
  }

 private:
  char here(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  std::string_view since(std::size_t start) const { return text_.substr(start, at_ - start); }
  void skip_blanks() {
    while (is_blank(here())) ++at_;
  }

  Token next() {
    const std::size_t start = at_;
    if (is_digit(here()) || (here() == '.' && is_digit(here(1)))) return number();
    if (is_letter(here())) {
      while (in_name(here())) ++at_;
      return {Token::Kind::name, since(start)};
    }
    if (std::string_view("+-*/^(),").find(here()) == std::string_view::npos)
      throw ExpressionError(
          fmt::format("'{}' is not allowed in an expression", text_.substr(at_, 1)));
    ++at_;
    return {Token::Kind::sign, since(start)};
  }

  Token number() {
    const std::size_t start = at_;
    double value = 0;
    const auto read = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(read.ptr - text_.data());
    const std::size_t end = at_;
    skip_blanks();
    const std::size_t begin = at_;
    if (here() == '1' && here(1) == '/' && in_unit(here(2))) at_ += 2;  // "5 1/s"
    if (!in_unit(here())) {
      at_ = end;
      return {Token::Kind::number, since(start)};
    }
    unit_word();
    while (further_factor()) {
    }
    return {Token::Kind::number, since(start), since(begin)};
  }

  // "um^2", "m-3", "s": the name of a unit with its power.
  void unit_word() {
    while (in_unit(here())) ++at_;
    const std::size_t caret = here() == '^' ? 1 : 0;
    const std::size_t sign = here(caret) == '-' || here(caret) == '+' ? 1 : 0;
    if (!is_digit(here(caret + sign))) return;
    at_ += caret + sign;
    while (is_digit(here())) ++at_;
  }

  // "/um^2", ".s", "*K", " m-3", "/(kg K)" after a unit; after an operator, a variable is no unit.
  bool further_factor() {
    const std::size_t start = at_;
    skip_blanks();
    const bool apart = at_ > start;
    const char joint = here();
    const bool joined = joint == '/' || joint == '*' || joint == '.';
    if (joined) {
      ++at_;
      skip_blanks();
    }
    if (joined && joint != '.' && bracket_of_units()) return true;
    if (in_unit(here()) && (joined ? !is_known_(word_here()) : apart)) {
      unit_word();
      return true;
    }
    at_ = start;
    return false;
  }

  std::string_view word_here() const {
    std::size_t end = at_;
    while (end < text_.size() && in_name(text_[end])) ++end;
    return text_.substr(at_, end - at_);
  }

  // "(kg K)": accepted if the brackets contain only units.
  bool bracket_of_units() {
    const std::size_t close = text_.find(')', at_);
    if (here() != '(' || close == std::string_view::npos) return false;
    const std::size_t start = at_++;
    skip_blanks();
    bool units = in_unit(here()) && !is_known_(word_here());
    if (units) unit_word();
    while (units && at_ < close && further_factor()) {
    }
    skip_blanks();
    units = units && at_ == close;
    at_ = units ? close + 1 : start;
    return units;
  }

  std::string_view text_;
  const IsKnown& is_known_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text, const IsKnown& is_known) {
  return Cutter(text, is_known).cut();
}

bool is_literal(const std::vector<Token>& tokens) {
  const bool sign = tokens.size() == 2 && (tokens[0].text == "-" || tokens[0].text == "+");
  return !tokens.empty() && (tokens.size() == 1 || sign) &&
         tokens.back().kind == Token::Kind::number;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!in_name(text[i])) continue;
    std::size_t end = i;
    while (end < text.size() && in_name(text[end])) ++end;
    if (is_letter(text[i])) words.push_back(text.substr(i, end - i));
    i = end;
  }
  return words;
}

}  // namespace pulvis::let

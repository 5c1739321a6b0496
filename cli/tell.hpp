// Messages on the terminal. Names, paths and messages may contain anything: control characters are
// escaped.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "engine/printable.hpp"

namespace pulvis {

template <class... Values>
void tell(std::FILE* to, fmt::format_string<Values...> format, Values&&... values) {
  fmt::print(to, "{}", printable_lines(fmt::format(format, std::forward<Values>(values)...)));
}

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell(stdout, format, std::forward<Values>(values)...);
}

}  // namespace pulvis

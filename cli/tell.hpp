// Messages on the terminal. Names, paths and messages may contain anything: control characters are
// escaped.
//
// Standard output and error may be closed, on a full disk, or a pipe whose reader has ended: no message that cannot be
// written ends a run.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

#include "engine/printable.hpp"

namespace pulvis {

// Call before any file is opened. A file would take the number of a closed stream, and messages would go into it. Where
// a reader of a pipe has ended, writing is an error from now on, not a signal that kills the process.
void prepare_standard_streams();
// The first part of it, for a process with signals of its own.
void hold_standard_streams();

// Never fails: what standard output has lost is reported at the end of the program.
void put(std::FILE* to, std::string_view text) noexcept;
void flush(std::FILE* to) noexcept;

// The exit code of a command that ends with `code`: lost output is a failure, unless it was a log.
int end_output(int code, bool is_log);

template <class... Values>
void tell(std::FILE* to, fmt::format_string<Values...> format, Values&&... values) {
  put(to, printable_lines(fmt::format(format, std::forward<Values>(values)...)));
}

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell(stdout, format, std::forward<Values>(values)...);
}

}  // namespace pulvis

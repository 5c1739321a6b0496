// Another program, run to its end with all that it prints.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct Captured {
  int code = -1;     // exit code; -1: a signal ended it
  std::string text;  // standard output and standard error, in the order in which they came
};

// The first word is looked for on PATH; `folder` is where the program runs. Throws NoProgram, or OutputError where the
// machine refuses.
Captured run_captured(const std::vector<std::string>& words, const std::filesystem::path& folder);

class NoProgram : public std::exception {
 public:
  const char* what() const noexcept override { return "there is no such program on PATH"; }
};

}  // namespace pulvis

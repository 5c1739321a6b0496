// Runs another program to its end and captures its output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct Captured {
  int code = -1;     // exit code; -1: a signal ended it
  std::string text;  // standard output and standard error, interleaved as printed
};

// The first word is looked up on PATH; `folder` is the working directory; variables whose names start with one of `hidden`
// are not passed on. Throws NoProgram, or OutputError if the system refuses.
Captured run_captured(const std::vector<std::string>& words, const std::filesystem::path& folder,
                      const std::vector<std::string>& hidden = {});

class NoProgram : public std::exception {
 public:
  const char* what() const noexcept override { return "there is no such program on PATH"; }
};

}  // namespace pulvis

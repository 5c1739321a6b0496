// The built program, started as a user would, in a folder of the test's own.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>
#include "tests/helpers/paths.hpp"

namespace pulvis {

using Words = std::vector<std::string>;

struct Outcome {
  int code = -1;  // 128 + signal where one ended it, as in a shell
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

inline void send_to(const std::filesystem::path& file, int descriptor) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(opened, descriptor);
}

class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    place = std::filesystem::temp_directory_path() /
            ("pulvis-program-" + std::to_string(getpid()) + "-" + test->name());
    std::filesystem::remove_all(place);
    std::filesystem::create_directories(place);
  }
  void TearDown() override { std::filesystem::remove_all(place); }

  // Starts the program in `place`; its output goes into files there. `shell` is run before, by a shell that
  // then becomes the program: limits.
  pid_t start(const Words& arguments, const std::string& shell = "") const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::filesystem::current_path(place);
    send_to(place / "out", STDOUT_FILENO);
    send_to(place / "err", STDERR_FILENO);
    const std::string program = paths::program();
    const std::string script = shell + "; exec \"$0\" \"$@\"";
    std::vector<char*> argv{const_cast<char*>("pulvis")};
    if (!shell.empty())
      argv = {const_cast<char*>("sh"), const_cast<char*>("-c"), const_cast<char*>(script.c_str()),
              const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    execv(shell.empty() ? program.c_str() : "/bin/sh", argv.data());
    _exit(127);
  }

  Outcome end_of(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            text_of(place / "out"), text_of(place / "err")};
  }

  Outcome pulvis(const Words& arguments, const std::string& shell = "") const {
    return end_of(start(arguments, shell));
  }

  static std::string scene(const std::string& name) {
    return paths::source_dir() + "/scenes/" + name;
  }

  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // What makes a matrix of 25 discs a run of some 250 steps.
  static Words quick() {
    return {"--set", "stage.press.duration=20 us",
            "--set", "stage.press.move[0].displacement=[\"0 mm\", \"-0.4 mm\"]",
            "--set", "output.frames=4",
            "--set", "output.samples=20"};
  }
  static Words short_run(const std::string& folder, const Words& more = {}) {
    return with(with({"run", scene("compaction/regular-25.toml"), "-o", folder}, quick()), more);
  }

  std::filesystem::path place;
};

}  // namespace pulvis

// Files that a user names: what is no regular file of bounded size is refused, and nothing waits for it.
#include "engine/files/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using ::testing::StartsWith;

class InputFile : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(place);
    std::ofstream(place / "ten") << "0123456789";
  }
  void TearDown() override { fs::remove_all(place); }

  static std::string refusal(const fs::path& path) {
    try {
      text_of_input(path, 1000);
    } catch (const UnfitInput& unfit) {
      return unfit.what();
    }
    return "none";
  }

  fs::path place = fs::temp_directory_path() / ("pulvis-input-" + std::to_string(getpid()));
};

TEST_F(InputFile, IsReadUpToItsBound) {
  EXPECT_EQ(text_of_input(place / "ten", 10), "0123456789");
  EXPECT_THROW(text_of_input(place / "ten", 9), UnfitInput);
  fs::create_symlink(place / "ten", place / "link");
  EXPECT_EQ(text_of_input(place / "link", 10), "0123456789");
}

// A pipe without a writer would wait for ever, /dev/zero would fill the memory.
TEST_F(InputFile, IsRefusedByWhatItIs) {
  ASSERT_EQ(mkfifo((place / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(place / "pipe"), "is a named pipe");
  EXPECT_EQ(refusal(place), "is a folder");
  EXPECT_EQ(refusal("/dev/zero"), "is a device");
  EXPECT_EQ(refusal("/dev/null"), "is a device");
  EXPECT_EQ(refusal(place / "none"), "there is no such file");
  EXPECT_EQ(refusal(place / "ten" / "below"), "there is no such file");
  EXPECT_THROW(require_regular_file(place / "pipe"), UnfitInput);
  EXPECT_NO_THROW(require_regular_file(place / "ten"));
}

// Files of /proc say that they are empty, and are not.
TEST_F(InputFile, IsBoundedByWhatIsReadNotByWhatIsTold) {
  EXPECT_THAT(text_of_input("/proc/self/cmdline", 1U << 20U), ::testing::Not(""));
  EXPECT_THAT(refusal("/proc/kallsyms"), StartsWith("is larger than 1000 bytes"));
}

}  // namespace
}  // namespace pulvis

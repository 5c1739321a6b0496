// What is shown holds no order to the terminal, whatever was given.
#include "engine/printable.hpp"

#include <gtest/gtest.h>

namespace pulvis {
namespace {

TEST(Printable, SpellsControlCharactersOut) {
  EXPECT_EQ(printable("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable(std::string_view("a\0b\x7f", 4)), "a\\x00b\\x7f");
  EXPECT_EQ(printable("a\nb\tc\r"), "a\\x0ab\\x09c\\x0d");
  EXPECT_EQ(printable_lines("a\nb\tc\r\x07"), "a\nb\tc\\x0d\\x07");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // CSI of C1, as UTF-8
}

TEST(Printable, KeepsTextOfAnyLanguage) {
  EXPECT_EQ(printable("Würfel µm 粉末 🙂"), "Würfel µm 粉末 🙂");
  EXPECT_EQ(printable("caf\xe9 \xf0\x9f"), "caf\\xe9 \\xf0\\x9f");  // no UTF-8
}

// Every pair of bytes: nothing below 0x20, no DEL, no C1, and printable text is left as it is.
TEST(Printable, LeavesNoControlCharacterOfAnyTwoBytes) {
  for (int a = 0; a < 256; ++a)
    for (int b = 0; b < 256; ++b) {
      const std::string given{static_cast<char>(a), static_cast<char>(b)}, shown = printable(given);
      for (std::size_t i = 0; i < shown.size(); ++i) {
        const auto c = static_cast<unsigned char>(shown[i]);
        EXPECT_TRUE(c >= 0x20 && c != 0x7f) << a << " " << b;
        const int next = c == 0xc2 ? static_cast<unsigned char>(shown.at(i + 1)) : 0xa0;
        EXPECT_GE(next, 0xa0) << a << " " << b;
      }
      EXPECT_EQ(printable(shown), shown);
    }
}

}  // namespace
}  // namespace pulvis

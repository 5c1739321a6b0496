// Enumerations are counted by the compiler, wherever they are declared.
#include "engine/enum_table.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace pulvis {
namespace {

enum class Hidden { first, second_2 };
struct Outer {
  enum class Inner : std::uint8_t { a, b, c };
};

static_assert(count_of<Hidden>() == 2);
static_assert(count_of<Outer::Inner>() == 3);

template <class Enum, int... numbers>
constexpr bool has_table = requires {
  EnumTable<Enum, int>(numbers...);
};

TEST(EnumTable, IsIndexedByItsEnumeration) {
  static constexpr EnumTable<Outer::Inner> names{"a", "b", "c"};
  EXPECT_STREQ(names[Outer::Inner::a], "a");
  EXPECT_STREQ(names[Outer::Inner::c], "c");
}

TEST(EnumTable, NeedsAnEntryForEachValue) {
  EXPECT_TRUE((has_table<Outer::Inner, 1, 2, 3>));
  EXPECT_FALSE((has_table<Outer::Inner, 1, 2>));
  EXPECT_FALSE((has_table<Outer::Inner, 1, 2, 3, 4>));
}

}  // namespace
}  // namespace pulvis

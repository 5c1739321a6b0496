#!/usr/bin/python3
"""What sizes.py takes for a function, and how many parameters it counts: beside what the compiler would say."""
import sys

import sizes

CODE = r'''
#define WRONG(a, b) void wrong(int a, int b) {
namespace pulvis {
namespace {
const char* const text = R"x(void no(int a) { )" ")x";  // void nor(int a) {
constexpr char brace = '{', quote = '"';
constexpr int many = 1'000'000;
template <class T, int N = (3 > 2)>
int plain(const std::map<int, std::pair<T, int>>& map, T a = T{1, 2}) {
  for (int i = 0; i < N; ++i) { use(map, a); }
  return 0;
}
}  // namespace
struct Base : Other<int, 2> {
  Base(int a, double b) : Other<int, 2>{a}, b_{b, [](int x, int y, int z) { return x + y + z; }} {}
  bool operator()(int row, int component = 0) const { return values[row] < component; }
  auto type() const noexcept(true) -> std::array<int, 2> { return {1, 2}; }
  double b_ = {0}, c_ = 0;
  std::array<double, 3> values{};
  void declared(int a, int b, int c);
};
const auto list = std::vector<int>{1, 2, f({3, 4})};
template <class F>
void system<F>::operator()(Chunk) const {
  if (auto found = find(1); found) { run([&] { return 1; }); }
}
TEST(Suite, Name) {
}
}  // namespace pulvis
'''
FUNCTIONS = {("plain", 5, 2), ("lambda", 1, 3), ("Base", 1, 2), ("operator()", 1, 2), ("type", 1, 0), ("lambda", 1, 0),
             ("system<F>::operator()", 4, 1), ("TEST", 2, 2)}


def main():
    walk = sizes.Walk("text", CODE)
    found = {(f.name, f.lines, f.parameters) for f in walk.functions}
    for one in sorted(found ^ FUNCTIONS):
        print("read, and not there:" if one in found else "there, and not read:", one)
    members = {r.name: (r.members, r.is_system) for r in walk.records}
    hidden = [f.name for f in walk.hidden]
    print(f"sizes_test: {len(found)} functions; members {members}; in anonymous namespaces {hidden}")
    return 0 if found == FUNCTIONS and members == {"Base": (3, False)} and hidden == ["plain"] and not walk.stack else 1


if __name__ == "__main__":
    sys.exit(main())

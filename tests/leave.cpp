// Programs that were not built with a sanitizer but run over a library that was end here, before the libraries
// that this one needs are taken down: p11-kit, which HDF5 brings along, would wait forever for glibc's lock of the
// locales. The exit code is lost, so their tests are judged by what they print (tests/CMakeLists.txt).
#include <unistd.h>

#include <cstdio>

namespace {

[[gnu::destructor, maybe_unused]] void leave() {
  std::fflush(nullptr);
  _exit(0);
}

}  // namespace

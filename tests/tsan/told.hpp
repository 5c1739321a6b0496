// What oneTBB promises about order, told to the thread sanitizer. Debian's libtbb is built without it, so that the
// sanitizer does not see how a task is handed from one thread to another and takes every hand-over for a race. The
// headers beside this one lie before oneTBB's own in the preset tsan-part: they wrap what Pulvis uses and say no more
// than what is documented. A loop: its caller comes before each body and each body before the caller goes on. A flow
// graph: a node comes after its predecessors. Whatever else touches one place from two threads is still reported.
#pragma once

#include <sanitizer/tsan_interface.h>

#include <vector>

namespace told {

using Tag = char;  // what an order hangs on is an address

inline void before(const Tag& tag) { __tsan_release(const_cast<Tag*>(&tag)); }
inline void after(const Tag& tag) { __tsan_acquire(const_cast<Tag*>(&tag)); }

// What a task copies and reads before the order is told is oneTBB's doing, and not looked at.
template <class Body>
struct Piece {
  const Body* body;
  const Tag *begin, *end;

  template <class... What>
  __attribute__((no_sanitize("thread"))) auto operator()(What&&... what) const {
    after(*begin);
    struct End {
      const Tag& tag;
      ~End() { before(tag); }
    } end_of_body{*end};
    return (*body)(static_cast<What&&>(what)...);
  }
};

// loop(piece) is one of oneTBB's loops over `body`.
template <class Body, class Loop>
auto ordered(const Body& body, const Loop& loop) {
  Tag begin = 0, end = 0;
  struct End {
    const Tag& tag;
    ~End() { after(tag); }
  } end_of_loop{end};
  before(begin);
  return loop(Piece<Body>{&body, &begin, &end});
}

}  // namespace told

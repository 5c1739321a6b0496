#include "scenes/space/packing/fill_packings.hpp"

namespace pulvis::space {

void fill_packings(Scene&, const schema::Origins&, Problems&) {}

}  // namespace pulvis::space

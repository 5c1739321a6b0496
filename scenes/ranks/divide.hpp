// Which rank owns which chunk.
#pragma once

#include <array>
#include <vector>

namespace pulvis {

// Recursive bisection: the ranks are halved, and the space along its longest side, so that both parts bear what their share
// of the ranks can (M. J. Berger & S. H. Bokhari, IEEE Transactions on Computers C-36 (1987) 570). `centre`: m, of every
// chunk; `cost`: > 0, in any unit. Returns a rank, 0 to ranks - 1, for every chunk; some have none where chunks are too few.
std::vector<int> divide_chunks(const std::vector<std::array<double, 3>>& centre,
                               const std::vector<double>& cost, int ranks);

}  // namespace pulvis

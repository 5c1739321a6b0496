// Assigns chunks to ranks.
#pragma once

#include <array>
#include <vector>

namespace pulvis {

// Recursive bisection: halves the ranks, and space along its longest side, so that the cost of both parts is proportional
// to their ranks (M. J. Berger & S. H. Bokhari, IEEE Transactions on Computers C-36 (1987) 570). `centre`: m, of every
// chunk; `cost`: > 0, in any unit. Returns a rank, 0 to ranks - 1, for every chunk; some get none if there are too few.
std::vector<int> divide_chunks(const std::vector<std::array<double, 3>>& centre,
                               const std::vector<double>& cost, int ranks);

}  // namespace pulvis

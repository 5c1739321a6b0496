// Text from a user or a file as it is quoted in messages: a wrong value of a hundred thousand characters would bury what
// is said about it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pulvis {

// Longer text loses its middle, between characters: "aaaaaa...aaa (100000 characters)".
std::string shortened(std::string_view text, std::size_t longest = 100);

}  // namespace pulvis

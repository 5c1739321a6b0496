// What a call refuses, as the message a user would see; "" when it refuses nothing.
#pragma once

#include <string>

#include "scenes/language/problem.hpp"

namespace pulvis {

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace pulvis

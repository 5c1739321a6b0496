// What a call refuses: the message that a user would see, or its problems one by one.
#pragma once

#include <string>
#include <vector>

#include "scenes/language/problem.hpp"

namespace pulvis {

// "" when it refuses nothing. Of a run that goes bad: message_of<RunFailure>(...).
template <class Error = SceneError, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// `text` without the name of a folder or file that is another in every run.
inline std::string without(const std::string& name, std::string text) {
  for (auto at = text.find(name); at != std::string::npos; at = text.find(name))
    text.erase(at, name.size());
  return text;
}

template <class Call>
std::vector<SceneProblem> problems_in(const Call& call) {
  try {
    call();
  } catch (const SceneError& error) {
    return error.errors();
  }
  return {};
}

}  // namespace pulvis

// The plan of a language's keys inside a test program: what is wrong with it is told by a test.
#pragma once

#include <gtest/gtest.h>

#include "key_plan.hpp"

namespace pulvis::keys {

// What a call throws; nothing where it does not.
template <class Call>
std::string fault_in(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

// A fault of the plan's own is one of its faults.
inline Plan plan_or_fault(const schema::Language& language, const std::filesystem::path& folder,
                          const Fault& fault) {
  Plan plan;
  const std::string own = fault_in([&] { plan = plan_for(language, folder, fault); });
  return own.empty() ? plan : Plan{{}, {}, {own}};
}

// `text`: "scene", `folder`: where its bases lie.
inline void expect_all_used(const Plan& plan, const std::string& text, const std::string& folder) {
  for (const std::string& fault : plan.faults)
    ADD_FAILURE() << "a " << text << " of " << folder << " is refused: " << fault;
  if (!plan.faults.empty()) return;  // what only that one uses would be missing, too
  for (const Use& use : plan.missing)
    ADD_FAILURE() << use.text() << " stands in no " << text << ", and none of " << folder
                  << " takes a value made from its declaration: give it one in a " << text
                  << " there in which it has a meaning, or add such a one";
}

}  // namespace pulvis::keys

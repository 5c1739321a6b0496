// Files that between them use every key of a language and every word that a key may be: small ones from a
// folder (the bases), and those with more keys put in, with values made from the declarations.
//
// A new key is put into the first base whose reader takes it. Where none does - a path, a name, a table that
// no base has, a value that no declaration tells - it is left over, and the test that asks for it says so.
#pragma once

#include <filesystem>
#include <functional>

#include "key_uses.hpp"

namespace pulvis::keys {

struct Case {
  std::string name;  // die_1; the base as it is: die
  std::filesystem::path base;
  std::vector<std::string> settings;  // what was put in, as for --set
  std::string text;                   // the whole, as TOML
};

void PrintTo(const Case& one, std::ostream* out);

struct Plan {
  std::vector<Case> cases;
  Uses missing;
  std::vector<std::string> faults;  // bases that are refused
};

// What is wrong with a file of this text in the bases' folder; nothing where it is right.
using Fault =
    std::function<std::string(const std::string& text, const std::filesystem::path& folder)>;

Plan plan_for(const schema::Language& language, const std::filesystem::path& folder,
              const Fault& fault);

}  // namespace pulvis::keys

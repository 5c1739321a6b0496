// Errors in a scene: collected while it is read, thrown together as one SceneError.
#pragma once

#include "scenes/language/document.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace pulvis {

struct SceneProblem {
  std::string file;
  int line = 0;  // 0 if an override is to blame
  int column = 0;
  std::string override_text;  // "contact.friction=-1"; empty if the file is to blame
  std::string key;            // "material[0].yield_stress"
  std::string message;        // what is wrong and what is allowed

  std::string text() const;  // file:line:col: key: message
};

class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<SceneProblem> problems);
  const std::vector<SceneProblem>& errors() const { return problems_; }

 private:
  std::vector<SceneProblem> problems_;
};

class Problems {
 public:
  Problems(std::filesystem::path file, std::vector<std::string> overrides)
      : files_{std::move(file)}, overrides_(std::move(overrides)) {}

  // Marks give a file by its index: the first is the scene itself, each following one is the base file of
  // the one before it.
  void add_file(const std::filesystem::path& file) { files_.push_back(file); }
  const std::vector<std::filesystem::path>& files() const { return files_; }
  const std::filesystem::path& file_of(const SourceMark& mark) const {
    return files_.at(static_cast<std::size_t>(mark.file));
  }

  void add(const document::Origin& origin, const std::string& key, const std::string& message);
  void throw_if_any() const;  // SceneError, in file order

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> overrides_;
  std::vector<SceneProblem> problems_;
};

// ", did you mean 'yield_stress'?" if a candidate is close to `word`, otherwise empty.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

// "a, b, c": the allowed values in a message; "none" if empty.
std::string listed(const std::vector<std::string>& words);

}  // namespace pulvis

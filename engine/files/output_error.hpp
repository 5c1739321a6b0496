// OutputError: the system failed to write output (disk full, no permission, broken file). Separate
// from errors in a scene because the program exits with a different code.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace pulvis {

class OutputError : public std::runtime_error {
 public:
  OutputError(std::filesystem::path path, std::string operation, std::string reason)
      : std::runtime_error(path.string() + ": cannot " + operation + ": " + reason),
        path_(std::move(path)),
        operation_(std::move(operation)),
        reason_(std::move(reason)) {}

  const std::filesystem::path& path() const { return path_; }
  const std::string& operation() const { return operation_; }  // "write /frames/000012/position"
  const std::string& reason() const { return reason_; }        // "No space left on device"

 private:
  std::filesystem::path path_;
  std::string operation_, reason_;
};

}  // namespace pulvis

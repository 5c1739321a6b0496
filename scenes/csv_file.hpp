// Small tables in text files, which users write or export: one header line with names and units
// ("x [mm]"), cells separated by commas, lines that start with # are comments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pulvis {

struct CsvCell {
  std::string text;
  int line = 0;
  int column = 0;  // of its first character
};

class CsvFile {
 public:
  // Throws SceneError where there is no such file, no header, or a row with more or fewer cells.
  explicit CsvFile(const std::filesystem::path& file);

  const std::vector<std::vector<CsvCell>>& rows() const { return rows_; }
  const std::vector<CsvCell>& comments() const { return comments_; }  // without their #
  bool has(const std::string& name) const { return find(name) >= 0; }

  // Refuses a header with other columns than these.
  void only(const std::vector<std::string>& names) const;

  std::vector<CsvCell> texts(const std::string& name) const;
  // In the SI unit `unit`, which the header gives in any unit of the dimension; empty: bare numbers.
  std::vector<double> numbers(const std::string& name, const std::string& unit) const;

  [[noreturn]] void refuse(const CsvCell& at, const std::string& message) const;

 private:
  int find(const std::string& name) const;
  double factor(int column, const std::string& unit) const;

  std::filesystem::path file_;
  std::vector<CsvCell> header_;  // names; their units:
  std::vector<std::string> units_;
  std::vector<std::vector<CsvCell>> rows_;
  std::vector<CsvCell> comments_;
};

}  // namespace pulvis

#include "cli/report/report_page.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "cli/report/report_assets.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

std::string with_replaced(std::string_view text, const std::map<char, const char*>& by) {
  std::string safe;
  for (const char c : text) {
    const auto other = by.find(c);
    other == by.end() ? safe += c : safe += other->second;
  }
  return safe;
}

std::string escaped(std::string_view text) {
  return with_replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}});
}

// JSON inside a script element: no text of the run may look like the element's end tag.
std::string harmless(std::string_view json) { return with_replaced(json, {{'<', "\\u003c"}}); }

// The table of names is JSON from its first brace on.
std::string names_of_keys() {
  const std::string_view table = report_asset("pulvis/figures/name_table.py");
  return "const NAMES = " + harmless(table.substr(table.find('{'))) + ";\n";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  if (std::ranges::find(names, "names.js") != names.end()) text += names_of_keys();
  for (const auto& name : names) text += std::string(report_asset(name)) + "\n";
  return text;
}

std::string carried(const ReportData& data) {
  if (data.head.empty()) return {};
  std::string text =
      "<script type=\"application/json\" id=\"head\">" + harmless(data.head) + "</script>\n";
  for (const auto& section : data.sections) {
    text += "<script type=\"application/octet-stream\" id=\"" + section.name + "\">" +
            section.text + "</script>\n";
  }
  return text;
}

struct PageParts {
  const std::vector<std::string>& scripts;
  const ReportData& data;
  Loads loads;
};

std::string part(std::string_view name, const PageParts& parts) {
  const auto& [scripts, data, loads] = parts;
  if (name == "connections") return loads == Loads::nothing ? "" : "; connect-src 'self'";
  if (name == "title") return escaped(data.title);
  if (name == "style") return std::string(report_asset("report.css"));
  if (name == "script") return joined(scripts);
  return carried(data);
}

// The page with every <!--@name@--> replaced; inserted text is not searched again.
std::string filled(std::string_view page, const PageParts& parts) {
  static constexpr std::string_view opening = "<!--@", closing = "@-->";
  std::string text;
  for (std::size_t from = 0;;) {
    const auto begin = page.find(opening, from);
    text += page.substr(from, begin - from);
    if (begin == std::string_view::npos) return text;
    const auto name = begin + opening.size(), end = page.find(closing, name);
    text += part(page.substr(name, end - name), parts);
    from = end + closing.size();
  }
}

}  // namespace

std::string page_text(const char* page, const std::vector<std::string>& scripts,
                      const ReportData& data, Loads loads) {
  std::string text;
  for (const char* asset : {"head.html", page, "tail.html"})
    text += filled(report_asset(asset), {scripts, data, loads});
  return text;
}

void write_page(const std::filesystem::path& path, const char* page,
                const std::vector<std::string>& scripts, const ReportData& data, const char* of) {
  write_own(path, of, page_text(page, scripts, data));
}

}  // namespace pulvis

# Writes OUTPUT, a source file that embeds each file of the list ASSETS. As bytes: compilers limit the
# length of string literals, and CMake alters some characters of text it reads.

set(arrays "")
set(choices "")
set(names "")
set(number 0)
foreach(asset ${ASSETS})
  get_filename_component(name ${asset} NAME)
  if(asset MATCHES "/python/(pulvis/.+)$")  # modules of the package keep their folders in the name
    set(name ${CMAKE_MATCH_1})
  endif()
  file(READ ${asset} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" bytes "${bytes}")
  string(APPEND arrays "constexpr unsigned char asset_${number}[] = {\n${bytes}};\n")
  string(APPEND choices
         "  if (name == \"${name}\") return view(asset_${number}, sizeof asset_${number});\n")
  string(APPEND names "\"${name}\", ")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE ${OUTPUT} "// Generated from cli/report/page/ and cli/python/ by cli/report/write_assets.cmake.
#include \"cli/report/report_assets.hpp\"

#include <cstddef>
#include <stdexcept>
#include <string>

namespace pulvis {
namespace {

${arrays}
std::string_view view(const unsigned char* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::string_view report_asset(std::string_view name) {
${choices}  throw std::invalid_argument(\"report: no part named \" + std::string(name));
}

std::vector<std::string> report_assets_named(std::string_view beginning) {
  std::vector<std::string> found;
  for (const char* name : {${names}}) {
    if (std::string_view(name).starts_with(beginning)) found.emplace_back(name);
  }
  return found;
}

}  // namespace pulvis
")

# Writes the version, and the commit with a hash of the sources, of this build: cmake -D GIT= -D SOURCE= -D FILES=
# -D VERSION= -D OUTPUT= -P identity.cmake. FILES lists the sources, one per line.
set(commit "unknown")
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE head
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(head)
    set(commit "${head}")
  endif()
endif()
file(STRINGS ${FILES} files)
list(SORT files)
set(all "")
foreach(file ${files})
  file(SHA256 ${file} hash)
  file(RELATIVE_PATH name ${SOURCE} ${file})
  string(APPEND all "${hash} ${name}\n")
endforeach()
string(SHA256 sources "${all}")
string(SUBSTRING ${sources} 0 12 sources)
file(WRITE ${OUTPUT} "#include \"cli/identity.hpp\"

namespace pulvis {

std::string program_version() { return \"${VERSION}\"; }
std::string program_commit() { return \"${commit}+${sources}\"; }

}  // namespace pulvis
")

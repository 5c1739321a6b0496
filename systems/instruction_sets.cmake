# Sets `core_sets` to the instruction sets (-march=) that the core library is built for, from PULVIS_INSTRUCTION_SETS:
#   native      the host processor only, as seen by the dynamic loader: the program does not run on older ones
#   all         any x86-64 processor, plus x86-64-v3 (AVX2) and x86-64-v4 (AVX-512): for a package
#   any;SETS    any processor, plus these sets
# `core_base` is the set of the library itself, empty for any processor; `core_sets` are the additional ones.
set(core_base "")
set(core_sets ${PULVIS_INSTRUCTION_SETS})
list(REMOVE_ITEM core_sets any)
if(PULVIS_INSTRUCTION_SETS STREQUAL "all")
  set(core_sets x86-64-v3 x86-64-v4)
elseif(PULVIS_INSTRUCTION_SETS STREQUAL "native")
  set(core_sets "")
  execute_process(COMMAND /lib64/ld-linux-x86-64.so.2 --help OUTPUT_VARIABLE loader ERROR_QUIET)
  if(loader MATCHES "(x86-64-v[34]) \\(supported, searched\\)")  # the best one comes first
    set(core_base ${CMAKE_MATCH_1})
  endif()
  message(STATUS "The core library is built for this processor alone: ${core_base}")
endif()

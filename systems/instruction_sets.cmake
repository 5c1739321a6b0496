# Sets `core_sets` to the instruction sets (-march=) that the core library is built for, from PULVIS_INSTRUCTION_SETS:
#   native      this processor's alone, as the dynamic loader sees it: the program does not run on lesser ones
#   all         any x86-64 processor, and beside it x86-64-v3 (AVX2) and x86-64-v4 (AVX-512): for a package
#   any;SETS    any processor, and these beside it
# `core_base` is the one of the library itself, empty for any processor; `core_sets` are those beside it.
set(core_base "")
set(core_sets ${PULVIS_INSTRUCTION_SETS})
list(REMOVE_ITEM core_sets any)
if(PULVIS_INSTRUCTION_SETS STREQUAL "all")
  set(core_sets x86-64-v3 x86-64-v4)
elseif(PULVIS_INSTRUCTION_SETS STREQUAL "native")
  set(core_sets "")
  execute_process(COMMAND /lib64/ld-linux-x86-64.so.2 --help OUTPUT_VARIABLE loader ERROR_QUIET)
  if(loader MATCHES "(x86-64-v[34]) \\(supported, searched\\)")  # the best one stands first
    set(core_base ${CMAKE_MATCH_1})
  endif()
  message(STATUS "The core library is built for this processor alone: ${core_base}")
endif()

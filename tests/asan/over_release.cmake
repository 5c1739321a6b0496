# Memory errors and undefined behaviour: the core library and the byte-level readers are built with the address
# and undefined-behaviour sanitizers, everything else comes from the other build. Memory passed from the programs to
# the library is checked too, since the sanitizer allocates it.
# (Excluded: tests that run Python, whose own leaks would be reported, and one that checks an exit code: leave.cpp.)
add_borrowed_tests(memory asan engine ${PULVIS_PROGRAMS_OF}/tests/test_engine
                   --gtest_filter=-RecorderTest.WritesAnXdmf*:RunMeshTest.Shows*:RecorderTest.TurnsAFullDisk*)
add_borrowed_tests(memory asan systems ${PULVIS_PROGRAMS_OF}/tests/test_systems
                   --gtest_filter=BroadPhase.*:Contact.*:SpaceFriction.*:SpaceDamping*)

include(${CMAKE_SOURCE_DIR}/scenes/readers.cmake)
list(APPEND readers ${record_readers})
list(TRANSFORM readers PREPEND "${CMAKE_SOURCE_DIR}/")
# These objects precede the archive, which then provides only the rest.
add_executable(replay_over_release fuzz/replay.cpp fuzz/targets.cpp ${readers})
target_link_libraries(replay_over_release PRIVATE ${PULVIS_PROGRAMS_OF}/cli/libpulvis_cli.a
                      ${PULVIS_PROGRAMS_OF}/scenes/libpulvis_scenes.a pulvis_core
                      tomlplusplus::tomlplusplus fcl nlohmann_json::nlohmann_json pugixml::pugixml spdlog::spdlog ${UDUNITS2} ${RE2}
                      ${CMAKE_DL_LIBS} z)
precompile(replay_over_release)
add_test(NAME memory.readers COMMAND replay_over_release ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus)
set_tests_properties(memory.readers PROPERTIES LABELS memory TIMEOUT ${PULVIS_TEST_TIMEOUT})

# Checks that a sanitizer report fails a test in this mixed build, too.
add_library(told SHARED asan/told_library.cpp)
target_link_libraries(told PRIVATE pulvis_rules)
add_executable(test_told asan/told_test.cpp)
target_compile_options(test_told PRIVATE -fno-sanitize=all)
target_link_options(test_told PRIVATE -fno-sanitize=all)
target_link_libraries(test_told PRIVATE pulvis_rules told)
add_borrowed(memory told-right asan $<TARGET_FILE:test_told> right)
function(add_told mode report)
  add_borrowed(memory told-${mode} asan ${CMAKE_CURRENT_SOURCE_DIR}/asan/told.sh ${report} $<TARGET_FILE:test_told> ${mode})
endfunction()
add_told(beyond-end "AddressSanitizer: heap-buffer-overflow")
add_told(after-free "AddressSanitizer: heap-use-after-free")
add_told(leak "LeakSanitizer: detected memory leaks")
add_told(overflow "runtime error: signed integer overflow")

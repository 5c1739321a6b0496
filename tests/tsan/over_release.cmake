# Data races: the library is built with the thread sanitizer, the programs are not.
add_borrowed_tests(threads tsan systems ${PULVIS_PROGRAMS_OF}/tests/test_systems --gtest_filter=BroadPhase.*:Contact.*)
foreach(test TwoRunsAgreeInEveryBit ThreadsDoNotChangeABit ObservingDoesNotChangeTheRun)
  add_borrowed_tests(threads tsan ${test} ${PULVIS_PROGRAMS_OF}/tests/test_cli --gtest_filter=Determinism.${test})
endforeach()
add_executable(test_told tsan/told_test.cpp)
target_link_libraries(test_told PRIVATE pulvis_rules TBB::tbb)
foreach(mode race-in-loop race-of-nodes ordered-nodes ordered-loops)
  add_test(NAME threads.${mode} COMMAND test_told ${mode})
  set_tests_properties(threads.${mode} PROPERTIES LABELS threads)
endforeach()
set_tests_properties(threads.race-in-loop threads.race-of-nodes PROPERTIES
  PASS_REGULAR_EXPRESSION "SUMMARY: ThreadSanitizer: data race.*told_test.cpp")
set_tests_properties(threads.ordered-nodes threads.ordered-loops PROPERTIES FAIL_REGULAR_EXPRESSION "data race")

# Ranks with MPI, each test under mpirun with 1 to 4 processes; how pulvis run --ranks handles its ranks.
find_program(PULVIS_MPIRUN mpirun REQUIRED)
set(mpirun ${PULVIS_MPIRUN} --quiet --oversubscribe --bind-to none --allow-run-as-root)

# Built with the sources of libpulvis_mpi, for short message parts; with --joined the library itself is used.
add_executable(test_ranks ${CMAKE_CURRENT_LIST_DIR}/ranks_test.cpp ${CMAKE_SOURCE_DIR}/cli/mpi/mpi_ranks.cpp)
target_link_libraries(test_ranks PRIVATE pulvis_cli MPI::MPI_C GTest::gmock)
target_compile_definitions(test_ranks PRIVATE OMPI_SKIP_MPICXX)
add_dependencies(test_ranks pulvis_mpi)
optimise(test_ranks 1)
foreach(count RANGE 1 4)
  add_test(NAME mpi.ranks_${count} COMMAND ${mpirun} -np ${count} $<TARGET_FILE:test_ranks>)
endforeach()
foreach(count RANGE 2 3)
  add_test(NAME mpi.ranks_joined_${count} COMMAND ${mpirun} -np ${count} $<TARGET_FILE:test_ranks> --joined)
endforeach()

# How a rank ends prematurely, and the common exit code.
foreach(how abort=4 exit=3 throw=4 wrong=4 killed=137)
  string(REPLACE "=" ";" how ${how})
  list(GET how 0 way)
  list(GET how 1 code)
  add_test(NAME mpi.ranks_${way}
           COMMAND sh -c "\"$@\"; test $? = ${code}" sh ${mpirun} -np 3 $<TARGET_FILE:test_ranks> --leave ${way})
endforeach()

add_executable(test_launch ${CMAKE_CURRENT_LIST_DIR}/launch_test.cpp)
target_link_libraries(test_launch PRIVATE pulvis_cli GTest::gmock_main)
optimise(test_launch 1)
gtest_discover_tests(test_launch TEST_PREFIX mpi. PROPERTIES TIMEOUT ${PULVIS_TEST_TIMEOUT} LABELS mpi)

# Bitwise identical results on any number of ranks, some with migrating chunks. For a long manual run of every case:
# tests/mpi/ranks_runs.py PROGRAM . --case NAME, --kills 50
foreach(case die damped-servo shear bonds tool-bonds constraints space-round space-welds space-mixture space-constraints)
  set(quick --quick)
  if(case STREQUAL die)
    set(quick)
  endif()
  add_test(NAME mpi.ranks_run_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/ranks_runs.py $<TARGET_FILE:pulvis> ${CMAKE_SOURCE_DIR}
                   --case ${case} ${quick})
endforeach()
add_executable(rebalanced_run ${CMAKE_CURRENT_LIST_DIR}/rebalanced_run.cpp)
target_link_libraries(rebalanced_run PRIVATE pulvis_cli)
add_dependencies(rebalanced_run pulvis_mpi)
optimise(rebalanced_run 1)
foreach(case friction cell space-cell welds space-die space-welds space-stl space-constraints)
  add_test(NAME mpi.ranks_run_rebalanced_${case}
           COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/ranks_runs.py $<TARGET_FILE:pulvis> ${CMAKE_SOURCE_DIR}
                   --case ${case} --quick --rebalanced $<TARGET_FILE:rebalanced_run>)
endforeach()
add_test(NAME mpi.ranks_run_keys
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/ranks_runs.py $<TARGET_FILE:pulvis> ${CMAKE_SOURCE_DIR} --keys)
add_test(NAME mpi.ranks_run_killed
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/ranks_runs.py $<TARGET_FILE:pulvis> ${CMAKE_SOURCE_DIR}
                 --kills 3)
add_test(NAME mpi.ranks_run_full
         COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/ranks_runs.py $<TARGET_FILE:pulvis> ${CMAKE_SOURCE_DIR} --full)

get_property(tests DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} PROPERTY TESTS)
list(FILTER tests INCLUDE REGEX "^mpi\\.ranks_")
# Ranks busy-wait; with more threads than cores they had better yield to each other.
set_tests_properties(${tests} PROPERTIES TIMEOUT 300 LABELS mpi PROCESSORS 2
                     ENVIRONMENT OMPI_MCA_mpi_yield_when_idle=1)

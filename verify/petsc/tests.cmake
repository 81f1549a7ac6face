# SPDX-License-Identifier: BSD-3-Clause
# The command line on many processes. The processors are kept for the ranks of one test at a time.
if(NOT TARGET delam_mpi)
  return()
endif()
set(RANKS ${CMAKE_CURRENT_LIST_DIR})
add_library(ranks_scarce MODULE ${RANKS}/scarce.c)
set_target_properties(ranks_scarce PROPERTIES PREFIX "" OUTPUT_NAME scarce C_STANDARD 11 C_EXTENSIONS ON
  C_VISIBILITY_PRESET default LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
set(engine)
if(TARGET petsc_test_engine)
  set(engine $<TARGET_FILE:petsc_test_engine>)
endif()
# delam_ranks_test(NAME TIER SCRIPT ARGUMENT ...)
function(delam_ranks_test name tier script)
  add_test(NAME ranks/${name} COMMAND /usr/bin/python3 ${RANKS}/${script}.py ${ARGN})
  set_tests_properties(ranks/${name} PROPERTIES LABELS "${tier};ranks" TIMEOUT ${DELAM_LIMIT} SKIP_RETURN_CODE 77
    RUN_SERIAL ON ENVIRONMENT "DELAM=$<TARGET_FILE:delam_cli>;DELAM_MPI=$<TARGET_FILE:delam_mpi>;\
DELAM_EXAMPLES=${PROJECT_SOURCE_DIR}/examples;DELAM_SCARCE_LIBRARY=$<TARGET_FILE:ranks_scarce>;\
DELAM_TEST_ENGINE=${engine}")
endfunction()
delam_ranks_test(scenes quick scenes --brief)
foreach(type bddc gamg)
  delam_ranks_test(${type} quick scenes --ranks 2 dcb-3d fibre punch)
  set_property(TEST ranks/${type} APPEND PROPERTY ENVIRONMENT "PETSC_OPTIONS=-delam_pc_type ${type}")
endforeach()
delam_ranks_test(faults quick faults kill signal step disk input)
delam_ranks_test(long_faults long faults memory)
delam_ranks_test(long_scenes long scenes --whole --ranks 1,2,4,8,16)
delam_ranks_test(long_loose long scenes --loose --ranks 1,2,4)

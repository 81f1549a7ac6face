# SPDX-License-Identifier: BSD-3-Clause
# The program of the README, and the examples in every language: one history each, that of the host in C, and the
# values of examples/reference.csv; a host on many processes in three languages; a user element for Abaqus.

# delam_example_test(SCENE LANGUAGE COMMAND...): what cannot run here is a test that says so and is skipped.
function(delam_example_test scene language)
  set(options --scene ${scene})
  string(REPLACE - _ name ${scene})
  if(language STREQUAL c AND TARGET delam_cli AND EXISTS ${PROJECT_SOURCE_DIR}/examples/${scene}/${scene}.toml)
    list(APPEND options --delam $<TARGET_FILE:delam_cli> ${PROJECT_SOURCE_DIR}/examples/${scene}/${scene}.toml)
  endif()
  set(command ${ARGN})
  if(NOT TARGET example_${name} OR (NOT command AND NOT language STREQUAL c))
    add_test(NAME example/${scene}_${language}
             COMMAND sh -c "echo 'skipped: the host of ${scene} in ${language} is not built'; exit 77")
  else()
    add_test(NAME example/${scene}_${language}
             COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/verify/cases/same_history.py ${options}
                     $<TARGET_FILE:example_${name}> ${command})
  endif()
  set_tests_properties(example/${scene}_${language} PROPERTIES LABELS "quick;example" TIMEOUT ${DELAM_LIMIT}
    SKIP_RETURN_CODE 77
    ENVIRONMENT "DELAM_LIBRARY=$<TARGET_FILE:delam>;PYTHONPATH=${PROJECT_SOURCE_DIR}/bindings/python/src;\
PYTHONDONTWRITEBYTECODE=1;JULIA_DEPOT_PATH=${PROJECT_BINARY_DIR}/bindings/julia/depot:")
endfunction()

if(NOT DELAM_SANITIZE)
  add_test(NAME example/readme COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/verify/cases/readme_program.py
           ${PROJECT_SOURCE_DIR}/README.md $<TARGET_FILE:delam> ${PROJECT_SOURCE_DIR}/include ${CMAKE_C_COMPILER})
  set_tests_properties(example/readme PROPERTIES LABELS "quick;example" TIMEOUT ${DELAM_LIMIT})
  foreach(scene enf dcb-host-law)
    string(REPLACE - _ name ${scene})
    delam_example_test(${scene} c)
    foreach(language cpp fortran)
      set(program)
      if(TARGET example_${name}_${language})
        set(program $<TARGET_FILE:example_${name}_${language}>)
      endif()
      delam_example_test(${scene} ${language} ${program})
    endforeach()
    delam_example_test(${scene} python /usr/bin/python3 ${PROJECT_SOURCE_DIR}/examples/${scene}/${name}.py)
    delam_example_test(${scene} julia sh ${PROJECT_SOURCE_DIR}/bindings/julia/test/julia.sh
                       ${PROJECT_SOURCE_DIR}/bindings/julia ${PROJECT_SOURCE_DIR}/examples/${scene}/${name}.jl)
  endforeach()
  # The host on many processes, against the library alone; gmsh: in Python, with parts of a mesh from files.
  foreach(language c fortran python gmsh)
    set(program)
    if(language STREQUAL c AND TARGET example_host_petsc)
      set(program $<TARGET_FILE:example_host_petsc>)
    elseif(language STREQUAL fortran AND TARGET example_host_petsc_fortran)
      set(program $<TARGET_FILE:example_host_petsc_fortran>)
    elseif(language STREQUAL python AND TARGET delam_petsc)
      set(program /usr/bin/python3 -m mpi4py ${PROJECT_SOURCE_DIR}/examples/host-petsc/host_petsc.py)
    elseif(language STREQUAL gmsh AND TARGET delam_petsc)
      set(program /usr/bin/python3 -m mpi4py ${PROJECT_SOURCE_DIR}/examples/host-petsc/host_petsc_gmsh.py)
    endif()
    foreach(ranks 1 2 4)
      set(test example/host_petsc_${language}_${ranks})
      if(program)
        add_test(NAME ${test} COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/verify/cases/host_petsc.py ${ranks}
                                      ${program})
      else()
        add_test(NAME ${test}
          COMMAND sh -c "echo 'skipped: the host in ${language} on MPI is not built: ${DELAM_PETSC_MISSING}'; exit 77")
      endif()
      delam_slots(${test} ${ranks})
      set_tests_properties(${test} PROPERTIES LABELS "quick;example" TIMEOUT ${DELAM_LIMIT} SKIP_RETURN_CODE 77
        ENVIRONMENT "DELAM_LIBRARY=$<TARGET_FILE:delam>;PYTHONPATH=${PROJECT_SOURCE_DIR}/bindings/python/src;\
PYTHONDONTWRITEBYTECODE=1;OPENBLAS_NUM_THREADS=1")
    endforeach()
  endforeach()
  # The user element for Abaqus, driven by a program that plays Abaqus; each check leaves its files in a folder.
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/host-abaqus)
  file(MAKE_DIRECTORY ${folder})
  foreach(check newton cutback whole energy restart threads derivative refused deck)
    set(test example/host_abaqus_${check})
    if(NOT TARGET example_host_abaqus)
      add_test(NAME ${test} COMMAND sh -c "echo 'skipped: the host that plays Abaqus is not built'; exit 77")
    elseif(check STREQUAL deck)
      add_test(NAME ${test} COMMAND sh -c "$<TARGET_FILE:example_host_abaqus> deck | cmp - \"$1\"" sh
                                    ${PROJECT_SOURCE_DIR}/examples/host-abaqus/delam_uel.inp)
    else()
      add_test(NAME ${test} COMMAND example_host_abaqus ${check} WORKING_DIRECTORY ${folder})
    endif()
    set_tests_properties(${test} PROPERTIES LABELS "quick;example" TIMEOUT ${DELAM_LIMIT} SKIP_RETURN_CODE 77
      ENVIRONMENT "OPENBLAS_NUM_THREADS=1")
  endforeach()
  if(TARGET example_host_abaqus)
    file(MAKE_DIRECTORY ${folder}/memory)
    add_test(NAME example/host_abaqus_memory COMMAND sh ${PROJECT_SOURCE_DIR}/verify/cases/memory.sh
             $<TARGET_FILE:example_host_abaqus> restart WORKING_DIRECTORY ${folder}/memory)
    set_tests_properties(example/host_abaqus_memory PROPERTIES LABELS "long;example" TIMEOUT ${DELAM_LIMIT}
      SKIP_RETURN_CODE 77)
  endif()
  # Ends the analysis, with the reason in the message file, which the program shows.
  if(TARGET example_host_abaqus)
    set_tests_properties(example/host_abaqus_refused PROPERTIES
      PASS_REGULAR_EXPRESSION "user element 102: no node of the mesh lies at node 1 of the element.*XIT")
  endif()
endif()

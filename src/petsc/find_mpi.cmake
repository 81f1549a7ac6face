# SPDX-License-Identifier: BSD-3-Clause
# Finds MPI without the traps of CMake's module: it ends with an error where MPI's compiler is there without its
# headers, and the build folder remembers what was not found.

# delam_forget_absent_mpi(): removes from the cache what the module did not find, so that it searches again.
function(delam_forget_absent_mpi)
  get_cmake_property(names CACHE_VARIABLES)
  foreach(name IN LISTS names)
    if(name MATCHES "^MPI_RESULT_" OR (name MATCHES "^MPI(EXEC)?_" AND "${${name}}" MATCHES "^$|NOTFOUND$"))
      unset(${name} CACHE)
    endif()
  endforeach()
endfunction()

# delam_find_mpi(MISSING): makes the target MPI::MPI_CXX; where it cannot, MISSING says what is not there, else it is
# empty. A macro, so that the module's variables are the caller's.
macro(delam_find_mpi missing)
  set(${missing} "")
  find_program(DELAM_MPI_COMPILER NAMES mpicxx mpic++ mpiCC)
  mark_as_advanced(DELAM_MPI_COMPILER)
  set(delam_mpi_compiler ${DELAM_MPI_COMPILER})
  if(MPI_CXX_COMPILER)
    set(delam_mpi_compiler ${MPI_CXX_COMPILER})
  endif()
  # Debian's openmpi-bin has the compiler alone; the module is asked only if a program with mpi.h compiles.
  if(delam_mpi_compiler)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/mpi_probe.cpp "#include <mpi.h>\nint main() { return MPI_SUCCESS; }\n")
    execute_process(COMMAND ${delam_mpi_compiler} mpi_probe.cpp -o mpi_probe
                    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
                    RESULT_VARIABLE delam_mpi_status OUTPUT_QUIET ERROR_QUIET)
    if(NOT delam_mpi_status EQUAL 0)
      set(${missing} "${delam_mpi_compiler} is there, and does not compile a program with mpi.h")
    endif()
  endif()
  delam_forget_absent_mpi()
  if(NOT ${missing})
    find_package(MPI QUIET COMPONENTS CXX)
    if(NOT MPI_CXX_FOUND)
      set(${missing} "MPI (mpicxx) is not there")
    endif()
  endif()
endmacro()

# SPDX-License-Identifier: BSD-3-Clause
# find_package(delam [COMPONENTS cpp fortran static]): delam::delam, and delam::cpp, delam::fortran, delam::delam_static
# where they are installed.
include("${CMAKE_CURRENT_LIST_DIR}/delam-targets.cmake")
foreach(part cpp fortran static)
  include("${CMAKE_CURRENT_LIST_DIR}/delam-${part}.cmake" OPTIONAL RESULT_VARIABLE delam_file)
  set(delam_${part}_FOUND FALSE)
  if(delam_file)
    set(delam_${part}_FOUND TRUE)
  endif()
endforeach()
unset(delam_file)
foreach(part IN LISTS delam_FIND_COMPONENTS)
  if(delam_FIND_REQUIRED_${part} AND NOT delam_${part}_FOUND)
    set(delam_FOUND FALSE)
    set(delam_NOT_FOUND_MESSAGE "component '${part}' is not installed here; known are cpp, fortran and static")
  endif()
endforeach()

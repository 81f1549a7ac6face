# SPDX-License-Identifier: BSD-3-Clause
# DELAM_RANKS_ENVIRONMENT: the environment of a test on ranks, KEY=VALUE.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/environment.txt)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/environment.txt DELAM_RANKS_ENVIRONMENT REGEX "^[A-Z]")

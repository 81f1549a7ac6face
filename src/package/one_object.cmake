# SPDX-License-Identifier: BSD-3-Clause
# cmake -DARCHIVE=A -DOBJECT=O -DSTRIP=ON|OFF -DLD=ld -DNM=nm -DOBJCOPY=objcopy -P one_object.cmake: the objects of A as
# one, O, in which the names of src/capi/delam.map alone are global; STRIP: without debug information.
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# Without section groups: a linker would take the host's group of the same name for ours, and ours for the host's.
run(${LD} -r --force-group-allocation --whole-archive ${ARCHIVE} -o ${OBJECT})
# objcopy makes names local that are global or weak, and leaves those that GNU calls unique; made weak, they are gone
# too.
execute_process(COMMAND ${NM} --defined-only ${OBJECT} OUTPUT_VARIABLE names COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " u [^\n]+" unique "${names}")
if(unique)
  list(TRANSFORM unique REPLACE "^ u " "")
  list(JOIN unique "\n" unique)
  file(WRITE ${OBJECT}.unique "${unique}\n")
  run(${OBJCOPY} --weaken-symbols=${OBJECT}.unique ${OBJECT})
  file(REMOVE ${OBJECT}.unique)
endif()
set(strip)
if(STRIP)
  set(strip --strip-debug)
endif()
run(${OBJCOPY} --wildcard --keep-global-symbol=delam_* ${strip} ${OBJECT})

# SPDX-License-Identifier: BSD-3-Clause
# cmake -DARCHIVES="libcholmod.a;libamd.a;.." -DOBJECT=O -DAR=ar -DLD=ld -DOBJCOPY=objcopy -P lgpl_object.cmake: the
# functions with long integers of CHOLMOD's LGPL modules, and all of the libraries that they need, as one object, O.
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# Of the modules Core, Check, Cholesky, Partition and CAMD, a line or two each. Not Supernodal, MatrixOps and Modify,
# which are under the GPL, nor reading and writing of files (Check), which needs MatrixOps.
set(members)
foreach(part aat add band change_factor common complex copy dense error factor memory sparse transpose triplet version
             check
             amd analyze colamd etree factorize postorder rcond resymbol rowcolcounts rowfac solve spsolve
             ccolamd csymamd metis nesdis
             camd)
  list(APPEND members cholmod_l_${part}.o)
endforeach()
set(work ${OBJECT}.parts)
file(REMOVE_RECURSE ${work})
foreach(archive IN LISTS ARCHIVES)
  get_filename_component(name ${archive} NAME_WE)
  file(MAKE_DIRECTORY ${work}/${name})
  set(wanted)
  if(name STREQUAL libcholmod)
    set(wanted ${members})
  endif()
  execute_process(COMMAND ${AR} x ${archive} ${wanted} WORKING_DIRECTORY ${work}/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB objects ${work}/*/*.o)
run(${LD} -r -o ${OBJECT} ${objects})
# Debian compiles archives for programs. In a shared library they may not name data of the C library; lgpl.c has
# pointers to the same streams.
run(${OBJCOPY} --redefine-sym stdout=delam_cholmod_stdout --redefine-sym stderr=delam_cholmod_stderr ${OBJECT})
file(REMOVE_RECURSE ${work})

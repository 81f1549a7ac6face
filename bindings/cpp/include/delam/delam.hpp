// SPDX-License-Identifier: BSD-3-Clause
//
// libdelam for C++17: move-only owners over delam.h, in headers alone. Hosts include this one.
//
//   errors     statuses < 0 throw delam::Error with the status and the context's message, those of files its FileError.
//              Outcomes (> 0) of a load step are returned as Outcome; elsewhere they throw too.
//   arrays     View<T>: a pointer with a size, a std::vector, a std::array or a braced list; rows one after another
//              as in delam.h. Sizes are checked where the library cannot. Results come as std::vector, or go into the
//              caller's buffer (Solver::field).
//   indices    from 0 as in C.
//   callbacks  std::function. What they throw stops the call that runs them, and comes out of it.
//   lifetime   objects may end in any order: each keeps the context, problems and solvers keep the callbacks of their
//              laws. An object that was moved from may only be assigned to or end.
//   the rest   get() is the C handle, for whatever is not here.
#ifndef DELAM_DELAM_HPP
#define DELAM_DELAM_HPP

#include "delam/cpp/argument.hpp"
#include "delam/cpp/context.hpp"
#include "delam/cpp/description.hpp"
#include "delam/cpp/law.hpp"
#include "delam/cpp/mesh.hpp"
#include "delam/cpp/problem.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/solver.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

#endif

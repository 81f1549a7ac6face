// SPDX-License-Identifier: BSD-3-Clause
//
// libdelam for C++17: move-only owners over delam.h, as headers. Hosts include this one.
//
//   errors     Statuses < 0 throw delam::Error with the status and the context's message; file errors throw FileError.
//              Outcomes (> 0) of a load step are returned as Outcome; elsewhere they throw too.
//   arrays     View<T>: a pointer with a size, a std::vector, a std::array or a braced list; row by row as in delam.h.
//              Sizes are checked where the library cannot check them. Results are std::vectors, or are written to the
//              caller's buffer (Solver::field).
//   indices    count from 0 as in C.
//   callbacks  std::function. An exception in a callback stops the call that runs it, and leaves that call unchanged.
//   lifetime   Objects may be destroyed in any order: each keeps the context, problems and solvers keep the callbacks
//   of
//              their laws. A moved-from object may only be assigned to or destroyed.
//   the rest   get() returns the C handle, for functions without a member here.
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

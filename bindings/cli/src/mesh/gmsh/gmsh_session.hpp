// SPDX-License-Identifier: BSD-3-Clause
// libgmsh for use inside a program: it reads no user options, prints nothing, and its errors become errors of the
// scene.
#pragma once

#include <algorithm>
#include <string>

#include <gmsh.h>

#include "text/error.hpp"

namespace cli {

class GmshSession {
public:
    GmshSession() {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::add("mesh");
    }
    ~GmshSession() {
        try {
            gmsh::finalize();
        } catch (...) {
        }
    }
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;
};

// Runs `work` in a separate session. subject: what an error of Gmsh concerns.
template <class Work>
auto with_gmsh(const Place& place, const std::string& subject, Work&& work) {
    const auto failure = [&](std::string text) {
        std::replace(text.begin(), text.end(), '\n', ' ');
        return SceneFailure(place, subject + ": Gmsh says: " + (text.empty() ? "an error without words" : text));
    };
    try {
        const GmshSession session;
        return work();
    } catch (const Failure&) {
        throw;
    } catch (const std::exception& e) {
        throw failure(e.what());
    } catch (const std::string& text) {
        throw failure(text);
    } catch (const char* text) {
        throw failure(text);
    } catch (int) {
        throw failure("");
    }
}

}  // namespace cli

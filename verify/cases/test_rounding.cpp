// SPDX-License-Identifier: BSD-3-Clause
// Plies so slender that rounding of their cell stiffnesses hides their bending: the result of the condensed operator is
// checked against the balance of forces, and a step without balance must not be called converged. Opened (the jump is
// large) and bent together (the jump is small, and the inside of the bodies loses its digits).
#include <cmath>
#include <string>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

// Two plies 1 m long, `ratio` times longer than thick; right end clamped (of both, or of the lower one, so that the
// upper one floats if it comes off), left end opened or bent by 1 mm.
Scene plies(int dimension, double ratio, bool opened, bool both) {
    const double length = 1.0, thickness = length / ratio, width = 0.2, young = 70e9;
    const double k = 2.0 * young * std::pow(thickness, 3) / 12.0 * std::pow(20.0 / length, 4);
    const bool flat = dimension == 2;
    Scene scene(dimension, flat ? std::vector<double>{length} : std::vector<double>{length, width},
                flat ? std::vector<std::int64_t>{120} : std::vector<std::int64_t>{24, 2}, {thickness, thickness},
                {1, 1}, flat ? DELAM_QUAD8 : DELAM_HEX20);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, LawData{k, k, 1e30, 1e30, 1e30, 1e30});
    const auto pairs = scene.pairs(0).node_a;
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (scene.coordinate(pairs[i], 0) < 0.5 * length) notch.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const auto at = [&](double x, double z) {
        return flat ? std::vector<double>{x, z} : std::vector<double>{x, 0.0, z};
    };
    const auto to = [&](double x, double z) {
        return flat ? std::vector<double>{x, z} : std::vector<double>{x, width, z};
    };
    const auto along = [&](int axis) {
        std::vector<double> e(static_cast<std::size_t>(dimension), 0.0);
        e[static_cast<std::size_t>(axis)] = 1.0;
        return e;
    };
    const auto right = scene.find(both ? -1 : 0, at(length, 0.0), to(length, 2.0 * thickness));
    for (int axis = 0; axis < dimension; ++axis) scene.hold(right, along(axis));
    const auto load = scene.pattern("end", {0.0, 1.0}, {0.0, 1e-3});
    const auto top = scene.find(1, at(0.0, 2.0 * thickness), to(0.0, 2.0 * thickness));
    const auto bottom = scene.find(0, at(0.0, 0.0), to(0.0, 0.0));
    scene.drive(top, along(dimension - 1), load, std::vector<double>(top.size(), 0.5));
    scene.drive(bottom, along(dimension - 1), load, std::vector<double>(bottom.size(), opened ? -0.5 : 0.5));
    scene.text("reduction", "condensed");
    return scene;
}

// The status of the first step and its out-of-balance forces; a refusal to condense is its status.
struct Found {
    std::int32_t status = DELAM_OK;
    double balance = 0.0, recoveries = 0.0;
    std::string words;
};

Found analyse(const Scene& scene) {
    Found found;
    try {
        Solver solver(scene, 0.0);
        found.status = solver.advance(1.0);
        found.words = delam_context_message(scene.context());
        found.recoveries = solver.value("field_recoveries");
        found.balance = solver.value("kkt_equilibrium");
    } catch (const reference::Failure& error) {
        found = {error.status(), 0.0, 0.0, error.what()};
    }
    return found;
}

LOOP_TEST(slender, 0, 6) {
    if (loop == 3 && !cases::whole()) return;  // bent in space
    const int dimension = loop % 2 == 0 ? 2 : 3;
    const bool opened = loop / 2 != 1, both = loop / 2 != 2;
    for (const double ratio : {10.0, 100.0, 1e3, 3e3, 1e4, 3e4}) {
        const Found found = analyse(plies(dimension, ratio, opened, both));
        const std::string where = std::to_string(dimension) + "D, " + (opened ? "opened, " : "bent, ") +
                                  (both ? "" : "the upper one may float, ") + std::to_string(static_cast<int>(ratio)) +
                                  " times longer than thick: " + delam_status_name(found.status) + " " + found.words;
        if (ratio <= 100.0) {
            cases::expect(found.status == DELAM_OK, where);
            cases::expect(found.recoveries == 0.0, where + ": recovered although nothing cancels");
            cases::expect_below(found.balance, 1e-7, where);
        }
        if (found.status == DELAM_OK) cases::expect_below(found.balance, 5e-3, where);
        if (ratio >= (opened ? 3e3 : 3e4)) {
            cases::expect(found.status == DELAM_NOT_CONVERGED || found.status == DELAM_ERROR_NUMERICAL, where);
            // Rounding decides which test fails first: of the balance, of the contact, or of the factor.
            const auto says = [&](const char* words) { return found.words.find(words) != std::string::npos; };
            cases::expect(found.status == DELAM_NOT_CONVERGED
                              ? says("out of balance") || says("the contact set still changes")
                              : says("not positive definite"),
                          where);
        }
    }
}

}  // namespace

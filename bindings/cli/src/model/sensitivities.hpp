// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of the reactions by numbers of the laws, as columns of history.csv ([output] sensitivities).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/library/model.hpp"

namespace cli {

// A number of a law, with the interfaces that have this law.
struct LawNumber {
    std::string path;  // as in messages: "laws[0].normal_toughness"
    std::string key;
    std::vector<std::int64_t> interfaces;
};

// Throws SceneFailure where a path is no number of a law, or no interface has the law.
std::vector<LawNumber> sensitivities_of(const Model& model, const Scene& scene);
// Follows the sensitivities from the initial state of the solver on. Throws SceneFailure where the library cannot
// follow one.
void follow_sensitivities(const Model& model, const Scene& scene, delam_solver* solver);
// Sensitivities of the state described by the solver, with so many numbers followed.
struct Sensitivities {
    std::vector<double> matrix;  // [patterns][numbers] of the reactions
    std::int64_t unknown = 0;    // pairs whose adhesion was taken as constant so far
};
Sensitivities read_sensitivities(const Model& model, delam_solver* solver, std::size_t numbers);

}  // namespace cli

// SPDX-License-Identifier: BSD-3-Clause
// An engine keeps the displacements of some answers. This is what the library knows of them, by place.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "reduction/sparse/engine/engine_state.hpp"

namespace delam {

class KeptAnswers {
public:
    explicit KeptAnswers(std::size_t places);
    void clear();

    // Returns the oldest place that the start does not need. start: weights, empty: there is none.
    std::size_t free_place(std::span<const double> start) const;
    // Makes the place the newest one. products: u_s^T K u of the answer with all kept ones.
    void keep(std::size_t place, std::span<const double> variables, std::span<const double> theta,
              std::span<const double> products);
    void forget(std::size_t place);
    std::size_t newest() const { return newest_; }
    // Forgets the newest answer; `before` was the newest one.
    void take_back(std::size_t before);
    // Returns the weights of the newest answer alone; empty: it is not there.
    std::vector<double> newest_alone() const;

    // Returns the weights of a state, as long as the answers that they name are kept. theta: of the state, empty: any;
    // moved: its rigid motions, in variables.
    std::optional<std::vector<double>> weights_of(const EngineLayout& at, std::span<const double> x,
                                                  std::span<const double> theta, std::vector<double> moved) const;
    // Returns 1/2 u^T K u of a combination.
    double strain(std::span<const double> weights) const;

private:
    struct Kept {
        std::vector<double> variables, theta;
        bool there = false;
    };
    std::vector<Kept> kept_;  // [places]
    DenseMatrix products_;    // [places][places]
    std::size_t newest_ = 0;
};

}  // namespace delam

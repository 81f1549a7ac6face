// SPDX-License-Identifier: BSD-3-Clause
// Loads of the dual problem, per pattern: dead forces on the first copy of their nodes, the forces of eigenstrains each
// on its own subdomain, prescribed displacements on the constraints, gaps on the jumps.
#pragma once

#include <span>
#include <vector>

#include "reduction/feti/dual/dual_operator.hpp"
#include "reduction/feti/dual/parts.hpp"

namespace delam {

struct DualLoads {
    DualLoads(const Problem& problem, const FetiParts& parts, const DualOperator& op, const Poll& poll);

    // The loads at given factors of the patterns.
    struct Sum {
        std::vector<double> jump;        // [rows] B K^+ f - c + g
        std::vector<double> resultant;   // [coarse] R^T f
        std::vector<double> prescribed;  // [constraints] c
        std::vector<double> gap;         // [jump rows] g
        void scale(int e);               // by 2^e
    };
    Sum at(std::span<const double> theta) const;

    std::vector<double> prescribed;              // [constraints][patterns], row-major
    std::vector<GapRow> gaps;                    // g, by row
    std::vector<std::vector<double>> jump;       // [patterns] B K^+ f, [rows]; empty: neither forces nor eigenstrains
    std::vector<std::vector<double>> resultant;  // [patterns] R^T f, [coarse]
    DenseMatrix work;                            // f_p^T K^+ f_q
    DenseMatrix strain_energy;                   // W of 1/2 theta^T W theta, of the eigenstrains alone
    std::vector<std::vector<std::vector<double>>> force;  // [pattern][subdomain] local vector, empty where none

private:
    void collect(const Problem& problem, const FetiParts& parts);
    // Adds the loads of one pattern; strained: its forces are those of eigenstrains, which have no resultant.
    void carry(std::size_t pattern, bool strained, const FetiParts& parts, const DualOperator& op, const Poll& poll);

    std::size_t rows_, coarse_, constraints_, jumps_;
};

}  // namespace delam

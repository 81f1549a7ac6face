// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions of a made-up zone. The work of the loads along them is that of the energy's own loads.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "reduction/dense/dense_zone.hpp"

struct TestMotions {
    delam::DenseMatrix rigid;  // [unknowns][motions], orthonormal
    delam::DeadWork dead_work{};

    explicit TestMotions(delam::DenseMatrix motions = {}) : rigid(std::move(motions)) {}
    // The result refers to this object.
    delam::ZoneMotions of(const delam::DenseEnergy& energy) {
        using delam::DenseMatrix;
        DenseMatrix unit(rigid.columns, rigid.columns);
        for (std::int64_t c = 0; c < rigid.columns; ++c) unit(c, c) = 1.0;
        dead_work = {DenseMatrix(energy.load.columns, rigid.columns), DenseMatrix(energy.load.columns, rigid.columns)};
        for (std::int64_t c = 0; c < rigid.columns; ++c)
            for (std::int64_t p = 0; p < energy.load.columns; ++p)
                for (std::int64_t i = 0; i < rigid.rows; ++i) {
                    dead_work.work(p, c) += rigid(i, c) * energy.load(i, p);
                    dead_work.magnitudes(p, c) += std::abs(rigid(i, c) * energy.load(i, p));
                }
        return {rigid, unit, &dead_work};
    }
};

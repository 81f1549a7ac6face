// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/curved_displacement.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "evolution/contact/extrapolation.hpp"

namespace delam {

namespace {

constexpr int most_steps = 200;
constexpr double tolerance = 1e-10;       // of the largest force
constexpr double acceptable = 1e-8;       // if rounding or the limit ends the steps
constexpr double scene_rounding = 1e-13;  // of an energy of the whole scene

double bulk(const Response& r) { return r.stored_bulk + r.load_potential; }

// Two admissible displacements and the segment between them.
class Segment {
public:
    Segment(const Response& from, const Response& to) : from_(from), to_(to) {
        for (std::size_t i = 0; i < from.jump.size(); ++i) {
            const double opened = to.jump[i] - from.jump[i];
            slope_ -= opened * from.force[i];
            bend_ -= opened * (to.force[i] - from.force[i]);
        }
    }
    // E(s) - E(0) of the bodies, from the work of the tractions: the residual of an iterative solve enters it with its
    // square, and a difference of two energies of the whole scene with itself.
    double bulk_change(double s) const { return s * (slope_ + 0.5 * s * bend_); }
    double bulk_energy(double s) const { return (1.0 - s) * bulk(from_) + s * bulk(to_) - 0.5 * s * (1.0 - s) * bend_; }
    std::vector<double> jump(double s) const { return mean(from_.jump, to_.jump, s); }
    Response at(double s) const {
        Response r = to_;
        r.jump = jump(s);
        r.force = mean(from_.force, to_.force, s);
        r.conjugate = mean(from_.conjugate, to_.conjugate, s);
        r.multipliers = mean(from_.multipliers, to_.multipliers, s);
        r.rigid = mean(from_.rigid, to_.rigid, s);
        r.load_potential = (1.0 - s) * from_.load_potential + s * to_.load_potential;
        r.stored_bulk = bulk_energy(s) - r.load_potential;
        return r;
    }

private:
    static std::vector<double> mean(const std::vector<double>& a, const std::vector<double>& b, double s) {
        std::vector<double> m(b);
        for (std::size_t i = 0; i < m.size() && i < a.size(); ++i) m[i] = (1.0 - s) * a[i] + s * b[i];
        return m;
    }
    const Response& from_;
    const Response& to_;
    double slope_ = 0.0, bend_ = 0.0;
};

}  // namespace

bool CurvedDisplacement::plain() const {
    for (std::size_t p = 0; p < adhesion_.size(); ++p)
        if (pairs_.mixed(p) && adhesion_[p] > 0.0 && adhesion_[p] < 1.0) return false;
    return true;
}

CurvedDisplacement::Model CurvedDisplacement::model(std::span<const double> jump) const {
    Model m{spring_stiffness(pairs_, adhesion_), std::vector<double>(adhesion_.size() * index(pairs_.dimension), 0.0)};
    if (jump.empty()) return m;
    const auto dim = index(pairs_.dimension);
    const double scale = largest_driving(pairs_, jump);
    for (std::size_t p = 0; p < adhesion_.size(); ++p) {
        if (!pairs_.mixed(p) || !(adhesion_[p] > 0.0 && adhesion_[p] < 1.0)) continue;
        const VariationalPair point = pair(p, scale);
        const std::span<const double> local = jump.subspan(p * dim, dim);
        const double more = point.proximal(local, adhesion_[p]);
        const std::array<double, 3> force = point.force(local, adhesion_[p]);
        for (std::size_t c = 0; c < dim; ++c) {
            const std::size_t r = p * dim + c;
            m.stiffness[r] *= 1.0 + more / adhesion_[p];
            m.force[r] = m.stiffness[r] * local[c] - pairs_.weight[p] * force[c];
        }
    }
    return m;
}

double CurvedDisplacement::interface_energy(std::span<const double> jump) const {
    return stored_energy(pairs_, adhesion_, jump) + stored_linear(pairs_, mixities(pairs_, jump, mixity_), adhesion_);
}

double CurvedDisplacement::mismatch(const std::vector<std::uint8_t>& closed, const Response& response) const {
    const auto dim = index(pairs_.dimension);
    const double scale = largest_driving(pairs_, response.jump);
    double worst = 0.0;
    for (std::size_t p = 0; p < adhesion_.size(); ++p) {
        if (!pairs_.mixed(p) || !(adhesion_[p] > 0.0 && adhesion_[p] < 1.0)) continue;
        const std::span<const double> local = std::span<const double>(response.jump).subspan(p * dim, dim);
        const std::array<double, 3> force = pair(p, scale).force(local, adhesion_[p]);
        for (std::size_t c = closed[p] != 0 ? 1 : 0; c < dim; ++c)
            worst = std::max(worst, std::abs(response.force[p * dim + c] - pairs_.weight[p] * force[c]));
    }
    const double most = max_abs(response.force);
    return most > 0.0 ? worst / most : 0.0;
}

bool CurvedDisplacement::run(const DisplacementSolve& solve, std::vector<std::uint8_t>& closed,
                             Response& response) const {
    const auto dim = index(pairs_.dimension);
    std::vector<std::size_t> rows;  // that bend
    for (std::size_t p = 0; p < adhesion_.size(); ++p)
        if (pairs_.mixed(p) && adhesion_[p] > 0.0 && adhesion_[p] < 1.0)
            for (std::size_t c = 0; c < dim; ++c) rows.push_back(p * dim + c);
    const auto gather = [&](std::span<const double> jump) {
        std::vector<double> z;
        for (const std::size_t r : rows) z.push_back(jump[r]);
        return z;
    };
    bool converged = true;
    {
        const Model m = model(response.jump);
        converged = solve(m.stiffness, m.force, closed, response);
    }
    std::vector<double> at = response.jump;  // where the next model touches
    bool ahead = false;                      // beyond the present displacements, extrapolated from the last steps
    Extrapolation extrapolation;
    double left = mismatch(closed, response);
    for (int step = 0; step < most_steps && left > tolerance; ++step) {
        const Model m = model(at);
        std::vector<std::uint8_t> to_closed = closed;
        Response to = response;
        converged = solve(m.stiffness, m.force, to_closed, to);
        const std::vector<double> image = gather(to.jump), from = gather(at);
        const Segment segment(response, to);
        const double energy = interface_energy(response.jump);
        const double slack = scene_rounding * (std::abs(bulk(response)) + energy);
        double s = 1.0;
        while (s > 1e-3 && segment.bulk_change(s) + interface_energy(segment.jump(s)) > energy + slack)
            s *= ahead ? 0.0 : 0.5;
        if (s <= 1e-3 && !ahead) return left <= acceptable && converged;  // rounding of the energy
        if (s >= 1.0) {
            closed = std::move(to_closed);
            response = std::move(to);
        } else if (s > 1e-3) {  // between an open and a closed displacement a pair is open
            for (std::size_t p = 0; p < closed.size(); ++p) closed[p] = closed[p] != 0 && to_closed[p] != 0 ? 1 : 0;
            Response between = segment.at(s);
            response = std::move(between);
        }
        left = mismatch(closed, response);
        at = response.jump;
        ahead = s >= 1.0;
        if (!ahead) {
            extrapolation.forget();
            continue;
        }
        const std::vector<double> next = extrapolation.next(from, image);
        for (std::size_t i = 0; i < rows.size(); ++i)
            at[rows[i]] = rows[i] % dim == 0 ? std::max(0.0, next[i]) : next[i];
    }
    return converged && left <= acceptable;
}

}  // namespace delam

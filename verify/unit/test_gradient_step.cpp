// SPDX-License-Identifier: BSD-3-Clause
// The damage step of the gradient term against brute force, optimality conditions and closed forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "evolution/increment/coupled_damage.hpp"
#include "gradients.hpp"

using namespace delam;
using namespace unit;

namespace {

// A damage step on an interface of a mesh, with independent code for its energy and gradient.
struct Step {
    GradientTerm term;
    std::vector<Toughness> toughness;
    Numbers driving, old, least;

    Step(const Mesh& mesh, double kappa, const Toughness& t)
        : term(kappa, stiffness_of(mesh), interface_of(mesh).weight, 0),
          toughness(term.pairs(), t),
          driving(term.pairs(), 0.0),
          old(term.pairs(), 1.0),
          least(term.pairs(), 0.0) {}

    std::size_t size() const { return old.size(); }
    Numbers pointwise() const {
        Numbers z;
        for (std::size_t i = 0; i < size(); ++i)
            z.push_back(std::max(least[i], Law{}.minimiser(toughness[i], driving[i], old[i])));
        return z;
    }
    CoupledDamage solve() const {
        return coupled_damage(term, Law{}, toughness, driving, least, old, pointwise(), old);
    }
    double energy(const Numbers& z) const {
        double sum = term.energy(z);
        for (std::size_t i = 0; i < size(); ++i)
            sum += term.weight()[i] * (z[i] * driving[i] + Law{}.dissipated(toughness[i], z[i]));
        return sum;
    }
    Numbers gradient(const Numbers& z) const {
        Numbers d = term.force(z);
        for (std::size_t i = 0; i < size(); ++i)
            d[i] += term.weight()[i] * (driving[i] - Law{}.driving(toughness[i], z[i]));
        return d;
    }
    // The larger of its terms: the scale for the gradient of a pair.
    Numbers size_of_gradient(const Numbers& z) const {
        Numbers s = term.force(z);
        for (std::size_t i = 0; i < size(); ++i)
            s[i] = std::max(
                {std::abs(s[i]), term.weight()[i] * driving[i], term.weight()[i] * Law{}.driving(toughness[i], z[i])});
        return s;
    }
    void ck_optimal(const Numbers& z, double tolerance, const std::string& where) const {
        const Numbers d = gradient(z), s = size_of_gradient(z);
        for (std::size_t i = 0; i < size(); ++i) {
            ck_assert_msg(z[i] >= least[i] && z[i] <= old[i], "%s: pair %zu at %.17g of %g to %g", where.c_str(), i,
                          z[i], least[i], old[i]);
            const double down = z[i] < old[i] ? std::max(0.0, -d[i]) : 0.0,
                         up = z[i] > least[i] ? std::max(0.0, d[i]) : 0.0;
            // The remaining gradient, also measured by how far the pair's own curvature lets it move.
            const double stiff = term.diagonal(i) - term.weight()[i] * Law{}.driving_slope(toughness[i], z[i]);
            const double move = std::min(std::max(down, up) / stiff, down > 0.0 ? old[i] - z[i] : z[i] - least[i]);
            ck_assert_msg(std::max(down, up) <= tolerance * s[i] || move <= tolerance,
                          "%s: pair %zu of %zu, z = %.6g of %g, gradient %.3e of %.3e, move %.2e", where.c_str(), i,
                          size(), z[i], old[i], d[i], s[i], move);
        }
    }
};

// Energy of many random loads and bounds.
void randomise(Step& s, std::mt19937& random, bool notched) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double wave = 1.0 + 5.0 * unit(random), phase = 6.0 * unit(random);
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(s.size());
        s.driving[i] = s.toughness[i].total * std::exp(4.0 * std::sin(wave * t + phase) + 2.0 * (unit(random) - 0.5));
        if (unit(random) < 0.1) s.driving[i] = 0.0;
        s.old[i] = unit(random) < 0.5 ? 1.0 : unit(random);
        if (notched && unit(random) < 0.15) s.old[i] = 0.0;
    }
}

}  // namespace

// Three pairs: no point of a grid over the whole box has less energy, and the best grid point lies beside the solution.
TEST(three_pairs_by_exhaustion) {
    const Mesh mesh = two_layers(CellType::quad4, {2.0}, {2});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int n = 36;  // the bounds below follow the spacing
    for (int k = 0; k < 60; ++k) {
        Step s(mesh, std::exp(8.0 * (unit(random) - 0.5)), {1.0, k % 3 == 0 ? 1.0 : 1.0 + 3.0 * unit(random)});
        for (std::size_t i = 0; i < 3; ++i) {
            s.driving[i] = s.toughness[i].total * std::exp(3.0 * (unit(random) - 0.5));
            s.old[i] = unit(random) < 0.6 ? 1.0 : unit(random);
        }
        if (k % 2 == 1)  // and a lower bound
            for (std::size_t i = 0; i < 3; ++i) s.least[i] = 0.9 * s.old[i] * unit(random);
        const auto place = [&s](std::size_t i, int a) { return s.least[i] + (s.old[i] - s.least[i]) * a / n; };
        const CoupledDamage found = s.solve();
        ck_assert(found.converged);
        const double least = s.energy(found.adhesion);
        double grid = 1e300;
        for (int a = 0; a <= n; ++a)
            for (int b = 0; b <= n; ++b)
                for (int c = 0; c <= n; ++c) grid = std::min(grid, s.energy({place(0, a), place(1, b), place(2, c)}));
        ck_assert_msg(least <= grid + 1e-12, "case %d: %.17g, grid %.17g", k, least, grid);
        // Second derivatives are below 2 Gc^2 + 4 kappa here.
        const double curved = 2.0 * s.toughness[0].total * s.toughness[0].total + 4.0 * s.term.kappa();
        ck_assert_msg(grid - least <= 6.0 * curved / (n * n),
                      "case %d: grid %.3e above, more than its spacing explains", k, grid - least);
    }
}

// Optimality on all kinds of faces, for laws from Griffith's to Gc/Go = 1e8 and kappa over twelve decades.
LOOP_TEST(random_steps_are_optimal, 0, 6) {
    const CellType type[] = {CellType::quad4, CellType::quad8, CellType::hex8,
                             CellType::tet4,  CellType::tet10, CellType::hex20};
    const bool plane = loop < 2;
    const Mesh mesh = two_layers(type[loop], plane ? Numbers{1.0} : Numbers{1.0, 1.0},
                                 plane ? std::vector<std::int64_t>{60} : std::vector<std::int64_t>{8, 7});
    std::mt19937 random(static_cast<unsigned>(5 + loop));
    std::int64_t worst = 0, total = 0, count = 0;
    for (const double ratio : {1.0, 1.0 + 1e-9, 1.0 + 1e-3, 2.5, 1e3, 1e8})
        for (int decade = -10; decade <= 2; ++decade)
            for (int k = 0; k < 4; ++k) {
                Step s(mesh, std::pow(10.0, decade), {1.0 / ratio, 1.0});
                randomise(s, random, k % 2 == 0);
                if (k >= 2)  // a part of a step: no pair may go further
                    for (std::size_t i = 0; i < s.size(); ++i)
                        s.least[i] = s.old[i] * std::uniform_real_distribution<double>(0.0, 1.0)(random);
                const CoupledDamage found = s.solve();
                const std::string where = "type " + std::to_string(loop) + ", Gc/Go " + std::to_string(ratio) +
                                          ", kappa 1e" + std::to_string(decade) + ", case " + std::to_string(k) + ", " +
                                          std::to_string(found.iterations) + " iterations, residual " +
                                          std::to_string(found.residual);
                ck_assert_msg(found.converged, "%s", where.c_str());
                s.ck_optimal(found.adhesion, 1e-7, where);
                worst = std::max(worst, found.iterations);
                total += found.iterations;
                ++count;
            }
    std::printf("random steps, kind %d: %.1f factorisations, at most %lld\n", loop,
                static_cast<double>(total) / static_cast<double>(count), static_cast<long long>(worst));
}

// Plain projected gradients, thousands of them, end in the same point.
TEST(projected_gradients) {
    const Mesh mesh = two_layers(CellType::quad8, {1.0}, {6});
    std::mt19937 random(23);
    for (int k = 0; k < 40; ++k) {
        Step s(mesh, k % 2 == 0 ? 0.02 : 1.0, {1.0, 1.0 + 0.1 * (k % 8)});
        randomise(s, random, true);
        double stiff = 0.0;  // of F in the metric of the weights, an upper bound
        for (std::size_t i = 0; i < s.size(); ++i)
            stiff = std::max(stiff, 3.0 * s.term.diagonal(i) / s.term.weight()[i] +
                                        2.0 * s.toughness[i].total * s.toughness[i].total);
        Numbers z = s.old, before = z;
        double momentum = 1.0, moved = 1.0;
        for (int step = 0; step < 200000 && moved > 1e-15;
             ++step) {  // with momentum (Nesterov; Beck and Teboulle, 2009), restarted
            const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
            Numbers ahead = z;
            for (std::size_t i = 0; i < z.size(); ++i)
                ahead[i] = std::clamp(z[i] + (momentum - 1.0) / next * (z[i] - before[i]), 0.0, s.old[i]);
            const Numbers d = s.gradient(ahead);
            before = z;
            double turn = 0.0;
            moved = 0.0;
            for (std::size_t i = 0; i < z.size(); ++i) {
                z[i] = std::clamp(ahead[i] - d[i] / (s.term.weight()[i] * stiff), 0.0, s.old[i]);
                turn += d[i] * (z[i] - before[i]);
                moved = std::max(moved, std::abs(z[i] - before[i]));
            }
            momentum = turn > 0.0 ? 1.0 : next;
        }
        const Numbers found = s.solve().adhesion;
        for (std::size_t i = 0; i < z.size(); ++i) ck_near(found[i], z[i], 1e-10, "adhesion");
    }
}

// Where the pointwise adhesion is smooth and inside the bounds, it changes by kappa times a fixed amount.
TEST(small_kappa_recovers_the_pointwise_law) {
    for (const double ratio : {2.5, 1e4}) {
        const Mesh mesh = two_layers(CellType::quad4, {1.0}, {40});
        Numbers moved;
        for (const double kappa : {1e-4, 1e-5, 1e-6}) {
            Step s(mesh, kappa / ratio, {1.0 / ratio, 1.0});
            for (std::size_t i = 0; i < s.size(); ++i) {
                const double z = 0.5 + 0.3 * std::cos(std::numbers::pi * static_cast<double>(i) / 40.0);
                s.driving[i] = Law{}.driving(s.toughness[i], z);
            }
            const Numbers with = s.solve().adhesion, without = s.pointwise();
            moved.push_back(0.0);
            for (std::size_t i = 0; i < with.size(); ++i)
                moved.back() = std::max(moved.back(), std::abs(with[i] - without[i]));
        }
        std::printf("Gc/Go %g: kappa moves the adhesion by %.2e, %.2e, %.2e\n", ratio, moved[0], moved[1], moved[2]);
        ck_assert(std::abs(std::log10(moved[1] / moved[2]) - 1.0) < 0.02);
    }
}

// Uniform adhesion: the minimiser of the sum over all pairs, clipped by the lowest bound.
TEST(large_kappa_is_uniform) {
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8, CellType::tet10}) {
        const bool plane = topology(type).dimension == 2;
        const Mesh mesh = two_layers(type, plane ? Numbers{1.0} : Numbers{1.0, 1.0},
                                     plane ? std::vector<std::int64_t>{30} : std::vector<std::int64_t>{5, 4});
        std::mt19937 random(31);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (const double ratio : {1.0, 2.5, 1e6}) {
            Step s(mesh, 1e6 / ratio,
                   {1.0 / ratio, 1.0});  // a million times what the law's curvature, about Go, stands against
            double mean = 0.0, size = 0.0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                s.driving[i] = (ratio == 1.0 ? 0.5 : 1.5 * s.toughness[i].onset) * (0.5 + unit(random));
                mean += s.term.weight()[i] * s.driving[i];
                size += s.term.weight()[i];
            }
            for (double& o : s.old) o = 0.9;
            const double uniform = Law{}.minimiser(s.toughness[0], mean / size, 0.9);
            const CoupledDamage found = s.solve();
            ck_assert(found.converged);
            for (const double z : found.adhesion) ck_near(z, uniform, 1e-6, "uniform adhesion");
        }
    }
}

// With a Griffith law the damage step is an obstacle problem. Y = G + p on the left half, G - q on the right: kappa
// zeta'' = p or -q between the contact with 0 and that with 1, so two parabolas that meet with the slope s = sqrt(2 /
// (kappa (1/p + 1/q))).
TEST(griffith_profile) {
    const double length = 3.0, kappa = 0.05, p = 0.4, q = 0.9, g = 1.0;
    const double slope = std::sqrt(2.0 / (kappa * (1.0 / p + 1.0 / q))), left = kappa * slope / p,
                 right = kappa * slope / q;
    ck_assert(left < 0.5 * length && right < 0.5 * length);
    const auto exact = [&](double x) {
        const double t = x - 0.5 * length;
        if (t <= -left) return 0.0;
        if (t >= right) return 1.0;
        return t <= 0.0 ? 0.5 * p / kappa * (t + left) * (t + left) : 1.0 - 0.5 * q / kappa * (right - t) * (right - t);
    };
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8}) {
        Numbers error;
        for (const std::int64_t n : {15, 45, 135, 405}) {  // odd: the load changes midway between two pairs
            if (type == CellType::hex8 && n > 135) continue;
            const Mesh mesh =
                two_layers(type, type == CellType::hex8 ? Numbers{length, 0.3} : Numbers{length},
                           type == CellType::hex8 ? std::vector<std::int64_t>{n, 2} : std::vector<std::int64_t>{n});
            Step s(mesh, kappa, {g, g});
            const Numbers x = field(mesh, [](const Point& at) { return at[0]; });
            // On 3-node edges the middle pair of the middle edge lies on the change: half of each value.
            for (std::size_t i = 0; i < x.size(); ++i)
                s.driving[i] = std::abs(x[i] - 0.5 * length) < 1e-9 ? g + 0.5 * (p - q)
                               : x[i] < 0.5 * length                ? g + p
                                                                    : g - q;
            const CoupledDamage found = s.solve();
            ck_assert(found.converged);
            error.push_back(0.0);
            for (std::size_t i = 0; i < x.size(); ++i)
                error.back() = std::max(error.back(), std::abs(found.adhesion[i] - exact(x[i])));
            std::printf("obstacle, type %d, %lld cells: error %.2e, %lld factorisations\n", static_cast<int>(type),
                        static_cast<long long>(n), error.back(), static_cast<long long>(found.iterations));
            ck_assert_int_le(found.iterations, 20);
        }
        const double order = std::log(error[0] / error.back()) / std::log(3.0) / static_cast<double>(error.size() - 1);
        std::printf("obstacle, type %d: order %.2f\n", static_cast<int>(type), order);
        ck_assert(order > 1.8);
    }
}

// Energies in other units: the same digits, or differences that rounding leaves.
TEST(units_of_the_step) {
    const Mesh mesh = two_layers(CellType::quad8, {1.0}, {20});
    for (const double ratio : {1.0, 2.5, 1e8}) {
        Numbers base;
        for (const double unit : {1.0, 4096.0, 1.0 / 1048576.0, 1e3}) {
            std::mt19937 random(41);
            Step s(mesh, 1e-3, {1.0 / ratio, 1.0});
            randomise(s, random, true);
            Step scaled(mesh, 1e-3 * unit, {unit * (1.0 / ratio), unit});
            scaled.driving = s.driving;
            for (double& y : scaled.driving) y *= unit;
            scaled.old = s.old;
            const Numbers z = scaled.solve().adhesion;
            if (base.empty()) base = z;
            for (std::size_t i = 0; i < z.size(); ++i) {
                if (unit == 1e3)
                    ck_near(z[i], base[i], 1e-8, "other units");
                else
                    ck_assert(z[i] == base[i]);
            }
        }
    }
}

// The result does not depend on where the search starts, and a solved step is a fixed point.
TEST(any_start) {
    const Mesh mesh = two_layers(CellType::hex8, {1.0, 1.0}, {9, 9});
    std::mt19937 random(43);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double ratio : {1.0, 2.5, 1e4}) {
        Step s(mesh, 1e-2, {1.0 / ratio, 1.0});
        randomise(s, random, true);
        for (std::size_t i = 0; i < s.size(); i += 3) s.least[i] = 0.4 * s.old[i];
        const Numbers base = s.solve().adhesion;
        for (int k = 0; k < 10; ++k) {
            Numbers start = s.old;
            for (double& z : start) z *= k == 0 ? 0.0 : unit(random);
            const Numbers z =
                coupled_damage(s.term, Law{}, s.toughness, s.driving, s.least, s.old, s.pointwise(), start).adhesion;
            for (std::size_t i = 0; i < z.size(); ++i) ck_near(z[i], base[i], 1e-9, "start");
        }
        const CoupledDamage again =
            coupled_damage(s.term, Law{}, s.toughness, s.driving, s.least, s.old, s.pointwise(), base);
        ck_assert_int_le(again.iterations, 2);
        for (std::size_t i = 0; i < base.size(); ++i) ck_near(again.adhesion[i], base[i], 1e-12, "fixed point");
    }
}

// SPDX-License-Identifier: BSD-3-Clause
// Random packings of discs: they reach the requested density, do not overlap, even across the borders, and are
// repeatable.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

#include "mesh/gmsh/packing.hpp"

namespace {

int failures = 0;

void expect(bool condition, const std::string& what) {
    std::printf("%s %s\n", condition ? "ok   " : "FAIL ", what.c_str());
    if (!condition) ++failures;
}

// Over all pairs and periodic images.
double smallest_gap(const cli::Packing& packing) {
    double smallest = 1e300;
    for (std::size_t i = 0; i < packing.centres.size(); ++i)
        for (std::size_t j = 0; j < packing.centres.size(); ++j)
            for (int p = -1; p <= 1; ++p)
                for (int q = -1; q <= 1; ++q) {
                    if (i == j && p == 0 && q == 0) continue;
                    const double x = packing.centres[i][0] - packing.centres[j][0] + p * packing.width;
                    const double y = packing.centres[i][1] - packing.centres[j][1] + q * packing.height;
                    smallest = std::min(smallest, std::hypot(x, y) - 2.0);
                }
    return smallest;
}

// Distance of a circle from touching an edge or passing through a corner.
double smallest_edge_gap(const cli::Packing& packing) {
    double smallest = 1e300;
    for (const auto& [x, y] : packing.centres) {
        for (const double d : {x, packing.width - x, y, packing.height - y})
            smallest = std::min(smallest, std::abs(d - 1.0));
        for (const double cx : {0.0, packing.width})
            for (const double cy : {0.0, packing.height})
                smallest = std::min(smallest, std::abs(std::hypot(x - cx, y - cy) - 1.0));
    }
    return smallest;
}

void dense_enough() {
    for (const std::int64_t count : {1, 2, 7, 30, 100})
        for (const double fraction : {0.1, 0.4, 0.55, 0.65})
            for (const std::uint64_t seed : {1U, 2U}) {
                cli::PackingRequest request{count, fraction, 0.06, 0.1, count == 7 ? 1.7 : 1.0, seed};
                const std::string name =
                    std::to_string(count) + " at " + std::to_string(fraction) + ", seed " + std::to_string(seed) + ": ";
                const cli::Packing packing = cli::pack_discs(request);
                const double area = packing.width * packing.height;
                const bool inside = std::all_of(packing.centres.begin(), packing.centres.end(), [&](const auto& c) {
                    return c[0] >= 0 && c[0] < packing.width && c[1] >= 0 && c[1] < packing.height;
                });
                expect(inside && packing.centres.size() == static_cast<std::size_t>(count) &&
                           std::abs(static_cast<double>(count) * std::numbers::pi / area - fraction) < 1e-12 &&
                           std::abs(packing.height / packing.width - request.aspect) < 1e-12 &&
                           smallest_gap(packing) >= 0.06 - 1e-12 && smallest_edge_gap(packing) >= 0.1 - 1e-12,
                       name + "fraction, gaps and edges kept");
            }
}

void repeatable() {
    const cli::PackingRequest request{30, 0.6, 0.06, 0.1, 1.0, 5};
    cli::PackingRequest other = request;
    other.seed = 6;
    const cli::Packing packing = cli::pack_discs(request);
    expect(packing.centres == cli::pack_discs(request).centres, "the same seed gives the same packing");
    expect(packing.centres != cli::pack_discs(other).centres, "another seed gives another packing");
    // Recorded; the same on every machine with IEEE doubles.
    const cli::Packing dense = cli::pack_discs({7, 0.65, 0.06, 0.1, 1.0, 42});
    expect(dense.centres[6][0] == 3.760328021423248 && dense.centres[6][1] == 5.1172241848915467,
           "the packing of a seed never changes");
}

void regular() {
    const cli::Packing square = cli::square_packing(0.5, 1.0);
    const cli::Packing hexagonal = cli::hexagonal_packing(0.6);
    expect(std::abs(std::numbers::pi / (square.width * square.height) - 0.5) < 1e-14 &&
               square.centres[0][0] == square.width / 2,
           "square: fraction and place");
    expect(std::abs(2 * std::numbers::pi / (hexagonal.width * hexagonal.height) - 0.6) < 1e-14 &&
               std::abs(smallest_gap(hexagonal) - (hexagonal.width - 2.0)) < 1e-12,
           "hexagonal: fraction, and all six neighbours equally far");
}

void refused(const std::string& what, const std::function<void()>& call) {
    try {
        call();
        expect(false, "refused: " + what);
    } catch (const std::domain_error& error) {
        expect(std::string(error.what()).find(what) != std::string::npos, error.what());
    }
}

void refusals() {
    const auto pack = [](std::int64_t count, double fraction, double gap, double edge, double aspect) {
        return [=] { cli::pack_discs({count, fraction, gap, edge, aspect, 1}); };
    };
    refused("fraction = 0.8: must be in (0, 0.7729] with gaps of 0.06 radii", pack(30, 0.8, 0.06, 0.1, 1));
    refused("fraction = 0:", pack(30, 0.0, 0.06, 0.1, 1));
    refused("fraction = nan:", pack(30, std::nan(""), 0.06, 0.1, 1));
    refused("fibres = 0: must be in 1..2000", pack(0, 0.5, 0.06, 0.1, 1));
    refused("gap = -1 radii", pack(3, 0.5, -1, 0.1, 1));
    refused("edge_gap = 0.7 radii", pack(3, 0.5, 0.1, 0.7, 1));
    refused("aspect = 0", pack(3, 0.5, 0.1, 0.1, 0));
    refused("meet its own image", pack(1, 0.5, 0.1, 0.1, 4));
    refused("no arrangement of 8 fibres", pack(8, 0.77, 0.06, 0.5, 1));
    refused("(0, 0.7854) in a square arrangement", [] { cli::square_packing(0.79, 1.0); });
    refused("(0, 0.9069) in a hexagonal arrangement", [] { cli::hexagonal_packing(0.91); });
}

}  // namespace

int main() {
    dense_enough();
    repeatable();
    regular();
    refusals();
    return failures == 0 ? 0 : 1;
}

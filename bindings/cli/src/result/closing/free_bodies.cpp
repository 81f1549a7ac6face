// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/free_bodies.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/library/call.hpp"

namespace cli {

namespace {

std::vector<double> field_of(const Model& model, delam_solver* solver, const char* key, std::int64_t& columns) {
    std::int64_t rows = 0;
    call(model.context.get(), delam_solver_field_shape(solver, key, -1, &rows, &columns), std::string(key));
    std::vector<double> values(static_cast<std::size_t>(rows * columns));
    call(model.context.get(), delam_solver_field(solver, key, -1, rows * columns, values.data()), std::string(key));
    return values;
}

std::string ways(const FreeBody& body, bool several) {
    std::string out;
    if (!body.axes.empty()) out = fmt::format("{} in {}", several ? "move" : "moves", fmt::join(body.axes, ", "));
    if (body.turns) out += (out.empty() ? "" : " and ") + std::string(several ? "turn" : "turns");
    return out;
}

}  // namespace

std::vector<FreeBody> free_bodies_of(const Model& model, delam_solver* solver, const Scene& scene) {
    std::int64_t columns = 0;
    const std::vector<double> since = field_of(model, solver, "free_since", columns);
    std::vector<FreeBody> out;
    if (std::none_of(since.begin(), since.end(), [](double step) { return step >= 0; })) return out;
    const std::vector<double> moves = field_of(model, solver, "free_motion", columns);
    const std::size_t axes = columns == 3 ? 2 : 3, width = static_cast<std::size_t>(columns);
    for (std::size_t b = 0; b < since.size() && b < scene.layers.size(); ++b) {
        if (since[b] < 0) continue;
        FreeBody body{scene.layers[b].name, static_cast<std::int64_t>(since[b]), {}, false};
        for (std::size_t k = 0; k < width; ++k) {
            if (moves[b * width + k] == 0) continue;
            if (k < axes)
                body.axes.emplace_back(1, "xyz"[k]);
            else
                body.turns = true;
        }
        out.push_back(std::move(body));
    }
    return out;
}

std::vector<std::string> free_body_lines(const std::vector<FreeBody>& bodies, const Scene& scene) {
    std::vector<std::string> out;
    std::vector<std::uint8_t> told(bodies.size(), 0);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (told[b] != 0) continue;
        std::vector<std::string> names;
        for (std::size_t other = b; other < bodies.size(); ++other) {
            if (bodies[other].since != bodies[b].since || ways(bodies[other], true) != ways(bodies[b], true)) continue;
            told[other] = 1;
            names.push_back(fmt::format("\"{}\"", bodies[other].name));
        }
        const bool several = names.size() > 1;
        const std::string noun = scene.mesh ? several ? "bodies" : "body" : several ? "layers" : "layer";
        const std::size_t most = 10, more = names.size() > most ? names.size() - most : 0;
        names.resize(names.size() - more);
        out.push_back(fmt::format("{} {}{} {} free since step {} ({}): neither adhesion, supports nor contact hold {}",
                                  noun, fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "",
                                  several ? "are" : "is", bodies[b].since, ways(bodies[b], several),
                                  several ? "them" : "it"));
    }
    return out;
}

}  // namespace cli

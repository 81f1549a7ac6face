// SPDX-License-Identifier: BSD-3-Clause
#include "model/sensitivities.hpp"

#include <charconv>

#include <fmt/format.h>

#include "delam/experimental.h"
#include "model/library/call.hpp"
#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

LawNumber parsed(const std::string& path, const Model& model, const Scene& scene) {
    const Place& place = scene.output.sensitivities_place;
    const std::string begin = "laws[";
    std::size_t law = 0;
    const char* end = path.data() + path.size();
    const auto number = path.starts_with(begin) ? std::from_chars(path.data() + begin.size(), end, law)
                                                : std::from_chars_result{path.data(), std::errc::invalid_argument};
    const std::string rest(number.ptr, end);
    if (number.ec != std::errc() || !rest.starts_with("].") || law >= scene.laws.size())
        throw SceneFailure(place,
                           fmt::format("\"{}\" is not allowed: laws[0].normal_toughness, for example; there are {} "
                                       "laws, counted from 0",
                                       path, scene.laws.size()));
    LawNumber out{path, rest.substr(2), {}};
    const KeyRow* row = scene_table("law").row(out.key);
    if (row == nullptr || row->kind != KeyKind::number)
        throw SceneFailure(place, fmt::format("\"{}\": \"{}\" is no number of a law", path, out.key));
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        if (!data.bonded && !data.contact && data.law == law) out.interfaces.push_back(static_cast<std::int64_t>(i));
    }
    if (out.interfaces.empty())
        throw SceneFailure(place, fmt::format("\"{}\": no interface has the law \"{}\"", path, scene.laws[law].name));
    return out;
}

}  // namespace

std::vector<LawNumber> sensitivities_of(const Model& model, const Scene& scene) {
    std::vector<LawNumber> out;
    for (const std::string& path : scene.output.sensitivities) out.push_back(parsed(path, model, scene));
    return out;
}

void follow_sensitivities(const Model& model, const Scene& scene, delam_solver* solver) {
    for (const LawNumber& number : sensitivities_of(model, scene)) {
        const std::int32_t status =
            delam_experimental_solver_follow(solver, static_cast<std::int64_t>(number.interfaces.size()),
                                             number.interfaces.data(), number.key.c_str(), nullptr);
        if (status == DELAM_ERROR_STATE || status == DELAM_ERROR_ARGUMENT)
            throw SceneFailure(scene.output.sensitivities_place,
                               fmt::format("\"{}\": {}", number.path, delam_context_message(model.context.get())));
        call(model.context.get(), status, scene.output.sensitivities_place);
    }
}

Sensitivities read_sensitivities(const Model& model, delam_solver* solver, std::size_t numbers) {
    std::int64_t patterns = 0;
    call(
        model.context.get(),
        delam_problem_constraints(model.problem.get(), nullptr, nullptr, &patterns, nullptr, nullptr, nullptr, nullptr),
        std::string("patterns"));
    Sensitivities out{std::vector<double>(static_cast<std::size_t>(patterns) * numbers), 0};
    call(model.context.get(),
         delam_experimental_solver_sensitivity(solver, static_cast<std::int64_t>(out.matrix.size()), out.matrix.data(),
                                               &out.unknown),
         std::string("sensitivities"));
    return out;
}

}  // namespace cli

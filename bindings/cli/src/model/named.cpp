// SPDX-License-Identifier: BSD-3-Clause
#include "model/named.hpp"

#include <regex>

#include <fmt/format.h>

#include "model/selection.hpp"

namespace cli {

namespace {

// Replaces every match of `pattern` by the result of `with`. std::regex calls itself for each repetition, and a message
// may contain the user's words: repetitions are bounded.
template <class With>
std::string replaced(const std::string& text, const std::regex& pattern, With with) {
    std::string out;
    auto from = text.begin();
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
        out.append(from, text.begin() + match->position());
        out += with(*match);
        from = text.begin() + match->position() + match->length();
    }
    return out.append(from, text.end());
}

}  // namespace

std::string said_of_scene(const std::string& message, const Model& model) {
    const auto interface = [&](const std::string& number) {
        const std::size_t index = std::stoul(number);
        return index < model.interfaces.size() ? fmt::format("\"{}\"", model.interfaces[index].name) : number;
    };
    // "interface 0", "interfaces 0, 1 and 2"; but not within a name given by the user.
    std::string out = replaced(
        message, std::regex(R"((^|[^"\w-])(interfaces?) (\d{1,9}(?:(?:, | and )\d{1,9}){0,30})\b(?!["-]))"),
        [&](const std::smatch& m) {
            return m[1].str() + m[2].str() + " " +
                   replaced(m[3].str(), std::regex(R"(\d+)"), [&](const std::smatch& n) { return interface(n.str()); });
        });
    out = replaced(out, std::regex(R"( \(delam_problem_propose\))"), [](const std::smatch&) { return std::string(); });
    return replaced(out, std::regex(R"((solution|backtracking) = (energetic|on)\b)"),
                    [](const std::smatch& m) { return fmt::format("{} = \"{}\"", m[1].str(), m[2].str()); });
}

std::string named(const std::string& message, const Scene& scene, const Model& model) {
    const auto body = [&](const std::string& number) {
        const std::size_t index = std::stoul(number);
        return index < scene.layers.size() ? fmt::format("\"{}\"", scene.layers[index].name) : number;
    };
    const std::string noun = scene.mesh ? "body" : "layer", nouns = scene.mesh ? "bodies" : "layers";
    // "bodies 0 and 1", "bodies 0, 1, 2", "body 3"; but not within a name given by the user.
    std::string out =
        replaced(message, std::regex(R"(\bbodies (\d{1,9}(?:(?:, | and )\d{1,9}){0,30}))"), [&](const std::smatch& m) {
            return nouns + " " +
                   replaced(m[1].str(), std::regex(R"(\d+)"), [&](const std::smatch& n) { return body(n.str()); });
        });
    out = replaced(out, std::regex(R"((^|[^"\w-])body (\d{1,9})\b(?!["-]))"),
                   [&](const std::smatch& m) { return m[1].str() + noun + " " + body(m[2].str()); });
    out = said_of_scene(out, model);
    out = replaced(out, std::regex(R"(\bcontrol node (\d{1,9}))"), [&](const std::smatch& m) {
        if (scene.controls.empty() || model.mesh == nullptr) return m.str();
        const std::int64_t first = control_node(model.context.get(), model.mesh.get(), scene, 0, scene.geometry.place);
        const std::int64_t index = std::stoll(m[1].str()) - first;
        if (index < 0 || index >= static_cast<std::int64_t>(scene.controls.size())) return m.str();
        return fmt::format("control node \"{}\"", scene.controls[static_cast<std::size_t>(index)].name);
    });
    return replaced(out, std::regex(R"(\bconstraint (\d{1,9}) \()"), [&](const std::smatch& m) {
        const std::size_t index = std::stoul(m[1].str());
        if (index >= model.constraint_places.size()) return m.str();
        const Place& place = model.constraint_places[index];
        return fmt::format("{}, line {}, constraint {} (", place.path, place.line, index);
    });
}

}  // namespace cli

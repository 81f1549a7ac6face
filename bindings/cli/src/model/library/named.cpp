// SPDX-License-Identifier: BSD-3-Clause
#include "model/library/named.hpp"

#include <algorithm>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include "model/library/selection.hpp"
#include "scene/read_mesh.hpp"

namespace cli {

namespace {

// Replaces every match of `pattern` by the result of `with`. std::regex calls itself for each repetition, and a message
// may contain the user's words: repetitions are bounded. A text without this word does not need the pattern, which
// takes longer to read than the text.
template <class With>
std::string replaced(const std::string& text, std::string_view word, const char* pattern, With with) {
    if (text.find(word) == std::string::npos) return text;
    const std::regex expected(pattern);
    std::string out;
    auto from = text.begin();
    for (std::sregex_iterator match(text.begin(), text.end(), expected), end; match != end; ++match) {
        out.append(from, text.begin() + match->position());
        out += with(*match);
        from = text.begin() + match->position() + match->length();
    }
    return out.append(from, text.end());
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
// True if a word or a name given by the user may go on with it.
bool goes_on(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '"' || c == '-';
}

// Returns the end of a whole number of up to nine digits that stands alone at a place; npos: there is none.
std::size_t number_end(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && end < at + 9 && is_digit(text[end])) ++end;
    const bool fraction = end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1]);
    return end > at && !fraction && (end == text.size() || !goes_on(text[end])) ? end : std::string::npos;
}

// Names what the numbers behind a noun are: "interface 0", and behind a plural "interfaces 0, 1 and 2"; but not within
// a name given by the user. noun: with the blank behind it; as: what stands in its place.
template <class Name>
std::string named_numbers(const std::string& text, std::string_view noun, std::string_view as, bool plural, Name name) {
    std::string out;
    std::size_t done = 0;
    for (std::size_t at = text.find(noun); at != std::string::npos; at = text.find(noun, at + 1)) {
        std::size_t number = at + noun.size();
        if (at < done || (at > 0 && goes_on(text[at - 1])) || number_end(text, number) == std::string::npos) continue;
        out.append(text, done, at - done).append(as);
        done = number;
        for (std::size_t end = 0; (end = number_end(text, number)) != std::string::npos;) {
            out.append(text, done, number - done).append(name(text.substr(number, end - number)));
            done = end;
            if (!plural) break;
            number = end + (text.compare(end, 2, ", ") == 0 ? 2 : text.compare(end, 5, " and ") == 0 ? 5 : 0);
        }
    }
    return out.append(text, done);
}

}  // namespace

std::string said_of_scene(const std::string& message, const Model& model) {
    const auto interface = [&](const std::string& number) {
        const std::size_t index = std::stoul(number);
        return index < model.interfaces.size() ? fmt::format("\"{}\"", model.interfaces[index].name) : number;
    };
    std::string out = named_numbers(message, "interface ", "interface ", false, interface);
    out = named_numbers(out, "interfaces ", "interfaces ", true, interface);
    out = replaced(out, "delam_problem_propose", R"( \(delam_problem_propose\))",
                   [](const std::smatch&) { return std::string(); });
    out = replaced(out, "solution = energetic", R"(\bsolution = energetic\b)",
                   [](const std::smatch&) { return std::string("solution = \"energetic\""); });
    return replaced(out, "backtracking = on", R"(\bbacktracking = on\b)",
                    [](const std::smatch&) { return std::string("backtracking = \"on\""); });
}

OfElements with_elements(const std::string& message, const Place& place, const Scene& scene) {
    if (!scene.mesh) return {message, place};
    std::vector<std::int64_t> cells;
    const auto note = [&](const std::string& number) {
        cells.push_back(std::stoll(number));
        return number;
    };
    for (const auto& [noun, plural] : {std::pair("cell ", false), std::pair("cells ", true)})
        (void)named_numbers(message, noun, noun, plural, note);
    const std::vector<FileElement> elements =
        cells.empty() ? std::vector<FileElement>{} : file_elements(*scene.mesh, cells);
    if (elements.empty()) return {message, place};
    const Place& first = elements.front().place;
    const bool moved = scene.imported.has_value();
    const auto name = [&](const std::string& number) {
        const auto at = std::find(cells.begin(), cells.end(), std::stoll(number)) - cells.begin();
        const FileElement& element = elements[static_cast<std::size_t>(at)];
        if (moved && at == 0) return element.label;
        return element.label + " of " + Place{element.place.file, "", element.place.line}.text();
    };
    std::string out = named_numbers(message, "cell ", "element ", false, name);
    out = named_numbers(out, "cells ", "elements ", true, name);
    return {out, moved ? first : place};
}

std::string named(const std::string& message, const Scene& scene, const Model& model) {
    const auto body = [&](const std::string& number) {
        const std::size_t index = std::stoul(number);
        return index < scene.layers.size() ? fmt::format("\"{}\"", scene.layers[index].name) : number;
    };
    std::string out = named_numbers(message, "bodies ", scene.mesh ? "bodies " : "layers ", true, body);
    out = named_numbers(out, "body ", scene.mesh ? "body " : "layer ", false, body);
    out = said_of_scene(out, model);
    out = replaced(out, "control node ", R"(\bcontrol node (\d{1,9}))", [&](const std::smatch& m) {
        if (scene.controls.empty() || model.mesh == nullptr) return m.str();
        const std::int64_t first = control_node(model.context.get(), model.mesh.get(), scene, 0, scene.geometry.place);
        const std::int64_t index = std::stoll(m[1].str()) - first;
        if (index < 0 || index >= static_cast<std::int64_t>(scene.controls.size())) return m.str();
        return fmt::format("control node \"{}\"", scene.controls[static_cast<std::size_t>(index)].name);
    });
    return replaced(out, "constraint ", R"(\bconstraint (\d{1,9}) \()", [&](const std::smatch& m) {
        const std::size_t index = std::stoul(m[1].str());
        if (index >= model.constraint_places.size()) return m.str();
        const Place& place = model.constraint_places[index];
        return fmt::format("{}, line {}, constraint {} (", place.path, place.line, index);
    });
}

}  // namespace cli

// SPDX-License-Identifier: BSD-3-Clause
#include "file/state.hpp"

#include <algorithm>
#include <functional>
#include <string_view>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "file/hash.hpp"
#include "file/input_file.hpp"
#include "text/error.hpp"

namespace cli {

namespace {

constexpr std::string_view begins = R"({"kind":"delam state )";
constexpr std::int64_t format = 4;
// The head has the numbers of all steps that did not converge, and the hashes of those with fields; five million of
// them fit.
constexpr std::size_t most_head_bytes = std::size_t{128} << 20;

// The line of JSON, and the bytes behind it that were read with it.
struct Head {
    std::string line;
    std::string behind;
};

Head read_head(InputFile& file, const Failure& damaged) {
    constexpr std::int64_t block = 65536;
    std::string text = file.read(block);
    if (!text.starts_with(begins)) throw damaged;
    std::size_t searched = 0;
    for (;;) {
        const std::size_t end = text.find('\n', searched);
        if (end != std::string::npos) return {text.substr(0, end), text.substr(end + 1)};
        searched = text.size();
        const std::string more = searched < most_head_bytes ? file.read(block) : "";
        if (more.empty()) throw damaged;
        text += more;
    }
}

std::string seal_of(std::string_view head, std::string_view bytes) {
    return hash_text(hash(bytes, hash("\n", hash(head)))) + "\n";
}

std::string kind_of(std::int64_t of) { return "delam state " + std::to_string(of); }

// True if the numbers of a state can be: a step that has been, and ascending ones before it.
bool is_possible(const State& state) {
    const auto& steps = state.not_converged;
    return state.step >= 0 && std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end() &&
           (steps.empty() || (steps.front() >= 0 && steps.back() <= state.step));
}

std::optional<ChosenInstants> read_instants(const nlohmann::json& head) {
    const auto found = head.find("instants");
    if (found == head.end()) return std::nullopt;
    return ChosenInstants{
        found->at("steps").get<std::vector<std::int64_t>>(),    found->at("kinds").get<std::vector<std::int64_t>>(),
        found->at("patterns").get<std::vector<std::int64_t>>(), found->at("changes").get<std::vector<double>>(),
        found->at("largest").get<std::vector<double>>(),        found->at("lowest").get<std::vector<double>>()};
}

bool is_possible(const ChosenInstants& instants, std::int64_t step) {
    const auto& steps = instants.steps;
    const auto patterns = static_cast<std::int64_t>(instants.largest.size());
    return steps.size() == instants.kinds.size() && steps.size() == instants.patterns.size() &&
           steps.size() == instants.changes.size() && instants.largest.size() == instants.lowest.size() &&
           std::all_of(instants.patterns.begin(), instants.patterns.end(),
                       [patterns](std::int64_t pattern) { return pattern >= 0 && pattern < patterns; }) &&
           std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end() &&
           (steps.empty() || (steps.front() >= 0 && steps.back() <= step));
}

}  // namespace

std::string pack(const State& state) {
    nlohmann::ordered_json head{
        {"kind", kind_of(format)},
        {"content_hash", state.content_hash},
        {"problem_hash", state.problem_hash},
        {"step", state.step},
        {"not_converged", state.not_converged},
        {"history", {{"bytes", state.companions.history.bytes}, {"hash", state.companions.history.hash}}},
        {"fields", state.companions.fields},
        {"size", state.bytes.size()}};
    if (const auto& instants = state.companions.instants)
        head["instants"] = {{"steps", instants->steps},       {"kinds", instants->kinds},
                            {"patterns", instants->patterns}, {"changes", instants->changes},
                            {"largest", instants->largest},   {"lowest", instants->lowest}};
    const std::string line = head.dump();
    return line + "\n" + state.bytes + seal_of(line, state.bytes);
}

StateFile read_state(const std::string& path) {
    const Failure damaged(exit_scene, path + ": damaged or of another version; run again without --resume");
    InputFile file(path);
    Head head = read_head(file, damaged);
    const auto json = nlohmann::json::parse(head.line, nullptr, false);
    if (!json.is_object()) throw damaged;
    try {
        StateFile out;
        for (const std::int64_t known : {2, 3, 4})
            if (json.at("kind") == kind_of(known)) out.format = known;
        if (out.format == 0) throw damaged;
        const bool sealed = out.format >= first_sealed_format;
        State& state = out.state;
        state.content_hash = json.at("content_hash");
        state.problem_hash = json.at("problem_hash");
        state.step = json.at("step");
        state.not_converged = json.at("not_converged").get<std::vector<std::int64_t>>();
        if (out.format == 2) out.origin = Origin{json.at("started"), json.at("resumed")};
        if (sealed) {
            const auto& history = json.at("history");
            state.companions = {{history.at("bytes"), history.at("hash")}, json.at("fields"), read_instants(json)};
            if (state.companions.instants && !is_possible(*state.companions.instants, state.step)) throw damaged;
        }
        // The whole file is read: what it holds besides its first line is limited by its own length.
        state.bytes = std::move(head.behind) + file.rest();
        std::string seal;
        if (sealed) {
            const std::size_t length = seal_of("", "").size();
            if (state.bytes.size() < length) throw damaged;
            seal = state.bytes.substr(state.bytes.size() - length);
            state.bytes.erase(state.bytes.size() - length);
        }
        if (state.bytes.size() != json.at("size").get<std::uint64_t>() || !is_possible(state)) throw damaged;
        if (sealed ? seal != seal_of(head.line, state.bytes) : hash_text(state.bytes) != json.at("checksum"))
            throw damaged;
        return out;
    } catch (const nlohmann::json::exception&) {
        throw damaged;
    }
}

bool is_state(const std::string& path) {
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return false;
    return InputFile(path).read(static_cast<std::int64_t>(begins.size())) == begins;
}

}  // namespace cli

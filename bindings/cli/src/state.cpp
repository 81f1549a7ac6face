// SPDX-License-Identifier: BSD-3-Clause
#include "state.hpp"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "error.hpp"
#include "hash.hpp"
#include "input_file.hpp"

namespace cli {

namespace {

constexpr const char* kind = "delam state 3";
constexpr const char* kind_with_origin = "delam state 2";
// With the numbers of all steps that did not converge; ten million of them fit.
constexpr std::size_t most_head_bytes = std::size_t{128} << 20;

// The line of JSON, and the bytes behind it that were read with it.
struct Head {
    std::string line;
    std::string behind;
};

Head read_head(InputFile& file, const Failure& damaged) {
    constexpr std::string_view begins = R"({"kind":"delam state )";
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

}  // namespace

std::string pack(const State& state) {
    const nlohmann::ordered_json head{{"kind", kind},
                                      {"content_hash", state.content_hash},
                                      {"problem_hash", state.problem_hash},
                                      {"step", state.step},
                                      {"not_converged", state.not_converged},
                                      {"size", state.bytes.size()},
                                      {"checksum", hash_text(state.bytes)}};
    return head.dump() + "\n" + state.bytes;
}

StateFile read_state(const std::string& path) {
    const Failure damaged(exit_scene, path + ": damaged or of another version; run again without --resume");
    InputFile file(path);
    Head head = read_head(file, damaged);
    const auto json = nlohmann::json::parse(head.line, nullptr, false);
    if (!json.is_object()) throw damaged;
    try {
        const bool with_origin = json.at("kind") == kind_with_origin;
        if (!with_origin && json.at("kind") != kind) throw damaged;
        StateFile out;
        State& state = out.state;
        state.content_hash = json.at("content_hash");
        state.problem_hash = json.at("problem_hash");
        state.step = json.at("step");
        state.not_converged = json.at("not_converged").get<std::vector<std::int64_t>>();
        if (with_origin) out.origin = Origin{json.at("started"), json.at("resumed")};
        const auto size = static_cast<std::uint64_t>(file.size()) - head.line.size() - 1;
        if (size != json.at("size").get<std::uint64_t>()) throw damaged;
        state.bytes = std::move(head.behind) + file.rest();
        if (state.bytes.size() != size || hash_text(state.bytes) != json.at("checksum")) throw damaged;
        return out;
    } catch (const nlohmann::json::exception&) {
        throw damaged;
    }
}

}  // namespace cli

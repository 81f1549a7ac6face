// SPDX-License-Identifier: BSD-3-Clause
#include "state.hpp"

#include <nlohmann/json.hpp>

#include "error.hpp"
#include "hash.hpp"

namespace cli {

namespace {
constexpr const char* kind = "delam state 2";
}

std::string pack(const State& state) {
    const nlohmann::ordered_json head{{"kind", kind},
                                      {"content_hash", state.content_hash},
                                      {"problem_hash", state.problem_hash},
                                      {"step", state.step},
                                      {"not_converged", state.not_converged},
                                      {"started", state.started},
                                      {"resumed", state.resumed},
                                      {"size", state.bytes.size()},
                                      {"checksum", hash_text(state.bytes)}};
    return head.dump() + "\n" + state.bytes;
}

State unpack(const std::string& path, const std::string& file) {
    const Failure damaged(exit_scene, path + ": damaged or of another version; run again without --resume");
    const std::size_t end = file.find('\n');
    if (end == std::string::npos) throw damaged;
    const auto head = nlohmann::json::parse(file.substr(0, end), nullptr, false);
    if (!head.is_object() || head.value("kind", "") != kind) throw damaged;
    try {
        State state;
        state.content_hash = head.at("content_hash");
        state.problem_hash = head.at("problem_hash");
        state.step = head.at("step");
        state.not_converged = head.at("not_converged").get<std::vector<std::int64_t>>();
        state.started = head.at("started");
        state.resumed = head.at("resumed");
        state.bytes = file.substr(end + 1);
        if (state.bytes.size() != head.at("size").get<std::size_t>() || hash_text(state.bytes) != head.at("checksum"))
            throw damaged;
        return state;
    } catch (const nlohmann::json::exception&) {
        throw damaged;
    }
}

}  // namespace cli

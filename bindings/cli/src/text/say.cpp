// SPDX-License-Identifier: BSD-3-Clause
#include "text/say.hpp"

#include <nlohmann/json.hpp>

namespace cli {

namespace {
bool json_lines = false;
std::string begun;  // of a line of text
}  // namespace

void say_json_lines(bool yes) {
    json_lines = yes;
    begun.clear();
}

bool says_json_lines() { return json_lines; }

void say_raw(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string json_text(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void say_event(std::string_view event, const std::string& members) {
    if (!json_lines) return;
    say_raw(fmt::format("{{\"event\": \"{}\"{}{}}}\n", event, members.empty() ? "" : ", ", members));
    std::fflush(stdout);  // programs wait for it
}

void say_text(std::string_view text) {
    if (!json_lines) return say_raw(printable(text));
    begun += text;
    for (std::size_t end = begun.find('\n'); end != std::string::npos; end = begun.find('\n')) {
        if (end > 0) say_event("line", "\"text\": " + json_text(begun.substr(0, end)));
        begun.erase(0, end + 1);
    }
}

}  // namespace cli

// SPDX-License-Identifier: BSD-3-Clause
// Lists the choices that the library has: the options of [solver] and the parameters of the laws.
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "delam/delam.h"
#include "text/error.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

using Json = nlohmann::ordered_json;

// null: there is no bound on that side.
Json bound(double value) { return value == value && value - value == 0.0 ? Json(value) : Json(nullptr); }

Json bounds(double lower, double upper, std::int32_t lower_open, std::int32_t upper_open) {
    return {{"lower", bound(lower)},
            {"upper", bound(upper)},
            {"lower_open", lower_open != 0},
            {"upper_open", upper_open != 0}};
}

Json options_listed() {
    Json out = Json::array();
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char *key = "", *alias = "", *type = "", *unit = "", *initial = "", *range = "", *meaning = "";
        delam_option_info(i, &key, &type, &unit, &initial, &range, &meaning);
        delam_option_alias(i, &alias);
        Json option{{"key", key},         {"alias", alias}, {"type", type},      {"unit", unit},
                    {"default", initial}, {"range", range}, {"meaning", meaning}};
        double lower = 0, upper = 0;
        std::int32_t lower_open = 0, upper_open = 0;
        if (delam_option_bounds(i, &lower, &upper, &lower_open, &upper_open) == DELAM_OK)
            option["bounds"] = bounds(lower, upper, lower_open, upper_open);
        out.push_back(std::move(option));
    }
    return out;
}

Json laws_listed() {
    Json out = Json::array();
    for (std::int64_t k = 0; k < delam_law_kind_count(); ++k) {
        const char *kind = "", *meaning = "";
        std::int32_t hosted = 0;
        delam_law_kind_info(k, &kind, &meaning, &hosted);
        if (hosted != 0) continue;  // for programs alone
        Json law{{"kind", kind}, {"meaning", meaning}, {"parameters", Json::array()}};
        for (std::int64_t i = 0; i < delam_law_parameter_count(kind); ++i) {
            const char *key = "", *type = "", *unit = "", *initial = "", *range = "", *words = "";
            delam_law_parameter_info(kind, i, &key, &type, &unit, &initial, &range, &words);
            Json row{{"key", key},         {"type", type},   {"unit", unit},
                     {"default", initial}, {"range", range}, {"meaning", words}};
            double lower = 0, upper = 0;
            std::int32_t lower_open = 0, upper_open = 0;
            if (std::string(type) != "text" &&
                delam_law_parameter_bounds(kind, i, &lower, &upper, &lower_open, &upper_open) == DELAM_OK)
                row["bounds"] = bounds(lower, upper, lower_open, upper_open);
            law["parameters"].push_back(std::move(row));
        }
        out.push_back(std::move(law));
    }
    return out;
}

void say_row(const Json& row) {
    const auto text = [&](const char* key) { return row.at(key).get<std::string>(); };
    const bool alias = row.contains("alias") && !text("alias").empty();
    const std::string unit = text("unit") == "-" ? "" : ", " + text("unit");
    say("{}{}\n    {}{}; {}; {}\n    {}\n", text("key"), alias ? " (" + text("alias") + ")" : "", text("type"), unit,
        text("range"), text("default").empty() ? "must be given" : "default " + text("default"), text("meaning"));
}

}  // namespace

int options(bool json) {
    const Json listed{{"version", delam_version()}, {"options", options_listed()}, {"laws", laws_listed()}};
    if (json) {
        say("{}\n", listed.dump(2));
        return exit_done;
    }
    say("Options of [solver]\n\n");
    for (const Json& row : listed.at("options")) say_row(row);
    for (const Json& law : listed.at("laws")) {
        say("\nParameters of [[laws]] with kind = \"{}\": {}\n\n", law.at("kind").get<std::string>(),
            law.at("meaning").get<std::string>());
        for (const Json& row : law.at("parameters")) say_row(row);
    }
    return exit_done;
}

}  // namespace cli

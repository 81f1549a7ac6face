// SPDX-License-Identifier: BSD-3-Clause
// Interface laws. The library lists the kinds and keys, and checks the conditions on their combination itself.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "delam/delam.h"
#include "scene_parts.hpp"

namespace cli {

namespace {

struct Parameter {
    std::string key;
    std::string type;
    Range range;
};

std::vector<Parameter> parameters_of(const std::string& kind) {
    std::vector<Parameter> out;
    for (std::int64_t i = 0; i < delam_law_parameter_count(kind.c_str()); ++i) {
        const char* key = nullptr;
        const char* type = nullptr;
        const char* words = nullptr;
        double lower = 0, upper = 0;
        std::int32_t lower_open = 0, upper_open = 0;
        delam_law_parameter_info(kind.c_str(), i, &key, &type, nullptr, nullptr, &words, nullptr);
        delam_law_parameter_bounds(kind.c_str(), i, &lower, &upper, &lower_open, &upper_open);
        out.push_back({key, type, {lower, upper, lower_open != 0, upper_open != 0, words}});
    }
    return out;
}

// Those that a scene can name: all but the one of callbacks.
std::vector<std::string> kinds() {
    std::vector<std::string> out;
    for (std::int64_t i = 0; i < delam_law_kind_count(); ++i) {
        const char* kind = nullptr;
        std::int32_t hosted = 0;
        delam_law_kind_info(i, &kind, nullptr, &hosted);
        if (hosted == 0) out.emplace_back(kind);
    }
    return out;
}

// Of the numbers in a table, whose words tell about the table as a whole.
std::string interval(const Range& range) {
    return fmt::format("in {}{:g}, {:g}{}", range.lower_open ? '(' : '[', range.lower, range.upper,
                       range.upper_open ? ')' : ']');
}

}  // namespace

void read_laws(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("laws")) {
        LawData law;
        law.kind = table.choice("kind", kinds(), "piecewise-linear");
        const std::vector<Parameter> parameters = parameters_of(law.kind);
        std::vector<std::string> known{"name", "kind"};
        for (const Parameter& parameter : parameters) known.push_back(parameter.key);
        table.only(known);
        law.name = new_name(table, scene.laws, "law");
        for (const auto& [key, type, range] : parameters) {
            if (!table.has(key)) continue;
            law.places.emplace(key, table.place(key));
            if (type == "text") {
                law.texts.emplace_back(key, table.text(key));
            } else if (type == "table") {
                const std::string words = interval(range);
                const Range each{range.lower, range.upper, range.lower_open, range.upper_open, words};
                for (const std::vector<double>& point : table.points(key, each, 2)) {
                    law.table_xi.push_back(point[0]);
                    law.table_s.push_back(point[1]);
                }
            } else {
                law.parameters.emplace_back(key, table.number(key, range));
            }
        }
        for (const char* mode : {"normal", "tangential"})
            if (table.has(std::string(mode) + "_onset") && table.has(std::string(mode) + "_strength"))
                table.fail(std::string(mode) + "_strength",
                           fmt::format("is given instead of {}_onset: give one", mode));
        law.place = table.place();
        scene.laws.push_back(std::move(law));
    }
}

}  // namespace cli

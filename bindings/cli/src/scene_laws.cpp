// SPDX-License-Identifier: BSD-3-Clause
// Interface laws. The library lists the kinds and keys, and checks the conditions on their combination itself.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "delam/delam.h"
#include "scene_parts.hpp"

namespace cli {

namespace {

struct Parameter {
    std::string key;
    std::string type;
    const Range* range;
};

std::vector<Parameter> parameters_of(const std::string& kind) {
    std::vector<Parameter> out;
    for (std::int64_t i = 0; i < delam_law_parameter_count(kind.c_str()); ++i) {
        const char* key = nullptr;
        const char* type = nullptr;
        const char* range = nullptr;
        delam_law_parameter_info(kind.c_str(), i, &key, &type, nullptr, nullptr, &range, nullptr);
        const std::string_view words = range;
        out.push_back({key, type,
                       words == "finite and > 0"    ? &positive
                       : words == "finite and >= 0" ? &not_negative
                                                    : &any_number});
    }
    return out;
}

}  // namespace

void read_laws(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("laws")) {
        LawData law;
        law.kind = table.choice("kind", {"piecewise-linear", "exponential", "trapezoidal", "tabulated", "griffith"},
                                "piecewise-linear");
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
                for (const std::vector<double>& point : table.points(key, fraction, 2)) {
                    law.table_xi.push_back(point[0]);
                    law.table_s.push_back(point[1]);
                }
            } else {
                law.parameters.emplace_back(key, table.number(key, *range));
            }
        }
        law.place = table.place();
        scene.laws.push_back(std::move(law));
    }
}

}  // namespace cli

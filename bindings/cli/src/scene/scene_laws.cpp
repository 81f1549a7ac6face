// SPDX-License-Identifier: BSD-3-Clause
// Interface laws. The library lists the kinds and keys, and checks the conditions on their combination itself.
#include <cmath>
#include <string>
#include <vector>

#include "scene/scene_parts.hpp"
#include "scene/table/scene_keys.hpp"

namespace cli {

void read_laws(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("laws")) {
        LawData law;
        law.kind = table.text("kind");
        law.name = new_name(table, scene.laws, "law");
        for (const KeyRow& row : scene_table("law").rows) {
            if (!table.has(row.key) || row.key == "name" || row.key == "kind") continue;
            law.places.emplace(row.key, table.place(row.key));
            if (row.kind == KeyKind::choice) {
                law.texts.emplace_back(row.key, table.text(row.key));
            } else if (row.kind == KeyKind::points) {
                for (const std::vector<double>& point : table.points(row.key, 2)) {
                    law.table_xi.push_back(point[0]);
                    law.table_s.push_back(point[1]);
                }
            } else {
                law.parameters.emplace_back(row.key, table.number(row.key));
            }
        }
        law.place = table.place();
        scene.laws.push_back(std::move(law));
    }
}

void read_law_of(const Table& table, InterfaceData& interface, const Scene& scene) {
    interface.law = find_named(table, "law", table.text("law"), scene.laws, "law");
    if (!table.has("shear_axis")) return;
    if (scene.geometry.dimension == 2)
        table.fail("shear_axis", "is for 3D: a plane scene has one direction of sliding");
    const std::vector<double> axis = table.numbers("shear_axis");
    if (!(std::hypot(axis[0], axis[1], axis[2]) > 0)) table.fail("shear_axis", "has length 0");
    interface.shear_axis = {axis[0], axis[1], axis[2]};
}

}  // namespace cli

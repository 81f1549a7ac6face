// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/generated.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace cli::abaqus {

namespace {

constexpr std::int64_t largest = 1000000000000;  // number of a node or element, so that sums of numbers fit

std::int64_t number_at(const InpLine& line, std::size_t at, std::int64_t otherwise) {
    if (at >= line.fields.size() || line.fields[at].empty()) return otherwise;
    const std::int64_t value = inp_whole(line.fields[at], line.place);
    if (value < 0 || value > largest)
        throw SceneFailure(line.place, fmt::format("{}: 0 to {} is expected", value, largest));
    return value;
}

void require_room(const InpLine& line, std::int64_t count, std::int64_t most) {
    if (count > most)
        throw SceneFailure(line.place,
                           fmt::format("with this *NGEN and *ELGEN add more than {} nodes and elements", most_copies));
}

void join(std::map<std::string, Set>& sets, const InpCard& card, const char* key, const Entry& entry) {
    if (!card.has(key)) return;
    const std::string name = card.required(key);
    Set& set = sets[upper(name)];
    if (set.name.empty()) {
        set.name = name;
        set.place = card.place;
    }
    set.entries.push_back(entry);
}

const Node& node_of(const Part& part, std::int64_t id, const Place& place) {
    const auto at = part.node_of.find(id);
    if (at == part.node_of.end()) throw SceneFailure(place, fmt::format("node {} is not there", id));
    return part.nodes[at->second];
}

}  // namespace

std::int64_t generate_nodes(const InpCard& card, Part& part, std::int64_t most) {
    card.check();
    std::int64_t made = 0;
    for (const InpLine& line : card.lines) {
        if (line.fields.size() < 2 || line.fields.size() > 3)
            throw SceneFailure(line.place, "two end nodes and an increment are expected: a straight line");
        const std::int64_t first = number_at(line, 0, 0), last = number_at(line, 1, 0), by = number_at(line, 2, 1);
        const Node begin = node_of(part, first, line.place), end = node_of(part, last, line.place);
        if (by == 0 || last <= first || (last - first) % by != 0)
            throw SceneFailure(
                line.place, fmt::format("{}, {}, {}: from first up to last in whole increments > 0", first, last, by));
        const std::int64_t parts = (last - first) / by;
        made += parts - 1;
        require_room(line, made, most);
        for (std::int64_t k = 1; k < parts; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(parts);
            Node node{first + k * by, {}};
            for (std::size_t a = 0; a < 3; ++a) node.at[a] = begin.at[a] + share * (end.at[a] - begin.at[a]);
            if (!part.node_of.emplace(node.id, part.nodes.size()).second)
                throw SceneFailure(line.place, fmt::format("node {} occurs twice", node.id));
            part.nodes.push_back(node);
        }
        join(part.node_sets, card, "NSET", {&part, std::to_string(first), line.place, last, by});
    }
    return made;
}

std::int64_t generate_elements(const InpCard& card, Part& part, std::int64_t most) {
    card.check();
    std::int64_t made = 0;
    for (const InpLine& line : card.lines) {
        const std::int64_t first = number_at(line, 0, 0);
        const auto at = part.element_of.find(first);
        if (at == part.element_of.end()) throw SceneFailure(line.place, fmt::format("element {} is not there", first));
        const Element master = part.elements[at->second];
        // Rows, rows of rows, layers: the number of elements, with the first one, and the increments of nodes and
        // elements.
        std::int64_t count[3], nodes[3], elements[3], all = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            count[k] = number_at(line, 1 + 3 * k, 1);
            nodes[k] = number_at(line, 2 + 3 * k, 1);
            elements[k] = number_at(line, 3 + 3 * k, 1);
            if (count[k] < 1 || count[k] > most_copies)
                throw SceneFailure(line.place, fmt::format("{} elements: at least 1 is expected", count[k]));
            require_room(line, made + (all *= count[k]), most);
        }
        made += all - 1;
        for (std::int64_t c = 0; c < count[2]; ++c)
            for (std::int64_t b = 0; b < count[1]; ++b)
                for (std::int64_t a = 0; a < count[0]; ++a) {
                    Element element = master;
                    element.id += a * elements[0] + b * elements[1] + c * elements[2];
                    for (std::int64_t& node : element.nodes) node += a * nodes[0] + b * nodes[1] + c * nodes[2];
                    element.place = line.place;
                    join(part.element_sets, card, "ELSET", {&part, std::to_string(element.id), line.place});
                    if (a + b + c == 0) continue;
                    element.set = card.parameter("ELSET");
                    if (!part.element_of.emplace(element.id, part.elements.size()).second)
                        throw SceneFailure(line.place, fmt::format("element {} occurs twice", element.id));
                    part.elements.push_back(std::move(element));
                }
    }
    return made;
}

}  // namespace cli::abaqus

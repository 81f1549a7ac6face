// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/generated.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

void require_room(const Place& place, std::int64_t count, std::int64_t most) {
    if (count > most)
        throw SceneFailure(
            place,
            fmt::format("with this *NGEN, *NFILL, *NCOPY, *ELGEN and *ELCOPY add more than {} nodes and elements",
                        most_copies));
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

void add(Part& part, const Node& node, const Place& place) {
    if (!part.node_of.emplace(node.id, part.nodes.size()).second)
        throw SceneFailure(place, fmt::format("node {} occurs twice", node.id));
    part.nodes.push_back(node);
}

void add(Part& part, Element element) {
    if (!part.element_of.emplace(element.id, part.elements.size()).second)
        throw SceneFailure(element.place, fmt::format("element {} occurs twice", element.id));
    part.elements.push_back(std::move(element));
}

std::array<double, 3> between(const Node& begin, const Node& end, double share) {
    std::array<double, 3> out{};
    for (std::size_t a = 0; a < 3; ++a) out[a] = begin.at[a] + share * (end.at[a] - begin.at[a]);
    return out;
}

// The numbers of a set that the part has so far, each once; ascending, unless the set is UNSORTED.
class Members {
public:
    Members(const std::map<std::string, Set>& sets, std::string what, std::int64_t most)
        : sets_(sets), what_(std::move(what)), most_(most) {}

    std::vector<std::int64_t> of(const std::string& name, const Place& place) {
        const auto found = sets_.find(upper(name));
        if (found == sets_.end()) throw SceneFailure(place, fmt::format("{} set \"{}\" is not there", what_, name));
        collect(found->second, place);
        if (!found->second.unsorted) std::sort(out_.begin(), out_.end());
        return std::move(out_);
    }

private:
    void collect(const Set& set, const Place& place) {
        if (!trail_.enter(set, place, what_.c_str())) return;
        for (const Entry& entry : set.entries) {
            const auto first = inp_whole(entry.text);
            if (!first) {
                const auto inner = sets_.find(upper(entry.text));
                if (inner == sets_.end())
                    throw SceneFailure(entry.place, fmt::format("{} set \"{}\" is not there", what_, entry.text));
                collect(inner->second, entry.place);
                continue;
            }
            for (std::int64_t id = *first; id == *first || (entry.by > 0 && id <= entry.last); id += entry.by) {
                if (known_.insert(id).second) out_.push_back(id);
                if (static_cast<std::int64_t>(out_.size()) > most_)
                    throw SceneFailure(place, fmt::format("\"{}\" has more than {} members", set.name, most_));
                if (entry.by == 0) break;
            }
        }
        trail_.leave(set);
    }

    const std::map<std::string, Set>& sets_;
    std::string what_;
    std::int64_t most_;
    Trail trail_;
    std::set<std::int64_t> known_;
    std::vector<std::int64_t> out_;
};

}  // namespace

std::int64_t fill_nodes(const InpCard& card, Part& part, std::int64_t most) {
    card.check();
    std::int64_t made = 0;
    for (const InpLine& line : card.lines) {
        if (line.fields.size() < 3 || line.fields.size() > 4)
            throw SceneFailure(line.place, "two sets of nodes, a number of intervals and an increment are expected");
        const std::int64_t parts = number_at(line, 2, 1), by = number_at(line, 3, 1);
        const auto first = Members(part.node_sets, "node", most).of(line.fields[0], line.place);
        const auto last = Members(part.node_sets, "node", most).of(line.fields[1], line.place);
        if (first.size() != last.size())
            throw SceneFailure(line.place, fmt::format("\"{}\" has {} nodes, \"{}\" has {}: as many are expected",
                                                       line.fields[0], first.size(), line.fields[1], last.size()));
        if (parts < 1 || by < 1)
            throw SceneFailure(line.place, fmt::format("{} intervals by {}: at least 1 is expected", parts, by));
        for (std::size_t i = 0; i < first.size(); ++i) {
            require_room(line.place, made += parts, most);
            const Node begin = node_of(part, first[i], line.place), end = node_of(part, last[i], line.place);
            for (std::int64_t k = 1; k < parts; ++k)
                add(part, {begin.id + k * by, between(begin, end, static_cast<double>(k) / static_cast<double>(parts))},
                    line.place);
            join(part.node_sets, card, "NSET",
                 {&part, std::to_string(begin.id), line.place, begin.id + (parts - 1) * by, by});
            join(part.node_sets, card, "NSET", {&part, std::to_string(end.id), line.place});
        }
    }
    return made;
}

std::int64_t copy_nodes(const InpCard& card, Part& part, std::int64_t most) {
    card.check();
    if (!card.has("SHIFT")) throw SceneFailure(card.place, "SHIFT is expected: copies at a distance are imported");
    const std::int64_t by = inp_whole(card.required("CHANGE NUMBER"), card.place);
    if (card.lines.size() > 1)
        throw SceneFailure(card.lines[1].place, "a rotation of copies is not imported: give the distance alone");
    const std::vector<double> shift = card.row();
    if (shift.size() > 3) throw SceneFailure(card.place, "three numbers are expected: the distance along x, y and z");
    const auto ids = Members(part.node_sets, "node", most).of(card.required("OLD SET"), card.place);
    require_room(card.place, static_cast<std::int64_t>(ids.size()), most);
    for (const std::int64_t id : ids) {
        Node node = node_of(part, id, card.place);
        node.id += by;
        for (std::size_t a = 0; a < shift.size(); ++a) node.at[a] += shift[a];
        if (node.id < 1 || node.id > largest)
            throw SceneFailure(card.place, fmt::format("node {}: 1 to {} is expected", node.id, largest));
        add(part, node, card.place);
        join(part.node_sets, card, "NEW SET", {&part, std::to_string(node.id), card.place});
    }
    return static_cast<std::int64_t>(ids.size());
}

std::int64_t copy_elements(const InpCard& card, Part& part, std::int64_t most) {
    card.check();
    const std::int64_t by = inp_whole(card.required("ELEMENT SHIFT"), card.place);
    const std::int64_t shift = inp_whole(card.required("SHIFT NODES"), card.place);
    const auto ids = Members(part.element_sets, "element", most).of(card.required("OLD SET"), card.place);
    require_room(card.place, static_cast<std::int64_t>(ids.size()), most);
    for (const std::int64_t id : ids) {
        const auto at = part.element_of.find(id);
        if (at == part.element_of.end()) throw SceneFailure(card.place, fmt::format("element {} is not there", id));
        Element element = part.elements[at->second];
        element.id += by;
        if (element.id < 1 || element.id > largest || std::abs(shift) > largest)
            throw SceneFailure(card.place, fmt::format("element {}: 1 to {} is expected", element.id, largest));
        for (std::int64_t& node : element.nodes) node += shift;
        element.place = card.place;
        element.set = card.parameter("NEW SET");
        join(part.element_sets, card, "NEW SET", {&part, std::to_string(element.id), card.place});
        add(part, std::move(element));
    }
    return static_cast<std::int64_t>(ids.size());
}

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
        require_room(line.place, made, most);
        for (std::int64_t k = 1; k < parts; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(parts);
            add(part, {first + k * by, between(begin, end, share)}, line.place);
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
            require_room(line.place, made + (all *= count[k]), most);
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
                    add(part, std::move(element));
                }
    }
    return made;
}

}  // namespace cli::abaqus

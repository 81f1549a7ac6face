// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "deck/deck_bodies.hpp"
#include "deck/deck_history.hpp"
#include "deck/deck_instants.hpp"
#include "deck/deck_temperatures.hpp"
#include "deck/deck_transforms.hpp"
#include "text/refusals.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

constexpr std::int64_t most_single_nodes = 200;
constexpr std::size_t most_points = 10000000;  // of all histories: each line may follow a long amplitude

class Loads {
public:
    Loads(Deck& deck, const Model& model, const MeshData& mesh, References& references)
        : deck_(deck),
          model_(model),
          mesh_(mesh),
          references_(references),
          temperatures_(deck, model, mesh),
          transforms_(deck, model, mesh.dimension) {}

    std::string text() {
        for (const LoadLine& line : deck_.held)
            refused_.attempt([&] {
                for (int dof = line.first; dof <= line.last; ++dof) at_one(line, false, dof);
            });
        for (const Step& step : deck_.steps) add_step(step);
        for (auto& [key, history] : histories_) history.hold_until(time_);
        for (auto& [body, history] : heated_) history.hold_until(time_);
        say_width();
        std::string out = instants_.text(time_, deck_.solver_keys);
        std::string loads;
        std::map<std::string, std::vector<std::size_t>> held;  // places with nothing but 0
        std::vector<std::pair<std::string, Place>> order;
        std::map<std::string, int> moved;  // places by pattern
        for (const auto& key : keys_)
            refused_.attempt([&] {
                const History& history = histories_.at(key);
                if (history.times.until && *history.times.until == 0)
                    return;  // of the model, taken away by the first step
                if (history.force) {
                    loads += force_text(history, key.dof);
                } else if (history.peak() != 0) {
                    const auto [pattern, coefficient] = pattern_of(history);
                    ++moved[pattern];
                    const auto turned = transforms_.direction(history.line.where, key.dof);
                    for (const auto& [place, axis, control] : prescribed(history.line.where, key.dof))
                        loads += fmt::format(
                            "{}[[loads]]\n{}{}{}\npattern = {}\n{}\n", origin_line(history.line.where.place), place,
                            history.times.text(),
                            turned ? "direction = " + toml_list(*turned)
                                   : fmt::format("component = [\"{}\"]", axis_names[axis]),
                            toml_text(pattern),
                            coefficient == 1 ? "" : fmt::format("coefficient = {}\n", toml_number(coefficient)));
                } else if (const auto turned = transforms_.direction(history.line.where, key.dof)) {
                    for (const auto& [place, axis, control] : prescribed(history.line.where, key.dof))
                        out +=
                            fmt::format("{}[[supports]]\n{}{}direction = {}\n\n", origin_line(history.line.where.place),
                                        place, history.times.text(), toml_list(*turned));
                } else {
                    for (const auto& [at, axis, control] : prescribed(history.line.where, key.dof)) {
                        const std::string place = at + history.times.text();
                        if (!held.contains(place)) order.emplace_back(place, history.line.where.place);
                        held[place].push_back(axis);
                    }
                }
            });
        refused_.require_none();
        for (const auto& [pattern, places] : moved)
            if (places > 1)
                deck_.changed.push_back(fmt::format(
                    "pattern \"{}\" moves {} places in proportion: its reaction is the sum of their forces, "
                    "each times its coefficient",
                    pattern, places));
        for (const auto& [place, origin] : order) {
            std::vector<std::string> axes;
            std::vector<std::size_t>& all = held[place];
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            for (const std::size_t axis : all) axes.emplace_back(axis_names[axis]);
            out += fmt::format("{}[[supports]]\n{}fix = {}\n\n", origin_line(origin), place, toml_list(axes));
        }
        std::map<std::int32_t, Points> changes;
        for (auto& [body, history] : heated_) changes.emplace(body, std::move(history.points));
        return patterns_ + out + loads + thermal_text(changes, mesh_);
    }

private:
    // Displacements, forces, and distributed forces: what OP=NEW ends.
    static std::size_t kind_of(const History& history) {
        return !history.force ? 0 : history.line.distributed.empty() ? 1 : 2;
    }

    // Null: the mesh has no such degree of freedom.
    History* at_one(const LoadLine& line, bool force, int dof) {
        static const std::vector<std::int64_t> none;
        const std::vector<std::int64_t>& references = line.distributed.empty() ? references_.of(line.where) : none;
        if (!references.empty()) {
            if (!moves(line, force, dof, references)) return nullptr;
        } else if (dof > mesh_.dimension && line.distributed.empty()) {
            if (force && dof > 3)
                throw SceneFailure(line.where.place,
                                   fmt::format("a moment on \"{}\", which does not rotate", line.where.text));
            if (line.named) return nullptr;
            const std::string text = dof > 3 ? "degrees of freedom 4 to 6: nodes of solids do not rotate"
                                             : "degree of freedom 3: a plane mesh has none";
            say_once(deck_.left_out, text);
            return nullptr;
        }
        HistoryKey key{(force ? "force " : "") + upper(line.where.text), dof, line.distributed};
        for (auto at = histories_.find(key); at != histories_.end() && at->second.times.until;
             at = histories_.find(key))
            ++key.part;
        const auto [found, inserted] = histories_.emplace(key, History{line, dof, force, histories_.size()});
        if (inserted) {
            keys_.push_back(key);
            if (time_ > 0 && !force) {
                found->second.times.from = time_;
                found->second.points = {{time_, 0.0}};
            }
        }
        acting_[kind_of(found->second)].emplace(found->second.number, &found->second);
        return &found->second;
    }

    // True if something moves with this degree of freedom of reference nodes. If nothing does, a support has no effect,
    // and all else is a mistake.
    [[nodiscard]] bool moves(const LoadLine& line, bool force, int dof, const std::vector<std::int64_t>& nodes) const {
        const auto moved = std::count_if(nodes.begin(), nodes.end(), [&](std::int64_t node) {
            return references_.component(node, dof).has_value();
        });
        const bool acts = force || line.magnitude != 0 || !line.amplitude.empty();
        if (acts && moved < static_cast<std::ptrdiff_t>(nodes.size()))
            throw SceneFailure(line.where.place,
                               fmt::format("degree of freedom {} of \"{}\": nothing moves with it{}", dof,
                                           line.where.text, moved > 0 ? " at some of the nodes" : ""));
        return moved > 0;
    }

    void add_step(const Step& step) {
        const double end = time_ + step.period;
        ++step_;
        // Each of these ends unless this step gives it again.
        std::map<std::size_t, History*> ending;
        const bool renewed[] = {step.new_boundaries, step.new_forces, step.new_distributed};
        for (std::size_t kind = 0; kind < std::size(renewed); ++kind)
            if (renewed[kind]) ending.merge(std::exchange(acting_[kind], {}));
        for (const bool force : {false, true})
            for (const LoadLine& line : force ? step.forces : step.boundaries)
                refused_.attempt([&] { add_line(step, line, force, end); });
        for (const LoadLine& line : step.temperatures) refused_.attempt([&] { heat(step, line, end); });
        for (const auto& [number, history] : ending) {
            if (history->given == step_) continue;
            if (!history->force) {
                history->times.until = time_;
                history->times.released = step.ramp ? end : first_increment(step);
                in_total_time_.erase(number);
                continue;
            }
            LoadLine ended = history->line;
            ended.magnitude = 0;
            ended.amplitude.clear();
            in_total_time_.erase(number);
            history->hold_until(time_);
            extend(*history, step, ended, end);
        }
        for (const auto& [number, history] : in_total_time_)
            if (history->given != step_) {
                history->hold_until(time_);
                extend(*history, step, *history->follows, end);
            }
        instants_.add(step, time_);
        time_ = end;
    }

    void add_line(const Step& step, const LoadLine& line, bool force, double end) {
        for (int dof = line.first; dof <= line.last; ++dof) {
            History* history = at_one(line, force, dof);
            if (history == nullptr) continue;
            if (line.direction != history->line.direction)
                throw SceneFailure(line.where.place,
                                   "TRVEC in another direction than before is not imported: give the "
                                   "surface another name");
            follow(*history, step, line, end);
            if (in_total_time(line))
                in_total_time_.emplace(history->number, history);
            else
                in_total_time_.erase(history->number);
        }
    }

    void heat(const Step& step, const LoadLine& line, double end) {
        for (const std::int32_t body : temperatures_.bodies(line.where)) {
            const auto [at, inserted] = heated_.try_emplace(body);
            if (inserted) at->second.points = {{0.0, temperatures_.initial(body)}};
            follow(at->second, step, line, end);
        }
    }

    // The last of several lines of a step for the same place counts.
    void follow(History& history, const Step& step, const LoadLine& line, double end) {
        history.follows = &line;
        if (history.given == step_) {
            history.points.resize(history.before);
        } else {
            history.given = step_;
            history.hold_until(time_);
            history.before = history.points.size();
        }
        extend(history, step, line, end);
    }

    [[nodiscard]] const Amplitude* amplitude_of(const LoadLine& line) const {
        if (line.amplitude.empty()) return nullptr;
        return &named(deck_.amplitudes, line.amplitude, "amplitude", line.where.place);
    }
    [[nodiscard]] bool in_total_time(const LoadLine& line) const {
        const Amplitude* amplitude = amplitude_of(line);
        return line.rate || (amplitude != nullptr && amplitude->total_time);
    }

    [[nodiscard]] double first_increment(const Step& step) const {
        return time_ + std::min(step.increment, step.period);
    }

    // A support that begins in this step finds its nodes somewhere. They go from there to where it is at the end of the
    // step, or, where it does not grow over the step, over the first increment; or all it says counts from there.
    void begin(History& history, const Step& step, const LoadLine& line, double end) {
        const Amplitude* amplitude = amplitude_of(line);
        if (line.rate || line.fixed) return history.times.reached.reset();
        const bool grows = amplitude == nullptr && step.ramp;
        history.times.reached = grows ? end : first_increment(step);
        double value = step.ramp ? 0.0 : line.magnitude;
        if (amplitude != nullptr)
            value = (amplitude->absolute ? 1.0 : line.magnitude) *
                    between(lines_of_amplitude(*amplitude), amplitude->total_time ? time_ : 0.0);
        if (value != 0) history.points = {{0.0, 0.0}, {time_, value}};
        if (!grows)
            say_once(deck_.changed,
                     fmt::format("{}: \"{}\" begins at a step: it moves to there over the first increment",
                                 line.where.place.text(), line.where.text));
    }

    const Points& lines_of_amplitude(const Amplitude& amplitude) {
        const auto [known, inserted] = lines_.try_emplace(&amplitude);
        if (inserted) known->second = lines_of(amplitude);
        return known->second;
    }

    // Continues from the last point to the end of the step.
    void extend(History& history, const Step& step, const LoadLine& line, double end) {
        if (history.times.from && *history.times.from == time_) begin(history, step, line, end);
        const double last = history.points.back().second;
        const Amplitude* amplitude = amplitude_of(line);
        Points next;
        if (line.fixed) {
            next = {{time_, last}, {end, last}};
        } else if (line.rate) {
            next = {{time_, last}, {end, last + line.magnitude * step.period}};
        } else if (amplitude == nullptr) {
            next = {{time_, step.ramp ? last : line.magnitude}, {end, line.magnitude}};
        } else {
            const double origin = amplitude->total_time ? 0.0 : time_;
            const double factor = amplitude->absolute ? 1.0 : line.magnitude;
            const Points& lines = lines_of_amplitude(*amplitude);
            next.emplace_back(time_, factor * between(lines, time_ - origin));
            const auto within = [&](const auto& point) { return point.first + origin <= time_; };
            for (auto at = std::partition_point(lines.begin(), lines.end(), within);
                 at != lines.end() && at->first + origin < end; ++at)
                next.emplace_back(at->first + origin, factor * at->second);
            next.emplace_back(end, factor * between(lines, end - origin));
        }
        if (next.front().second != last) {
            const double first = first_increment(step);
            const double value = between(next, first);
            std::erase_if(next, [&](const auto& point) { return point.first <= first; });
            next.insert(next.begin(), {first, value});
            deck_.changed.push_back(
                fmt::format("{}: \"{}\" jumps at the beginning of a step, from {} to {}; here it moves "
                            "over the first increment",
                            line.where.place.text(), line.where.text, last, value));
        } else {
            next.erase(next.begin());
        }
        points_ += next.size();
        if (points_ > most_points)
            throw SceneFailure(line.where.place, fmt::format("with this the amplitudes of all lines have more than {} "
                                                             "points in all steps",
                                                             most_points));
        history.points.insert(history.points.end(), next.begin(), next.end());
    }

    void say_width() {
        if (mesh_.dimension == 2 && deck_.width > 0 && deck_.width != 1)
            deck_.changed.push_back(
                fmt::format("the plane mesh is {} thick: the scene is per unit of thickness, and its "
                            "reactions and energies are to be multiplied by this",
                            deck_.width));
    }

    // A pattern, and what its factor is multiplied by to give these values. The first of several that are in proportion
    // gives the factor the size of its values, so that the reaction is the force there; the factor of forces goes to 1.
    std::pair<std::string, double> pattern_of(const History& history) {
        const double peak = history.peak();
        Points points;
        std::vector<double> values;
        for (const auto& [time, value] : history.points) {
            const double share = value / peak + 0.0;  // no negative zero
            if (points.size() > 1) {
                const auto& [a, fa] = points[points.size() - 2];
                const double straight = fa + (share - fa) * (points.back().first - a) / (time - a);
                if (std::abs(straight - points.back().second) <= 1e-14) {
                    points.pop_back();
                    values.pop_back();
                }
            }
            points.emplace_back(time, share);
            values.push_back(history.force ? share : share * std::abs(peak));
        }
        std::map<Points, Pattern>& made = made_[history.force ? 1 : 0];
        if (const auto known = made.find(points); known != made.end())
            return {known->second.name, peak / known->second.peak};
        const std::size_t alike = made.size() + 1;
        const std::string base = history.force ? "force" : "displacement";
        const double unit = history.force ? 1.0 : std::abs(peak);
        const Pattern pattern{alike == 1 ? base : fmt::format("{}-{}", base, alike), unit};
        std::vector<double> times;
        for (const auto& [time, share] : points) times.push_back(time);
        patterns_ +=
            fmt::format("{}[[patterns]]\nname = {}\ntimes = {}\nvalues = {}\n\n", origin_line(history.line.where.place),
                        toml_text(pattern.name), toml_list(times), toml_list(values));
        made.emplace(std::move(points), pattern);
        return {pattern.name, peak / unit};
    }

    // Returns the node of an entry that is a number.
    [[nodiscard]] std::optional<std::int64_t> node_of(const Entry& raw) const {
        const Entry entry = model_.resolved_scope(raw);
        const auto id = inp_whole(entry.text);
        if (!id) return std::nullopt;
        return node_number(*entry.scope, *id, entry.place);
    }

    // Returns the places of a degree of freedom of an entry in the scene; that of a node of several bodies is in each
    // of them.
    [[nodiscard]] std::vector<SceneComponent> components(const Entry& raw, int dof) const {
        std::vector<SceneComponent> out;
        const auto axis = static_cast<std::size_t>(dof - 1);
        if (const std::vector<std::int64_t>& nodes = references_.of(raw); !nodes.empty()) {
            for (const std::int64_t node : nodes)
                if (const auto at = references_.component(node, dof)) out.push_back(*at);
        } else if (const std::optional<std::int64_t> node = node_of(raw)) {
            for (const std::int32_t body : references_.bodies_at(*node))
                out.push_back({point_text(mesh_, *node, body), axis, 0});
        } else {
            out.push_back({fmt::format("set = {}\n", toml_text(set_name(raw))), axis, 0});
        }
        return out;
    }

    [[nodiscard]] std::vector<SceneComponent> prescribed(const Entry& raw, int dof) {
        std::vector<SceneComponent> out = components(raw, dof);
        if (!references_.of(raw).empty())
            for (const SceneComponent& component : out) references_.prescribe(component);
        return out;
    }

    [[nodiscard]] std::string set_name(const Entry& raw) const {
        std::string name = node_set_name(model_, raw);
        if (!mesh_.node_sets.contains(name))
            throw SceneFailure(raw.place, "node set \"" + raw.text + "\" is not there, or empty");
        return name;
    }

    [[nodiscard]] std::string faces_named(const Entry& raw) const {
        std::string name = surface_name(model_, raw);
        if (name.empty()) throw SceneFailure(raw.place, "surface \"" + raw.text + "\" is not there");
        return name;
    }

    std::string force_text(const History& history, int dof) {
        if (history.peak() == 0) return "";
        const Entry& where = history.line.where;
        const auto [name, peak] = pattern_of(history);
        const std::string pattern = fmt::format("pattern = {}\n", toml_text(name));
        if (history.line.distributed == "P")
            return fmt::format("{}[[forces]]\nset = {}\n{}pressure = {}\n\n", origin_line(where.place),
                               toml_text(faces_named(where)), pattern, toml_number(peak));
        std::vector<double> force(static_cast<std::size_t>(mesh_.dimension), 0.0);
        if (history.line.distributed == "TRVEC") {
            double length = 0;
            for (const double x : history.line.direction) length += x * x;
            if (history.line.direction.size() < force.size() || !(length > 0))
                throw SceneFailure(where.place, "a magnitude and a direction are expected");
            for (std::size_t a = 0; a < force.size(); ++a)
                force[a] = peak * history.line.direction[a] / std::sqrt(length);
            return fmt::format("{}[[forces]]\nset = {}\n{}traction = {}\n\n", origin_line(where.place),
                               toml_text(faces_named(where)), pattern, toml_list(force));
        }
        // The scene is per unit of thickness.
        const double width = mesh_.dimension == 2 && deck_.width > 0 ? deck_.width : 1.0;
        // *CLOAD gives each node of a set the whole force.
        std::string out;
        for (const auto& [place, axis, control] : pushed(where, dof)) {
            std::fill(force.begin(), force.end(), 0.0);
            force[axis] = 1;
            if (const auto turned = transforms_.direction(where, dof)) force = *turned;
            for (double& x : force) x *= peak / width;
            out += fmt::format("{}[[forces]]\n{}{}force = {}\n\n", origin_line(where.place), place, pattern,
                               toml_list(force));
        }
        return out;
    }

    // The places on which a force acts; a node of several bodies with the first of them.
    [[nodiscard]] std::vector<SceneComponent> pushed(const Entry& raw, int dof) {
        std::vector<SceneComponent> out;
        if (!references_.of(raw).empty()) {
            out = components(raw, dof);
            for (const SceneComponent& component : out) {
                if (!pushed_.insert({component.place, component.axis}).second)
                    throw SceneFailure(raw.place, fmt::format("\"{}\" has a force from another line by another name: "
                                                              "give it one",
                                                              raw.text));
                references_.push(component, raw.place);
            }
            return out;
        }
        const std::optional<std::int64_t> one = node_of(raw);
        const std::vector<std::int64_t> alone = one ? std::vector{*one} : std::vector<std::int64_t>{};
        const std::vector<std::int64_t>& numbers = one ? alone : mesh_.node_sets.at(set_name(raw));
        if (static_cast<std::int64_t>(numbers.size()) > most_single_nodes)
            throw SceneFailure(raw.place, fmt::format("forces at {} nodes: at most {} are imported; give a surface a "
                                                      "traction (*DSLOAD)",
                                                      numbers.size(), most_single_nodes));
        for (const std::int64_t node : numbers) {
            if (!mesh_.has_given(node)) continue;
            // A later line replaces the force of an earlier one only where both have the same place.
            if (!loaded_.insert({node, dof}).second)
                throw SceneFailure(raw.place, fmt::format("a node of \"{}\" has a force from another line by another "
                                                          "name: give each node one",
                                                          raw.text));
            out.push_back(
                {point_text(mesh_, node, references_.bodies_at(node).front()), static_cast<std::size_t>(dof - 1), 0});
        }
        return out;
    }

    Deck& deck_;
    const Model& model_;
    const MeshData& mesh_;
    References& references_;
    RefusalList refused_;
    Temperatures temperatures_;
    Transforms transforms_;
    std::map<std::int32_t, History> heated_;  // by body
    std::map<HistoryKey, History> histories_;
    std::vector<HistoryKey> keys_;                          // in the order of the deck
    std::set<std::pair<std::string, std::size_t>> pushed_;  // components of control nodes with a force
    std::set<std::pair<std::int64_t, int>> loaded_;         // nodes and degrees of freedom with a force of their own
    std::map<Points, Pattern> made_[2];                     // of displacements, of forces
    std::map<const Amplitude*, Points> lines_;
    // Histories by number: those that steps prescribe, by kind_of(), and those of them that go on by themselves.
    std::array<std::map<std::size_t, History*>, 3> acting_;
    std::map<std::size_t, History*> in_total_time_;
    std::size_t step_ = 0, points_ = 0;
    std::string patterns_;
    Instants instants_;
    double time_ = 0;
};

}  // namespace

std::string loads_text(Deck& deck, const Model& model, const MeshData& mesh, References& references) {
    return Loads(deck, model, mesh, references).text();
}

}  // namespace cli::abaqus

// SPDX-License-Identifier: BSD-3-Clause
// `delam check --draw`: finds what a drawing of the scene shows, with the names of the scene. A script draws it
// (bindings/cli/plot/draw.py), as it draws the pictures of results.
#include "command/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "command/commands.hpp"
#include "model/library/call.hpp"
#include "model/library/model.hpp"
#include "model/library/selection.hpp"
#include "text/error.hpp"
#include "text/unit.hpp"
#include "view/view_surface.hpp"

namespace cli {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

// The mesh of a model as the page of results takes it from a file.
ViewMesh mesh_of(const Model& model, const std::string& what) {
    const delam_mesh* mesh = model.mesh.get();
    ViewMesh out;
    std::int64_t nodes = 0, cells = 0, entries = 0;
    call(model.context.get(), delam_mesh_size(mesh, &out.dimension, &nodes, &cells, nullptr, nullptr), what);
    const auto dimension = static_cast<std::size_t>(out.dimension);
    std::vector<double> at(static_cast<std::size_t>(nodes) * dimension);
    call(model.context.get(), delam_mesh_nodes(mesh, static_cast<std::int64_t>(at.size()), at.data()), what);
    out.points.assign(static_cast<std::size_t>(nodes) * 3, 0.0);
    for (std::size_t i = 0; i < at.size(); ++i) out.points[i / dimension * 3 + i % dimension] = at[i];
    call(model.context.get(), delam_mesh_cells(mesh, nullptr, nullptr, nullptr, 0, nullptr, &entries), what);
    out.body.resize(static_cast<std::size_t>(cells));
    std::vector<std::int32_t> types(out.body.size());
    std::vector<std::int64_t> offsets(out.body.size() + 1), connectivity(static_cast<std::size_t>(entries));
    call(model.context.get(),
         delam_mesh_cells(mesh, types.data(), out.body.data(), offsets.data(), entries, connectivity.data(), &entries),
         what);
    for (std::size_t c = 0; c < out.body.size(); ++c)
        out.per_cell = std::max(out.per_cell, static_cast<std::size_t>(offsets[c + 1] - offsets[c]));
    out.cells.assign(out.body.size() * out.per_cell, -1);
    for (std::size_t c = 0; c < out.body.size(); ++c)
        std::copy(connectivity.begin() + offsets[c], connectivity.begin() + offsets[c + 1],
                  out.cells.begin() + static_cast<std::ptrdiff_t>(c * out.per_cell));
    return out;
}

ViewInterface interface_of(const Model& model, std::size_t index) {
    const std::string& what = model.interfaces[index].name;
    const auto number = static_cast<std::int64_t>(index);
    ViewInterface out;
    out.name = what;
    std::int32_t a = 0, b = 0, per_face = 0;
    std::int64_t pairs = 0, faces = 0;
    call(model.context.get(), delam_mesh_interface_size(model.mesh.get(), number, &a, &b, &pairs, &faces, &per_face),
         what);
    out.body_a = a;
    out.body_b = b;
    out.per_face = static_cast<std::size_t>(per_face);
    out.faces.resize(static_cast<std::size_t>(faces * per_face));
    PairNodes nodes = nodes_of_pairs(model, number, what);
    out.nodes_a = std::move(nodes.a);
    out.nodes_b = std::move(nodes.b);
    call(model.context.get(), delam_mesh_interface_faces(model.mesh.get(), number, out.faces.data()), what);
    return out;
}

constexpr std::size_t most_angles = 8;  // of plies of one layer that are named

// Returns ", 90°" for a layer whose fibres lie in its plane at this angle to x, all angles for one of few plies.
std::string turned(const Layer& layer) {
    std::vector<std::array<double, 6>> plies = layer.plies;
    if (plies.empty() && layer.axes) plies.push_back(*layer.axes);
    if (plies.empty() || plies.size() > most_angles) return "";
    std::vector<std::string> angles;
    for (const auto& frame : plies) {
        if (std::abs(frame[2]) > 1e-9) return "";
        const double angle = std::atan2(frame[1], frame[0]) * 180 / std::acos(-1.0);
        angles.push_back(fmt::format("{:g}", std::round(10 * angle) / 10 + 0.0));
    }
    return fmt::format(", {}°", fmt::join(angles, "/"));
}

class Drawing {
public:
    Drawing(const Model& model, const Scene& scene)
        : model_(model), scene_(scene), mesh_(mesh_of(model, scene.file)), origins_(mesh_.nodes()) {
        call(model.context.get(),
             delam_mesh_node_origins(model.mesh.get(), static_cast<std::int64_t>(origins_.size()), origins_.data()),
             scene.file);
        for (std::size_t i = 0; i < model.interfaces.size(); ++i) interfaces_.push_back(interface_of(model, i));
    }

    json found() {
        const Seen seen = seen_of(mesh_, interfaces_, scene_.file);
        json points = json::array(), body = json::array(), bodies = json::array();
        for (const std::int64_t node : seen.nodes) points.push_back(point(node));
        for (const std::int64_t cell : seen.cells) body.push_back(mesh_.body[static_cast<std::size_t>(cell)]);
        for (const Layer& layer : scene_.layers)
            bodies.push_back(
                {{"name", layer.name}, {"material", scene_.materials[layer.material].name + turned(layer)}});
        json out{{"dimension", mesh_.dimension},
                 {"title", scene_.title.empty() ? scene_.file : scene_.title},
                 {"scales", json::array()},
                 {"points", points},
                 {"offsets", seen.faces.offsets},
                 {"faces", seen.faces.nodes},
                 {"body", body},
                 {"bodies", bodies},
                 {"interfaces", json::array()},
                 {"marks", json::array()},
                 {"levers", json::array()},
                 {"remarks", json::array()}};
        for (const Scale& scale : scales_of(Quantity::length, scene_.units.names))
            out["scales"].push_back({scale.factor, scale.name});
        for (std::size_t i = 0; i < interfaces_.size(); ++i)
            out["interfaces"].push_back(interface_json(i, seen.interfaces[i]));
        add_prescriptions(out);
        add_forces(out);
        add_ties(out);
        add_remarks(out["remarks"]);
        return out;
    }

private:
    [[nodiscard]] json point(std::int64_t node) const {
        const double* at = mesh_.points.data() + 3 * node;
        return {at[0], at[1], at[2]};
    }

    // True if a face, given by its pairs, lies in a region.
    [[nodiscard]] bool holds(const Region& region, const ViewInterface& of, std::size_t face) const {
        // Between layers a region is a part of the plane.
        const auto bounded = static_cast<std::size_t>(mesh_.dimension) - (scene_.mesh ? 0 : 1);
        bool in = true;
        for (std::size_t i = 0; i < of.per_face && in; ++i) {
            const std::int64_t node = of.nodes_b[static_cast<std::size_t>(of.faces[face * of.per_face + i])];
            if (!region.set.empty()) {
                const auto& nodes = scene_.mesh->node_sets.at(region.set);
                in = std::binary_search(nodes.begin(), nodes.end(), origins_[static_cast<std::size_t>(node)]);
                continue;
            }
            for (std::size_t a = 0; a < bounded; ++a) {
                const double x = mesh_.points[static_cast<std::size_t>(3 * node) + a];
                const double rounding = 1e-9 * (1 + std::abs(x));
                in = in && x >= region.lower[a] - rounding && x <= region.upper[a] + rounding;
            }
        }
        return in != region.outside;
    }

    json interface_json(std::size_t index, const SeenInterface& seen) {
        const InterfaceData& data = model_.interfaces[index];
        const ViewInterface& of = interfaces_[index];
        json adhesion = json::array(), faces = json::array();
        for (std::size_t f = 0; f < seen.faces.count(); ++f) {
            double value = data.contact ? 0.0 : 1.0;
            for (const Region& region : data.regions)
                if (holds(region, of, f)) value = region.adhesion;
            adhesion.push_back(value);
            for (std::int32_t i = seen.faces.offsets[f]; i < seen.faces.offsets[f + 1]; ++i)
                faces.push_back(seen.b[static_cast<std::size_t>(seen.faces.nodes[static_cast<std::size_t>(i)])]);
        }
        const std::string kind = data.bonded    ? "bonded permanently"
                                 : data.contact ? "contact without adhesion"
                                                : "law " + scene_.laws[data.law].name;
        return {{"name", data.name},
                {"kind", of.body_a < 0 ? "rigid plane, " + kind : kind},
                {"law", !data.bonded && !data.contact},
                {"offsets", seen.faces.offsets},
                {"faces", faces},
                {"adhesion", adhesion}};
    }

    [[nodiscard]] std::string terms_text(const std::vector<Term>& terms, double sign = 1) const {
        std::vector<std::string> parts;
        for (const Term& term : terms)
            parts.push_back(
                fmt::format("{:g} {}", sign * term.coefficient,
                            term.pattern < scene_.patterns.size() ? scene_.patterns[term.pattern].name : "factor"));
        return parts.empty() ? "0" : fmt::format("{}", fmt::join(parts, " + "));
    }

    // The axis along which a direction points; 3: along none, or it points backwards and forwards is asked.
    static std::size_t axis_of(const std::vector<double>& direction, bool forwards) {
        std::size_t axis = 3, others = 0;
        for (std::size_t a = 0; a < direction.size(); ++a)
            if (std::abs(direction[a]) > 0) {
                axis = a;
                ++others;
            }
        return others == 1 && (direction[axis] > 0 || !forwards) ? axis : 3;
    }

    // "ux" for an axis, "u along (0.6, 0.8)" for another direction.
    static std::string along(const std::vector<double>& direction, bool forwards = true) {
        if (const std::size_t axis = axis_of(direction, forwards); axis < 3) return std::string("u") + axes[axis];
        return fmt::format("u along ({:.3g})", fmt::join(direction, ", "));
    }

    // Returns the name that the scene gives, or which entry of the scene this is and the name of its place.
    [[nodiscard]] std::string called(const Place& place, const Selection& where) const {
        return where.name.empty() ? place.path + place_text(where) : where.name;
    }

    [[nodiscard]] std::string place_text(const Selection& where) const {
        if (const auto* set = std::get_if<NamedSet>(&where.shape); set != nullptr && !set->name.empty())
            return " \"" + set->name + "\"";
        if (const auto* control = std::get_if<ControlNode>(&where.shape))
            return " \"" + scene_.controls[control->index].name + "\"";
        return "";
    }

    // A control node that the scene puts nowhere has no place in a drawing: it is named below.
    void add_mark(json& out, const char* kind, const Selection& where, bool faces, const std::string& text,
                  const std::vector<std::vector<double>>& directions) {
        const auto* control = std::get_if<ControlNode>(&where.shape);
        if (control != nullptr && !scene_.controls[control->index].placed) {
            out["remarks"].push_back(text);
            return;
        }
        const Selected selected = select(model_.context.get(), model_.mesh.get(), scene_, where, faces);
        json points = json::array();
        for (const std::int64_t node : selected.nodes) points.push_back(point(node));
        out["marks"].push_back({{"kind", kind}, {"text", text}, {"points", points}, {"directions", directions}});
        if (std::holds_alternative<Patch>(where.shape)) out["marks"].back()["centre"] = centre_of(selected);
    }

    // Returns the centre of the part of a boundary that a patch takes. Its ends lie between nodes, whose weights make
    // the mean over this part.
    [[nodiscard]] std::array<double, 3> centre_of(const Selected& selected) const {
        std::array<double, 3> sum{};
        double whole = 0;
        for (std::size_t i = 0; i < selected.nodes.size(); ++i) {
            const double weight = selected.weights[i];
            whole += weight;
            for (std::size_t a = 0; a < 3; ++a)
                sum[a] += weight * mesh_.points[static_cast<std::size_t>(3 * selected.nodes[i]) + a];
        }
        for (double& x : sum) x /= whole;
        return sum;
    }

    void add_prescriptions(json& out) {
        for (const Prescription& one : scene_.prescriptions) {
            std::vector<std::string> moved;
            // Along -y by 1 is uy = -1; a support has no sign.
            const std::vector<double>& first = one.directions.front();
            const bool turned = one.directions.size() == 1 && axis_of(first, true) == 3 && axis_of(first, false) < 3;
            for (const auto& direction : one.directions)
                moved.push_back(along(direction, !turned && !one.terms.empty()));
            std::vector<std::vector<double>> pointed = one.directions;
            if (!one.terms.empty() && one.terms.front().coefficient < 0)
                for (auto& direction : pointed)
                    for (double& x : direction) x = -x;
            add_mark(out, one.terms.empty() ? "support" : "load", one.where, false,
                     fmt::format("{}: {}{} = {}", called(one.place, one.where), one.mean ? "mean " : "",
                                 fmt::join(moved, " = "), terms_text(one.terms, turned ? -1 : 1)),
                     pointed);
        }
    }

    void add_forces(json& out) {
        for (const DeadForce& one : scene_.forces) {
            const char* kind = one.kind == ForceKind::total      ? "total force"
                               : one.kind == ForceKind::traction ? "traction"
                                                                 : "pressure";
            const bool arrow = one.kind != ForceKind::pressure;
            add_mark(out, arrow ? "force" : "pressure", one.where, one.kind != ForceKind::total,
                     fmt::format("{}: {} ({:g}) {}", called(one.place, one.where), kind, fmt::join(one.force, ", "),
                                 scene_.patterns[one.pattern].name),
                     arrow ? std::vector<std::vector<double>>{one.force} : std::vector<std::vector<double>>{});
        }
    }

    void add_ties(json& out) {
        for (const CouplingData& one : scene_.couplings)
            add_mark(
                out, "tie", one.where, false,
                fmt::format("{}: moves with \"{}\"", called(one.place, one.where), scene_.controls[one.control].name),
                {});
        for (const EquationData& one : scene_.equations) {
            const std::string name = one.name.empty() ? one.place.path : one.name;
            for (const EquationTerm& term : one.left)
                add_mark(
                    out, "tie", term.where, true,
                    fmt::format("{}{}: {:g} {}", name, place_text(term.where), term.coefficient, along(term.direction)),
                    {});
            add_lever(out, one, name);
        }
    }

    // Returns the middle of what a term of an equation takes hold of; nothing if that has no place.
    [[nodiscard]] std::optional<std::array<double, 3>> middle_of(const Selection& where) const {
        const auto* control = std::get_if<ControlNode>(&where.shape);
        if (control != nullptr && !scene_.controls[control->index].placed) return std::nullopt;
        const auto nodes = select(model_.context.get(), model_.mesh.get(), scene_, where, true).nodes;
        if (nodes.empty()) return std::nullopt;
        std::array<double, 3> middle{};
        for (const std::int64_t node : nodes)
            for (std::size_t a = 0; a < 3; ++a)
                middle[a] += mesh_.points[static_cast<std::size_t>(3 * node) + a] / static_cast<double>(nodes.size());
        return middle;
    }

    // Two parallel displacements c1 u1 + c2 u2 are (c1 + c2) times that of one point of a rigid bar through both
    // places, which divides their distance by c1 and c2: the load of a lever. It is drawn if it is no farther off the
    // bodies than these are long.
    void add_lever(json& out, const EquationData& one, const std::string& name) const {
        if (one.left.size() != 2 || one.right.empty()) return;
        const std::vector<double>& along_first = one.left[0].direction;
        const std::vector<double>& along_second = one.left[1].direction;
        double product = 0, first = 0, second = 0;
        for (std::size_t a = 0; a < along_first.size(); ++a) {
            product += along_first[a] * along_second[a];
            first += along_first[a] * along_first[a];
            second += along_second[a] * along_second[a];
        }
        if (std::abs(product) < (1 - 1e-9) * std::sqrt(first * second)) return;
        const double c1 = one.left[0].coefficient, c2 = one.left[1].coefficient * product / first, sum = c1 + c2;
        const auto p1 = middle_of(one.left[0].where), p2 = middle_of(one.left[1].where);
        if (!p1 || !p2 || sum == 0) return;
        std::array<double, 3> load{};
        double above = 0;  // of the load over the first place: it has the height of that
        for (std::size_t a = 0; a < 3; ++a) load[a] = (c1 * (*p1)[a] + c2 * (*p2)[a]) / sum;
        for (std::size_t a = 0; a < along_first.size(); ++a) above += along_first[a] * (load[a] - (*p1)[a]) / first;
        for (std::size_t a = 0; a < along_first.size(); ++a) load[a] -= above * along_first[a];
        for (std::size_t a = 0; a < 3; ++a) {
            double low = mesh_.points[a], high = low;
            for (std::size_t i = a; i < mesh_.points.size(); i += 3) {
                low = std::min(low, mesh_.points[i]);
                high = std::max(high, mesh_.points[i]);
            }
            if (load[a] < 2 * low - high || load[a] > 2 * high - low) return;
        }
        std::vector<double> direction = along_first;
        for (double& x : direction) x *= one.right.front().coefficient / sum > 0 ? 1 : -1;
        out["levers"].push_back(
            {{"text", fmt::format("{}: {} = {}", name, along(along_first), terms_text(one.right, 1 / sum))},
             {"ends", {*p1, *p2}},
             {"load", load},
             {"direction", direction}});
    }

    void add_remarks(json& remarks) const {
        std::map<std::string, std::vector<std::string>> strained;  // bodies by what strains them
        for (const EigenstrainData& one : scene_.eigenstrains)
            strained[one.place.path + " by " + scene_.patterns[one.pattern].name].push_back(
                one.body < 0 ? "all bodies" : scene_.layers[static_cast<std::size_t>(one.body)].name);
        for (const auto& [what, bodies] : strained)
            remarks.push_back(fmt::format("{}: strain in {}", what, fmt::join(bodies, ", ")));
        if (!scene_.cell) return;
        for (const CellComponent& one : scene_.cell->components)
            remarks.push_back(fmt::format("periodic cell: average {} {}{} = {}", one.stress ? "stress" : "strain",
                                          axes[one.i], axes[one.j], terms_text(one.terms)));
    }

    const Model& model_;
    const Scene& scene_;
    ViewMesh mesh_;
    std::vector<std::int64_t> origins_;
    std::vector<ViewInterface> interfaces_;
};

}  // namespace

json drawing_of(const Model& model, const Scene& scene) { return Drawing(model, scene).found(); }

void require_drawable(const std::string& file, const Caller& caller) {
    if (caller.around) throw Failure(exit_scene, "--draw: the program of many processes draws nothing; call delam");
    for (const char* end : {".svg", ".png"})
        if (file.size() > 4 && file.ends_with(end)) return;
    throw Failure(exit_scene, fmt::format("--draw {}: a name that ends with .svg or .png is expected", file));
}

void draw(const json& drawing, const std::string& file) {
    const std::string text = drawing.dump(-1, ' ', true, json::error_handler_t::replace);
    // The script inherits the descriptor; the file has no name, and nothing is left of it.
    std::FILE* between = std::tmpfile();
    if (between == nullptr || std::fwrite(text.data(), 1, text.size(), between) != text.size() ||
        std::fflush(between) != 0)
        throw OutputFailure(file, "no temporary file can be written for the drawing");
    std::rewind(between);
    (void)std::fflush(stdout);  // becoming another program does not
    start_script("draw.py", json{{"file", file}, {"descriptor", fileno(between)}}.dump(-1, ' ', true,
                                                                                       json::error_handler_t::replace));
}

}  // namespace cli

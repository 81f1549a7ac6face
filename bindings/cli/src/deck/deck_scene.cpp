// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_scene.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/abaqus_cards.hpp"
#include "deck/abaqus/abaqus_mesh.hpp"
#include "deck/cards/deck_cards.hpp"
#include "deck/cards/deck_refusals.hpp"
#include "deck/deck_bodies.hpp"
#include "deck/deck_interfaces.hpp"
#include "deck/deck_kinematics.hpp"
#include "deck/deck_loads.hpp"
#include "mesh/body_pieces.hpp"
#include "text/printable.hpp"
#include "text/refusals.hpp"
#include "text/say.hpp"
#include "text/toml_text.hpp"
#include "text/wildcard.hpp"

namespace cli::abaqus {

namespace {

// The first line of a scene: what stands before and behind the name of its deck.
constexpr std::string_view begin_of_origin = "# From ", end_of_origin = " by delam import.";

// Moduli and ratios from D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323, by the inverse of the upper
// block.
std::vector<std::pair<const char*, double>> engineering_constants(const MaterialCards& m) {
    const Numbers& d = m.constants;
    const double c[3][3] = {{d[0], d[1], d[3]}, {d[1], d[2], d[4]}, {d[3], d[4], d[5]}};
    double s[3][3];
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            s[j][i] = c[(i + 1) % 3][(j + 1) % 3] * c[(i + 2) % 3][(j + 2) % 3] -
                      c[(i + 1) % 3][(j + 2) % 3] * c[(i + 2) % 3][(j + 1) % 3];
    for (std::size_t j = 0; j < 3; ++j) determinant += c[0][j] * s[j][0];
    if (!(d[0] > 0 && d[0] * d[2] - d[1] * d[1] > 0 && determinant > 0))
        throw SceneFailure(m.place,
                           fmt::format("material \"{}\": its ORTHOTROPIC constants are not positive definite", m.name));
    const auto young = [&](std::size_t i) { return determinant / s[i][i]; };
    const auto ratio = [&](std::size_t i, std::size_t j) { return -s[i][j] / s[i][i]; };
    return {{"E1", young(0)},      {"E2", young(1)}, {"E3", young(2)}, {"nu12", ratio(0, 1)}, {"nu13", ratio(0, 2)},
            {"nu23", ratio(1, 2)}, {"G12", d[6]},    {"G13", d[7]},    {"G23", d[8]}};
}

class SceneWriter {
public:
    SceneWriter(Deck& deck, const Model& model, const MeshData& mesh, const std::vector<std::string>& plain_names,
                const std::vector<std::size_t>& pieces)
        : deck_(deck), model_(model), mesh_(mesh), plain_names_(plain_names), pieces_(pieces) {}

    std::string text(const std::string& mesh_name, bool pieces) {
        std::string out = "schema = 1\n";
        if (!deck_.title.empty()) out += fmt::format("title = {}\n", toml_text(as_utf8(deck_.title)));
        out += fmt::format("\n[mesh]\nfile = {}\n", toml_text(mesh_name));
        if (pieces) out += "pieces = true       # what no nodes connect is a body of its own\n";
        out += "\n";
        RefusalList refused;
        refused.attempt([&] { out += bodies_and_materials(); });
        refused.attempt([&] { out += interfaces_text(deck_, model_, mesh_); });
        refused.attempt([&] {
            References references(deck_, model_, mesh_);
            deck_.solver_keys = kinematics_key(deck_, references);
            const std::string loads = loads_text(deck_, model_, mesh_, references);
            out += references.text() + loads;
        });
        refused.require_none();
        out += "# For labels: the deck does not say which units it has.\n[units]\nlength = \"\"\nforce = \"\"\n";
        return out;
    }

private:
    // A scene in the plane is per unit of thickness; the thickness of the deck has to be one.
    void require_width(const Section& section) {
        if (mesh_.dimension == 3) return;
        if (deck_.width == 0) deck_.width = section.width;
        if (section.width != deck_.width)
            throw SceneFailure(section.place,
                               fmt::format("a thickness of {} and one of {} in one plane mesh: they must "
                                           "be the same",
                                           deck_.width, section.width));
    }

    std::string bodies_and_materials() {
        std::string bodies;
        std::set<std::string> used;
        // Cohesive elements have a width in a plane mesh, too.
        for (const Section& section : deck_.sections)
            if (!section.thickness.empty()) require_width(section);
        const SectionIndex sections(deck_, model_, &Part::sections);
        std::vector<std::string> sorted = mesh_.body_names;
        std::sort(sorted.begin(), sorted.end());
        std::size_t begin = 0;  // of its pieces
        RefusalList refused;
        for (std::size_t i = 0; i < plain_names_.size(); begin += pieces_[i++])
            refused.attempt([&] {
                const std::string& plain = plain_names_[i];
                const SectionOf found = sections.of(plain);
                if (found.section == nullptr)
                    throw SceneFailure(model_.file, fmt::format("\"{}\" has no *SOLID SECTION", plain));
                const Section& section = *found.section;
                require_width(section);
                const MaterialCards& material = named(deck_.materials, section.material, "material", section.place);
                used.insert(material.name);
                const std::string rest =
                    fmt::format("material = {}\n{}\n", toml_text(material.name), axes_text(section, *found.scope));
                for (const std::string& name : entries_for(plain, begin, begin + pieces_[i], sorted))
                    bodies +=
                        fmt::format("{}[[bodies]]\nname = {}\n{}", origin_line(section.place), toml_text(name), rest);
            });
        std::string out;
        for (const MaterialCards& material : deck_.materials)
            if (used.contains(material.name)) refused.attempt([&] { out += material_text(material); });
        refused.require_none();
        return out + bodies;
    }

    // One entry for all pieces of a body, if its name fits no other.
    [[nodiscard]] std::vector<std::string> entries_for(const std::string& plain, std::size_t begin, std::size_t end,
                                                       const std::vector<std::string>& sorted) const {
        const auto& names = mesh_.body_names;
        if (end - begin > 1 && !is_pattern(plain) && number_beginning_with(sorted, plain + "-") == end - begin)
            return {plain + "-*"};
        return {names.begin() + static_cast<std::ptrdiff_t>(begin), names.begin() + static_cast<std::ptrdiff_t>(end)};
    }

    // The angle of a ply, and an orientation of a shell, are about the normal of the plies, which must be axis 3 here.
    void require_third_axis(const Section& section) const {
        const bool said = !section.orientation.empty() && orientation_of(deck_, section).about == 3;
        if ((section.angle != 0 || section.turned_plies) && !said)
            throw SceneFailure(section.place,
                               "the angle of a ply is imported with an *ORIENTATION whose second line is "
                               "3, ..: axis 3 is the normal of the plies");
        if (section.shell && !section.orientation.empty() && !said)
            throw SceneFailure(section.place,
                               "the *ORIENTATION of a shell section needs a second line 3, ..: axis 3 is "
                               "the normal of the plies");
    }

    std::string axes_text(const Section& section, const Part& scope) {
        require_third_axis(section);
        if (section.orientation.empty() && section.angle == 0) {
            if (section.shell)
                say_once(deck_.changed, "*SHELL SECTION without ORIENTATION: material axes 1, 2, 3 are x, y, z");
            return "";
        }
        if (section.plies && !section.orientation.empty())
            return "# The axes of its plies are those of the mesh, one cell for each ply.\n";
        Axes axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        if (!section.orientation.empty()) {
            const Orientation& o = orientation_of(deck_, section);
            if (o.of_each_element())
                return fmt::format("# Its axes differ from cell to cell: those of *ORIENTATION {} of the mesh.\n",
                                   one_line(o.name));
            axes = o.axes(o.points, {}, o.place);
        }
        turn(axes, 3, section.angle);
        // The section of a part turns with its instance.
        if (!section.part.empty())
            for (Vector& axis : axes) axis = turned_by(scope, axis);
        const std::array<double, 6> two = first_two(axes);
        return fmt::format("axes = [{}, {}]\n", toml_list(std::vector<double>(two.begin(), two.begin() + 3)),
                           toml_list(std::vector<double>(two.begin() + 3, two.end())));
    }

    std::string material_text(const MaterialCards& m) {
        const Numbers& c = m.constants;
        std::string out =
            fmt::format("{}[[materials]]\nname = {}\n",
                        origin_line(m.elastic_place.line > 0 ? m.elastic_place : m.place), toml_text(m.name));
        const auto key = [&](const char* name, double value) {
            out += fmt::format("{} = {}\n", name, toml_number(value));
        };
        if (m.elastic == "ISOTROPIC") {
            key("young", c[0]);
            key("poisson", c[1]);
        } else if (m.elastic == "ENGINEERING CONSTANTS") {
            const char* const names[] = {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};
            for (std::size_t i = 0; i < 9; ++i) key(names[i], c[i]);
        } else if (m.elastic == "ORTHOTROPIC") {
            for (const auto& [name, value] : engineering_constants(m)) key(name, value);
        } else if (m.elastic == "LAMINA") {
            const double nu23 = c[1] / (2 * c[5]) - 1;
            if (!(std::abs(nu23) < 1))
                throw SceneFailure(m.place,
                                   fmt::format("E2 = {} and G23 = {} make nu23 = {}: a lamina that is the same "
                                               "across its fibres has it in (-1, 1); give ENGINEERING CONSTANTS",
                                               c[1], c[5], nu23));
            deck_.changed.push_back(
                fmt::format("material \"{}\": LAMINA says nothing of the third direction; E3 = E2, "
                            "nu13 = nu12, nu23 = E2/(2 G23) - 1 = {:.4g}",
                            m.name, nu23));
            const std::pair<const char*, double> values[] = {{"E1", c[0]},   {"E2", c[1]},   {"E3", c[1]},
                                                             {"nu12", c[2]}, {"nu13", c[2]}, {"nu23", nu23},
                                                             {"G12", c[3]},  {"G13", c[4]},  {"G23", c[5]}};
            for (const auto& [name, value] : values) key(name, value);
        } else {
            throw SceneFailure(m.place, fmt::format("material \"{}\" of a body has {}", m.name,
                                                    m.elastic.empty() ? "no *ELASTIC" : "*ELASTIC, TYPE=" + m.elastic));
        }
        const bool heated = std::any_of(deck_.steps.begin(), deck_.steps.end(),
                                        [](const Step& step) { return !step.temperatures.empty(); });
        if (m.expansion.size() == 3)
            out += fmt::format("expansion = {}\n", toml_list(m.expansion));
        else if (heated || !m.expansion.empty())
            key("expansion", m.expansion.empty() ? 0.0 : m.expansion[0]);
        return out + "\n";
    }

    Deck& deck_;
    const Model& model_;
    const MeshData& mesh_;
    const std::vector<std::string>& plain_names_;
    const std::vector<std::size_t>& pieces_;  // number of pieces of each body
};

std::string header(const ImportedScene& scene, const std::string& deck) {
    std::string out = fmt::format("{}{}{}\n", begin_of_origin, one_line(deck), end_of_origin);
    const auto list = [&](const char* title, const std::vector<std::string>& texts) {
        if (texts.empty()) return;
        out += fmt::format("# {}:\n", title);
        for (const std::string& text : texts) out += "#   " + one_line(text) + "\n";
    };
    list("Changed", scene.changed);
    list("Left out", scene.left_out);
    return out + "\n";
}

// Makes comments of the lines that say where tables come from.
void note_origins(ImportedScene& scene) {
    std::string out;
    int number = 1;
    for (std::size_t at = 0; at < scene.text.size(); ++number) {
        const std::size_t end = std::min(scene.text.find('\n', at), scene.text.size() - 1) + 1;
        std::string line = scene.text.substr(at, end - at);
        at = end;
        if (line.starts_with(begin_of_origin_line)) {
            const std::size_t path = line.find('\t') + 1, file = line.find('\t', path) + 1;
            const Place place{line.substr(file, line.size() - 1 - file), line.substr(path, file - 1 - path),
                              std::stoi(line.substr(begin_of_origin_line.size()))};
            scene.origins.emplace(number + 1, place);
            line = "# " + place.text() + "\n";
        }
        out += line;
    }
    scene.text = std::move(out);
}

}  // namespace

}  // namespace cli::abaqus

namespace cli {

bool is_imported(std::string_view text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    return line.starts_with(abaqus::begin_of_origin) && line.ends_with(abaqus::end_of_origin);
}

std::vector<std::string> import_lines(const ImportedScene& scene) {
    std::vector<std::string> lines;
    for (const std::string& text : scene.taken) lines.push_back("taken     " + text);
    for (const std::string& text : scene.changed) lines.push_back("changed   " + text);
    for (const std::string& text : scene.left_out) lines.push_back("left out  " + text);
    return lines;
}

ImportedScene import_deck(const std::string& deck_path, const std::string& mesh_name) {
    const Place place{deck_path, "", 0};
    std::string bytes;
    const std::vector<InpCard> cards = read_cards(deck_path, place, bytes);
    abaqus::require_importable(cards);
    abaqus::Model model;
    abaqus::Deck deck;
    RefusalList refused;
    refused.attempt([&] { abaqus::take_cards(cards, deck_path, model); });
    refused.attempt([&] { deck = abaqus::read_deck(cards, deck_path, model.root); });
    refused.require_none();
    MeshData mesh = abaqus::mesh_of(model, {}, place);
    const std::vector<std::string> plain_names = mesh.body_names;
    const std::vector<std::size_t> parts = split_into_pieces(mesh);
    const bool pieces = mesh.body_names != plain_names;

    constexpr std::string_view left_out = "left out: ";
    ImportedScene out;
    const std::string text = abaqus::SceneWriter(deck, model, mesh, plain_names, parts).text(mesh_name, pieces);
    for (const std::string& note : mesh.notes)
        if (!note.starts_with("ignored: ") && !note.starts_with("cohesive: ") && !note.starts_with(left_out))
            out.changed.push_back(note);
    out.changed.insert(out.changed.end(), deck.changed.begin(), deck.changed.end());
    out.left_out = deck.left_out;
    for (const std::string& note : mesh.notes)
        if (note.starts_with(left_out)) out.left_out.push_back(note.substr(left_out.size()));
    for (const abaqus::Part* scope : model.scopes())
        for (const auto& [key, surface] : scope->surfaces)
            if (surface.refusal)
                out.left_out.push_back(fmt::format("surface \"{}\", which nothing uses ({})", surface.name,
                                                   surface.refusal->place().text()));
    std::int64_t cells = 0, held = 0;
    for (const CellBlock& block : mesh.blocks) cells += static_cast<std::int64_t>(block.bodies.size());
    for (const CohesiveSet& set : mesh.cohesive) held += static_cast<std::int64_t>(set.lower.size());
    out.taken.push_back(
        fmt::format("{} in {}", counted(cells, "cell"),
                    mesh.body_names.size() == 1 ? "1 body" : fmt::format("{} bodies", mesh.body_names.size())));
    if (held > 0) out.taken.push_back(counted(held, "cohesive element"));
    if (!deck.couplings.empty())
        out.taken.push_back(counted(static_cast<std::int64_t>(deck.couplings.size()), "rigid coupling"));
    if (!deck.equations.empty())
        out.taken.push_back(counted(static_cast<std::int64_t>(deck.equations.size()), "equation"));
    out.taken.push_back(counted(static_cast<std::int64_t>(deck.steps.size()), "step"));
    out.text = abaqus::header(out, deck_path) + text;
    abaqus::note_origins(out);
    return out;
}

}  // namespace cli

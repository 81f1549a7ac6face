// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/read_abaqus.hpp"

#include "deck/abaqus/abaqus_cards.hpp"
#include "deck/abaqus/abaqus_mesh.hpp"
#include "deck/abaqus/inp_cards.hpp"
#include "file/hash.hpp"

namespace cli {

bool is_abaqus_file(const std::string& path) { return path.ends_with(".inp") || path.ends_with(".INP"); }

MeshFile read_abaqus(const std::string& path, const std::vector<std::string>& bodies, const Place& place) {
    std::string bytes;
    const std::vector<InpCard> cards = read_cards(path, place, bytes);
    abaqus::Model model;
    abaqus::take_cards(cards, path, model);
    return {abaqus::mesh_of(model, bodies, place), hash_text(bytes)};
}

std::vector<FileElement> abaqus_elements(const std::string& path, const std::vector<std::string>& bodies,
                                         const Place& place, const std::vector<std::int64_t>& cells) {
    std::string bytes;
    const std::vector<InpCard> cards = read_cards(path, place, bytes);
    abaqus::Model model;
    abaqus::take_cards(cards, path, model);
    std::vector<abaqus::ElementAt> made;
    (void)abaqus::mesh_of(model, bodies, place, &made);
    std::vector<FileElement> out;
    for (const std::int64_t cell : cells) {
        const abaqus::ElementAt& at = made.at(static_cast<std::size_t>(cell));
        const abaqus::Element& element = at.element();
        out.push_back({abaqus::full_name(*at.scope, std::to_string(element.id)), element.place});
    }
    return out;
}

}  // namespace cli

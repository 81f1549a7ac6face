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

}  // namespace cli

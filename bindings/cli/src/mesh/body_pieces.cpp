// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/body_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "text/wildcard.hpp"

namespace cli {

namespace {

// Cells connected by nodes: a forest in which each cell points towards the first of its piece.
class Pieces {
public:
    explicit Pieces(std::size_t cells) : first_(cells) { std::iota(first_.begin(), first_.end(), std::size_t{0}); }

    std::size_t first_of(std::size_t cell) {
        while (first_[cell] != cell) cell = first_[cell] = first_[first_[cell]];
        return cell;
    }
    void join(std::size_t a, std::size_t b) {
        a = first_of(a);
        b = first_of(b);
        first_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> first_;
};

}  // namespace

std::vector<std::size_t> split_into_pieces(MeshData& mesh) {
    std::size_t cells = 0;
    for (const CellBlock& block : mesh.blocks) cells += block.bodies.size();
    Pieces pieces(cells);
    std::map<std::pair<std::int32_t, std::int64_t>, std::size_t> cell_at;  // by body and node
    std::size_t cell = 0;
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t nodes = shape_of(block.type).nodes;
        for (std::size_t c = 0; c < block.bodies.size(); ++c, ++cell)
            for (std::size_t k = 0; k < nodes; ++k) {
                const auto [at, inserted] =
                    cell_at.emplace(std::pair(block.bodies[c], block.connectivity[c * nodes + k]), cell);
                if (!inserted) pieces.join(at->second, cell);
            }
    }
    // The first cells of the pieces of each body.
    std::vector<std::vector<std::size_t>> found(mesh.body_names.size());
    cell = 0;
    for (const CellBlock& block : mesh.blocks)
        for (const std::int32_t body : block.bodies) {
            if (pieces.first_of(cell) == cell) found[static_cast<std::size_t>(body)].push_back(cell);
            ++cell;
        }
    std::map<std::size_t, std::int32_t> label_of;  // by first cell
    std::vector<std::string> names;
    std::vector<std::size_t> counts;
    std::vector<std::string> sorted = mesh.body_names;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t body = 0; body < found.size(); ++body) {
        const std::string& name = mesh.body_names[body];
        const bool taken = number_beginning_with(sorted, name + "-") > 0;
        const auto piece = [&](std::size_t i) { return fmt::format("{}-{}{}", name, taken ? "piece-" : "", i + 1); };
        for (std::size_t i = 0; i < found[body].size(); ++i) {
            label_of[found[body][i]] = static_cast<std::int32_t>(names.size());
            names.push_back(found[body].size() == 1 ? name : piece(i));
        }
        counts.push_back(found[body].size());
        if (counts.back() > 1)
            mesh.notes.push_back(fmt::format("body \"{}\" consists of {} pieces: \"{}\" to \"{}\"", name, counts.back(),
                                             piece(0), piece(counts.back() - 1)));
    }
    cell = 0;
    for (CellBlock& block : mesh.blocks)
        for (std::int32_t& body : block.bodies) body = label_of.at(pieces.first_of(cell++));
    mesh.body_names = std::move(names);
    return counts;
}

}  // namespace cli

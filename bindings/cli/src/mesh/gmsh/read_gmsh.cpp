// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/read_gmsh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "delam/delam.h"
#include "file/hash.hpp"
#include "file/input_file.hpp"
#include "mesh/cell_format.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/gmsh/gmsh_session.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr const char* entity_names[] = {"point", "curve", "surface", "volume"};
constexpr const char* element_names[] = {"point", "edge", "face"};

constexpr std::int64_t format_bytes = 4096;  // $MeshFormat is expected within these

// Gmsh would read, and run, a file that is no mesh as a script. head: the first bytes of the file.
void require_mesh_format(const std::string& path, const std::string& head, const Place& place) {
    std::istringstream lines(head);
    std::string line;
    while (std::getline(lines, line) && line.rfind("$Comments", 0) == 0)
        while (std::getline(lines, line) && line.rfind("$EndComments", 0) != 0) continue;
    std::string version;
    if (line.rfind("$MeshFormat", 0) != 0 || !(lines >> version))
        throw SceneFailure(place, path + ": no mesh of Gmsh: $MeshFormat is expected first");
    const bool known =
        version == "2" || version.rfind("2.", 0) == 0 || version == "4" || version == "4.0" || version == "4.1";
    if (!known)
        throw SceneFailure(place, fmt::format("{}: mesh format {:.20} is not read: 2.2 and 4.1 are", path, version));
}

void require_sections(const std::string& path, const std::string& bytes, const Place& place) {
    for (const char* section : {"Nodes", "Elements"})
        if (bytes.find(std::string("$") + section) != std::string::npos &&
            bytes.find(std::string("$End") + section) == std::string::npos)
            throw SceneFailure(place, fmt::format("{}: the file ends before $End{}", path, section));
}

// The number of partitions that a file of format 4.1 says its mesh has; 0: it says none.
std::uint64_t partitions_said(const std::string& bytes) {
    constexpr std::string_view section = "$PartitionedEntities\n";
    const std::size_t begin = bytes.find(section);
    if (begin == std::string::npos) return 0;
    std::istringstream format(bytes.substr(0, static_cast<std::size_t>(format_bytes)));
    std::string line, version;
    int binary = 0;
    while (std::getline(format, line) && line.rfind("$MeshFormat", 0) != 0) continue;
    format >> version >> binary;
    const std::string rest = bytes.substr(begin + section.size(), 32);
    std::uint64_t count = 0;
    if (binary == 0)
        std::istringstream(rest) >> count;
    else if (rest.size() >= sizeof count)
        std::memcpy(&count, rest.data(), sizeof count);
    return count;
}

// A mesh in several files has the cells of one partition in each.
void require_all_partitions(const std::string& path, const std::string& bytes, const MeshData& mesh,
                            const Place& place) {
    std::set<std::int32_t> here;
    for (const CellBlock& block : mesh.blocks) here.insert(block.partitions.begin(), block.partitions.end());
    const std::uint64_t said = partitions_said(bytes);
    if (!here.empty() && here.size() < said)
        throw SceneFailure(place,
                           fmt::format("{}: has cells of {} of its {} partitions, as one file of a split mesh has: "
                                       "give the mesh in one file (gmsh without -part_split)",
                                       path, here.size(), said));
}

class GmshReader {
public:
    GmshReader(std::string subject, const Place& place) : subject_(std::move(subject)), place_(place) {}

    MeshData read() {
        find_dimension();
        read_nodes();
        read_cells();
        keep_partitions();
        read_sets();
        tell();
        return std::move(mesh_);
    }

    // Returns the numbers of the elements of which the cells are made, block after block.
    std::vector<std::size_t> elements() {
        find_dimension();
        read_nodes();
        read_cells();
        std::vector<std::size_t> out;
        for (const auto& tags : tags_) out.insert(out.end(), tags.begin(), tags.end());
        return out;
    }

private:
    [[noreturn]] void fail(const std::string& text) const { throw SceneFailure(place_, subject_ + ": " + text); }

    // The dimension of the elements, not of the entities: a mesh of a surface may contain its volume.
    void find_dimension() {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> tags;
        std::vector<std::vector<std::size_t>> nodes;
        for (int dimension : {3, 2}) {
            gmsh::model::mesh::getElements(types, tags, nodes, dimension);
            if (types.empty()) continue;
            mesh_.dimension = dimension;
            return;
        }
        fail("there are no cells in it");
    }

    void read_nodes() {
        std::vector<std::size_t> tags;
        std::vector<double> coordinates;
        std::vector<double> parameters;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
        double extent = 0;
        for (const double x : coordinates) extent = std::max(extent, std::abs(x));
        const auto dimension = static_cast<std::size_t>(mesh_.dimension);
        for (std::size_t i = 0; i < tags.size(); ++i) {
            if (!number_.emplace(tags[i], static_cast<std::int64_t>(i)).second)
                fail(fmt::format("node {} occurs twice", tags[i]));
            for (std::size_t a = 0; a < 3; ++a)
                if (!std::isfinite(coordinates[3 * i + a]))
                    fail(fmt::format("node {}: its place is not finite", tags[i]));
            if (dimension == 2 && std::abs(coordinates[3 * i + 2]) > 1e-12 * extent)
                fail(fmt::format("node {} is at z = {}: a mesh without solid cells must lie in the plane z = 0",
                                 tags[i], coordinates[3 * i + 2]));
            mesh_.nodes.insert(mesh_.nodes.end(), coordinates.begin() + static_cast<std::ptrdiff_t>(3 * i),
                               coordinates.begin() + static_cast<std::ptrdiff_t>(3 * i + dimension));
        }
    }

    std::int64_t number(std::size_t node, std::size_t element) const {
        const auto at = number_.find(node);
        if (at == number_.end()) fail(fmt::format("element {} has node {}, which is not there", element, node));
        return at->second;
    }

    static std::string group_name(int dimension, int tag) {
        std::string name;
        gmsh::model::getPhysicalName(dimension, tag, name);
        return name.empty() ? fmt::format("{}-{}", entity_names[dimension], tag) : name;
    }

    std::int32_t label(const std::string& body) {
        auto& names = mesh_.body_names;
        const auto at = std::find(names.begin(), names.end(), body);
        if (at != names.end()) return static_cast<std::int32_t>(at - names.begin());
        names.push_back(body);
        return static_cast<std::int32_t>(names.size() - 1);
    }

    // A partitioned mesh has each entity in pieces, one for each partition, and the borders between partitions, which
    // are pieces of an entity of a higher dimension. An entity that is no piece is its own parent.
    static std::pair<int, int> parent_of(int dimension, int entity) {
        int parent_dimension = -1;
        int parent = -1;
        gmsh::model::getParent(dimension, entity, parent_dimension, parent);
        return parent < 0 ? std::pair(dimension, entity) : std::pair(parent_dimension, parent);
    }
    // 0: in none.
    std::int32_t partition_of(int entity) const {
        std::vector<int> partitions;
        gmsh::model::getPartitions(mesh_.dimension, entity, partitions);
        return partitions.empty() ? 0 : partitions.front();
    }

    // Partitions of all cells, or of none.
    void keep_partitions() {
        const bool all = std::all_of(mesh_.blocks.begin(), mesh_.blocks.end(), [](const CellBlock& block) {
            return std::all_of(block.partitions.begin(), block.partitions.end(), [](std::int32_t p) { return p > 0; });
        });
        if (all) return;
        for (CellBlock& block : mesh_.blocks) block.partitions.clear();
    }

    // The body to which an entity of the highest dimension belongs; "": none.
    std::string body_of(int entity, bool grouped) const {
        if (!grouped)
            return fmt::format("{}-{}", entity_names[mesh_.dimension], parent_of(mesh_.dimension, entity).second);
        std::vector<int> groups;
        gmsh::model::getPhysicalGroupsForEntity(mesh_.dimension, entity, groups);
        std::set<std::string> names;
        for (const int group : groups) names.insert(group_name(mesh_.dimension, group));
        if (names.size() > 1)
            fail(fmt::format("{} {} is in the physical groups \"{}\" and \"{}\": a cell belongs to one body only",
                             entity_names[mesh_.dimension], entity, *names.begin(), *std::next(names.begin())));
        return names.empty() ? "" : *names.begin();
    }

    void read_cells() {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups, mesh_.dimension);
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, mesh_.dimension);
        for (const auto& [dimension, entity] : entities) {
            std::vector<int> types;
            std::vector<std::vector<std::size_t>> tags;
            std::vector<std::vector<std::size_t>> nodes;
            gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
            if (types.empty()) continue;
            const std::string body = body_of(entity, !groups.empty());
            if (body.empty())
                fail(fmt::format("element {} of {} {} is in no physical group, so in no body", tags[0].at(0),
                                 entity_names[dimension], entity));
            for (std::size_t i = 0; i < types.size(); ++i)
                add_cells(types[i], tags[i], nodes[i], label(body), partition_of(entity),
                          fmt::format("{} {}", entity_names[dimension], entity));
        }
    }

    void add_cells(int gmsh_type, const std::vector<std::size_t>& tags, const std::vector<std::size_t>& nodes,
                   std::int32_t body, std::int32_t partition, const std::string& entity) {
        const CellFormat* from = format_of_gmsh(gmsh_type);
        if (from == nullptr)
            fail(fmt::format("element {} of {} is a {}: {} are known", tags.at(0), entity, type_name(gmsh_type),
                             fmt::join(shape_names(mesh_.dimension), ", ")));
        const std::size_t per_cell = shape_of(from->type).nodes;
        CellBlock& block = block_of(from->type);
        for (std::size_t c = 0; c < tags.size(); ++c) {
            for (std::size_t i = 0; i < per_cell; ++i)
                block.connectivity.push_back(
                    number(nodes.at(c * per_cell + (from->gmsh_order.empty() ? i : from->gmsh_order[i])), tags[c]));
            block.bodies.push_back(body);
            block.partitions.push_back(partition);
        }
        auto& known = tags_.at(static_cast<std::size_t>(&block - mesh_.blocks.data()));
        known.insert(known.end(), tags.begin(), tags.end());
    }

    static std::string type_name(int gmsh_type) {
        std::string name;
        int dimension = 0;
        int order = 0;
        int nodes = 0;
        int corners = 0;
        std::vector<double> local;
        gmsh::model::mesh::getElementProperties(gmsh_type, name, dimension, order, nodes, local, corners);
        return fmt::format("{} (type {}, {} nodes)", name, gmsh_type, nodes);
    }

    CellBlock& block_of(std::int32_t type) {
        for (CellBlock& block : mesh_.blocks)
            if (block.type == type) return block;
        mesh_.blocks.push_back({type, {}, {}, {}});
        tags_.emplace_back();
        return mesh_.blocks.back();
    }

    void read_sets() {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups);
        for (const auto& [dimension, group] : groups) {
            if (dimension >= mesh_.dimension) continue;
            std::vector<int> entities;
            gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
            // Gmsh puts borders between partitions into groups with the number of the body's.
            std::erase_if(entities, [at = dimension](int entity) { return parent_of(at, entity).first != at; });
            if (entities.empty()) continue;
            const std::string name = group_name(dimension, group);
            auto& nodes_of_set = mesh_.node_sets[name];
            for (const int entity : entities) {
                std::vector<int> types;
                std::vector<std::vector<std::size_t>> tags;
                std::vector<std::vector<std::size_t>> nodes;
                gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
                for (std::size_t i = 0; i < types.size(); ++i) {
                    const std::size_t per_element = nodes[i].size() / tags[i].size();
                    for (std::size_t e = 0; e < tags[i].size(); ++e) {
                        std::array<std::int64_t, 9> face{};
                        face.fill(-1);
                        for (std::size_t k = 0; k < per_element; ++k) {
                            const std::int64_t node = number(nodes[i][e * per_element + k], tags[i][e]);
                            nodes_of_set.push_back(node);
                            if (k < face.size()) face[k] = node;
                        }
                        if (dimension + 1 == mesh_.dimension && per_element <= face.size())
                            mesh_.face_sets[name].push_back(face);
                    }
                }
            }
            std::sort(nodes_of_set.begin(), nodes_of_set.end());
            nodes_of_set.erase(std::unique(nodes_of_set.begin(), nodes_of_set.end()), nodes_of_set.end());
            if (nodes_of_set.empty()) mesh_.node_sets.erase(name);
        }
    }

    // Notes what was taken, and what was left out: points, edges and faces that belong to no named set.
    void tell() {
        std::int64_t cells = 0;
        std::vector<std::string> kinds, others;
        for (const CellBlock& block : mesh_.blocks) {
            const auto count = static_cast<std::int64_t>(block.bodies.size());
            cells += count;
            kinds.push_back(fmt::format("{} {}", count, shape_of(block.type).name));
        }
        for (int dimension = mesh_.dimension - 1; dimension >= 0; --dimension) {
            const std::int64_t left = unnamed(dimension);
            if (left > 0) others.push_back(counted(left, element_names[dimension]));
        }
        mesh_.notes.insert(
            mesh_.notes.begin(),
            fmt::format("taken: {} ({}) in {}, {}", counted(cells, "cell"), fmt::join(kinds, ", "),
                        mesh_.body_names.size() == 1 ? "1 body" : fmt::format("{} bodies", mesh_.body_names.size()),
                        counted(static_cast<std::int64_t>(mesh_.node_sets.size()), "named set")));
        if (!others.empty())
            mesh_.notes.insert(mesh_.notes.begin() + 1,
                               fmt::format("left out: {} in no physical group", fmt::join(others, ", ")));
    }

    // Returns how many elements of a dimension are in no physical group.
    [[nodiscard]] static std::int64_t unnamed(int dimension) {
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, dimension);
        std::int64_t count = 0;
        for (const auto& [of, entity] : entities) {
            std::vector<int> groups, types;
            gmsh::model::getPhysicalGroupsForEntity(of, entity, groups);
            if (!groups.empty()) continue;
            std::vector<std::vector<std::size_t>> tags;
            std::vector<std::vector<std::size_t>> nodes;
            gmsh::model::mesh::getElements(types, tags, nodes, of, entity);
            for (const auto& of_type : tags) count += static_cast<std::int64_t>(of_type.size());
        }
        return count;
    }

    std::string subject_;
    Place place_;
    MeshData mesh_;
    std::vector<std::vector<std::size_t>> tags_;            // of the elements of each block of cells
    std::unordered_map<std::size_t, std::int64_t> number_;  // by tag
};

}  // namespace

namespace {

// The bytes of a file whose beginning is that of a mesh; another file is not read to its end.
std::string checked_bytes(const std::string& path, const Place& place) {
    std::string bytes;
    try {
        InputFile file(path);
        bytes = file.read(format_bytes);
        require_mesh_format(path, bytes, place);
        require_mesh_size(path, file.size(), place);
        bytes += file.rest();
    } catch (const SceneFailure&) {
        throw;
    } catch (const Failure& e) {
        throw SceneFailure(place, e.what());
    }
    require_sections(path, bytes, place);
    return bytes;
}

}  // namespace

MeshFile read_gmsh(const std::string& path, const Place& place) {
    const std::string bytes = checked_bytes(path, place);
    return with_gmsh(place, path, [&] {
        gmsh::merge(path);
        MeshData mesh = read_gmsh_model(path, place);
        require_all_partitions(path, bytes, mesh, place);
        return MeshFile{std::move(mesh), hash_text(bytes)};
    });
}

std::vector<std::size_t> gmsh_elements(const std::string& path, const Place& place) {
    (void)checked_bytes(path, place);
    return with_gmsh(place, path, [&] {
        gmsh::merge(path);
        return GmshReader(path, place).elements();
    });
}

MeshData read_gmsh_model(const std::string& subject, const Place& place) { return GmshReader(subject, place).read(); }

}  // namespace cli

// SPDX-License-Identifier: BSD-3-Clause
// Meshes that a host may pass by mistake: two blocks of cells on a grid, then nodes moved anywhere, connectivity with
// any content, labels, pairs, obstacles and projected interfaces that make no sense. If the library accepts a mesh, it
// is read, made into a problem, and factored.
#include <algorithm>
#include <cmath>

#include "contract.hpp"
#include "input.hpp"

namespace {

using namespace fuzz;

std::size_t size(std::int64_t count) { return static_cast<std::size_t>(count); }

struct Arrays {
    std::int32_t dimension = 2;
    std::int32_t type = DELAM_QUAD4;
    std::int32_t base = 0;
    std::vector<double> nodes;
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> bodies;
    std::int64_t node_count() const { return static_cast<std::int64_t>(nodes.size()) / dimension; }
    std::int64_t cell_count() const { return static_cast<std::int64_t>(bodies.size()); }
};

constexpr std::int64_t per_cell(std::int32_t type) {
    constexpr std::int64_t nodes[] = {0, 3, 4, 4, 8, 6, 8, 9, 10, 20, 27, 6, 5, 15};
    return type >= 1 && type <= DELAM_WEDGE15 ? nodes[type] : 8;
}

// Arrays of a block of layers as the library makes it, without its interfaces; the input corrupts them.
Arrays block(Host& host, Input& in) {
    static constexpr std::int32_t flat[] = {DELAM_QUAD4, DELAM_TRI3, DELAM_TRI6, DELAM_QUAD8, DELAM_QUAD9};
    static constexpr std::int32_t solid[] = {DELAM_HEX8,  DELAM_TET4,   DELAM_TET10,    DELAM_HEX20,
                                             DELAM_HEX27, DELAM_WEDGE6, DELAM_PYRAMID5, DELAM_WEDGE15};
    Arrays out;
    out.dimension = in.byte() % 3 == 2 ? 3 : 2;
    out.type = out.dimension == 3 ? solid[in.below(8)] : flat[in.below(5)];
    const double lengths[] = {1.0, 1.0};
    const std::int64_t divisions[] = {1 + in.below(3), 1 + in.below(2)};
    const double thickness[] = {0.5, 0.25};
    const std::int64_t across[] = {1, 1};
    delam_mesh* mesh = nullptr;
    expect(delam_mesh_create_layers(host.context, out.dimension, lengths, divisions, 1 + in.below(2), thickness, across,
                                    out.type, &mesh) == DELAM_OK,
           "a block is made", "delam_mesh_create_layers");
    std::int64_t nodes = 0, cells = 0, entries = 0;
    delam_mesh_size(mesh, nullptr, &nodes, &cells, nullptr, nullptr);
    delam_mesh_cells(mesh, nullptr, nullptr, nullptr, 0, nullptr, &entries);
    out.nodes.resize(size(nodes * out.dimension));
    out.connectivity.resize(size(entries));
    out.bodies.resize(size(cells));
    delam_mesh_nodes(mesh, nodes * out.dimension, out.nodes.data());
    delam_mesh_cells(mesh, nullptr, out.bodies.data(), nullptr, entries, out.connectivity.data(), nullptr);
    delam_mesh_destroy(&mesh);
    return out;
}

// The upper block as a coarser or finer copy beside the first, so that the meshes do not match.
void add_unmatched(Arrays& a, Host& host, Input& in) {
    Arrays other = block(host, in);
    if (other.dimension != a.dimension || other.type != a.type) return;
    double top = 0.0;
    for (std::size_t i = size(a.dimension - 1); i < a.nodes.size(); i += size(a.dimension))
        top = std::max(top, a.nodes[i]);
    const std::int64_t first = a.node_count();
    for (std::size_t i = 0; i < other.nodes.size(); ++i)
        a.nodes.push_back(other.nodes[i] + (i % size(a.dimension) == size(a.dimension - 1) ? top : 0.0));
    for (const std::int64_t node : other.connectivity) a.connectivity.push_back(node + first);
    for (const std::int32_t body : other.bodies) a.bodies.push_back(body + 2);
}

void spoil(Arrays& a, Input& in) {
    for (std::int64_t left = in.below(6); left > 0; --left) {
        const std::size_t at = in.raw<std::uint16_t>();
        switch (in.below(8)) {
            case 0:
                a.nodes[at % a.nodes.size()] = in.hostile_real();
                break;
            case 1:
                a.nodes[at % a.nodes.size()] = in.signed_real();
                break;
            case 2: {  // onto another node
                const std::size_t to = at % size(a.node_count()), from = size(in.below(a.node_count()));
                for (std::size_t d = 0; d < size(a.dimension); ++d)
                    a.nodes[to * size(a.dimension) + d] = a.nodes[from * size(a.dimension) + d];
                break;
            }
            case 3:
                a.connectivity[at % a.connectivity.size()] = in.hostile_whole();
                break;
            case 4:
                a.connectivity[at % a.connectivity.size()] = in.below(a.node_count());
                break;
            case 5:
                std::swap(a.connectivity[at % a.connectivity.size()], a.connectivity[(at + 1) % a.connectivity.size()]);
                break;
            case 6:
                a.bodies[at % a.bodies.size()] = static_cast<std::int32_t>(in.index(3));
                break;
            case 7: {
                const double factor = in.real();
                for (double& x : a.nodes) x *= factor;
                break;
            }
        }
    }
    for (std::int64_t control = in.below(3); control > 0; --control)
        for (std::int32_t d = 0; d < a.dimension; ++d) a.nodes.push_back(in.signed_real());
    if (in.seldom())
        for (double& x : a.nodes) x *= in.flag() ? 1e-160 : 1e160;
    a.base = in.base();
    if (a.base == 1)
        for (std::int64_t& node : a.connectivity) node += node < std::numeric_limits<std::int64_t>::max() ? 1 : 0;
}

class Target {
public:
    explicit Target(Input& in) : in_(in) {}
    ~Target() {
        delam_solver_destroy(&solver_);
        delam_problem_destroy(&problem_);
        delam_law_destroy(&law_);
        delam_mesh_destroy(&mesh_);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    void run() {
        Arrays arrays = block(host_, in_);
        if (in_.flag()) add_unmatched(arrays, host_, in_);
        spoil(arrays, in_);
        if (!call("delam_mesh_create", may::argument,
                  delam_mesh_create(host_.context, arrays.dimension, arrays.node_count(), arrays.nodes.data(), &mesh_)))
            return;
        // The cells come in one call or in two.
        const std::int64_t first = in_.seldom() ? in_.below(arrays.cell_count() + 1) : arrays.cell_count();
        const bool conforming = in_.flag();
        add(arrays, 0, first, conforming);
        add(arrays, first, arrays.cell_count(), conforming);
        for (std::int64_t left = in_.below(4); left > 0; --left) add_interface(arrays);
        for (std::int64_t left = in_.below(3); left > 0; --left) ask(arrays);
        (void)print_of(mesh_);
        make_problem(arrays);
    }

private:
    // An error must leave the mesh unchanged.
    bool call(const char* name, Statuses documented, std::int32_t status) {
        host_.settle(name, status, documented);
        host_.begin();
        return status == DELAM_OK;
    }
    template <class Change>
    void change(const char* name, Statuses documented, Change&& make) {
        const std::string before = print_of(mesh_);
        host_.begin();
        const std::int32_t status = make();
        host_.settle(name, status, documented);
        if (status != DELAM_OK) expect(print_of(mesh_) == before, "an error leaves the object as it was", name);
        host_.begin();
    }

    void add(const Arrays& a, std::int64_t from, std::int64_t to, bool conforming) {
        const std::int64_t nodes = per_cell(a.type);
        change("delam_mesh_add_cells", may::argument | may::mesh | may::state, [&] {
            const auto cells = conforming ? delam_mesh_add_conforming_cells : delam_mesh_add_cells;
            return cells(mesh_, a.type, to - from, a.connectivity.data() + from * nodes, a.bodies.data() + from,
                         a.base);
        });
    }

    void add_interface(const Arrays& a) {
        std::int64_t index = -1;
        const std::int64_t which = in_.below(4);
        if (which == 0) {
            const double slack = in_.flag() ? 0.0 : in_.fraction();
            change("delam_mesh_add_all_interfaces", may::argument | may::mesh,
                   [&] { return delam_mesh_add_all_interfaces(mesh_, slack, &index); });
            change("delam_mesh_add_seams", may::argument | may::mesh,
                   [&] { return delam_mesh_add_seams(mesh_, slack, &index); });
            change("delam_mesh_add_self_contact", may::argument | may::mesh,
                   [&] { return delam_mesh_add_self_contact(mesh_, 4.0 * slack, &index); });
        } else if (which == 3) {
            add_obstacle(a);
        } else {
            const std::int32_t lower = in_.small_label(4), upper = in_.small_label(4);
            const double slack = in_.flag() ? 0.0 : in_.fraction();
            const auto join = which == 1      ? delam_mesh_add_interface
                              : lower < upper ? delam_mesh_add_projected_interface
                                              : delam_mesh_add_mortar_interface;
            change("delam_mesh_add_interface", may::argument | may::mesh,
                   [&] { return join(mesh_, lower, upper, slack, &index); });
        }
    }

    void add_obstacle(const Arrays& a) {
        std::int64_t index = -1;
        const std::int64_t count = in_.below(6);
        const std::int32_t base = in_.base();
        // A side of the first body, or any nodes.
        std::vector<std::int64_t> nodes;
        if (in_.flag()) {
            double lower[3] = {-1e9, -1e9, -1e9}, upper[3] = {1e9, 1e9, 1e9};
            upper[a.dimension - 1] = 0.0;
            nodes.resize(size(a.node_count() + 1));
            std::int64_t found = 0;
            delam_mesh_find_nodes(mesh_, static_cast<std::int32_t>(in_.below(3)), lower, upper, a.node_count(),
                                  nodes.data(), &found);
            nodes.resize(size(std::min(found, a.node_count())));
            for (std::int64_t& node : nodes) node += base == 1 ? 1 : 0;
        } else {
            nodes = in_.indices(size(count), a.node_count(), base);
        }
        std::vector<double> normals(nodes.size() * size(a.dimension)), weights = in_.reals(nodes.size());
        for (std::size_t i = 0; i < normals.size(); ++i)
            normals[i] = in_.seldom() ? in_.signed_real() : i % size(a.dimension) == size(a.dimension - 1) ? 1.0 : 0.0;
        const std::int64_t control = in_.index(a.node_count());
        const bool own_weights = in_.flag();
        change("delam_mesh_add_obstacle", may::argument | may::mesh, [&] {
            return delam_mesh_add_obstacle(mesh_, static_cast<std::int64_t>(nodes.size()), nodes.data(), normals.data(),
                                           own_weights ? weights.data() : nullptr, control, base, &index);
        });
    }

    void ask(const Arrays& a) {
        std::vector<double> lower = in_.reals(3), upper = in_.reals(3), direction = in_.reals(3);
        std::vector<std::int64_t> nodes(size(3 * a.node_count()));
        std::vector<double> weights(nodes.size());
        std::int64_t count = 0;
        const std::int32_t body = in_.small_label(3);
        const auto room = static_cast<std::int64_t>(nodes.size());
        if (call("delam_mesh_find_patch", may::argument | may::mesh,
                 delam_mesh_find_patch(mesh_, body, lower.data(), upper.data(), direction.data(), room, nodes.data(),
                                       weights.data(), &count)))
            for (std::int64_t i = 0; i < count; ++i)
                expect(std::isfinite(weights[size(i)]), "weights are finite", "delam_mesh_find_patch");
        call("delam_mesh_find_nodes", may::argument,
             delam_mesh_find_nodes(mesh_, -1, lower.data(), upper.data(), room, nodes.data(), &count));
    }

    // Materials, a law on every interface, and supports at the lowest nodes; then a factorisation and a step.
    void make_problem(const Arrays& a) {
        if (!call("delam_problem_create", may::argument, delam_problem_create(host_.context, mesh_, &problem_))) return;
        call("delam_law_create", may::usual, delam_law_create(host_.context, "piecewise-linear", &law_));
        for (const char* key : {"normal_stiffness", "tangential_stiffness"}) delam_law_set(law_, key, 1e4);
        for (const char* key : {"normal_onset", "tangential_onset"}) delam_law_set(law_, key, 0.01);
        for (const char* key : {"normal_toughness", "tangential_toughness"}) delam_law_set(law_, key, 0.05);
        std::int64_t interfaces = 0, nodes = 0;
        delam_mesh_size(mesh_, nullptr, &nodes, nullptr, nullptr, &interfaces);
        for (std::int64_t i = 0; i < interfaces; ++i) {
            std::int32_t body_a = 0;
            delam_mesh_interface_size(mesh_, i, &body_a, nullptr, nullptr, nullptr, nullptr);
            const bool contact = body_a == -1 || in_.seldom();
            call("an interface's properties", may::argument | may::problem,
                 contact ? delam_problem_set_contact(problem_, i) : delam_problem_set_law(problem_, i, law_));
        }
        call("delam_problem_set_elastic", may::argument, delam_problem_set_elastic(problem_, -1, 1000.0, 0.25));
        static const char* const formulations[] = {"standard", "incompatible", "mean-dilatation"};
        call("delam_problem_set_formulation", may::argument,
             delam_problem_set_formulation(problem_, -1, formulations[in_.below(3)]));
        hold(a, nodes);
        for (std::int64_t i = 0; i < interfaces; ++i) {
            double length = 0.0, spacing = 0.0;
            call("delam_problem_process_zone", may::argument | may::problem,
                 delam_problem_process_zone(problem_, i, &length, &spacing));
        }
        for (const char* key : {"minimisation_limit", "linear_limit"}) delam_problem_set_number(problem_, key, 50.0);
        if (in_.flag()) delam_problem_set_text(problem_, "reduction", "feti");
        call("delam_problem_check", may::mesh | may::problem, delam_problem_check(problem_));
        const std::int32_t status = delam_solver_create(problem_, 0.0, &solver_);
        call("delam_solver_create",
             may::not_converged | may::cancelled | may::limit | may::argument | may::mesh | may::problem |
                 may::numerical,
             status);
        if (solver_ == nullptr) return;
        const std::int32_t step = delam_solver_advance(solver_, 1.0);
        call("delam_solver_advance",
             may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::numerical, step);
        (void)print_of(solver_);
        double value = 0.0;
        for (const char* key : {"rotation_max", "kkt_equilibrium", "crack_length"})
            call(key, may::problem, delam_solver_value(solver_, key, &value));
    }

    void hold(const Arrays& a, std::int64_t node_count) {
        const double times[] = {0.0, 1.0}, values[] = {0.0, 1.0};
        std::int64_t pattern = 0;
        delam_problem_add_pattern(problem_, "load", 2, times, values, &pattern);
        double lower[3] = {-1e300, -1e300, -1e300}, upper[3] = {1e300, 1e300, 1e300};
        std::vector<std::int64_t> nodes(size(node_count));
        for (const bool top : {false, true}) {
            lower[a.dimension - 1] = top ? 0.75 : -1e300;
            upper[a.dimension - 1] = top ? 1e300 : 0.0;
            std::int64_t count = 0;
            delam_mesh_find_nodes(mesh_, -1, lower, upper, node_count, nodes.data(), &count);
            const std::vector<double> coefficients(size(count), top ? 0.01 : 0.0);
            for (std::int32_t d = 0; d < a.dimension; ++d) {
                double direction[3] = {};
                direction[d] = 1.0;
                if (top && d + 1 < a.dimension) continue;
                host_.begin();
                call("delam_problem_prescribe_nodes", may::argument | may::problem,
                     delam_problem_prescribe_nodes(problem_, count, nodes.data(), direction, 1, &pattern,
                                                   coefficients.data(), 0));
            }
        }
        if (in_.seldom()) {
            const std::vector<double> periods = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
            const std::int64_t control[] = {node_count - 1, node_count - 2};
            call("delam_problem_add_periodic", may::argument | may::mesh,
                 delam_problem_add_periodic(problem_, 1, periods.data(), control, in_.fraction(), 0));
        }
    }

    Input& in_;
    Host host_;
    delam_mesh* mesh_ = nullptr;
    delam_law* law_ = nullptr;
    delam_problem* problem_ = nullptr;
    delam_solver* solver_ = nullptr;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input in(data, size);
    Target(in).run();
    return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
//
// libdelam for C++17: move-only owners over delam.h, in a header alone.
//
//   errors     statuses < 0 throw delam::Error with the status and the context's message. Outcomes (> 0) of a load
//   step
//              are returned as Outcome; elsewhere they throw too.
//   arrays     View<T>: a pointer with a size, a std::vector, a std::array or a braced list; rows one after another
//   as
//              in delam.h. Sizes are checked where the library cannot. Results come as std::vector, or go into the
//              caller's buffer (Solver::field).
//   indices    from 0 as in C.
//   callbacks  std::function. What they throw stops the call that runs them, and comes out of it.
//   lifetime   objects may end in any order: each keeps the context, problems and solvers keep the callbacks of their
//              laws. An object that was moved from may only be assigned to or end.
//   the rest   get() is the C handle, for whatever is not here.
#ifndef DELAM_DELAM_HPP
#define DELAM_DELAM_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "delam/delam.h"

namespace delam {

class Error : public std::runtime_error {
public:
    Error(std::int32_t status, const std::string& message) : std::runtime_error(message), status_(status) {}
    std::int32_t status() const noexcept { return status_; }
    const char* name() const noexcept { return delam_status_name(status_); }

private:
    std::int32_t status_;
};

enum class Outcome : std::int32_t {
    done = DELAM_OK,
    not_converged = DELAM_NOT_CONVERGED,
    cancelled = DELAM_CANCELLED,
    limit = DELAM_LIMIT
};

// Read-only contiguous values that live elsewhere, as an argument.
template <class T>
class View {
public:
    constexpr View() noexcept = default;
    constexpr View(const T* data, std::size_t size) noexcept : data_(data), size_(size) {}
    View(std::initializer_list<T> list) noexcept : size_(list.size()) {
        data_ = list.begin();  // lives as long as the call's full expression
    }
    template <
        class Container,
        class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<const Container&>().data()), const T*>>>
    View(const Container& container) noexcept : data_(container.data()), size_(container.size()) {}
    const T* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    std::int64_t count() const noexcept { return static_cast<std::int64_t>(size_); }

private:
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

// A zero-terminated text that lives elsewhere, as an argument.
class Text {
public:
    Text(const char* text) noexcept : text_(text) {}
    Text(const std::string& text) noexcept : text_(text.c_str()) {}
    const char* get() const noexcept { return text_; }

private:
    const char* text_;
};

using LogCallback = std::function<void(std::int32_t level, std::string_view text)>;
// false: stop, the call ends with DELAM_CANCELLED.
using ProgressCallback = std::function<bool(std::string_view stage, std::int64_t done, std::int64_t total)>;

struct AdhesionValue {
    double adhesion, slope;
};
struct DissipationValue {
    double dissipated, slope, mixity_slope;
};
// The two functions of a host's law (delam_law_create_host). To fail, throw.
using AdhesionCallback = std::function<AdhesionValue(double mixity, double driving)>;
using DissipationCallback = std::function<DissipationValue(double mixity, double adhesion)>;

namespace detail {

template <class T, void (*destroy)(T**)>
struct Destroy {
    void operator()(T* handle) const noexcept { destroy(&handle); }
};
template <class T, void (*destroy)(T**)>
using Handle = std::unique_ptr<T, Destroy<T, destroy>>;

// What a callback threw, until the call that runs it is back: callbacks run on the calling thread.
inline thread_local std::exception_ptr thrown;

// What all objects of a context share.
struct Shared {
    Handle<delam_context, delam_context_destroy> handle;
    LogCallback log;
    ProgressCallback progress;

    // What was thrown has precedence over the status that it led to.
    std::int32_t settle(std::int32_t status) const {
        if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
        if (status < 0) fail(status);
        return status;
    }
    void check(std::int32_t status) const {
        if (settle(status) != DELAM_OK) fail(status);
    }
    [[noreturn]] void fail(std::int32_t status) const { throw Error(status, delam_context_message(handle.get())); }
};

struct HostLaw {
    AdhesionCallback adhesion;
    DissipationCallback dissipation;
};

inline void require(bool holds, const char* message) {
    if (!holds) throw Error(DELAM_ERROR_ARGUMENT, message);
}

inline std::size_t length(std::int64_t count) { return static_cast<std::size_t>(count); }

inline std::string copy(const char* text) { return text == nullptr ? std::string() : std::string(text); }

inline std::size_t nodes_of(std::int32_t cell_type) {
    constexpr std::array<std::size_t, 10> nodes{0, 3, 4, 4, 8, 6, 8, 9, 10, 20};
    return cell_type >= 1 && cell_type <= 9 ? nodes[static_cast<std::size_t>(cell_type)] : 0;
}

}  // namespace detail

inline std::string version() { return delam_version(); }
inline std::string commit() { return delam_commit(); }

// An option of problems, or a parameter of a law.
struct Description {
    std::string key, type, unit, initial, range, meaning;
};

namespace detail {

template <class Ask>
std::vector<Description> describe(std::int64_t count, Ask&& ask) {
    std::vector<Description> all;
    for (std::int64_t i = 0; i < count; ++i) {
        std::array<const char*, 6> texts{};
        const auto status = ask(i, texts);
        if (status != DELAM_OK) throw Error(status, "a description that was counted is not there");
        all.push_back(
            {copy(texts[0]), copy(texts[1]), copy(texts[2]), copy(texts[3]), copy(texts[4]), copy(texts[5])});
    }
    return all;
}

}  // namespace detail

inline std::vector<Description> options() {
    return detail::describe(delam_option_count(), [](std::int64_t i, std::array<const char*, 6>& t) {
        return delam_option_info(i, &t[0], &t[1], &t[2], &t[3], &t[4], &t[5]);
    });
}
// All criteria taken together; none for an unknown kind.
inline std::vector<Description> law_parameters(Text kind) {
    return detail::describe(
        delam_law_parameter_count(kind.get()), [kind](std::int64_t i, std::array<const char*, 6>& t) {
            return delam_law_parameter_info(kind.get(), i, &t[0], &t[1], &t[2], &t[3], &t[4], &t[5]);
        });
}

class Context {
public:
    Context() : shared_(std::make_shared<detail::Shared>()) {
        delam_context* made = nullptr;
        const std::int32_t status = delam_context_create(&made);
        shared_->handle.reset(made);
        if (status != DELAM_OK) throw Error(status, "no context could be made");
    }
    Context(Context&&) noexcept = default;
    Context& operator=(Context&&) noexcept = default;

    delam_context* get() const noexcept { return shared_->handle.get(); }
    std::string message() const { return delam_context_message(get()); }
    // An empty function switches it off.
    void on_log(LogCallback callback) {
        const bool wanted = static_cast<bool>(callback);
        shared_->log = std::move(callback);
        shared_->check(delam_context_set_log(get(), wanted ? &Context::say : nullptr, shared_.get()));
    }
    void on_progress(ProgressCallback callback) {
        const bool wanted = static_cast<bool>(callback);
        shared_->progress = std::move(callback);
        shared_->check(delam_context_set_progress(get(), wanted ? &Context::tell : nullptr, shared_.get()));
    }
    // From any thread.
    void cancel() const noexcept { delam_context_cancel(get()); }

    const std::shared_ptr<detail::Shared>& shared() const noexcept { return shared_; }

private:
    static void say(std::int32_t level, const char* text, void* user) {
        auto& shared = *static_cast<detail::Shared*>(user);
        if (detail::thrown) return;
        try {
            shared.log(level, text);
        } catch (...) {
            detail::thrown = std::current_exception();
        }
    }
    static std::int32_t tell(const char* stage, std::int64_t done, std::int64_t total, void* user) {
        auto& shared = *static_cast<detail::Shared*>(user);
        if (detail::thrown) return 1;
        try {
            return shared.progress(stage, done, total) ? 0 : 1;
        } catch (...) {
            detail::thrown = std::current_exception();
            return 1;
        }
    }

    std::shared_ptr<detail::Shared> shared_;
};

struct MeshSize {
    std::int32_t dimension;
    std::int64_t nodes, cells, bodies, interfaces;
};
struct Ties {
    std::vector<std::int64_t> nodes, starts, of;
    std::vector<double> weights;
};
struct Cells {
    std::vector<std::int32_t> types, bodies;
    std::vector<std::int64_t> offsets, connectivity;
};
struct InterfaceSize {
    std::int32_t body_a, body_b;
    std::int64_t pairs, faces;
    std::int32_t nodes_per_face;
};
struct Pairs {
    std::vector<std::int64_t> nodes_a, nodes_b;
    std::vector<double> weights, frames;
};
struct Patch {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;
};

class Mesh {
public:
    Mesh(const Context& context, std::int32_t dimension, View<double> nodes) : shared_(context.shared()) {
        detail::require(dimension > 0 && nodes.size() % detail::length(dimension) == 0,
                        "nodes: not a whole number of points");
        delam_mesh* made = nullptr;
        const auto status =
            delam_mesh_create(context.get(), dimension, nodes.count() / dimension, nodes.data(), &made);
        handle_.reset(made);
        shared_->check(status);
    }
    static Mesh layers(const Context& context, View<double> lengths, View<std::int64_t> divisions,
                       View<double> thickness, View<std::int64_t> layer_divisions, std::int32_t cell_type) {
        detail::require(lengths.size() == divisions.size() && thickness.size() == layer_divisions.size(),
                        "lengths and divisions, thickness and layer_divisions: unequal sizes");
        Mesh mesh(context.shared());
        delam_mesh* made = nullptr;
        const auto status = delam_mesh_create_layers(context.get(), static_cast<std::int32_t>(lengths.size()) + 1,
                                                     lengths.data(), divisions.data(), thickness.count(),
                                                     thickness.data(), layer_divisions.data(), cell_type, &made);
        mesh.handle_.reset(made);
        mesh.shared_->check(status);
        return mesh;
    }

    delam_mesh* get() const noexcept { return handle_.get(); }

    // bodies: a label for each cell; none: all 0.
    void add_cells(std::int32_t cell_type, View<std::int64_t> connectivity, View<std::int32_t> bodies = {}) {
        const auto count = cells_in(cell_type, connectivity, bodies);
        shared_->check(delam_mesh_add_cells(get(), cell_type, count, connectivity.data(),
                                            bodies.size() == 0 ? nullptr : bodies.data(), 0));
    }
    void add_conforming_cells(std::int32_t cell_type, View<std::int64_t> connectivity,
                              View<std::int32_t> bodies = {}) {
        const auto count = cells_in(cell_type, connectivity, bodies);
        shared_->check(delam_mesh_add_conforming_cells(get(), cell_type, count, connectivity.data(),
                                                       bodies.size() == 0 ? nullptr : bodies.data(), 0));
    }
    std::int64_t add_interface(std::int32_t body_a, std::int32_t body_b, double tolerance = 0.0) {
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_interface(get(), body_a, body_b, tolerance, &made));
        return made;
    }
    std::int64_t add_all_interfaces(double tolerance = 0.0) {
        std::int64_t count = 0;
        shared_->check(delam_mesh_add_all_interfaces(get(), tolerance, &count));
        return count;
    }
    std::int64_t add_projected_interface(std::int32_t body_a, std::int32_t body_b, double gap = 0.0) {
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_projected_interface(get(), body_a, body_b, gap, &made));
        return made;
    }
    // weights: none for the nodal ones.
    std::int64_t add_obstacle(View<std::int64_t> nodes, View<double> normals, std::int64_t control_node,
                              View<double> weights = {}) {
        detail::require(normals.size() == nodes.size() * detail::length(dimension()),
                        "normals: not one for each node");
        detail::require(weights.size() == 0 || weights.size() == nodes.size(), "weights: not one for each node");
        std::int64_t made = -1;
        shared_->check(delam_mesh_add_obstacle(get(), nodes.count(), nodes.data(), normals.data(),
                                               weights.size() == 0 ? nullptr : weights.data(), control_node, 0,
                                               &made));
        return made;
    }

    MeshSize size() const {
        MeshSize size{};
        shared_->check(
            delam_mesh_size(get(), &size.dimension, &size.nodes, &size.cells, &size.bodies, &size.interfaces));
        return size;
    }
    std::int32_t dimension() const { return size().dimension; }
    std::vector<double> nodes() const {
        const MeshSize now = size();
        std::vector<double> nodes(detail::length(now.nodes * now.dimension));
        shared_->check(delam_mesh_nodes(get(), now.nodes * now.dimension, nodes.data()));
        return nodes;
    }
    std::vector<std::int32_t> node_bodies() const {
        std::vector<std::int32_t> bodies(detail::length(size().nodes));
        shared_->check(delam_mesh_node_bodies(get(), static_cast<std::int64_t>(bodies.size()), bodies.data()));
        return bodies;
    }
    std::vector<std::int64_t> node_origins() const {
        std::vector<std::int64_t> origins(detail::length(size().nodes));
        shared_->check(delam_mesh_node_origins(get(), static_cast<std::int64_t>(origins.size()), origins.data()));
        return origins;
    }
    Ties node_ties() const {
        std::int64_t count = 0;
        std::int64_t entries = 0;
        shared_->check(delam_mesh_node_ties(get(), &count, &entries, nullptr, nullptr, nullptr, nullptr));
        Ties ties;
        ties.nodes.resize(detail::length(count));
        ties.starts.resize(detail::length(count) + 1);
        ties.of.resize(detail::length(entries));
        ties.weights.resize(detail::length(entries));
        shared_->check(delam_mesh_node_ties(get(), nullptr, nullptr, ties.nodes.data(), ties.starts.data(),
                                            ties.of.data(), ties.weights.data()));
        return ties;
    }
    Cells cells() const {
        const auto count = detail::length(size().cells);
        std::int64_t needed = 0;
        shared_->check(delam_mesh_cells(get(), nullptr, nullptr, nullptr, 0, nullptr, &needed));
        Cells cells;
        cells.types.resize(count);
        cells.bodies.resize(count);
        cells.offsets.resize(count + 1);
        cells.connectivity.resize(detail::length(needed));
        shared_->check(delam_mesh_cells(get(), cells.types.data(), cells.bodies.data(), cells.offsets.data(), needed,
                                        cells.connectivity.data(), nullptr));
        return cells;
    }
    InterfaceSize interface_size(std::int64_t interface_index) const {
        InterfaceSize size{};
        shared_->check(delam_mesh_interface_size(get(), interface_index, &size.body_a, &size.body_b, &size.pairs,
                                                 &size.faces, &size.nodes_per_face));
        return size;
    }
    Pairs interface_pairs(std::int64_t interface_index) const {
        const auto count = detail::length(interface_size(interface_index).pairs);
        const auto space = detail::length(dimension());
        Pairs pairs;
        pairs.nodes_a.resize(count);
        pairs.nodes_b.resize(count);
        pairs.weights.resize(count);
        pairs.frames.resize(count * space * space);
        shared_->check(delam_mesh_interface_pairs(get(), interface_index, pairs.nodes_a.data(), pairs.nodes_b.data(),
                                                  pairs.weights.data(), pairs.frames.data()));
        return pairs;
    }
    // [faces][nodes per face], as pair indices.
    std::vector<std::int64_t> interface_faces(std::int64_t interface_index) const {
        const InterfaceSize size = interface_size(interface_index);
        std::vector<std::int64_t> faces(detail::length(size.faces * size.nodes_per_face));
        shared_->check(delam_mesh_interface_faces(get(), interface_index, faces.data()));
        return faces;
    }
    // body -1: of all.
    std::vector<std::int64_t> find_nodes(std::int32_t body, View<double> lower, View<double> upper) const {
        const auto space = detail::length(dimension());
        detail::require(lower.size() == space && upper.size() == space,
                        "lower and upper must have the mesh's dimension");
        std::int64_t count = 0;
        shared_->check(delam_mesh_find_nodes(get(), body, lower.data(), upper.data(), 0, nullptr, &count));
        std::vector<std::int64_t> nodes(detail::length(count));
        shared_->check(delam_mesh_find_nodes(get(), body, lower.data(), upper.data(), count, nodes.data(), &count));
        return nodes;
    }
    Patch find_patch(std::int32_t body, View<double> lower, View<double> upper, View<double> direction) const {
        const auto space = detail::length(dimension());
        detail::require(lower.size() == space && upper.size() == space && direction.size() == space,
                        "lower, upper and direction must have the mesh's dimension");
        std::int64_t count = 0;
        shared_->check(delam_mesh_find_patch(get(), body, lower.data(), upper.data(), direction.data(), 0, nullptr,
                                             nullptr, &count));
        Patch patch;
        patch.nodes.resize(detail::length(count));
        patch.weights.resize(detail::length(count));
        shared_->check(delam_mesh_find_patch(get(), body, lower.data(), upper.data(), direction.data(), count,
                                             patch.nodes.data(), patch.weights.data(), &count));
        return patch;
    }

private:
    explicit Mesh(std::shared_ptr<detail::Shared> shared) : shared_(std::move(shared)) {}
    // Unknown cell types are left to the library, which names them.
    static std::int64_t cells_in(std::int32_t cell_type, View<std::int64_t> connectivity, View<std::int32_t> bodies) {
        const std::size_t nodes = detail::nodes_of(cell_type);
        if (nodes == 0) return 0;
        detail::require(connectivity.size() % nodes == 0, "connectivity: not a whole number of cells");
        const std::size_t count = connectivity.size() / nodes;
        detail::require(bodies.size() == 0 || bodies.size() == count, "bodies: not one for each cell");
        return static_cast<std::int64_t>(count);
    }

    std::shared_ptr<detail::Shared> shared_;
    detail::Handle<delam_mesh, delam_mesh_destroy> handle_;
};

struct Toughness {
    std::vector<double> onset, toughness;
};
struct Response {
    std::vector<double> adhesion, traction;
};

class Law {
public:
    Law(const Context& context, Text kind) : shared_(context.shared()) {
        delam_law* made = nullptr;
        const auto status = delam_law_create(context.get(), kind.get(), &made);
        handle_.reset(made);
        shared_->check(status);
    }
    // By the host's functions; name stands for them in messages and in the hash of a problem.
    Law(const Context& context, Text name, AdhesionCallback adhesion, DissipationCallback dissipation)
        : shared_(context.shared()),
          host_(std::make_shared<detail::HostLaw>(detail::HostLaw{std::move(adhesion), std::move(dissipation)})) {
        detail::require(host_->adhesion && host_->dissipation, "a law needs both functions");
        delam_law* made = nullptr;
        const auto status = delam_law_create_host(context.get(), name.get(), &Law::adhesion_of, &Law::dissipation_of,
                                                  host_.get(), &made);
        handle_.reset(made);
        shared_->check(status);
    }

    delam_law* get() const noexcept { return handle_.get(); }
    void set(Text key, double value) { shared_->check(delam_law_set(get(), key.get(), value)); }
    void set(Text key, Text value) { shared_->check(delam_law_set_text(get(), key.get(), value.get())); }
    void set_table(View<double> xi, View<double> s) {
        detail::require(xi.size() == s.size(), "xi and s: unequal sizes");
        shared_->check(delam_law_set_table(get(), xi.count(), xi.data(), s.data()));
    }
    void check() const { shared_->check(delam_law_check(get())); }
    Toughness toughness(View<double> mixity) const {
        Toughness values;
        values.onset.resize(mixity.size());
        values.toughness.resize(mixity.size());
        shared_->check(
            delam_law_toughness(get(), mixity.count(), mixity.data(), values.onset.data(), values.toughness.data()));
        return values;
    }
    // jump: [count][dimension]
    Response respond(std::int32_t dimension, View<double> jump, View<double> mixity,
                     View<double> adhesion_old) const {
        detail::require(dimension > 0 && jump.size() == mixity.size() * detail::length(dimension) &&
                            adhesion_old.size() == mixity.size(),
                        "jump, mixity and adhesion_old: unequal sizes");
        Response response;
        response.adhesion.resize(mixity.size());
        response.traction.resize(jump.size());
        shared_->check(delam_law_respond(get(), dimension, mixity.count(), jump.data(), mixity.data(),
                                         adhesion_old.data(), response.adhesion.data(), response.traction.data()));
        return response;
    }

    const std::shared_ptr<detail::HostLaw>& host() const noexcept { return host_; }

private:
    template <class Call>
    static std::int32_t run(Call&& call) noexcept {
        if (detail::thrown) return 1;
        try {
            call();
            return 0;
        } catch (...) {
            detail::thrown = std::current_exception();
            return 1;
        }
    }
    static std::int32_t adhesion_of(double mixity, double driving, double* adhesion, double* slope, void* user) {
        const auto& law = *static_cast<const detail::HostLaw*>(user);
        return run([&] {
            const AdhesionValue value = law.adhesion(mixity, driving);
            *adhesion = value.adhesion;
            *slope = value.slope;
        });
    }
    static std::int32_t dissipation_of(double mixity, double adhesion, double* dissipated, double* slope,
                                       double* mixity_slope, void* user) {
        const auto& law = *static_cast<const detail::HostLaw*>(user);
        return run([&] {
            const DissipationValue value = law.dissipation(mixity, adhesion);
            *dissipated = value.dissipated;
            *slope = value.slope;
            *mixity_slope = value.mixity_slope;
        });
    }

    std::shared_ptr<detail::Shared> shared_;
    std::shared_ptr<detail::HostLaw> host_;
    detail::Handle<delam_law, delam_law_destroy> handle_;
};

struct Matrix {
    std::vector<std::int64_t> row_starts, columns;
    std::vector<double> values;
};
struct Constraints {
    Matrix matrix;
    std::vector<double> coefficients;  // [rows][patterns]
};
struct ProcessZone {
    double length, spacing;
};
struct Dofs {
    std::int64_t primal, dual;
};

class Problem {
public:
    Problem(const Context& context, const Mesh& mesh) : shared_(context.shared()), dimension_(mesh.dimension()) {
        delam_problem* made = nullptr;
        const auto status = delam_problem_create(context.get(), mesh.get(), &made);
        handle_.reset(made);
        shared_->check(status);
    }

    delam_problem* get() const noexcept { return handle_.get(); }

    void set_plane(Text assumption) { shared_->check(delam_problem_set_plane(get(), assumption.get())); }
    // body -1: of all, here and below.
    void set_elastic(std::int32_t body, double young, double poisson) {
        shared_->check(delam_problem_set_elastic(get(), body, young, poisson));
    }
    // constants: E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
    void set_orthotropic(std::int32_t body, const std::array<double, 9>& constants) {
        shared_->check(delam_problem_set_orthotropic(get(), body, constants.data()));
    }
    // axes: [cells][2][3]
    void set_orientation(std::int32_t body, View<std::int64_t> cells, View<double> axes) {
        detail::require(axes.size() == 6 * cells.size(), "axes: not [cells][2][3]");
        shared_->check(delam_problem_set_orientation(get(), body, cells.count(), cells.data(), axes.data(), 0));
    }
    void set_orientation(std::int32_t body, const std::array<double, 6>& axes) {
        shared_->check(delam_problem_set_orientation(get(), body, 1, nullptr, axes.data(), 0));
    }
    void set_formulation(std::int32_t body, Text formulation) {
        shared_->check(delam_problem_set_formulation(get(), body, formulation.get()));
    }
    void set_law(std::int64_t interface_index, const Law& law) {
        if (law.host()) laws_.push_back(law.host());
        shared_->check(delam_problem_set_law(get(), interface_index, law.get()));
    }
    void set_bonded(std::int64_t interface_index) {
        shared_->check(delam_problem_set_bonded(get(), interface_index));
    }
    void set_contact(std::int64_t interface_index) {
        shared_->check(delam_problem_set_contact(get(), interface_index));
    }
    void set_adhesion(std::int64_t interface_index, View<std::int64_t> pairs, View<double> adhesion) {
        detail::require(pairs.size() == adhesion.size(), "pairs and adhesion: unequal sizes");
        shared_->check(
            delam_problem_set_adhesion(get(), interface_index, pairs.count(), pairs.data(), adhesion.data(), 0));
    }

    std::int64_t add_pattern(Text name, View<double> times, View<double> values) {
        detail::require(times.size() == values.size(), "times and values: unequal sizes");
        std::int64_t made = -1;
        shared_->check(
            delam_problem_add_pattern(get(), name.get(), times.count(), times.data(), values.data(), &made));
        return made;
    }
    // coefficients: [nodes][patterns]; without patterns: held at zero.
    void prescribe_nodes(View<std::int64_t> nodes, View<double> direction, View<std::int64_t> patterns = {},
                         View<double> coefficients = {}) {
        in_space(direction.size(), 1);
        detail::require(coefficients.size() == nodes.size() * patterns.size(), "coefficients: not [nodes][patterns]");
        shared_->check(delam_problem_prescribe_nodes(get(), nodes.count(), nodes.data(), direction.data(),
                                                     patterns.count(), patterns.data(), coefficients.data(), 0));
    }
    void prescribe_mean(View<std::int64_t> nodes, View<double> weights, View<double> direction,
                        View<std::int64_t> patterns = {}, View<double> coefficients = {}) {
        in_space(direction.size(), 1);
        detail::require(weights.size() == nodes.size() && coefficients.size() == patterns.size(),
                        "nodes and weights, patterns and coefficients: unequal sizes");
        shared_->check(delam_problem_prescribe_mean(get(), nodes.count(), nodes.data(), weights.data(),
                                                    direction.data(), patterns.count(), patterns.data(),
                                                    coefficients.data(), 0));
    }
    // coefficients: [nodes][dimension]
    void add_equation(View<std::int64_t> nodes, View<double> coefficients, View<std::int64_t> patterns = {},
                      View<double> prescribed = {}) {
        in_space(coefficients.size(), nodes.size());
        detail::require(prescribed.size() == patterns.size(), "patterns and prescribed: unequal sizes");
        shared_->check(delam_problem_add_equation(get(), nodes.count(), nodes.data(), coefficients.data(),
                                                  patterns.count(), patterns.data(), prescribed.data(), 0));
    }
    // periods: [control nodes][dimension]
    void add_periodic(View<double> periods, View<std::int64_t> control_nodes, double tolerance = 0.0) {
        in_space(periods.size(), control_nodes.size());
        shared_->check(delam_problem_add_periodic(get(), control_nodes.count(), periods.data(), control_nodes.data(),
                                                  tolerance, 0));
    }
    // forces: [nodes][dimension]
    void add_forces(std::int64_t pattern, View<std::int64_t> nodes, View<double> forces) {
        in_space(forces.size(), nodes.size());
        shared_->check(delam_problem_add_forces(get(), pattern, nodes.count(), nodes.data(), forces.data(), 0));
    }
    void add_eigenstrain(std::int64_t pattern, std::int32_t body, const std::array<double, 6>& strain) {
        shared_->check(delam_problem_add_eigenstrain(get(), pattern, body, strain.data()));
    }

    void set(Text key, double value) { shared_->check(delam_problem_set_number(get(), key.get(), value)); }
    void set(Text key, Text value) { shared_->check(delam_problem_set_text(get(), key.get(), value.get())); }
    void check() { shared_->check(delam_problem_check(get())); }
    std::string hash() const {
        std::array<char, 17> digits{};
        shared_->check(delam_problem_hash(get(), digits.data()));
        return digits.data();
    }
    Dofs dofs() const {
        Dofs dofs{};
        shared_->check(delam_problem_dofs(get(), &dofs.primal, &dofs.dual));
        return dofs;
    }
    ProcessZone process_zone(std::int64_t interface_index) const {
        ProcessZone zone{};
        shared_->check(delam_problem_process_zone(get(), interface_index, &zone.length, &zone.spacing));
        return zone;
    }
    Matrix body_matrix(std::int32_t body) const {
        std::int64_t rows = 0;
        std::int64_t entries = 0;
        shared_->check(delam_problem_body_matrix(get(), body, &rows, &entries, nullptr, nullptr, nullptr));
        Matrix matrix = sized(rows, entries);
        shared_->check(delam_problem_body_matrix(get(), body, &rows, &entries, matrix.row_starts.data(),
                                                 matrix.columns.data(), matrix.values.data()));
        return matrix;
    }
    Constraints constraints() const {
        std::int64_t rows = 0;
        std::int64_t entries = 0;
        std::int64_t patterns = 0;
        shared_->check(
            delam_problem_constraints(get(), &rows, &entries, &patterns, nullptr, nullptr, nullptr, nullptr));
        Constraints all{sized(rows, entries), std::vector<double>(detail::length(rows * patterns))};
        shared_->check(delam_problem_constraints(get(), &rows, &entries, &patterns, all.matrix.row_starts.data(),
                                                 all.matrix.columns.data(), all.matrix.values.data(),
                                                 all.coefficients.data()));
        return all;
    }
    std::vector<double> forces(std::int64_t pattern) const {
        std::vector<double> forces(detail::length(dofs().primal));
        shared_->check(delam_problem_forces(get(), pattern, static_cast<std::int64_t>(forces.size()), forces.data()));
        return forces;
    }
    std::vector<double> eigenstrain_energy() const {
        const std::int64_t count = pattern_count();
        std::vector<double> matrix(detail::length(count * count));
        shared_->check(delam_problem_eigenstrain_energy(get(), count * count, matrix.data()));
        return matrix;
    }
    std::vector<double> factors(double time) const {
        std::vector<double> factors(detail::length(pattern_count()));
        shared_->check(delam_problem_factors(get(), time, static_cast<std::int64_t>(factors.size()), factors.data()));
        return factors;
    }
    std::int64_t pattern_count() const {
        std::int64_t count = 0;
        shared_->check(delam_problem_pattern_count(get(), &count));
        return count;
    }
    std::string pattern_name(std::int64_t pattern) const {
        return detail::copy(delam_problem_pattern_name(get(), pattern));
    }

    const std::shared_ptr<detail::Shared>& shared() const noexcept { return shared_; }
    const std::vector<std::shared_ptr<detail::HostLaw>>& host_laws() const noexcept { return laws_; }

private:
    void in_space(std::size_t components, std::size_t vectors) const {
        detail::require(components == vectors * detail::length(dimension_),
                        "a vector has not the problem's dimension");
    }
    static Matrix sized(std::int64_t rows, std::int64_t entries) {
        Matrix matrix;
        matrix.row_starts.resize(detail::length(rows) + 1);
        matrix.columns.resize(detail::length(entries));
        matrix.values.resize(detail::length(entries));
        return matrix;
    }

    std::shared_ptr<detail::Shared> shared_;
    std::vector<std::shared_ptr<detail::HostLaw>> laws_;
    std::int32_t dimension_;
    detail::Handle<delam_problem, delam_problem_destroy> handle_;
};

struct Field {
    std::int64_t rows, columns;
    std::vector<double> values;  // [rows][columns]
};
struct Average {
    double volume;
    std::array<double, 6> strain, stress;
};
struct Fronts {
    std::vector<std::int64_t> starts;
    std::vector<std::int32_t> closed;
    std::vector<double> places, directions, lengths, rates, zone_lengths, zone_pairs;
};
struct PlanItem {
    std::string subject, decision, reason;
    double cost, saving;
    std::string unit;
};
struct Jump {
    std::int64_t step;
    double before, time, stored, dissipated, released, debonded;
    std::int64_t interface_index, first_pair, last_pair;
};

class Solver {
public:
    Solver(const Problem& problem, double time) : shared_(problem.shared()), laws_(problem.host_laws()) {
        delam_solver* made = nullptr;
        const auto status = delam_solver_create(problem.get(), time, &made);
        handle_.reset(made);
        initial_ = static_cast<Outcome>(shared_->settle(status));
        if (!handle_) shared_->fail(status);
    }

    delam_solver* get() const noexcept { return handle_.get(); }
    // Of the displacement at the initial time: done or not_converged.
    Outcome initial() const noexcept { return initial_; }

    [[nodiscard]] Outcome advance(double time) {
        return static_cast<Outcome>(shared_->settle(delam_solver_advance(get(), time)));
    }
    // adhesion: of all pairs; none: the committed one.
    [[nodiscard]] Outcome equilibrate(double time, View<double> adhesion = {}) {
        detail::require(adhesion.size() == 0 || adhesion.count() == shape("adhesion", -1).rows,
                        "adhesion: not one for each pair of all interfaces");
        const double* values = adhesion.size() == 0 ? nullptr : adhesion.data();
        return static_cast<Outcome>(shared_->settle(delam_solver_equilibrate(get(), time, values)));
    }
    void commit() { shared_->check(delam_solver_commit(get())); }
    void rollback() { shared_->check(delam_solver_rollback(get())); }

    double value(Text key) {
        double value = 0.0;
        shared_->check(delam_solver_value(get(), key.get(), &value));
        return value;
    }
    std::vector<std::string> value_names() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_value_count(get(), &count));
        std::vector<std::string> names;
        for (std::int64_t i = 0; i < count; ++i) names.push_back(detail::copy(delam_solver_value_name(get(), i)));
        return names;
    }
    // part: an interface, for the fields of pairs; -1 otherwise, and for all interfaces.
    Field field(Text key, std::int64_t part = -1) {
        Field field = shape(key, part);
        field.values.resize(detail::length(field.rows * field.columns));
        shared_->check(delam_solver_field(get(), key.get(), part, field.rows * field.columns, field.values.data()));
        return field;
    }
    // Into the caller's buffer.
    void field(Text key, std::int64_t part, double* values, std::size_t size) {
        shared_->check(delam_solver_field(get(), key.get(), part, static_cast<std::int64_t>(size), values));
    }
    // Rows and columns alone.
    Field shape(Text key, std::int64_t part = -1) const {
        Field field{};
        shared_->check(delam_solver_field_shape(get(), key.get(), part, &field.rows, &field.columns));
        return field;
    }
    Average average(std::int32_t body = -1) const {
        Average average{};
        shared_->check(
            delam_solver_average(get(), body, &average.volume, average.strain.data(), average.stress.data()));
        return average;
    }
    Fronts fronts(std::int64_t interface_index) const {
        std::int64_t count = 0;
        std::int64_t points = 0;
        shared_->check(delam_solver_front_count(get(), interface_index, &count, &points));
        const auto n = detail::length(points);
        const auto space = detail::length(shape("jump", interface_index).columns);
        Fronts fronts;
        fronts.starts.resize(detail::length(count) + 1);
        fronts.closed.resize(detail::length(count));
        fronts.places.resize(n * space);
        fronts.directions.resize(n * space);
        fronts.lengths.resize(n);
        fronts.rates.resize(3 * n);
        fronts.zone_lengths.resize(n);
        fronts.zone_pairs.resize(n);
        shared_->check(delam_solver_front(get(), interface_index, count, points, fronts.starts.data(),
                                          fronts.closed.data(), fronts.places.data(), fronts.directions.data(),
                                          fronts.lengths.data(), fronts.rates.data(), fronts.zone_lengths.data(),
                                          fronts.zone_pairs.data()));
        return fronts;
    }
    // [patterns][patterns]; patterns: how many the problem has.
    std::vector<double> tangent(std::int64_t patterns) {
        std::vector<double> matrix(detail::length(patterns * patterns));
        shared_->check(delam_solver_tangent(get(), patterns * patterns, matrix.data()));
        return matrix;
    }

    std::string plan() { return delam_solver_plan(get()); }
    std::vector<PlanItem> plan_items() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_plan_count(get(), &count));
        std::vector<PlanItem> items;
        for (std::int64_t i = 0; i < count; ++i) {
            const char *subject = nullptr, *decision = nullptr, *reason = nullptr, *unit = nullptr;
            double cost = 0.0;
            double saving = 0.0;
            shared_->check(delam_solver_plan_item(get(), i, &subject, &decision, &reason, &cost, &saving, &unit));
            items.push_back({detail::copy(subject), detail::copy(decision), detail::copy(reason), cost, saving,
                             detail::copy(unit)});
        }
        return items;
    }
    // "" for an unknown key.
    std::string option(Text key) const { return detail::copy(delam_solver_option(get(), key.get())); }
    std::string searched() const { return delam_solver_searched(get()); }
    // -1: back to the pending state, else the committed one.
    void look(std::int64_t step) { shared_->check(delam_solver_look(get(), step)); }
    std::vector<Jump> jumps() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_jump_count(get(), &count));
        std::vector<Jump> jumps;
        for (std::int64_t i = 0; i < count; ++i) {
            Jump jump{};
            shared_->check(delam_solver_jump(get(), i, &jump.step, &jump.before, &jump.time, &jump.stored,
                                             &jump.dissipated, &jump.released, &jump.debonded, &jump.interface_index,
                                             &jump.first_pair, &jump.last_pair));
            jumps.push_back(jump);
        }
        return jumps;
    }
    std::vector<std::uint8_t> save() const {
        std::int64_t needed = 0;
        shared_->check(delam_solver_save(get(), 0, nullptr, &needed));
        std::vector<std::uint8_t> bytes(detail::length(needed));
        shared_->check(delam_solver_save(get(), needed, bytes.data(), &needed));
        return bytes;
    }
    void load(View<std::uint8_t> bytes) { shared_->check(delam_solver_load(get(), bytes.count(), bytes.data())); }

private:
    std::shared_ptr<detail::Shared> shared_;
    std::vector<std::shared_ptr<detail::HostLaw>> laws_;
    detail::Handle<delam_solver, delam_solver_destroy> handle_;
    Outcome initial_ = Outcome::done;
};

}  // namespace delam

#endif

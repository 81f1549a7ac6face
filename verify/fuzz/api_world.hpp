// SPDX-License-Identifier: BSD-3-Clause
// Handles of the sequence of calls, the words that it knows, and what is written where.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "contract.hpp"
#include "delam/experimental.h"
#include "dense_engine.hpp"
#include "host_law.hpp"
#include "input.hpp"

namespace fuzz {

inline constexpr std::size_t slots = 3;  // of each kind

template <class T>
inline void destroy_handle(T** handle);
template <>
inline void destroy_handle(delam_mesh** handle) {
    delam_mesh_destroy(handle);
}
template <>
inline void destroy_handle(delam_law** handle) {
    delam_law_destroy(handle);
}
template <>
inline void destroy_handle(delam_problem** handle) {
    delam_problem_destroy(handle);
}
template <>
inline void destroy_handle(delam_solver** handle) {
    delam_solver_destroy(handle);
}

// Handles of one kind, each with the host whose context it was made with.
template <class T>
struct Shelf {
    T* handle[slots] = {};
    Host* host[slots] = {};

    void put(std::size_t slot, T* made, Host* with) {
        destroy_handle(&handle[slot]);
        handle[slot] = made;
        host[slot] = with;
    }
    // Empty slots give NULL.
    T* pick(Input& in) const { return handle[static_cast<std::size_t>(in.below(slots))]; }
};

// An engine that problems of the library may have taken.
struct Engaged {
    explicit Engaged(Dense stiffness) : engine(std::move(stiffness)) {}
    DenseEngine engine;
    std::int64_t taken = 0;
};

// Two contexts, the objects made with them, and the data of the callbacks.
struct World {
    std::vector<std::unique_ptr<Engaged>> engines;
    std::vector<std::uint8_t> part;  // last output of delam_experimental_problem_part
    std::unique_ptr<Host> host[2] = {std::make_unique<Host>(), std::make_unique<Host>()};
    HostLaw host_law;
    Shelf<delam_mesh> mesh;
    Shelf<delam_law> law;
    Shelf<delam_problem> problem;
    Shelf<delam_solver> solver;
    // The running call: its subject, and the callbacks that it may call.
    Host* heard = nullptr;
    // The next call: number of polls until it is cancelled, and whether by the callback's answer; -1: not at all.
    std::int64_t interrupt_in = -1;
    bool interrupt_by_call = false;

    ~World() {
        for (std::size_t i = 0; i < slots; ++i) {
            delam_solver_destroy(&solver.handle[i]);
            delam_problem_destroy(&problem.handle[i]);
            delam_law_destroy(&law.handle[i]);
            delam_mesh_destroy(&mesh.handle[i]);
            expect(solver.handle[i] == nullptr && mesh.handle[i] == nullptr, "destroyed handles are NULL", "destroy");
        }
        for (const auto& each : engines)
            expect(each->engine.released == each->taken, "each engine that was taken is released once", "release");
    }
    // Engines fail and answer nonsense only while the call runs that is asked, not while objects are compared.
    void wake(bool awake) {
        for (const auto& each : engines) each->engine.awake = awake, each->engine.failed &= !awake;
    }
    bool engine_failed() const {
        return std::any_of(engines.begin(), engines.end(), [](const auto& each) { return each->engine.failed; });
    }
    Host& any_host(Input& in) { return *host[in.below(2)]; }

    // Status of a call that makes an object; if it succeeds, the object goes into a slot.
    template <class T, class Make>
    std::int32_t make(Shelf<T>& shelf, Input& in, Host& with, Make&& call) {
        T* made = reinterpret_cast<T*>(this);  // must be overwritten
        T** out = in.seldom() ? nullptr : &made;
        const std::int32_t status = call(out);
        if (out == nullptr) {
            expect(status < 0, "no place for the object is an error", "create");
            return status;
        }
        const bool is_there = status == DELAM_OK || status == DELAM_NOT_CONVERGED;
        expect((made != nullptr) == is_there, "*out is NULL on error, and the object otherwise", "create");
        if (made != nullptr) shelf.put(static_cast<std::size_t>(in.below(slots)), made, &with);
        return status;
    }
};

// ---- arguments ------------------------------------------------------------------------------------------------------

inline const std::vector<const char*> value_keys = words_of(
    "stored_bulk stored_interface dissipated work lower upper defect defect_slides front kkt_gap kkt_pressure "
    "kkt_complementarity kkt_equilibrium rotation_max damage_change linear_residual crack_length "
    "crack_length:0 crack_length:7 energy_release_rate front_mixity:1 process_zone_length process_zone_pairs:0 "
    "load:load reaction:load reaction:none search_gap debonded_length contact_pairs mixity_error "
    "increment_lower bulk_factorisations field_recoveries crack_area process_zone_pairs_mean:0 crack_length: "
    "crack_length:99999999999999999999 "
    "crack_length:-1 load:");
inline const std::vector<const char*> field_keys =
    words_of("displacement stress rotation jump traction adhesion mixity contact reaction");
inline const std::vector<const char*> law_keys = words_of(
    "normal_stiffness tangential_stiffness normal_onset tangential_onset normal_toughness tangential_toughness "
    "plateau gradient onset_exponent_1 toughness_exponent_2 onset_exponent toughness_exponent criterion");
inline const std::vector<const char*> law_kinds =
    words_of("piecewise-linear exponential trapezoidal tabulated griffith host");
inline const char* const criteria[] = {"valoroso-champaney", "power", "benzeggagh-kenane"};
// Every word that some text option may be.
inline std::span<const char* const> option_texts() {
    static const std::set<std::string> texts = [] {
        std::set<std::string> words;
        for (std::int64_t i = 0; i < delam_option_count(); ++i) {
            const char *type = "", *range = "";
            delam_option_info(i, nullptr, &type, nullptr, nullptr, &range, nullptr);
            if (std::string(type) != "text") continue;
            std::istringstream list{std::string(range)};
            for (std::string word; list >> word;)
                if (word != "|") words.insert(word);
        }
        return words;
    }();
    static const std::vector<const char*> pointers = [] {
        std::vector<const char*> list;
        for (const std::string& word : texts) list.push_back(word.c_str());
        return list;
    }();
    return pointers;
}

inline const char* option_key(Input& in) {
    const char* key = nullptr;
    const std::int64_t index = in.below(delam_option_count() + 1);
    return delam_option_info(index, &key, nullptr, nullptr, nullptr, nullptr, nullptr) == DELAM_OK ? key : "no option";
}

struct MeshSizes {
    std::int32_t dimension = 2;
    std::int64_t nodes = 0, cells = 0, bodies = 0, interfaces = 0;
};
inline MeshSizes sizes_of(const delam_mesh* mesh) {
    MeshSizes s;
    delam_mesh_size(mesh, &s.dimension, &s.nodes, &s.cells, &s.bodies, &s.interfaces);
    return s;
}
// A problem does not return its mesh; fields that exist in only one dimension reveal the dimension.
struct ProblemSizes {
    std::int64_t dofs = 0, dual = 0, patterns = 0;
};
inline ProblemSizes sizes_of(const delam_problem* problem) {
    ProblemSizes s;
    delam_problem_dofs(problem, &s.dofs, &s.dual);
    delam_problem_pattern_count(problem, &s.patterns);
    return s;
}

// A capacity near the required one, and a buffer of exactly that many entries, so that writing one more is detected.
template <class T>
struct Room {
    Room(Input& in, std::int64_t needed) {
        const std::uint8_t how = in.byte();
        capacity = how == 255 ? -1 : how == 254 ? std::numeric_limits<std::int64_t>::min() : needed + how % 8 - 2;
        if (how < 200) capacity = needed;
        entries.resize(static_cast<std::size_t>(std::max<std::int64_t>(capacity, 0)));
    }
    std::int64_t capacity = 0;
    std::vector<T> entries;
    T* data() { return entries.data(); }
};

inline std::size_t few(Input& in) { return static_cast<std::size_t>(in.below(6)); }

// A call of the analysis: the progress callback may cancel, the law's callbacks may fail.
template <class Call>
inline std::int32_t watched(World& world, Input& in, Call&& call) {
    if (in.seldom() || in.seldom()) {
        world.heard->cancel_in = in.below(64);
        world.heard->cancel_by_call = in.flag();
    }
    if (in.seldom()) {
        world.host_law.fail_in = in.byte();
        if (in.flag()) world.host_law.fail_with = in.raw<std::int32_t>();
    }
    const std::int32_t status = call();
    world.heard->cancel_in = -1;
    world.host_law.fail_in = -1;
    return status;
}

}  // namespace fuzz

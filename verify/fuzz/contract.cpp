// SPDX-License-Identifier: BSD-3-Clause
#include "contract.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace fuzz {

namespace {

class Print {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        text_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    template <class T>
    void add(T value) {
        text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    std::string text() { return std::move(text_); }

private:
    std::string text_;
};

std::size_t size(std::int64_t count) { return static_cast<std::size_t>(count); }

void read(std::int32_t status, const char* what) { expect(status == DELAM_OK, "what has been made can be read", what); }

}  // namespace

void expect(bool kept, const char* promise, const char* where) {
    if (kept) return;
    std::fprintf(stderr, "promise broken: %s (%s)\n", promise, where);
    std::abort();
}

Host::Host() {
    expect(delam_context_create(&context) == DELAM_OK && context != nullptr, "a context", "delam_context_create");
    delam_context_set_log(context, log, this);
    delam_context_set_progress(context, progress, this);
}

Host::~Host() { delam_context_destroy(&context); }

void Host::log(std::int32_t level, const char* text, void* user) {
    Host& host = *static_cast<Host*>(user);
    expect(delam_context_set_log(host.context, log, user) == DELAM_ERROR_STATE, "no way in from a callback",
           "log callback");
    expect(text != nullptr && level >= 0 && level <= 2, "lines of level 0 to 2", "log callback");
    if (level == 2) return;
    host.last_ = text;
    host.last_level_ = level;
}

std::int32_t Host::progress(const char* stage, std::int64_t done, std::int64_t total, void* user) {
    Host& host = *static_cast<Host*>(user);
    expect(delam_context_set_progress(host.context, progress, user) == DELAM_ERROR_STATE, "no way in from a callback",
           "progress callback");
    expect(stage != nullptr && *stage != '\0' && done >= 0 && total >= 0, "a stage and counts", "progress callback");
    if (--host.polls_left < 0) return 1;
    if (host.cancel_in < 0 || --host.cancel_in >= 0) return 0;
    if (!host.cancel_by_call) return 1;
    delam_context_cancel(host.context);
    return 0;
}

void Host::begin() {
    last_.clear();
    last_level_ = -1;
}

void Host::settle(const char* call, std::int32_t status, Statuses documented) {
    if (status == DELAM_OK) return;
    const Statuses always = bit(DELAM_ERROR_HANDLE) | bit(DELAM_ERROR_MEMORY);
    if (status < DELAM_ERROR_FILE || status > DELAM_LIMIT || ((documented | always) & bit(status)) == 0) {
        std::fprintf(stderr, "%s: %s, '%s'\n", call, delam_status_name(status),
                     context != nullptr ? delam_context_message(context) : "");
        expect(false, "a status that the comment of the function lists", call);
    }
    if (context == nullptr || status == DELAM_ERROR_HANDLE) return;
    const char* message = delam_context_message(context);
    expect(message != nullptr && *message != '\0', "a message", call);
    expect(!listens || last_ == message, "the log gets the message", call);
    expect(!listens || last_level_ == (status < 0 ? 0 : 1), "the log gets the level", call);
}

std::string print_of(const delam_mesh* mesh) {
    Print print;
    std::int32_t dimension = 0;
    std::int64_t nodes = 0, cells = 0, bodies = 0, interfaces = 0, entries = 0, ties = 0;
    read(delam_mesh_size(mesh, &dimension, &nodes, &cells, &bodies, &interfaces), "delam_mesh_size");
    for (const std::int64_t count : {std::int64_t{dimension}, nodes, cells, bodies, interfaces}) print.add(count);
    std::vector<double> places(size(nodes * dimension));
    read(delam_mesh_nodes(mesh, nodes * dimension, places.data()), "delam_mesh_nodes");
    print.add(places);
    std::vector<std::int32_t> labels(size(nodes)), types(size(cells)), of_cells(size(cells));
    std::vector<std::int64_t> origins(size(nodes)), offsets(size(cells + 1));
    read(delam_mesh_node_bodies(mesh, nodes, labels.data()), "delam_mesh_node_bodies");
    read(delam_mesh_node_origins(mesh, nodes, origins.data()), "delam_mesh_node_origins");
    read(delam_mesh_cells(mesh, nullptr, nullptr, nullptr, 0, nullptr, &entries), "delam_mesh_cells");
    std::vector<std::int64_t> connectivity(size(entries));
    read(delam_mesh_cells(mesh, types.data(), of_cells.data(), offsets.data(), entries, connectivity.data(), nullptr),
         "delam_mesh_cells");
    print.add(labels), print.add(origins), print.add(types), print.add(of_cells), print.add(offsets);
    print.add(connectivity);
    read(delam_mesh_node_ties(mesh, &ties, &entries, nullptr, nullptr, nullptr, nullptr), "delam_mesh_node_ties");
    std::vector<std::int64_t> tied(size(ties)), starts(size(ties + 1)), of(size(entries));
    std::vector<double> weights(size(entries));
    read(delam_mesh_node_ties(mesh, nullptr, nullptr, tied.data(), starts.data(), of.data(), weights.data()),
         "delam_mesh_node_ties");
    print.add(tied), print.add(starts), print.add(of), print.add(weights);
    for (std::int64_t i = 0; i < interfaces; ++i) {
        std::int32_t a = 0, b = 0, per_face = 0;
        std::int64_t pairs = 0, faces = 0;
        read(delam_mesh_interface_size(mesh, i, &a, &b, &pairs, &faces, &per_face), "delam_mesh_interface_size");
        std::vector<std::int64_t> node_a(size(pairs)), node_b(size(pairs)), face(size(faces * per_face));
        std::vector<double> weight(size(pairs)), frame(size(pairs * dimension * dimension));
        read(delam_mesh_interface_pairs(mesh, i, node_a.data(), node_b.data(), weight.data(), frame.data()),
             "delam_mesh_interface_pairs");
        // An obstacle has pairs and no faces.
        std::int64_t none = 0;
        read(delam_mesh_interface_faces(mesh, i, face.empty() ? &none : face.data()), "delam_mesh_interface_faces");
        print.add(a), print.add(b), print.add(node_a), print.add(node_b), print.add(weight), print.add(frame);
        print.add(face);
    }
    return print.text();
}

std::string print_of(const delam_law* law) {
    Print print;
    const std::int32_t whole = delam_law_check(law);
    print.add(whole);
    if (whole != DELAM_OK) return print.text();
    const double mixity[] = {0.0, 0.25, 1.0};
    const double jump[] = {1e-3, 0.0, 0.01, 0.01, 0.0, 0.1};
    const double old[] = {1.0, 1.0, 0.5};
    std::vector<double> onset(3), toughness(3), adhesion(3), traction(6);
    print.add(delam_law_toughness(law, 3, mixity, onset.data(), toughness.data()));
    print.add(delam_law_respond(law, 2, 3, jump, mixity, old, adhesion.data(), traction.data()));
    print.add(onset), print.add(toughness), print.add(adhesion), print.add(traction);
    return print.text();
}

std::string print_of(const delam_problem* problem) {
    char hash[17] = {};
    std::int64_t patterns = 0, rows = 0, entries = 0;
    read(delam_problem_hash(problem, hash), "delam_problem_hash");
    expect(std::strlen(hash) == 16, "16 digits", "delam_problem_hash");
    read(delam_problem_pattern_count(problem, &patterns), "delam_problem_pattern_count");
    read(delam_problem_constraints(problem, &rows, &entries, nullptr, nullptr, nullptr, nullptr, nullptr),
         "delam_problem_constraints");
    Print print;
    for (const char digit : hash) print.add(digit);
    for (std::int64_t p = 0; p < patterns; ++p) {
        const char* name = delam_problem_pattern_name(problem, p);
        expect(name != nullptr && *name != '\0', "a pattern has a name", "delam_problem_pattern_name");
        for (; *name != '\0'; ++name) print.add(*name);
    }
    print.add(patterns), print.add(rows), print.add(entries);
    return print.text();
}

std::vector<std::uint8_t> saved(const delam_solver* solver) {
    std::int64_t needed = 0;
    read(delam_solver_save(solver, 0, nullptr, &needed), "delam_solver_save");
    std::vector<std::uint8_t> bytes(size(needed));
    read(delam_solver_save(solver, needed, bytes.data(), &needed), "delam_solver_save");
    return bytes;
}

// The last 8 bytes: FNV-1a of all before them.
std::vector<std::uint8_t> with_checksum(std::vector<std::uint8_t> bytes) {
    if (bytes.size() < 8) return bytes;
    std::uint64_t sum = 14695981039346656037ULL;
    for (std::size_t i = 0; i + 8 < bytes.size(); ++i) sum = (sum ^ bytes[i]) * 1099511628211ULL;
    std::memcpy(bytes.data() + bytes.size() - 8, &sum, 8);
    return bytes;
}

std::string print_of(delam_solver* solver) {
    Print print;
    print.add(saved(solver));
    // The state that the values refer to: pending, committed or an earlier one.
    for (const char* key : {"step", "time", "stored_bulk", "dissipated", "work", "jumps", "revisions"}) {
        double value = 0.0;
        read(delam_solver_value(solver, key, &value), key);
        print.add(value);
    }
    for (const char* key : {"jump", "adhesion", "contact"}) {
        std::int64_t rows = 0, columns = 0;
        read(delam_solver_field_shape(solver, key, -1, &rows, &columns), key);
        std::vector<double> values(size(rows * columns));
        read(delam_solver_field(solver, key, -1, rows * columns, values.data()), key);
        print.add(values);
    }
    return print.text();
}

}  // namespace fuzz

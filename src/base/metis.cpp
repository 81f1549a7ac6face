// SPDX-License-Identifier: BSD-3-Clause
#include "base/metis.hpp"

#include <array>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <new>

#include "base/error.hpp"
#include "base/room.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// METIS 5 reseeds rand() and installs handlers for SIGABRT and SIGTERM while it runs. Both belong to the host: its
// random sequence continues where it was, and its handlers are restored. This is process-wide state, hence one call at
// a time. METIS takes a SIGTERM from outside for an error of its own and leaves by a jump, so that one to this thread
// should wait until METIS has ended. It cannot wait while METIS cuts into parts: there METIS raises SIGTERM itself,
// where its memory ends.
enum class Terminate { waits, interrupts };
class Visit {
public:
    explicit Visit(Terminate terminate) : lock_(mutex()) {
        sequence_ = initstate(1, buffer_.data(), buffer_.size());
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], nullptr, &handlers_[i]);
        sigset_t blocked;
        sigemptyset(&blocked);
        if (terminate == Terminate::waits) sigaddset(&blocked, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &blocked, &mask_);
    }
    ~Visit() {
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &handlers_[i], nullptr);
        pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
        setstate(sequence_);
    }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

private:
    static constexpr std::array<int, 2> signals{SIGABRT, SIGTERM};
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
    std::array<char, 128> buffer_{};
    char* sequence_ = nullptr;
    std::array<struct sigaction, 2> handlers_{};
    sigset_t mask_{};
};

// METIS prints a message if an allocation fails. Its maximal memory was measured on grids: up to 43 bytes per vertex or
// neighbour, in small parts, and at least 100 KiB.
constexpr std::size_t metis_part = 49152;  // bytes of its first large allocation

void require_room_for_metis(const Graph& graph) {
    const std::size_t bytes = (std::size_t{1} << 17) + 48 * (graph.size() + graph.neighbour.size());
    require_room(bytes);
    require_room(bytes, metis_part);
}

std::array<idx_t, METIS_NOPTIONS> options_of_metis() {
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    return options;
}

// METIS reports a general error if its innermost stage lacks memory; nothing else here causes that error.
void check_metis(int status, const char* function) {
    if (status == METIS_ERROR_MEMORY || status == METIS_ERROR) throw std::bad_alloc();
    if (status != METIS_OK) fail(DELAM_ERROR_INTERNAL, function, ": status ", status);
}

idx_t* weights_of(Graph& graph) { return graph.weight.empty() ? nullptr : graph.weight.data(); }

}  // namespace

std::vector<idx_t> cut_with_metis(Graph& graph, idx_t parts) {
    require_room_for_metis(graph);
    auto vertices = static_cast<idx_t>(graph.size());
    idx_t constraints = 1, cut = 0;
    auto options = options_of_metis();
    options[METIS_OPTION_CONTIG] = 1;
    std::vector<idx_t> part(graph.size(), 0);
    int status = METIS_OK;
    {
        const Visit visit(Terminate::interrupts);
        status =
            METIS_PartGraphKway(&vertices, &constraints, graph.start.data(), graph.neighbour.data(), weights_of(graph),
                                nullptr, nullptr, &parts, nullptr, nullptr, options.data(), &cut, part.data());
    }
    check_metis(status, "METIS_PartGraphKway");
    return part;
}

std::vector<idx_t> dissect_with_metis(Graph& graph) {
    require_room_for_metis(graph);
    auto vertices = static_cast<idx_t>(graph.size());
    auto options = options_of_metis();
    options[METIS_OPTION_COMPRESS] = 0;  // done by the caller, who knows the variables of a node
    std::vector<idx_t> order(graph.size()), position(graph.size());
    int status = METIS_OK;
    {
        const Visit visit(Terminate::waits);
        status = METIS_NodeND(&vertices, graph.start.data(), graph.neighbour.data(), weights_of(graph), options.data(),
                              order.data(), position.data());
    }
    check_metis(status, "METIS_NodeND");
    return order;
}

}  // namespace delam

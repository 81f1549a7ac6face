// SPDX-License-Identifier: BSD-3-Clause
// fault_cancel [STRIDE [SCENE ...]]: every STRIDE-th call of the progress callback cancels, by its result or by
// delam_context_cancel (calls that read obey only the latter). The call must return DELAM_CANCELLED and restore the
// state before it, and the host must get the same result when it goes on.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "scenes.hpp"

namespace {

using faults::expect;

// True for names like "delam_solver_value kkt_gap".
bool reads(const std::string& name) {
    for (const char* function : {"delam_mesh_find_patch", "delam_problem_body_matrix", "delam_problem_constraints",
                                 "delam_problem_eigenstrain_energy", "delam_problem_forces", "delam_problem_hash",
                                 "delam_problem_process_zone", "delam_problem_propose", "delam_solver_average",
                                 "delam_solver_condensed", "delam_solver_field", "delam_solver_value"})
        if (name.substr(0, name.find(' ')) == function) return true;
    return false;
}

class Canceller : public faults::Host {
public:
    explicit Canceller(int stride) : stride_(stride) {}

    void made(delam_context* context) override {
        Host::made(context);
        expect(delam_context_set_progress(context, poll, this) == DELAM_OK, "delam_context_set_progress");
    }

    void call(const std::string& name, Repeat, const Call& call, const Call&) override {
        const bool watched = solver_ != nullptr;
        const faults::Transcript before = watched ? faults::state_of(solver_) : faults::Transcript();
        for (int k = 1;; k += stride_) {
            left_ = k;
            by_request_ = reads(name) || !by_request_;
            const std::int32_t status = call();
            const bool asked = left_ <= 0;
            left_ = 0;
            if (!asked) {
                expect(status == DELAM_OK, name + ": " + delam_status_name(status) + ": " + message());
                return;
            }
            const std::string where = name + " cancelled at poll " + std::to_string(k) + " ('" + stage_ + "')";
            expect(status == DELAM_CANCELLED, where + ": " + delam_status_name(status) + ": " + message());
            ++cancelled;
            if (!watched) continue;
            const std::string difference = before.difference(faults::state_of(solver_));
            expect(difference.empty(), where + ": state: " + difference);
        }
    }

    long cancelled = 0;

private:
    // Cancels at one poll only.
    static std::int32_t poll(const char* stage, std::int64_t, std::int64_t, void* user) {
        auto& self = *static_cast<Canceller*>(user);
        if (self.left_ <= 0 || --self.left_ > 0) return 0;
        self.left_ = -1;
        self.stage_ = stage;
        if (!self.by_request_) return 1;
        delam_context_cancel(self.context_);
        return 0;
    }

    int stride_;
    int left_ = 0;
    bool by_request_ = false;
    std::string stage_;
};

}  // namespace

int main(int argc, char** argv) {
    const int stride = argc > 1 ? std::atoi(argv[1]) : 1;
    int failed = 0;
    for (const faults::Strip& strip : faults::strips()) {
        bool wanted = argc <= 2;
        for (int i = 2; i < argc; ++i) wanted = wanted || strip.name == argv[i];
        if (!wanted) continue;
        try {
            faults::Calm calm;
            faults::analyse(calm, strip);
            Canceller canceller(stride);
            faults::analyse(canceller, strip);
            const std::string difference = calm.transcript.difference(canceller.transcript);
            expect(difference.empty(), "result: " + difference);
            expect(canceller.cancelled > 0, "nothing was cancelled");
            std::printf("%-12s %ld calls cancelled, %zu results the same\n", strip.name.c_str(), canceller.cancelled,
                        calm.transcript.size());
        } catch (const std::exception& e) {
            std::printf("%-12s failed: %s\n", strip.name.c_str(), e.what());
            ++failed;
        }
    }
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

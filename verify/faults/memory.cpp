// SPDX-License-Identifier: BSD-3-Clause
// fault_memory [MOST [SCENE ...]]: the k-th allocation inside a call fails, for k = 1, 2, 3 ... up to MOST / 2, and
// from there on in steps of 2 k / MOST, rounded down (MOST 0: every one). The program lists the calls in which some
// were left out. Each failure must give a status, leave the object usable and unchanged, and leak nothing.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "allocator.hpp"
#include "scenes.hpp"

namespace {

using faults::expect;

class Starver : public faults::Host {
public:
    explicit Starver(long most) : most_(most) {}

    void call(const std::string& name, Repeat repeat, const Call& call, const Call& undo) override {
        ++calls;
        const bool watched = solver_ != nullptr;
        const auto state = [&](bool words) {
            return watched ? faults::state_of(solver_, words) : faults::Transcript();
        };
        faults::Transcript before = state(true);
        const faults::Transcript numbers = state(false);
        long step = 1, blocks = 0, tried = 0;
        for (long k = 1;; k += step, ++tried) {
            const long live = faults::live_blocks();
            faults::fail_at(k);
            const std::int32_t status = call();
            const bool starved = faults::stop_failing();
            const std::string where = name + " with allocation " + std::to_string(k) + " failing";
            if (!starved) {
                expect(status == DELAM_OK, name + ": " + delam_status_name(status) + ": " + message());
                if (step > 1)
                    std::printf(
                        "  %s: %ld of some %ld allocations failed, each of the first %ld, every %ld-th in the end\n",
                        name.c_str(), tried, k - step / 2, most_ / 2, step);
                return;
            }
            ++failed;
            if (status == DELAM_OK) {  // the call succeeded without that allocation
                ++done_without;
                if (repeat == Repeat::once) return;
                if (repeat == Repeat::after_undo) expect(undo() == DELAM_OK, where + ", but done: taking it back");
                const std::string difference = numbers.difference(state(false));
                expect(difference.empty(), where + ", but done, and taken back: state: " + difference);
                before = state(true);
            } else {
                expect(status == DELAM_ERROR_MEMORY, where + ": " + delam_status_name(status) + ": " + message());
                blocks = faults::live_blocks();
                if (repeat == Repeat::after_undo && !watched)
                    expect(blocks <= live + 1, where + ": " + std::to_string(blocks - live) + " blocks are left");
            }
            if (watched) {
                const std::string difference = before.difference(faults::state_of(solver_));
                expect(difference.empty(), where + ": state: " + difference);
            }
            // The number of allocations is unknown until the call succeeds, so the steps grow with k.
            if (most_ > 0 && k >= most_ / 2) step = std::max(1L, 2 * k / most_);
        }
    }

    long calls = 0, failed = 0, done_without = 0;

private:
    long most_;
};

void starve(const faults::Strip& strip, long most, const faults::Transcript& calm) {
    const long before = faults::live_blocks();
    {
        Starver starver(most);
        faults::analyse(starver, strip);
        const std::string difference = calm.difference(starver.transcript);
        expect(difference.empty(), "result: " + difference);
        expect(starver.failed > 0, "nothing has failed");
        std::printf("%-12s %ld calls, %ld failed allocations, %ld of them done without; %zu results the same\n",
                    strip.name.c_str(), starver.calls, starver.failed, starver.done_without, calm.size());
    }
    const long left = faults::live_blocks() - before;
    expect(left == 0, std::to_string(left) + " blocks are left in the end");
}

}  // namespace

int main(int argc, char** argv) {
    if (!faults::can_fail()) {
        std::printf("skipped: the allocator of this build cannot be told to fail\n");
        return 77;
    }
    static char buffer[4096];  // otherwise the first printed line would count as a block that is not freed
    std::setvbuf(stdout, buffer, _IOLBF, sizeof buffer);
    const long most = argc > 1 ? std::atol(argv[1]) : 0;
    int failures = 0;
    for (const faults::Strip& strip : faults::strips()) {
        bool wanted = argc <= 2;
        for (int i = 2; i < argc; ++i) wanted = wanted || strip.name == argv[i];
        if (!wanted) continue;
        try {
            faults::Calm calm;
            faults::analyse(calm, strip);
            starve(strip, most, calm.transcript);
        } catch (const std::exception& e) {
            faults::stop_failing();
            std::printf("%-12s failed: %s\n", strip.name.c_str(), e.what());
            ++failures;
        }
    }
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

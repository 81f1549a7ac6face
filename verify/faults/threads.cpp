// SPDX-License-Identifier: BSD-3-Clause
// fault_threads [ROUNDS]: eight threads run scenes of their own at the same time, condensed, FETI cut by METIS,
// energetic, saved and loaded, also with the library's own threads. Each must give the bits of the same analysis run
// alone. Under ThreadSanitizer: no race.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

#include "scenes.hpp"

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 1;
    constexpr std::size_t threads = 8;
    const std::vector<faults::Strip>& strips = faults::strips();
    std::vector<faults::Transcript> alone;
    std::string failure[threads];
    try {
        for (const faults::Strip& strip : strips) {
            faults::Calm host;
            faults::analyse(host, strip);
            alone.push_back(std::move(host.transcript));
        }
        std::vector<std::thread> all;
        for (std::size_t t = 0; t < threads; ++t)
            all.emplace_back([&, t] {
                try {
                    for (int round = 0; round < rounds; ++round) {
                        const std::size_t i = (t + static_cast<std::size_t>(round)) % strips.size();
                        faults::Strip strip = strips[i];
                        faults::Calm host;
                        faults::analyse(host, strip);
                        const std::string difference = alone[i].difference(host.transcript);
                        faults::expect(difference.empty(), strip.name + ": " + difference);
                    }
                } catch (const std::exception& e) {
                    failure[t] = e.what();
                }
            });
        for (std::thread& thread : all) thread.join();
        for (std::size_t t = 0; t < threads; ++t)
            faults::expect(failure[t].empty(), "thread " + std::to_string(t) + ": " + failure[t]);
    } catch (const std::exception& e) {
        std::printf("failed: %s\n", e.what());
        return EXIT_FAILURE;
    }
    std::printf("%zu threads, %d rounds: same results as alone\n", threads, rounds);
    return EXIT_SUCCESS;
}

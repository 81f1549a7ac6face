// SPDX-License-Identifier: BSD-3-Clause
#include "child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>

#include "measure.hpp"

namespace bench {

Json ask_child(const std::vector<std::string>& task, int threads) {
    int pipe_ends[2];
    if (pipe(pipe_ends) != 0) return {{"error", "pipe failed"}};
    const pid_t child = fork();
    if (child < 0) return {{"error", "fork failed"}};
    if (child == 0) {
        dup2(pipe_ends[1], STDOUT_FILENO);
        close(pipe_ends[0]);
        close(pipe_ends[1]);
        const std::string count = std::to_string(threads);
        setenv("OPENBLAS_NUM_THREADS", count.c_str(), 1);
        setenv("OMP_NUM_THREADS", count.c_str(), 1);
        // CHOLMOD 3 requests four OpenMP threads whatever OMP_NUM_THREADS is.
        if (getenv("DELAM_BENCH_AS_SHIPPED") == nullptr) setenv("OMP_THREAD_LIMIT", count.c_str(), 1);
        std::vector<std::string> words{"delam_bench", "--child"};
        words.insert(words.end(), task.begin(), task.end());
        std::vector<char*> arguments;
        for (auto& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    close(pipe_ends[1]);
    std::string text;
    char buffer[65536];
    for (ssize_t n = 0; (n = read(pipe_ends[0], buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(n));
    close(pipe_ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    Json answer = Json::parse(text, nullptr, false);
    if (answer.is_discarded()) return {{"error", "the child ended with status " + std::to_string(status)}};
    return answer;
}

Json run_child_task(const std::vector<std::string>& task) {
    try {
        const auto word = [&](std::size_t i) { return i < task.size() ? task[i] : std::string(); };
        const auto number = [&](std::size_t i) { return std::strtod(word(i).c_str(), nullptr); };
        if (word(0) == "series") return measure_series(word(1), static_cast<int>(number(2)), number(3));
        if (word(0) == "memory") return measure_memory(word(1), word(2), number(3));
        if (word(0) == "agreement") return measure_agreement(word(1), number(2), number(3));
        if (word(0) == "critical") return measure_critical(word(1), number(2));
        if (word(0) == "concepts") return measure_concepts(word(1), static_cast<int>(number(2)), number(3));
        return {{"error", "unknown task '" + word(0) + "'"}};
    } catch (const std::exception& e) {
        return {{"error", e.what()}};
    }
}

}  // namespace bench

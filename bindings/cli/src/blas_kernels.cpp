// SPDX-License-Identifier: BSD-3-Clause
#include "blas_kernels.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include <dlfcn.h>
#include <unistd.h>

namespace cli {

namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";

// Returns a text that a function of OpenBLAS gives; empty: another BLAS is loaded.
std::string_view told(const char* function) {
    using Text = char* (*)();
    const auto call = reinterpret_cast<Text>(dlsym(RTLD_DEFAULT, function));
    const char* text = call == nullptr ? nullptr : call();
    return text == nullptr ? "" : text;
}

// True if kernels of this name have neither AVX2 nor AVX-512.
bool are_old(std::string_view name) {
    constexpr std::string_view old[] = {"Katmai",      "Coppermine", "Northwood",  "Prescott",     "Banias",
                                        "Atom",        "Core2",      "Penryn",     "Dunnington",   "Nehalem",
                                        "Sandybridge", "Athlon",     "Opteron",    "Opteron_SSE3", "Barcelona",
                                        "Bobcat",      "Bulldozer",  "Piledriver", "Steamroller",  "Nano"};
    return std::find(std::begin(old), std::end(old), name) != std::end(old);
}

// Returns the kernels that use most of what the processor and the system have; null: neither AVX2 nor AVX-512.
const char* best_kernels() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
        return "SkylakeX";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
    return nullptr;
}

}  // namespace

void choose_blas_kernels(char** argv) {
    const char* const best = best_kernels();
    if (best == nullptr || std::getenv(variable) != nullptr || !are_old(told("openblas_get_corename"))) return;
    if (told("openblas_get_config").find("DYNAMIC_ARCH") == std::string_view::npos) return;
    if (setenv(variable, best, 0) == 0) (void)execv("/proc/self/exe", argv);
}

}  // namespace cli

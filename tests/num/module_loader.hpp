// Loads the operations of an instruction set's module, where the CPU can run them.
#pragma once

#include <dlfcn.h>
#include <fmt/format.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "num/operations.hpp"

namespace quadrel::num_tests {

/// The instruction sets that modules were built for.
inline std::vector<std::string> built_isas() {
    std::istringstream words(QUADREL_TEST_ISAS);
    std::vector<std::string> isas;
    for (std::string isa; words >> isa;) isas.push_back(isa);
    return isas;
}

inline bool cpu_has(const std::string& isa) {
#if defined(__x86_64__)
    const bool sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") &&
                      __builtin_cpu_supports("pclmul");
    const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                      __builtin_cpu_supports("f16c");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
    return (isa == "sse4" && sse4) || (isa == "avx2" && avx2) || (isa == "avx512" && avx512);
#else
    return isa == "neon";
#endif
}

inline std::string module_path(const std::string& isa) {
    return fmt::format("{}/quadrel-test-num-{}.so", QUADREL_TEST_MODULE_DIR, isa);
}

using TableFunction = OperationTable (*)(int packets_only);

/// The module's entry; stays loaded. Throws std::runtime_error with the loader's message.
inline TableFunction load_module(const std::string& isa) {
    void* handle = dlopen(module_path(isa).c_str(), RTLD_NOW | RTLD_LOCAL);
    void* entry = handle != nullptr ? dlsym(handle, "quadrel_num_operations") : nullptr;
    if (entry == nullptr) throw std::runtime_error(dlerror());
    return reinterpret_cast<TableFunction>(entry);
}

}  // namespace quadrel::num_tests

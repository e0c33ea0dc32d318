#include "kernels/select.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>

#include "file/module_path.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using TableFunction = const KernelTable* (*)();

#if defined(__x86_64__)
bool has_sse4() {
    return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") &&
           __builtin_cpu_supports("pclmul");
}
bool has_avx2() {
    return has_sse4() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
           __builtin_cpu_supports("f16c");
}
bool has_avx512() {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd");
}
#endif

/// The module's table, or null with `error` set.
const KernelTable* load_module(const std::string& isa, std::string& error) {
    const auto path = find_module("quadrel-kernels-" + isa);
    if (!path) {
        error = "its module is not installed";
        return nullptr;
    }
    void* module = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) {
        error = dlerror();
        return nullptr;
    }
    const auto function = reinterpret_cast<TableFunction>(dlsym(module, kernel_symbol));
    const KernelTable* table = function ? function() : nullptr;
    if (!table || table->magic != kernel_magic || table->abi_version != kernel_abi_version) {
        error = fmt::format("{} is not of this version of Quadrel", path->string());
        return nullptr;
    }
    return table;
}

const KernelTable* cached_module(const std::string& isa, std::string& error) {
    static std::mutex mutex;
    static std::map<std::string, const KernelTable*> loaded;
    const std::lock_guard lock(mutex);
    if (const auto found = loaded.find(isa); found != loaded.end()) return found->second;
    const KernelTable* table = load_module(isa, error);
    if (table) loaded[isa] = table;
    return table;
}

const KernelTable& widest() {
    std::string error;
    for (const std::string& isa : isa_names()) {
        if (isa == "scalar" || !cpu_supports(isa)) continue;
        if (const KernelTable* table = cached_module(isa, error)) return *table;
    }
    return scalar_float_kernels();
}

}  // namespace

const std::vector<std::string>& isa_names() {
    static const std::vector<std::string> names{"avx512", "avx2", "sse4", "neon", "scalar"};
    return names;
}

bool cpu_supports(std::string_view isa) {
    if (isa == "scalar") return true;
#if defined(__x86_64__)
    if (isa == "sse4") return has_sse4();
    if (isa == "avx2") return has_avx2();
    if (isa == "avx512") return has_avx512();
#elif defined(__aarch64__)
    if (isa == "neon") return true;
#endif
    return false;
}

const KernelTable& select_kernels(const std::string& number, const std::string& isa) {
    const auto& names = isa_names();
    if (isa != "auto" && std::find(names.begin(), names.end(), isa) == names.end())
        throw UsageError(
            fmt::format("isa: found \"{}\", expected auto, {}", isa, fmt::join(names, ", ")));
    if (number == "double") {
        if (isa != "auto" && isa != "scalar")
            throw UsageError(
                fmt::format("isa: found \"{}\" beside double, expected scalar or auto", isa));
        return scalar_double_kernels();
    }
    if (number != "float")
        throw UsageError(fmt::format("number: found \"{}\", expected float or double", number));
    if (isa == "auto") return widest();
    if (isa == "scalar") return scalar_float_kernels();
    if (!cpu_supports(isa))
        throw UsageError(
            fmt::format("isa: found \"{}\", expected an instruction set that this CPU has", isa));
    std::string error;
    const KernelTable* table = cached_module(isa, error);
    if (!table) throw UsageError(fmt::format("instruction set \"{}\": {}", isa, error));
    return *table;
}

}  // namespace quadrel

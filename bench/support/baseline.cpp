#include "support/baseline.hpp"

#include <dlfcn.h>

#include <stdexcept>

#include "kernels/select.hpp"

namespace quadrel::bench {

const KernelTable& baseline_kernels(const std::string& isa) {
    const std::string file =
        QUADREL_BENCH_DIR "/quadrel-baseline" + (isa.empty() ? "" : "-" + isa) + ".so";
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) throw std::runtime_error(dlerror());
    using TableFunction = const KernelTable* (*)();
    const auto function = reinterpret_cast<TableFunction>(dlsym(module, kernel_symbol));
    if (!function) throw std::runtime_error(dlerror());
    return *function();
}

std::vector<std::string> lane_sets() {
    std::vector<std::string> sets;
    for (const std::string& isa : isa_names())
        if (isa != "scalar" && cpu_supports(isa)) sets.insert(sets.begin(), isa);
    return sets;
}

}  // namespace quadrel::bench

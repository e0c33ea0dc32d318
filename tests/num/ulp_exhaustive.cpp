// Measures a float function's largest error over every float, judged by the same text on doubles
// (which ulp_test.cpp judges by MPFR). Usage: num_ulp_exhaustive FUNCTION [STRIDE]
#include <fmt/format.h>

#include <atomic>
#include <bit>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "quadrel/num/math.hpp"

namespace {

using quadrel::PlainFloat;

struct Function {
    const char* name;
    float (*in_float)(float);
    double (*in_double)(double);
    float largest;  // |x| up to which the bound is stated
};

#define QUADREL_FUNCTION(name, largest)                                                            \
    Function {                                                                                     \
#name,                                                                                     \
            [](float x) { return quadrel::name(x); },                                              \
                                                   [](double x) { return quadrel::name(x); },      \
                                                                                           largest \
    }

const Function functions[] = {
    QUADREL_FUNCTION(exp2, 1e38f),     QUADREL_FUNCTION(exp, 1e38f),
    QUADREL_FUNCTION(log2, 3e38f),     QUADREL_FUNCTION(log, 3e38f),
    QUADREL_FUNCTION(sin, 4194304.0f), QUADREL_FUNCTION(cos, 4194304.0f),
    QUADREL_FUNCTION(tan, 4194304.0f), QUADREL_FUNCTION(atan, 3e38f),
    QUADREL_FUNCTION(asin, 1.0f),      QUADREL_FUNCTION(acos, 1.0f),
};

/// |found - exact| in units of exact's spacing among floats.
double ulps(float found, double exact) {
    if (found != found || exact != exact) return found != found && exact != exact ? 0 : 1e30;
    if (static_cast<double>(found) == exact || static_cast<float>(exact) == found) {
        if (quadrel::abs(exact) > 3.4028234e38) return 0;
    }
    const double magnitude = quadrel::max(quadrel::abs(exact), 0x1p-126);
    const double spacing = quadrel::power_of_two(quadrel::exponent(magnitude) - 23);
    return quadrel::abs(static_cast<double>(found) - exact) / spacing;
}

struct Worst {
    double error = 0;
    float at = 0;
};

Worst measure(const Function& f, std::uint32_t first, std::uint32_t last, std::uint32_t stride) {
    Worst worst;
    for (std::uint64_t bits = first; bits <= last; bits += stride) {
        const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        if (!(quadrel::abs(x) <= f.largest)) continue;
        const double error = ulps(f.in_float(x), f.in_double(x));
        if (error > worst.error) worst = {error, x};
    }
    return worst;
}

Worst measure_all(const Function& f, std::uint32_t stride) {
    constexpr std::uint32_t block = 1u << 22;
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    Worst worst;
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < std::jthread::hardware_concurrency(); ++t) {
        threads.emplace_back([&] {
            for (std::uint64_t i; (i = next++) < 1024;) {
                const auto first = static_cast<std::uint32_t>(i * block);
                const Worst found = measure(f, first, first + (block - 1), stride);
                const std::scoped_lock lock(mutex);
                if (found.error > worst.error) worst = found;
            }
        });
    }
    threads.clear();
    return worst;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string wanted = argc > 1 ? argv[1] : "";
    const auto stride = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 1);
    for (const Function& f : functions) {
        if (wanted != f.name && wanted != "all") continue;
        const Worst worst = measure_all(f, stride);
        fmt::print("{}: {:.4f} ulp at {:a}\n", f.name, worst.error, worst.at);
    }
    return 0;
}

// Whether two implementations of an operation give the same bits, and the hash of what one gives.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "num/inputs.hpp"
#include "num/operations.hpp"

namespace quadrel::num_tests {

template <class T>
std::vector<std::uint64_t> evaluate(const Operation<T>& operation, const Inputs<T>& in) {
    std::vector<std::uint64_t> out(max_outputs * in.a.size());
    operation.run(in.a.data(), in.b.data(), in.c.data(), in.a.size(), out.data());
    return out;
}

template <class T>
testing::AssertionResult same_bits(const Operation<T>& truth, const Operation<T>& tested,
                                   const Inputs<T>& in) {
    if (std::string(truth.name) != tested.name) {
        return testing::AssertionFailure()
               << tested.name << " where " << truth.name << " should be";
    }
    const auto expected = evaluate(truth, in);
    const auto found = evaluate(tested, in);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        if (expected[k] == found[k]) continue;
        const std::size_t i = k % in.a.size();
        return testing::AssertionFailure() << fmt::format(
                   "{}: a={:a} b={:a} c={:a}: output {} is {:x}, expected {:x}", truth.name,
                   in.a[i], in.b[i], in.c[i], k / in.a.size(), found[k], expected[k]);
    }
    return testing::AssertionSuccess();
}

/// FNV-1a over 64-bit words.
template <class T>
std::uint64_t hash_of(const Operation<T>& operation, const Inputs<T>& in) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::uint64_t word : evaluate(operation, in)) hash = (hash ^ word) * 0x100000001b3u;
    return hash;
}

}  // namespace quadrel::num_tests

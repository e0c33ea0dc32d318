// A command line that is refused, and the one line that it gets.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/process.hpp"

namespace quadrel::cli_tests {

/// A command line, the exit code that it ends with, and parts of the line that it prints.
struct BadInput {
    std::string what;
    std::vector<std::string> arguments;
    int code;
    std::vector<std::string> says;
};

inline testing::AssertionResult complains(const Outcome& outcome, const BadInput& bad) {
    const auto wrong = [&](const std::string& how) {
        return testing::AssertionFailure() << bad.what << ": " << how << ": code " << outcome.code
                                           << ", " << outcome.err << outcome.out;
    };
    if (outcome.code != bad.code) return wrong("another exit code");
    if (!outcome.out.empty()) return wrong("printed something");
    if (outcome.err.compare(0, 9, "quadrel: ") != 0 || outcome.err.back() != '\n')
        return wrong("no message");
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    if (std::count_if(outcome.err.begin(), outcome.err.end(), control) != 1)
        return wrong("not one printable line");
    for (const std::string& part : bad.says)
        if (outcome.err.find(part) == std::string::npos) return wrong("does not say " + part);
    return testing::AssertionSuccess();
}

}  // namespace quadrel::cli_tests

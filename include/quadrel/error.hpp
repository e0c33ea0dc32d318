// What can go wrong outside of our own code, as exceptions at the border of the library. Our own
// mistakes are QUADREL_CHECK (check.hpp); the two never mix.
#pragma once

#include <stdexcept>
#include <string>

namespace quadrel {

/// Exit codes of the command line.
enum class ExitCode : int {
    ok = 0,
    difference = 1,  ///< `compare` found a difference
    usage = 2,       ///< bad command line
    input = 3,       ///< bad or missing input
    internal = 4,    ///< a check of our own failed
    output = 5,      ///< output could not be written
    try_again = 75,  ///< a passing condition (EX_TEMPFAIL)
};

/// Bad input: one line that names the file, the place in it, what was found and what was expected.
/// `key` is a JSON-pointer-like path ("objects[0].material") or empty; line and column count from
/// 1, 0 means unknown.
struct InputError : std::runtime_error {
    InputError(std::string file, std::string key, std::string found, std::string expected,
               int line = 0, int column = 0);

    std::string file, key, found, expected;
    int line, column;
};

/// A command line or API call that makes no sense (exit code 2).
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An output that could not be written whole (exit code 5). The final name is untouched.
struct OutputError : std::runtime_error {
    OutputError(std::string file, std::string reason);

    std::string file, reason;
};

}  // namespace quadrel

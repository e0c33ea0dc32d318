// Examples for the help of each verb.
#pragma once

#include <CLI/App.hpp>
#include <span>

namespace quadrel::cli {

struct Example {
    const char* verb;
    const char* arguments;  ///< after the verb, as a shell takes them
    const char* meaning;
};

/// At least two a verb.
std::span<const Example> examples();

/// Ends the help of every verb of the program with its examples.
void add_examples(CLI::App& program);

}  // namespace quadrel::cli

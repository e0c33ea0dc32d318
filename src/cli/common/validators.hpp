// What an option takes, in words where it is something else: found "1", expected 2 to 1024.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <map>
#include <string>
#include <vector>

#include "text/suggest.hpp"

namespace quadrel::cli {

/// An integer of [low, high].
inline CLI::Validator whole_number(int low, int high) {
    const std::string range = std::to_string(low) + " to " + std::to_string(high);
    return CLI::Validator(
        [=](std::string& text) {
            int value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            const bool fits = error == std::errc() && stop == end && value >= low && value <= high;
            return fits ? "" : "found \"" + text + "\", expected an integer, " + range;
        },
        "INT in [" + std::to_string(low) + " - " + std::to_string(high) + "]");
}

/// One of some words.
inline CLI::Validator one_word_of(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ",") + word;
    return CLI::Validator(
        [words](std::string& text) {
            for (const std::string& word : words)
                if (word == text) return std::string();
            return "found \"" + text + "\", expected " + one_of(text, words);
        },
        "{" + list + "}");
}

/// A key of a map.
template <class Value>
CLI::Validator one_word_of(const std::map<std::string, Value>& values) {
    std::vector<std::string> words;
    for (const auto& [word, value] : values) words.push_back(word);
    return one_word_of(words);
}

}  // namespace quadrel::cli

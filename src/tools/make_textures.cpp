// quadrel-make-textures DIRECTORY [RECIPE]...: writes the textures of data/textures. Without names,
// all of them. Equal input gives equal texels on every machine.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

#include "textures/recipes.hpp"

namespace {

using quadrel::textures::Recipe;

int usage() {
    fmt::print(stderr, "usage: quadrel-make-textures DIRECTORY [RECIPE]...\nrecipes:");
    for (const Recipe& recipe : quadrel::textures::recipes())
        fmt::print(stderr, " {}", recipe.name);
    fmt::print(stderr, "\n");
    return 2;
}

const Recipe* find_recipe(std::string_view name) {
    for (const Recipe& recipe : quadrel::textures::recipes())
        if (name == recipe.name) return &recipe;
    return nullptr;
}

/// The recipes named from argv[2] on, all if none is named; empty for a name that does not exist.
std::vector<Recipe> chosen_recipes(int argc, char** argv) {
    const auto all = quadrel::textures::recipes();
    if (argc <= 2) return {all.begin(), all.end()};
    std::vector<Recipe> chosen;
    for (int i = 2; i < argc; ++i) {
        const Recipe* recipe = find_recipe(argv[i]);
        if (!recipe) return {};
        chosen.push_back(*recipe);
    }
    return chosen;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return usage();
    const std::vector<Recipe> chosen = chosen_recipes(argc, argv);
    if (chosen.empty()) return usage();
    try {
        const std::filesystem::path directory = argv[1];
        std::filesystem::create_directories(directory);
        for (const Recipe& recipe : chosen) recipe.write(directory);
    } catch (const std::exception& error) {
        fmt::print(stderr, "quadrel-make-textures: {}\n", error.what());
        return 5;
    }
    return 0;
}

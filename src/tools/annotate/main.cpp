// quadrel-annotate: copies the headers of texts, with names for what they compute, for the module
// that writes shaders.
//
//     quadrel-annotate INCLUDE OUTPUT ROOM...
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tools/annotate/names.hpp"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw std::runtime_error("cannot read " + file.string());
    return text.str();
}

std::vector<fs::path> headers_of(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".hpp") files.push_back(entry.path());
    return files;
}

/// Only where it changes, so that nothing is compiled anew for nothing.
void write(const fs::path& file, const std::string& text) {
    if (fs::exists(file) && read(file) == text) return;
    fs::create_directories(file.parent_path());
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw std::runtime_error("cannot write " + file.string());
}

void annotate_all(const fs::path& include, const fs::path& output,
                  const std::vector<std::string>& rooms) {
    quadrel::annotate::Structs structs;
    std::vector<fs::path> files;
    for (const std::string& room : rooms)
        for (const fs::path& file : headers_of(include / "quadrel" / room)) {
            files.push_back(file);
            quadrel::annotate::add_structs(structs, read(file));
        }
    for (const fs::path& file : files)
        write(output / fs::relative(file, include),
              quadrel::annotate::with_names(read(file), structs));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: quadrel-annotate INCLUDE OUTPUT ROOM...\n");
        return 2;
    }
    try {
        annotate_all(argv[1], argv[2], {argv + 3, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "quadrel-annotate: %s\n", error.what());
        return 1;
    }
    return 0;
}

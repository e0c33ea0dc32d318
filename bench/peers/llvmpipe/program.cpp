#include "llvmpipe/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "gl/context/program.hpp"

namespace quadrel::peers {
namespace {

std::string text_of(const std::string& name) {
    const std::string path = fmt::format("{}/{}.glsl", QUADREL_PEERS_SHADERS, name);
    std::ifstream in(path);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string head(const std::vector<std::string>& defines) {
    std::string text = "#version 450 core\n";
    for (const std::string& define : defines) text += "#define " + define + "\n";
    return text;
}

}  // namespace

GLuint make_program(const std::vector<std::string>& files,
                    const std::vector<std::string>& defines) {
    std::string fragment = head(defines);
    for (const std::string& file : files) fragment += text_of(file);
    const std::string what = fmt::format("{}", fmt::join(files, ", "));
    return gl::make_program(head({}) + text_of("vertex"), fragment, what);
}

}  // namespace quadrel::peers

// The rows of the tables: a picture of Quadrel's and the shader that draws the same.
#pragma once

#include <string>
#include <vector>

namespace quadrel::peers {

struct Row {
    std::string name;  ///< on the command line
    std::string title;
    /// "key=value" that make the scene of picture.hpp this row's.
    std::vector<std::string> overrides;
    std::vector<std::string> shaders;  ///< files of shaders/ without ending, in their order
    std::vector<std::string> defines;
    /// Overrides of the picture that the shader draws, where that is not quite what is timed.
    std::vector<std::string> shader_draws = {};
    /// Mean difference of R, G and B above which two pictures are not the same.
    double tolerance = 2e-4;

    /// Overrides of the picture that the shader has to draw: as Quadrel draws it when it imitates
    /// llvmpipe's levels of detail and interpolation.
    std::vector<std::string> judged_overrides() const;
};

/// Drawn beside llvmpipe.
const std::vector<Row>& drawn_rows();

/// One of them, by a name that there is.
const Row& row_of(const std::string& name);

/// Their names.
std::vector<std::string> row_names();

/// "a, b, c".
std::string joined(const std::vector<std::string>& words);

}  // namespace quadrel::peers

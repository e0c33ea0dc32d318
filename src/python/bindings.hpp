// The parts of the Python module `quadrel._quadrel`, a function each. What people call is Python,
// in src/python/package; this is what that needs of the library.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <string>

#include "python/output_file.hpp"
#include "python/unlocked.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/scene.hpp"
#include "quadrel/texture/texture.hpp"
#include "text/suggest.hpp"

namespace quadrel::python {

namespace py = pybind11;

/// A film and what the header of an EXR says of it. Planes are neither added nor resized once
/// Python has it, so that arrays may be views of them.
struct NamedFilm {
    Film film;
    Attributes attributes;
    std::map<std::string, Storage> stored;  ///< of channels that were codes
    Inputs inputs;                          ///< what it was made of, which it is not written to
    Inputs source;                          ///< the file that it was read from
};

/// A scene that Python holds.
struct LoadedScene : Scene {
    Inputs inputs;
};

/// A texture that Python holds.
struct HeldTexture {
    std::shared_ptr<const Texture> texture;
    Inputs inputs;
};

void bind_errors(py::module_& module);
void bind_scenes(py::module_& module);
void bind_films(py::module_& module);
void bind_renders(py::module_& module);
void bind_judges(py::module_& module);
void bind_textures(py::module_& module);
void bind_look_ups(py::module_& module);

/// The value of a word in a table of (word, value). Throws UsageError.
template <class Table>
auto value_of(const std::string& what, const std::string& word, const Table& table) {
    std::vector<std::string> words;
    for (const auto& [name, value] : table) {
        if (name == word) return value;
        words.emplace_back(name);
    }
    throw UsageError(what + ": found \"" + word + "\", expected " + one_of(word, words));
}

}  // namespace quadrel::python

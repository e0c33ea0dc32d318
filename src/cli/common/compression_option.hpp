// --compression, wherever a verb writes EXR files.
#pragma once

#include <CLI/App.hpp>

#include "quadrel/film/exr.hpp"

namespace quadrel::cli {

void add_compression_option(CLI::App& verb, ExrCompression& compression);

}  // namespace quadrel::cli

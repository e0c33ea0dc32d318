// Which implementation of OpenGL draws: options that programs which ask one have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

#include "gl/context/context.hpp"
#include "text/printable.hpp"

namespace quadrel::gl {

struct RendererChoice {
    bool llvmpipe = false;
    std::string part_of_name;  ///< of GL_RENDERER; empty: any
};

inline void add_renderer_options(CLI::App& app, RendererChoice& choice) {
    app.add_flag("--llvmpipe", choice.llvmpipe, "Mesa's llvmpipe, whatever else there is");
    app.add_option("--renderer", choice.part_of_name,
                   "nothing (exit code 3) where its name has not this in it")
        ->type_name("TEXT");
}

/// Its context, made current. Throws std::runtime_error where there is none, and "skipped: ..."
/// where it is another implementation than was asked for.
inline Context chosen_context(const RendererChoice& choice) {
    Context context = choice.llvmpipe ? Context::llvmpipe(0) : Context::at_hand();
    const std::string renderer = gl_string(GL_RENDERER);
    if (renderer.find(choice.part_of_name) == std::string::npos)
        throw std::runtime_error("skipped: the renderer is " + printable(renderer));
    return context;
}

}  // namespace quadrel::gl

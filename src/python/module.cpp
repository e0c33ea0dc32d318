// The extension module.
#include "python/bindings.hpp"

PYBIND11_MODULE(_quadrel, module) {
    module.doc() = "What the package `quadrel` needs of the library; for nobody else.";
    using namespace quadrel::python;
    await_at_exit();
    bind_errors(module);
    bind_scenes(module);
    bind_films(module);
    bind_renders(module);
    bind_judges(module);
    bind_textures(module);
    bind_look_ups(module);
    module.attr("version") = QUADREL_VERSION;
}

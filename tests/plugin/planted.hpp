// Errors that the checks on plugins and shaders must find.
#pragma once

namespace quadrel::plugin_tests {

enum class Planted {
    other_result,      ///< the program's own stage computes something else than the plugin's
    other_parameters,  ///< parameters do not arrive
    shifted_quad,      ///< a shader is called for the quad beside
    leaked_symbol,     ///< a plugin exports more than its table
};

}  // namespace quadrel::plugin_tests

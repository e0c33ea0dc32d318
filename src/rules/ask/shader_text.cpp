#include "rules/ask/shader_text.hpp"

namespace quadrel::rules {

std::string vertex_text(const std::string& head) {
    return head +
           "in vec4 position;\nin vec4 corner;\nout vec4 at_pixel;\n"
           "void main() {\n    gl_Position = position;\n    at_pixel = corner;\n}\n";
}

std::string fragment_text(const Question& question, const std::string& head) {
    std::string text = head;
    for (std::size_t i = 0; i < question.maps.size(); ++i)
        text += std::string("uniform ") + (question.maps[i].cube ? "samplerCube" : "sampler2D") +
                " map" + std::to_string(i) + ";\n";
    return text + question.uniforms +
           "uniform usampler2D numbers;\nin vec4 at_pixel;\nout uvec4 bits;\n"
           "vec4 answer(vec4 asked, vec4 interpolated, vec2 pixel) {\n" +
           question.glsl +
           "\n}\n\nvoid main() {\n"
           "    vec4 asked = uintBitsToFloat(texelFetch(numbers, ivec2(gl_FragCoord.xy), 0));\n"
           "    bits = floatBitsToUint(answer(asked, at_pixel, floor(gl_FragCoord.xy)));\n}\n";
}

}  // namespace quadrel::rules

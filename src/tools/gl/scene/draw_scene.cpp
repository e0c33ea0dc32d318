#include "gl/scene/draw_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "gl/context/context.hpp"
#include "gl/context/sampler.hpp"
#include "gl/scene/objects.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/film/resolve.hpp"

namespace quadrel::gl {
namespace {

/// The text with PASS as another number; lines stay where they are.
std::string text_of_pass(const std::string& text, int pass) {
    const std::string standard = "#define PASS 0\n";
    const std::size_t at = text.find(standard);
    if (at == std::string::npos) return text;
    return text.substr(0, at) + fmt::format("#define PASS {}\n", pass) +
           text.substr(at + standard.size());
}

Program make_program(const ExportedMaterial& material, int pass) {
    try {
        return {material.vertex, text_of_pass(material.fragment, pass),
                "of " + material.fragment_file};
    } catch (const std::runtime_error& error) {
        throw InputError(material.fragment_file, "", error.what(),
                         "shaders that the implementation takes");
    }
}

void set_uniform(GLuint program, const Uniform& uniform) {
    const GLint at = glGetUniformLocation(program, uniform.name.c_str());
    if (at < 0) return;  // not read by this pass
    const auto count = static_cast<GLsizei>(uniform.values.size()) / uniform.components;
    const float* const values = uniform.values.data();
    switch (uniform.components) {
        case 1:
            return glUniform1fv(at, count, values);
        case 2:
            return glUniform2fv(at, count, values);
        case 3:
            return glUniform3fv(at, count, values);
        default:
            return glUniform4fv(at, count, values);
    }
}

void set_uniforms(GLuint program, const std::vector<Uniform>& uniforms) {
    for (const Uniform& uniform : uniforms) set_uniform(program, uniform);
}

/// The sampler objects of one material; bound to units with their textures.
class Samplers {
  public:
    Samplers(const ExportedScene& scene, const ExportedMaterial& material,
             const SceneTextures& textures, GLuint program) {
        for (std::size_t unit = 0; unit < material.samplers.size(); ++unit) {
            const ExportedSampler& sampler = material.samplers[unit];
            const ExportedTexture& texture = scene.textures[sampler.texture];
            glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
            glBindTexture(texture.target, textures[sampler.texture]);
            ids_.push_back(make_sampler(sampler.state, static_cast<int>(texture.levels.size())));
            glBindSampler(static_cast<GLuint>(unit), ids_.back());
            const GLint at = glGetUniformLocation(program, sampler.uniform.c_str());
            if (at >= 0) glUniform1i(at, static_cast<GLint>(unit));
        }
    }
    ~Samplers() {
        for (std::size_t unit = 0; unit < ids_.size(); ++unit)
            glBindSampler(static_cast<GLuint>(unit), 0);
        glDeleteSamplers(static_cast<GLsizei>(ids_.size()), ids_.data());
    }
    Samplers(const Samplers&) = delete;
    Samplers& operator=(const Samplers&) = delete;

  private:
    std::vector<GLuint> ids_;
};

void set_state(const ExportedScene& scene) {
    glDisable(GL_BLEND);
    glDisable(GL_DITHER);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(scene.depth_function);
    glDepthRange(scene.depth_range[0], scene.depth_range[1]);
    glFrontFace(scene.front_face);
    if (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control"))
        glClipControl(scene.upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                      scene.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    else if (scene.upper_left || scene.zero_to_one)
        throw std::runtime_error(
            "the scene's conventions need OpenGL 4.5, or the extension ARB_clip_control");
}

void draw_object(const ExportedScene& scene, const Draw& draw, GLuint program) {
    set_uniforms(program, draw.uniforms);
    const auto& cull = scene.materials[draw.material].cull;
    if (cull) {
        glEnable(GL_CULL_FACE);
        glCullFace(*cull);
    } else {
        glDisable(GL_CULL_FACE);
    }
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(draw.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(4 * draw.first_index));
}

void draw_pass(const ExportedScene& scene, int pass, const SceneTextures& textures,
               Programs& programs) {
    const Pass& targets = scene.passes[static_cast<std::size_t>(pass)];
    for (std::size_t i = 0; i < targets.size(); ++i)
        glClearBufferfv(GL_COLOR, static_cast<GLint>(i), targets[i].clear.data());
    const auto depth = static_cast<float>(scene.depth_clear);
    glClearBufferfv(GL_DEPTH, 0, &depth);
    for (const Draw& draw : scene.draws) {  // in order: depth may tie
        const ExportedMaterial& material = scene.materials[draw.material];
        const GLuint program = programs.of(material, pass);
        glUseProgram(program);
        set_uniforms(program, scene.uniforms);
        set_uniforms(program, material.uniforms);
        const Samplers samplers(scene, material, textures, program);
        draw_object(scene, draw, program);
    }
    glUseProgram(0);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error(fmt::format("OpenGL: error {:#x} in pass {}", error, pass));
}

/// Whole numbers that a shader wrote as floats: NaN and what is below 0 become 0.
std::uint32_t whole(float value) {
    if (!(value > 0)) return 0;
    return value >= 0x1p32f ? 0xffffffffu : static_cast<std::uint32_t>(std::floor(value + 0.5f));
}

/// Four floats per pixel of one target, of each sample.
using SampleValues = std::vector<std::vector<float>>;

/// Where each pixel of the film lies in what is read back.
class Rows {
  public:
    explicit Rows(const ExportedScene& scene)
        : width_(static_cast<std::size_t>(scene.width)),
          height_(static_cast<std::size_t>(scene.height)),
          top_first_(scene.first_row_is_top) {}

    std::size_t pixels() const { return width_ * height_; }
    /// Of a pixel of the film, whose top row comes first.
    std::size_t operator()(std::size_t pixel) const {
        const std::size_t x = pixel % width_, y = pixel / width_;
        return (top_first_ ? y : height_ - 1 - y) * width_ + x;
    }

  private:
    std::size_t width_, height_;
    bool top_first_;
};

std::uint32_t bits_of(float value, bool integer) {
    return integer ? whole(value) : canonical_bits(std::bit_cast<std::uint32_t>(value));
}

/// Channels whose samples become one value; of others a pixel has that of its lowest covered
/// sample.
bool is_resolved(const std::string& channel) {
    return channel == "R" || channel == "G" || channel == "B" || channel == "A" || channel == "Z";
}

float resolved(const std::string& channel, const SampleValues& samples, std::size_t at) {
    std::vector<ColorSample> all(samples.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
        all[s].r = samples[s][at];  // colours and coverage are means, whichever it is
        all[s].z = samples[s][at];
    }
    const ColorSample one = resolve(all);
    return channel == "Z" ? one.z : one.r;
}

/// Copies one component of a target into a plane. `owners`: of each pixel as it is read back, the
/// lowest sample that something covers.
void copy_channel(const Rows& rows, const SampleValues& samples,
                  const std::vector<std::uint8_t>& owners, std::size_t component, bool integer,
                  Plane& plane) {
    const bool resolves = samples.size() > 1 && is_resolved(plane.name);
    for (std::size_t pixel = 0; pixel < rows.pixels(); ++pixel) {
        const std::size_t row = rows(pixel), at = 4 * row + component;
        plane.bits[pixel] = bits_of(resolves ? resolved(plane.name, samples, at)
                                             : samples[owners.empty() ? 0 : owners[row]][at],
                                    integer);
    }
}

/// Of each pixel, window row 0 first, the lowest sample that something covers; 0 where none is.
/// Empty where a pixel has one sample.
std::vector<std::uint8_t> owners_of(const ExportedScene& scene, const FloatTargets& drawn,
                                    const SampleReader* reader) {
    if (reader == nullptr) return {};
    std::vector<std::uint8_t> owners(Rows(scene).pixels(), 0);
    for (int sample = scene.samples - 1; sample >= 0; --sample) {
        const std::vector<float> depths = reader->read(drawn.depth(), sample);
        for (std::size_t i = 0; i < owners.size(); ++i)
            if (depths[4 * i] != static_cast<float>(scene.depth_clear))
                owners[i] = static_cast<std::uint8_t>(sample);
    }
    return owners;
}

SampleValues values_of(const ExportedScene& scene, const FloatTargets& drawn,
                       const SampleReader* reader, std::size_t target) {
    if (reader == nullptr) return {drawn.read(target)};
    SampleValues values;
    for (int sample = 0; sample < scene.samples; ++sample)
        values.push_back(reader->read(drawn.color(target), sample));
    return values;
}

/// Adds the channels of what a pass has drawn.
void add_channels(const ExportedScene& scene, const Pass& targets, const FloatTargets& drawn,
                  const SampleReader* reader, Film& film) {
    const std::vector<std::uint8_t> owners = owners_of(scene, drawn, reader);
    const Rows rows(scene);
    for (std::size_t target = 0; target < targets.size(); ++target) {
        const SampleValues values = values_of(scene, drawn, reader, target);
        for (std::size_t c = 0; c < 4; ++c) {
            const TargetChannel& channel = targets[target].channels[c];
            if (channel.name.empty() || film.find(channel.name) != nullptr) continue;
            Plane& plane = film.add(channel.name,
                                    channel.integer ? ChannelType::uint32 : ChannelType::float32);
            copy_channel(rows, values, owners, c, channel.integer, plane);
        }
    }
}

/// Floats have no +inf of their own in the manifest, nor are all integers among them.
void clear_uncovered(Film& film) {
    const Plane* const coverage = film.find("A");
    if (coverage == nullptr) return;
    const std::vector<std::uint32_t> covered = coverage->bits;
    for (Plane& plane : film.planes) {
        if (plane.name == "R" || plane.name == "G" || plane.name == "B") continue;  // background
        for (std::size_t i = 0; i < covered.size(); ++i)
            if (!(std::bit_cast<float>(covered[i]) > 0)) plane.bits[i] = uncovered_bits(plane.name);
    }
}

void check_passes(const ExportedScene& scene, const std::vector<int>& passes) {
    for (const int pass : passes)
        if (pass < 0 || pass >= static_cast<int>(scene.passes.size()))
            throw UsageError(fmt::format("--pass: found {}, expected 0 to {}", pass,
                                         static_cast<int>(scene.passes.size()) - 1));
}

}  // namespace

GLuint Programs::of(const ExportedMaterial& material, int pass) {
    const std::string key = fmt::format("{}\n{}\n{}", pass, material.vertex, material.fragment);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second.id();
    return known_.emplace(key, make_program(material, pass)).first->second.id();
}

Film draw_scene(const ExportedScene& scene, const std::vector<int>& passes) {
    Programs programs;
    return draw_scene(scene, passes, programs);
}

Film draw_scene(const ExportedScene& scene, const std::vector<int>& passes, Programs& programs) {
    check_passes(scene, passes);
    const Window frame{0, 0, scene.width, scene.height};
    Film film{frame, frame, {}};
    const SceneBuffers buffers(scene);
    const SceneTextures textures(scene);
    std::optional<SampleReader> reader;
    if (scene.samples > 1) reader.emplace(scene.width, scene.height);
    for (int pass = 0; pass < static_cast<int>(scene.passes.size()); ++pass) {
        if (!passes.empty() && std::ranges::count(passes, pass) == 0) continue;
        const Pass& targets = scene.passes[static_cast<std::size_t>(pass)];
        const FloatTargets drawn(scene.width, scene.height, targets.size(), scene.samples);
        set_state(scene);
        draw_pass(scene, pass, textures, programs);
        add_channels(scene, targets, drawn, reader ? &*reader : nullptr, film);
    }
    clear_uncovered(film);
    return film;
}

Attributes drawing_attributes(const ExportedScene& scene) {
    Attributes attributes{{"quadrel:sceneHash", scene.scene_hash},
                          {"quadrel:gl.renderer", gl_string(GL_RENDERER)},
                          {"quadrel:gl.vendor", gl_string(GL_VENDOR)},
                          {"quadrel:gl.version", gl_string(GL_VERSION)},
                          {"quadrel:gl.glsl", gl_string(GL_SHADING_LANGUAGE_VERSION)},
                          {"quadrel:gl.language", scene.language}};
    return attributes;
}

}  // namespace quadrel::gl

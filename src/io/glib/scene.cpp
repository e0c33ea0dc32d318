// Commands take effect in their order, as in glman: a shape is drawn with the program and the
// textures of that moment.
#include "io/glib/scene.hpp"

#include <array>
#include <optional>

#include "io/glib/commands.hpp"
#include "io/glib/program.hpp"
#include "io/glib/shapes.hpp"
#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

class GlibScene {
  public:
    explicit GlibScene(const std::filesystem::path& file) : file_(file) {
        document_.file = file;
        document_.root = Json::object();
        document_.root["quadrel"] = 1;
        objects_ = Json::array();
        materials_ = Json::object();
    }

    void take(const GlibCommand& command) {
        const GlibCommandText* text = find_glib_command(command.name.text);
        GlibArguments arguments(command, file_);
        if (!text) reject_command(arguments);
        perform(text->verb, arguments);
        arguments.finish(text->signature);
        end_ = command.end;
    }

    SceneDocument finish() {
        if (!seen_.contains(GlibVerb::perspective))
            fail("Perspective", "no such command", "one, before the shapes");
        if (objects_.empty()) fail("", "no shape in the scene", "QuadXY, Sphere, Torus or Teapot");
        document_.root["camera"] = std::move(camera_);
        document_.root["materials"] = std::move(materials_);
        document_.root["objects"] = std::move(objects_);
        return std::move(document_);
    }

  private:
    void perform(GlibVerb verb, GlibArguments& arguments) {
        switch (verb) {
            case GlibVerb::background:
                return background(arguments);
            case GlibVerb::perspective:
                return perspective(arguments);
            case GlibVerb::look_at:
                return look_at(arguments);
            case GlibVerb::cube_map:
                return cube_map(arguments);
            case GlibVerb::texture_2d:
                return texture_2d(arguments);
            case GlibVerb::vertex:
                return shader(verb, arguments, "Parallax.vert");
            case GlibVerb::fragment:
                return shader(verb, arguments, "Parallax.frag");
            case GlibVerb::program:
                return program(arguments);
            case GlibVerb::quad_xy:
            case GlibVerb::sphere:
            case GlibVerb::torus:
            case GlibVerb::teapot:
                return draw(verb, arguments);
        }
    }

    // At the end of the file.
    [[noreturn]] void fail(const std::string& key, const std::string& found,
                           const std::string& expected) const {
        throw InputError(file_.string(), key, found, expected, end_.line, end_.column);
    }
    [[noreturn]] void reject_command(const GlibArguments& arguments) const {
        const std::string& name = arguments.name().text;
        arguments.fail(arguments.name().at, "a command that is not understood",
                       one_of(name, glib_command_names()));
    }

    // --- Frame and camera

    void only_once(GlibVerb verb, const GlibArguments& arguments) {
        const auto [first, is_new] = seen_.emplace(verb, arguments.name().at);
        if (!is_new)
            arguments.fail(arguments.name().at, "the command a second time",
                           "it once (it is on line " + std::to_string(first->second.line) + ")");
    }

    void place(const std::string& path, TextPosition at) { document_.positions[path] = at; }

    // An array of numbers; each remembers its place.
    Json vector(GlibArguments& arguments, const std::string& path, std::string_view meaning) {
        Json out = Json::array();
        for (std::size_t i = 0; i < 3; ++i) {
            const GlibNumber number = arguments.number(meaning);
            if (i == 0) place(path, number.at);
            place(join_index(path, i), number.at);
            out.push_back(number.value);
        }
        return out;
    }

    void background(GlibArguments& arguments) {
        only_once(GlibVerb::background, arguments);
        document_.root["background"] = vector(arguments, "background", "red, green or blue");
    }

    void perspective(GlibArguments& arguments) {
        only_once(GlibVerb::perspective, arguments);
        const GlibNumber angle = arguments.number("the field of view in degrees");
        place("camera.fov_y", angle.at);
        camera_["fov_y"] = angle.value;
    }

    void look_at(GlibArguments& arguments) {
        only_once(GlibVerb::look_at, arguments);
        place("camera", arguments.name().at);
        camera_["eye"] = vector(arguments, "camera.eye", "a coordinate of the eye");
        camera_["target"] = vector(arguments, "camera.target", "a coordinate of the target");
        camera_["up"] = vector(arguments, "camera.up", "a coordinate of the direction upwards");
    }

    // --- Textures

    void texture_2d(GlibArguments& arguments) {
        const int unit = arguments.unit();
        textures_[unit] = arguments.word("a file");
        material_is_current_ = false;
    }

    void cube_map(GlibArguments& arguments) {
        const int unit = arguments.unit();
        std::array<GlibWord, 6> faces;
        for (GlibWord& face : faces) face = arguments.word("six files: +x -x +y -y +z -z");
        cubes_[unit] = faces;
        material_is_current_ = false;
    }

    // --- The program

    void shader(GlibVerb verb, GlibArguments& arguments, std::string_view file_name) {
        read_glib_shader(arguments, file_name);
        seen_.emplace(verb, arguments.name().at);
    }

    void program(GlibArguments& arguments) {
        if (!seen_.contains(GlibVerb::vertex) || !seen_.contains(GlibVerb::fragment))
            arguments.fail(arguments.name().at, "a program without its shaders",
                           "Vertex Parallax.vert and Fragment Parallax.frag before it");
        program_ = read_glib_program(arguments);
        if (!program_->samplers.contains("Normal_Map"))
            arguments.fail(arguments.name().at, "no Normal_Map",
                           "it, since its alpha is the height of the relief");
        material_is_current_ = false;
    }

    template <class Bound>
    const Bound& bound(const std::map<int, Bound>& units, const GlibSampler& sampler,
                       const GlibBinding& binding, std::string_view command) const {
        const auto found = units.find(binding.unit);
        if (found != units.end()) return found->second;
        throw InputError(file_.string(), std::string(sampler.uniform),
                         "texture unit " + std::to_string(binding.unit) + ", which has none",
                         "the unit of a " + std::string(command) + " before the shape",
                         binding.at.line, binding.at.column);
    }

    void add_map(Json& material, const std::string& path, const GlibSampler& sampler,
                 const GlibBinding& binding) {
        const GlibWord& file = bound(textures_, sampler, binding, "Texture2D");
        const std::string here = join_key(path, sampler.map);
        place(here, file.at);
        Json& map = material[std::string(sampler.map)];
        map["file"] = with_slashes(file.text).string();
        if (!sampler.swizzle.empty()) map["swizzle"] = sampler.swizzle;
        map["flip_v"] = true;
    }

    Json relief(const std::string& path) {
        place(path, program_->at);
        Json out{{"frame", "frame-thesis"},
                 {"trace", "linear-thesis"},
                 {"surface", "h2n-thesis@published"},
                 {"shadow", "shadow-march-thesis@published"}};
        if (program_->depth) {
            place(join_key(path, "depth"), program_->depth->at);
            out["depth"] = program_->depth->value;
        }
        return out;
    }

    void add_material() {
        const std::size_t count = materials_.size() + 1;
        material_ = count == 1 ? "Parallax" : "Parallax-" + std::to_string(count);
        const std::string path = join_key("materials", material_);
        place(path, program_->at);
        Json material = Json::object();
        for (const GlibSampler& sampler : glib_samplers) {
            const auto given = program_->samplers.find(sampler.uniform);
            if (given != program_->samplers.end() && sampler.map != "environment")
                add_map(material, path, sampler, given->second);
        }
        material["relief"] = relief(join_key(path, "relief"));
        material["shade"] = "shade-thesis@published";
        materials_[material_] = std::move(material);
        material_is_current_ = true;
    }

    Json environment_of_program() {
        const auto given = program_->samplers.find("Environment_Map");
        if (given == program_->samplers.end()) return nullptr;
        const auto& faces = bound(cubes_, glib_samplers[0], given->second, "CubeMap");
        Json out = Json::array();
        for (std::size_t i = 0; i < faces.size(); ++i) {
            place(join_index("environment.faces", i), faces[i].at);
            out.push_back(with_slashes(faces[i].text).string());
        }
        return Json{{"faces", out}};
    }

    void use_environment(const GlibArguments& arguments) {
        const Json environment = environment_of_program();
        if (objects_.empty() && !environment.is_null()) document_.root["environment"] = environment;
        const auto first = document_.root.find("environment");
        if (environment != (first == document_.root.end() ? Json() : *first))
            arguments.fail(arguments.name().at, "another Environment_Map than the first shape has",
                           "one for the whole scene");
    }

    // --- Shapes

    void draw(GlibVerb verb, GlibArguments& arguments) {
        if (!program_)
            arguments.fail(arguments.name().at, "a shape without a program",
                           "Program Parallax before it");
        GlibShape shape = read_glib_shape(verb, arguments);
        if (!material_is_current_) add_material();
        use_environment(arguments);
        const std::string path = join_index("objects", objects_.size());
        place(path, arguments.name().at);
        for (const auto& [key, at] : shape.positions) place(join_key(path, key), at);
        shape.object["material"] = material_;
        objects_.push_back(std::move(shape.object));
    }

    const std::filesystem::path& file_;
    TextPosition end_{1, 1};  ///< behind the last command
    SceneDocument document_;
    Json objects_, materials_;
    // Until LookAt says otherwise, glman's eye is at the origin and looks along -z.
    Json camera_{{"type", "perspective"}, {"eye", {0, 0, 0}}, {"target", {0, 0, -1}}};
    std::map<GlibVerb, TextPosition> seen_;
    std::map<int, GlibWord> textures_;
    std::map<int, std::array<GlibWord, 6>> cubes_;
    std::optional<GlibProgram> program_;
    std::string material_;
    bool material_is_current_ = false;  ///< no program or texture since it was made
};

}  // namespace

SceneDocument parse_glib_text(std::string_view text, const std::filesystem::path& file) {
    GlibScene scene(file);
    for (const GlibCommand& command : split_glib(text, file)) scene.take(command);
    return scene.finish();
}

}  // namespace quadrel

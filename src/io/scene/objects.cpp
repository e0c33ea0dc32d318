#include "io/scene/objects.hpp"

#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {
namespace {

class ObjectReader {
  public:
    ObjectReader(Fields& root, const TextureTable& textures, Scene& scene)
        : scene_(scene), sources_{textures, scene.hardware, *scene.texture_cache, scene.notes} {
        if (root.has("meshes")) read_named_meshes(root.get("meshes"));
    }

    void read(const SceneValue& value) {
        Fields fields(value);
        Object object;
        object.name = "object " + std::to_string(scene_.objects.size());
        fields.read("name", object.name);
        object.mesh = mesh_index(fields.get("mesh"));
        object.material = material_index(fields);
        if (fields.has("transform")) object.transform = read_transform(fields.get("transform"));
        fields.read("visible", object.visible);
        fields.finish("an object");
        check_binding(object, value);
        scene_.objects.push_back(object);
    }

  private:
    void read_named_meshes(const SceneValue& meshes) {
        Fields fields(meshes);
        for (const std::string& name : fields.rest()) add_mesh(name, meshes.member(name));
    }

    std::size_t add_mesh(const std::string& name, const SceneValue& value) {
        Mesh mesh = read_mesh(value, sources_);
        vertices_ += mesh.positions.size();
        if (vertices_ > max_mesh_vertices)
            value.fail("a mesh that makes " + std::to_string(vertices_) + " vertices in all",
                       "at most " + std::to_string(max_mesh_vertices) + " in a scene");
        mesh.name = name;
        scene_.meshes.push_back(std::move(mesh));
        return named_[name] = scene_.meshes.size() - 1;
    }

    // Meshes of equal description are loaded once.
    std::size_t mesh_index(const SceneValue& value) {
        const bool is_name = value.json().is_string();
        const std::string key = is_name ? value.string() : value.json().dump();
        if (const auto found = named_.find(key); found != named_.end()) return found->second;
        if (is_name) check_mesh_name(value);
        return add_mesh(key, value);
    }

    void check_mesh_name(const SceneValue& value) const {
        std::vector<std::string> known = {"quad",  "cube",   "icosahedron", "sphere",
                                          "torus", "teapot", "billboard"};
        for (const auto& word : known)
            if (word == value.string()) return;
        for (const auto& [name, index] : named_)
            if (name[0] != '{') known.push_back(name);
        value.reject("the name of a mesh or shape: " + one_of(value.string(), known));
    }

    std::size_t material_index(Fields& object) {
        std::vector<std::string> known;
        for (const Material& material : scene_.materials) known.push_back(material.name);
        if (!object.has("material")) {
            if (known.size() == 1) return 0;
            object.value().fail("no \"material\"",
                                "it, since there are several: " + one_of("", known));
        }
        const SceneValue value = object.get("material");
        const std::string name = value.string();
        for (std::size_t i = 0; i < known.size(); ++i)
            if (known[i] == name) return i;
        value.reject("the name of a material: " + one_of(name, known));
    }

    void check_binding(const Object& object, const SceneValue& value) const {
        const Material& material = scene_.materials[object.material];
        const bool bare = material.textures.empty() && !material.noise;
        if (bare || !scene_.meshes[object.mesh].uvs.empty()) return;
        value.member("mesh").fail(
            "a mesh without texture coordinates",
            "some, since the material \"" + material.name + "\" has textures");
    }

    Scene& scene_;
    MeshSources sources_;
    std::map<std::string, std::size_t> named_;
    std::size_t vertices_ = 0;  ///< of all meshes so far
};

}  // namespace

void read_objects(Fields& fields, const TextureTable& textures, Scene& scene) {
    ObjectReader reader(fields, textures, scene);
    if (!fields.has("objects")) return;
    const SceneValue objects = fields.get("objects");
    if (!objects.json().is_array()) objects.reject("an array of objects");
    for (std::size_t i = 0; i < objects.json().size(); ++i) reader.read(objects.element(i));
}

}  // namespace quadrel

// Scenes, and what there is to choose from.
#include <pybind11/stl.h>

#include "python/bindings.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "render/lists/rows.hpp"
#include "render/plan/plan.hpp"

namespace quadrel::python {
namespace {

std::shared_ptr<LoadedScene> load(const std::string& file_or_name,
                                  const std::vector<std::string>& assignments,
                                  const LoadedScene* before) {
    const Unlocked unlocked;
    const auto scene = std::make_shared<LoadedScene>();
    scene->inputs =
        inputs_of([&] { static_cast<Scene&>(*scene) = load_scene(file_or_name, assignments); });
    // A stage's name and its parameters are known now: who sets one need not render to hear that it
    // is wrong.
    for (const Material& material : scene->materials) material_stages(*scene, material);
    if (before != nullptr) scene->texture_cache = before->texture_cache;
    return scene;
}

std::string list_json(ListRows (*make)(), const std::vector<std::string>& words) {
    ListRows rows = make();
    std::erase_if(rows, [&](const ListRow& row) { return !has_all_words(row, words); });
    return rows_json(rows);
}

}  // namespace

void bind_scenes(py::module_& module) {
    py::class_<LoadedScene, std::shared_ptr<LoadedScene>>(module, "Scene")
        .def_property_readonly(
            "file", [](const LoadedScene& scene) { return py::bytes(scene.file.string()); })
        .def_readonly("width", &LoadedScene::width)
        .def_readonly("height", &LoadedScene::height)
        .def_readonly("canonical", &LoadedScene::canonical)
        .def_readonly("hash", &LoadedScene::hash)
        .def_readonly("notes", &LoadedScene::notes);
    module.def("load_scene", load, py::arg("file_or_name"), py::arg("assignments"),
               py::arg("before") = nullptr);
    const auto add_list = [&](const char* name, ListRows (*make)()) {
        module.def(
            name, [make](const std::vector<std::string>& words) { return list_json(make, words); },
            py::arg("words"));
    };
    add_list("list_algorithms", algorithm_rows);
    add_list("list_channels", channel_rows);
    add_list("list_presets", preset_rows);
    add_list("list_scenes", scene_rows);
    module.def(
        "load_plugin", [](const std::string& file) { load_plugin(file); }, py::arg("file"));
}

}  // namespace quadrel::python

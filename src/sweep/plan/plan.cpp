#include "sweep/plan/plan.hpp"

#include <algorithm>

#include "file/read_file.hpp"
#include "io/document/value.hpp"
#include "sweep/plan/plan_algorithms.hpp"
#include "sweep/plan/plan_checks.hpp"
#include "sweep/plan/plan_maps.hpp"
#include "sweep/plan/plan_values.hpp"

namespace quadrel::sweep {
namespace {

constexpr double steepest_view = 89.5;

// Scenes

PlannedScene read_scene(const SceneValue& value) {
    PlannedScene scene;
    if (value.json().is_string()) {
        scene.file_or_name = value.string();
    } else {
        Fields fields(value);
        scene.file_or_name = fields.get("scene").string();
        fields.read("name", scene.name);
        if (fields.has("set")) {
            const SceneValue set = fields.get("set");
            if (!set.json().is_object()) set.reject("an object of keys of the scene");
            for (const auto& [key, member] : set.json().items())
                scene.overrides.push_back(key + "=" + member.dump());
        }
        fields.finish("a scene of a plan");
    }
    const std::string named = scene.file_or_name.string();
    if (named.empty()) value.fail("an empty name", "a scene file or the name of an installed one");
    if (scene.name.empty()) scene.name = scene.file_or_name.stem().string();
    // A file is meant from the plan on, an installed scene by its name.
    if (scene.file_or_name.has_extension() && scene.file_or_name.is_relative())
        scene.file_or_name = value.document().file.parent_path() / scene.file_or_name;
    return scene;
}

// How they are run

View read_view(const SceneValue& value) {
    if (!value.json().is_string()) return {value.number({0, steepest_view})};
    word_in(value, {"camera"});
    return {};
}

void read_size(Fields& fields, Plan& plan) {
    if (!fields.has("size")) return;
    const SceneValue size = fields.get("size");
    if (!size.json().is_array() || size.json().size() != 2)
        size.reject("an array of 2: width and height in pixels");
    plan.width = size.element(0).integer(8, 8192);
    plan.height = size.element(1).integer(8, 8192);
}

void read_pictures(Fields& fields, PictureSettings& pictures) {
    if (!fields.has("pictures")) return;
    Fields own(fields.get("pictures"));
    own.read("side", pictures.side, 16, 256);
    own.read("most", pictures.most, 0, 2000);
    if (own.has("angles"))
        for (const SceneValue& value : distinct_elements(own.get("angles")))
            pictures.angles.push_back(value.number({0, steepest_view}));
    own.finish("the pictures of a plan");
}

void read_running(Fields& fields, Plan& plan) {
    read_size(fields, plan);
    fields.read("samples", plan.samples, 1, 16);
    fields.read("repeats", plan.repeats, 1, 1000);
    fields.read("repeat_seconds", plan.repeat_seconds, above_zero);
    fields.read("wrong_texels", plan.wrong_texels, above_zero);
    fields.read("published_on", plan.published_on);
    if (fields.has("numbers")) {
        plan.numbers.clear();
        for (const SceneValue& value : distinct_elements(fields.get("numbers")))
            plan.numbers.push_back(word_in(value, {"float", "double"}));
    }
    if (fields.has("isa")) {
        plan.isas.clear();
        for (const SceneValue& value : distinct_elements(fields.get("isa")))
            plan.isas.push_back(
                word_in(value, {"auto", "scalar", "sse4", "avx2", "avx512", "neon"}));
    }
    if (fields.has("threads")) {
        plan.threads.clear();
        for (const SceneValue& value : distinct_elements(fields.get("threads")))
            plan.threads.push_back(value.integer(1, 1024));
    }
    read_pictures(fields, plan.pictures);
}

constexpr const char* plan_keys[] = {"sweep",        "title",          "scenes",  "maps",
                                     "views",        "algorithms",     "size",    "samples",
                                     "repeats",      "repeat_seconds", "isa",     "wrong_texels",
                                     "published_on", "numbers",        "threads", "pictures"};

SceneDocument open_plan(const std::filesystem::path& file) {
    SceneDocument document = parse_scene_text(read_whole_file(file), file);
    const SceneValue root(document, document.root, "");
    if (!root.json().is_object() || root.json().empty())
        root.reject("a plan: an object { \"sweep\": 1, ... }");
    const std::string first = root.json().begin().key();
    if (first != "sweep")
        root.member(first).fail("\"" + first + "\" as the first key",
                                "\"sweep\": 1, the format's version, first");
    const std::vector<std::string> known(std::begin(plan_keys), std::end(plan_keys));
    for (const auto& [key, member] : root.json().items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            root.member(key).fail("an unknown key", one_of(key, known));
    return document;
}

}  // namespace

std::string View::name() const { return angle ? short_number(*angle) : "camera"; }

Plan read_plan(const std::filesystem::path& file) {
    const SceneDocument document = open_plan(file);
    Fields fields(SceneValue(document, document.root, ""));
    Plan plan;
    plan.file = file;
    fields.get("sweep").integer(1, 1);
    plan.title = file.stem().string();
    fields.read("title", plan.title);
    for (const SceneValue& value : elements(fields.get("scenes")))
        plan.scenes.push_back(read_scene(value));
    if (fields.has("maps"))
        for (const SceneValue& value : elements(fields.get("maps"))) read_map(value, plan.maps);
    else
        plan.maps.push_back(scene_map());
    for (const SceneValue& value : distinct_elements(fields.get("views")))
        plan.views.push_back(read_view(value));
    plan.algorithms = read_algorithms(elements(fields.get("algorithms")));
    read_running(fields, plan);
    fields.finish("a plan");
    check_plan(plan, fields.value());
    return plan;
}

}  // namespace quadrel::sweep

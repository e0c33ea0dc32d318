#include "io/gltf/schema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

enum class Kind {
    whole,      ///< an integer from `least`
    bytes,      ///< the same, which may be large
    numbers,    ///< an array of `least` numbers; 0: of any length
    wholes,     ///< an array of integers from 0
    text,       ///<
    boolean,    ///<
    object,     ///< of the section `below`
    list,       ///< an array of such
    wholes_of,  ///< an object of integers from 0, by any names
    lists_of,   ///< an array of such
};

struct Property {
    const char* section;
    const char* key;
    Kind kind;
    int least = 0;
    const char* below = "";
    bool required = false;
};

constexpr bool required = true;

// glTF 2.0, 5.
constexpr Property properties[] = {
    {"root", "asset", Kind::object, 0, "asset", required},
    {"root", "accessors", Kind::list, 0, "accessor"},
    {"root", "buffers", Kind::list, 0, "buffer"},
    {"root", "bufferViews", Kind::list, 0, "bufferView"},
    {"root", "materials", Kind::list, 0, "material"},
    {"root", "meshes", Kind::list, 0, "mesh"},
    {"root", "nodes", Kind::list, 0, "node"},
    {"root", "scene", Kind::whole},
    {"root", "scenes", Kind::list, 0, "scene"},
    {"root", "skins", Kind::list, 0, "skin"},
    {"asset", "version", Kind::text, 0, "", required},
    {"accessor", "bufferView", Kind::whole},
    {"accessor", "byteOffset", Kind::bytes},
    {"accessor", "componentType", Kind::whole, 0, "", required},
    {"accessor", "count", Kind::whole, 1, "", required},
    {"accessor", "max", Kind::numbers},
    {"accessor", "min", Kind::numbers},
    {"accessor", "normalized", Kind::boolean},
    {"accessor", "sparse", Kind::object, 0, "sparse"},
    {"accessor", "type", Kind::text, 0, "", required},
    {"sparse", "count", Kind::whole, 1, "", required},
    {"sparse", "indices", Kind::object, 0, "sparse indices", required},
    {"sparse", "values", Kind::object, 0, "sparse values", required},
    {"sparse indices", "bufferView", Kind::whole, 0, "", required},
    {"sparse indices", "byteOffset", Kind::whole},
    {"sparse indices", "componentType", Kind::whole, 0, "", required},
    {"sparse values", "bufferView", Kind::whole, 0, "", required},
    {"sparse values", "byteOffset", Kind::whole},
    {"buffer", "byteLength", Kind::bytes, 1, "", required},
    {"buffer", "uri", Kind::text},
    {"bufferView", "buffer", Kind::whole, 0, "", required},
    {"bufferView", "byteLength", Kind::bytes, 1, "", required},
    {"bufferView", "byteOffset", Kind::bytes},
    {"bufferView", "byteStride", Kind::whole, 4},
    {"mesh", "primitives", Kind::list, 0, "primitive", required},
    {"mesh", "weights", Kind::numbers},
    {"primitive", "attributes", Kind::wholes_of, 0, "", required},
    {"primitive", "indices", Kind::whole},
    {"primitive", "material", Kind::whole},
    {"primitive", "mode", Kind::whole},
    {"primitive", "targets", Kind::lists_of},
    {"node", "children", Kind::wholes},
    {"node", "matrix", Kind::numbers, 16},
    {"node", "mesh", Kind::whole},
    {"node", "rotation", Kind::numbers, 4},
    {"node", "scale", Kind::numbers, 3},
    {"node", "skin", Kind::whole},
    {"node", "translation", Kind::numbers, 3},
    {"node", "weights", Kind::numbers},
    {"scene", "nodes", Kind::wholes},
    {"skin", "inverseBindMatrices", Kind::whole},
    {"skin", "joints", Kind::wholes, 0, "", required},
    {"skin", "skeleton", Kind::whole},
};

class Checker {
  public:
    explicit Checker(const std::string& name) : name_(name) {}

    json section(const json& value, const std::string& section, const std::string& path) const {
        if (!value.is_object()) fail(path, value, "an object");
        json out = json::object();
        for (const Property& property : properties) {
            if (property.section != section) continue;
            const std::string key = path.empty() ? property.key : path + "." + property.key;
            const auto found = value.find(property.key);
            if (found != value.end())
                out[property.key] = this->value(*found, property, key);
            else if (property.required)
                throw InputError(name_, path, "no \"" + std::string(property.key) + "\"", "one");
        }
        return out;
    }

  private:
    [[noreturn]] void fail(const std::string& key, const json& found,
                           const std::string& expected) const {
        const bool large = found.is_structured() && found.size() > 4;
        throw InputError(name_, key, large ? std::string(found.type_name()) : found.dump(),
                         expected);
    }

    json value(const json& value, const Property& property, const std::string& key) const {
        switch (property.kind) {
            case Kind::whole:
                return whole(value, property.least, key);
            case Kind::bytes:
                return whole(value, property.least, key, 0x1p53);
            case Kind::numbers:
                return numbers(value, static_cast<std::size_t>(property.least), key);
            case Kind::text:
                if (!value.is_string()) fail(key, value, "a string");
                return value;
            case Kind::boolean:
                if (!value.is_boolean()) fail(key, value, "true or false");
                return value;
            case Kind::object:
                return section(value, property.below, key);
            case Kind::wholes_of:
                return wholes_of(value, key);
            default:
                return list(value, property, key);
        }
    }

    json list(const json& value, const Property& property, const std::string& key) const {
        if (!value.is_array()) fail(key, value, "an array");
        json out = json::array();
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string place = key + "[" + std::to_string(i) + "]";
            if (property.kind == Kind::wholes) out.push_back(whole(value[i], 0, place));
            if (property.kind == Kind::lists_of) out.push_back(wholes_of(value[i], place));
            if (property.kind == Kind::list)
                out.push_back(section(value[i], property.below, place));
        }
        return out;
    }

    json wholes_of(const json& value, const std::string& key) const {
        if (!value.is_object()) fail(key, value, "an object");
        json out = json::object();
        for (const auto& [name, member] : value.items())
            out[name] = whole(member, 0, key + "." + name);
        return out;
    }

    json whole(const json& value, int least, const std::string& key,
               double most = std::numeric_limits<std::int32_t>::max()) const {
        const double number = value.is_number() ? value.get<double>() : -1;
        if (!value.is_number() || number != std::floor(number) || number < least || number > most)
            fail(key, value, "an integer from " + std::to_string(least));
        return static_cast<std::uint64_t>(number);
    }

    json numbers(const json& value, std::size_t count, const std::string& key) const {
        const bool fits = value.is_array() && (count == 0 || value.size() == count) &&
                          std::all_of(value.begin(), value.end(),
                                      [](const json& element) { return element.is_number(); });
        if (!fits)
            fail(key, value,
                 count == 0 ? "an array of numbers" : std::to_string(count) + " numbers");
        return value;
    }

    const std::string& name_;
};

}  // namespace

json checked_gltf(const std::string& name, const json& root) {
    return Checker(name).section(root, "root", "");
}

}  // namespace quadrel

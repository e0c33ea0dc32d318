#include "io/exr/attributes.hpp"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <set>

namespace quadrel {
namespace {

bool describes_storage(const std::string& name) {
    static const std::set<std::string> names = {"channels",
                                                "chunkCount",
                                                "compression",
                                                "dataWindow",
                                                "displayWindow",
                                                "lineOrder",
                                                "name",
                                                "tiles",
                                                "type",
                                                "version",
                                                "pixelAspectRatio",
                                                "screenWindowCenter",
                                                "screenWindowWidth"};
    return names.count(name) != 0;
}

template <class T>
const T* as(const Imf::Attribute& attribute) {
    const auto* typed = dynamic_cast<const Imf::TypedAttribute<T>*>(&attribute);
    return typed == nullptr ? nullptr : &typed->value();
}

std::string attribute_text(const Imf::Attribute& attribute) {
    if (const auto* text = as<std::string>(attribute)) return *text;
    if (const auto* number = as<int>(attribute)) return fmt::format("{}", *number);
    if (const auto* number = as<float>(attribute)) return fmt::format("{}", *number);
    if (const auto* number = as<double>(attribute)) return fmt::format("{}", *number);
    if (const auto* v = as<Imath::V2f>(attribute)) return fmt::format("{} {}", v->x, v->y);
    if (const auto* v = as<Imath::V3f>(attribute)) return fmt::format("{} {} {}", v->x, v->y, v->z);
    return fmt::format("<{}>", attribute.typeName());
}

}  // namespace

Attributes read_attributes(const Imf::Header& header) {
    Attributes attributes;
    for (auto i = header.begin(); i != header.end(); ++i)
        if (!describes_storage(i.name())) attributes[i.name()] = attribute_text(i.attribute());
    return attributes;
}

}  // namespace quadrel

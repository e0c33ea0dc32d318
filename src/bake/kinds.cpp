#include "bake/kinds.hpp"

#include <fmt/format.h>

#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel {

const BakeKindRow& bake_row(BakeKind kind) {
    const BakeKindRow& row = bake_rows().at(static_cast<std::size_t>(kind));
    QUADREL_CHECK_OP(==, static_cast<int>(row.info.kind), static_cast<int>(kind));
    return row;
}

const std::vector<BakeKindInfo>& bake_kinds() {
    static const std::vector<BakeKindInfo> kinds = [] {
        std::vector<BakeKindInfo> all;
        for (const BakeKindRow& row : bake_rows()) all.push_back(row.info);
        return all;
    }();
    return kinds;
}

const BakeKindInfo& bake_kind_info(BakeKind kind) { return bake_row(kind).info; }

BakeKind bake_kind_from_name(std::string_view name) {
    std::vector<std::string> names;
    for (const BakeKindRow& row : bake_rows()) {
        if (name == row.info.name) return row.info.kind;
        names.emplace_back(row.info.name);
    }
    throw UsageError(fmt::format("kind: found \"{}\", expected {}", name, one_of(name, names)));
}

bool bakes_layers(BakeKind kind) { return bake_row(kind).heights == Heights::layers; }

double bake_seconds_estimate(BakeKind kind, int width, int height) {
    return bake_row(kind).seconds(static_cast<double>(width) * height);
}

bool is_quick_to_bake(BakeKind kind) {
    return kind == BakeKind::max_mip || kind == BakeKind::min_max || kind == BakeKind::texel_max ||
           kind == BakeKind::layer_bounds;
}

}  // namespace quadrel

#include "page/view.hpp"

#include <optional>
#include <string_view>

#include "page/bits.hpp"
#include "page/range_codes.hpp"
#include "page/template.hpp"
#include "text/printable.hpp"

namespace quadrel::page {
namespace {

Json window_json(const Window& window) {
    return Json::array({window.x0, window.y0, window.x1, window.y1});
}

/// The plane of an earlier source that is stored in the same places, so that bits that are equal
/// take no room.
const Plane* earlier_plane(const ViewSource* earlier, const ViewSource& source,
                           const Plane& plane) {
    if (earlier == nullptr || earlier->image.film.window != source.image.film.window)
        return nullptr;
    return earlier->image.film.find(plane.name);
}

Json channel_json(const ViewSource& source, const Plane& plane, const Plane* earlier) {
    return {{"name", plane.name},
            {"type", plane.type == ChannelType::uint32 ? "uint32" : "float32"},
            {"stored", storage_name(source.image.stored.at(plane.name))},
            {"against", earlier != nullptr},
            {"bits", packed_bits(plane.bits,
                                 earlier != nullptr ? std::span<const std::uint32_t>(earlier->bits)
                                                    : std::span<const std::uint32_t>(),
                                 static_cast<std::size_t>(source.image.film.window.width()))}};
}

std::vector<float> floats_of(const Plane& plane) {
    std::vector<float> values(plane.bits.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = plane.as_float(i);
    return values;
}

/// A bound of another channel's values: that channel, and which end.
struct BoundOf {
    const Plane* values;
    RangeEnd end;
};
std::optional<BoundOf> bound_of(const Film& film, const Plane& plane) {
    using namespace std::string_view_literals;
    // A gap is rounded inwards, so that it leaves out nothing that is permitted.
    for (const auto& [group, end] : {std::pair{"gpu.lo."sv, RangeEnd::low},
                                     {"gpu.hi."sv, RangeEnd::high},
                                     {"gpu.gap.lo."sv, RangeEnd::high},
                                     {"gpu.gap.hi."sv, RangeEnd::low}})
        if (plane.name.starts_with(group))
            if (const Plane* const values = film.find(plane.name.substr(group.size()));
                values != nullptr && values->type == ChannelType::float32)
                return BoundOf{values, end};
    return std::nullopt;
}

Json bound_json(const ViewSource& source, const Plane& plane, const BoundOf& of) {
    const std::vector<std::uint32_t> codes =
        range_codes(floats_of(*of.values), floats_of(plane), of.end);
    return {{"name", plane.name},
            {"type", "float32"},
            {"stored", storage_name(source.image.stored.at(plane.name))},
            {"beside", of.values->name},
            {"end", of.end == RangeEnd::low ? "low" : "high"},
            {"bits", packed_bits(codes)}};
}

/// `rounded`: bounds stand behind the channels that they are of, and go as small numbers.
Json source_json(const ViewSource& source, const ViewSource* earlier, bool rounded = false) {
    const Film& film = source.image.film;
    Json channels = Json::array();
    for (const Plane& plane : film.planes) {
        const auto bound = rounded ? bound_of(film, plane) : std::nullopt;
        channels.push_back(
            bound ? bound_json(source, plane, *bound)
                  : channel_json(source, plane, earlier_plane(earlier, source, plane)));
    }
    return {{"name", source.name},
            {"frame", window_json(film.frame)},
            {"window", window_json(film.window)},
            {"attributes", source.image.attributes},
            {"channels", channels}};
}

std::string title_of(std::span<const ViewSource> sources) {
    std::string title;
    for (const ViewSource& source : sources)
        title += (title.empty() ? "" : " and ") + printable(source.name);
    return title;
}

/// `scripts` follow those of the viewer.
std::string page_of(const Json& data, const std::string& scripts, const std::string& styles,
                    const std::string& title) {
    PageTemplate page("page/view.html");
    page.fill("/*{{SCRIPT}}*/", page_parts({"page/base.js", "page/sources.js", "page/values.js",
                                            "page/pictures.js", "page/panels.js", "page/view.js"}) +
                                    scripts + page_part("page/start.js"));
    page.fill("{{SOURCES}}", embedded_json(data));
    page.fill("/*{{STYLE}}*/", page_parts({"page/base.css", "page/view.css"}) + styles);
    page.fill("{{HEADING}}", escaped_text(title));
    page.fill("{{TITLE}}", escaped_text(title));
    return page.text();
}

}  // namespace

std::string view_html(std::span<const ViewSource> sources) {
    Json all = Json::array();
    for (std::size_t i = 0; i < sources.size(); ++i)
        all.push_back(source_json(sources[i], i > 0 ? &sources[i - 1] : nullptr));
    return page_of({{"sources", all}}, "", "", title_of(sources));
}

std::string judge_html(const ViewSource& reference, const Json& scene, const std::string& title) {
    const Json data{{"sources", Json::array({source_json(reference, nullptr, true)})},
                    {"scene", scene}};
    return page_of(
        data,
        page_parts({"page/webgl_text.js", "page/webgl.js", "page/webgpu.js", "page/judge.js",
                    "page/rules_gl.js", "page/rules_words.js", "page/rules.js"}),
        page_part("page/judge.css"), title);
}

}  // namespace quadrel::page

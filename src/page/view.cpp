#include "page/view.hpp"

#include "page/bits.hpp"
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

Json source_json(const ViewSource& source, const ViewSource* earlier) {
    const Film& film = source.image.film;
    Json channels = Json::array();
    for (const Plane& plane : film.planes)
        channels.push_back(channel_json(source, plane, earlier_plane(earlier, source, plane)));
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

}  // namespace

std::string view_html(std::span<const ViewSource> sources) {
    Json all = Json::array();
    for (std::size_t i = 0; i < sources.size(); ++i)
        all.push_back(source_json(sources[i], i > 0 ? &sources[i - 1] : nullptr));
    PageTemplate page("page/view.html");
    page.fill("/*{{SCRIPT}}*/", page_parts({"page/base.js", "page/sources.js", "page/values.js",
                                            "page/pictures.js", "page/panels.js", "page/view.js"}));
    page.fill("{{SOURCES}}", embedded_json({{"sources", all}}));
    page.fill("/*{{STYLE}}*/", page_parts({"page/base.css", "page/view.css"}));
    page.fill("{{HEADING}}", escaped_text(title_of(sources)));
    page.fill("{{TITLE}}", escaped_text(title_of(sources)));
    return page.text();
}

}  // namespace quadrel::page

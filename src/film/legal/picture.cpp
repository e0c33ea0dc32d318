// The verdicts as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "film/draw.hpp"
#include "film/legal/verdict.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

struct Colour {
    std::uint8_t r, g, b;
};

/// By LegalVerdict; Okabe and Ito 2008, but for the gray.
constexpr std::array<Colour, legal_verdict_count> colours = {
    {{0, 114, 178}, {240, 228, 66}, {160, 160, 160}, {213, 94, 0}}};

constexpr int columns = 6, margin = 4, swatch = 11, legend_gap = 10;

/// The worst verdict of each pixel over some channels, and whether there is one.
struct Verdicts {
    std::vector<LegalVerdict> worst;
    std::vector<bool> judged;
    bool any = false;

    explicit Verdicts(std::size_t pixels) : worst(pixels, LegalVerdict::pass), judged(pixels) {}

    void raise(std::size_t i, LegalVerdict verdict) {
        worst[i] = std::max(worst[i], verdict);
        judged[i] = any = true;
    }
};

/// What a panel shows: all channels together come first.
struct Panel {
    std::string name;
    Verdicts verdicts;
};

void judge_channel(const LegalReference& reference, std::size_t plane, const Film& test,
                   const LegalRules& rules, std::array<Verdicts*, 2> into) {
    const Plane& values = reference.values.planes[plane];
    const Plane* other = test.find(values.name);
    if (other == nullptr) return;
    const std::vector<std::size_t> pixels = pixels_in(test, reference.values.window);
    const std::vector<Covered> covered = compare_coverage(reference, test, pixels);
    const double extent = extent_of(reference.values, values, rules.left_out);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (!rules.left_out.empty() && rules.left_out[i]) continue;
        const LegalVerdict verdict =
            pixels[i] == no_pixel || covered[i] == Covered::alone_decided ? LegalVerdict::fail
            : covered[i] == Covered::alone_undecided
                ? LegalVerdict::ambiguous
                : legal_verdict(range_at(reference, plane, i), value_of(*other, pixels[i]), extent,
                                rules.widest);
        for (Verdicts* verdicts : into) verdicts->raise(i, verdict);
    }
}

std::vector<Panel> judge_panels(const LegalReference& reference, const Film& test,
                                const LegalRules& rules) {
    const std::size_t pixels = reference.values.window.area();
    std::vector<Panel> panels{{"all channels", Verdicts(pixels)}};
    panels.reserve(reference.values.planes.size() + 1);
    for (std::size_t plane = 0; plane < reference.values.planes.size(); ++plane) {
        const std::string name = vector_of(reference.values.planes[plane].name);
        auto panel = std::find_if(panels.begin(), panels.end(),
                                  [&](const Panel& one) { return one.name == name; });
        if (panel == panels.end()) panel = panels.insert(panel, {name, Verdicts(pixels)});
        judge_channel(reference, plane, test, rules, {&panels.front().verdicts, &panel->verdicts});
    }
    std::erase_if(panels, [](const Panel& panel) { return !panel.verdicts.any; });
    return panels;
}

void paint(Picture& picture, int x, int y, LegalVerdict verdict) {
    const Colour& colour = colours[static_cast<std::size_t>(verdict)];
    picture.set(x, y, colour.r, colour.g, colour.b);
}

SheetEntry entry_of(const Panel& panel, const Window& window) {
    SheetEntry entry{panel.name, Picture(window.width(), window.height(), 0)};
    std::size_t i = 0;
    for (int y = 0; y < entry.picture.height; ++y)
        for (int x = 0; x < entry.picture.width; ++x, ++i)
            if (panel.verdicts.judged[i]) paint(entry.picture, x, y, panel.verdicts.worst[i]);
    return entry;
}

/// The four colours with their names, one below the other.
Picture legend() {
    constexpr int width = swatch + margin + 13 * text_letter_width;
    Picture picture(width, static_cast<int>(legal_verdict_count) * (swatch + 2), paper);
    for (std::size_t i = 0; i < legal_verdict_count; ++i) {
        const int top = static_cast<int>(i) * (swatch + 2);
        for (int y = 0; y < swatch; ++y)
            for (int x = 0; x < swatch; ++x)
                paint(picture, x, top + y, static_cast<LegalVerdict>(i));
        draw_label(picture, swatch + margin, top + (swatch - text_height) / 2,
                   width - swatch - margin, legal_verdict_name(static_cast<LegalVerdict>(i)));
    }
    return picture;
}

}  // namespace

Picture legal_picture(const LegalReference& reference, const Film& test, const LegalRules& rules) {
    if (reference.values.frame != test.frame) throw UsageError("heat map: the frames differ");
    std::vector<SheetEntry> entries;
    for (const Panel& panel : judge_panels(reference, test, rules))
        entries.push_back(entry_of(panel, reference.values.window));
    if (entries.empty()) throw UsageError("heat map: no channel is judged");
    const Picture sheet = contact_sheet(entries, columns), key = legend();
    Picture all(std::max(sheet.width, key.width + 2 * margin),
                sheet.height + legend_gap + key.height + margin, paper);
    draw_picture(all, 0, 0, sheet);
    draw_picture(all, margin, sheet.height + legend_gap, key);
    return all;
}

}  // namespace quadrel

// The viewer: a page that shows every value of one image or of two; and the judge's page, where the
// second one is what the visitor's GPU draws.
#pragma once

#include <span>
#include <string>

#include "io/document/json.hpp"
#include "quadrel/film/comparable.hpp"

namespace quadrel::page {

/// An image under the name that the page gives it.
struct ViewSource {
    std::string name;
    ComparableImage image;
};

/// One HTML file, self-contained, of one or two sources; a second one is the test of the first.
/// Values are embedded by their bits, so the page shows what the file holds. The template lies in
/// the data directory: page/view.html and what it names. Throws InputError if it does not.
std::string view_html(std::span<const ViewSource> sources);

/// The same page of one source, which draws `scene` for the second: a manifest of an exported scene
/// with `data` for its files, as src/export/scene/judge_page.hpp makes it. Ends of ranges in the
/// source (gpu.lo.X, gpu.hi.X behind X) are rounded outwards by 1/8 of their distance from X, those
/// of gaps (gpu.gap.lo.X, gpu.gap.hi.X) inwards.
std::string judge_html(const ViewSource& reference, const Json& scene, const std::string& title);

}  // namespace quadrel::page

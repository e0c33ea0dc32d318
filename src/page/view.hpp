// The viewer: a page that shows every value of one image or of two.
#pragma once

#include <span>
#include <string>

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

}  // namespace quadrel::page

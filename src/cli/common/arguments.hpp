// Values of command-line arguments.
#pragma once

#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel::cli {

/// "a,b,c" in its parts, blanks around them dropped. Throws UsageError for an empty part.
std::vector<std::string> parse_list(const std::string& option, const std::string& text);

/// The same of values of a scene: commas within brackets, braces and quotes do not separate.
std::vector<std::string> parse_values(const std::string& option, const std::string& text);

struct Size {
    int width = 0, height = 0;
};

/// "640x480", each 1 to 65536. Throws UsageError.
Size parse_size(const std::string& option, const std::string& text);

/// "x0,y0,x1,y1", half-open, not empty, nothing negative. Throws UsageError.
Window parse_window(const std::string& option, const std::string& text);

struct Pixel {
    int x = 0, y = 0;
};

/// "x,y", image coordinates. Throws UsageError.
Pixel parse_pixel(const std::string& option, const std::string& text);

/// One of several jobs that share a work.
struct Task {
    int number = 1, of = 1;
};

/// "I/N" with 1 <= I <= N; empty is 1/1. Throws UsageError.
Task parse_task(const std::string& text);

/// `overrides` with --size ("" for none) as the last, so that it wins over -D. Throws UsageError.
std::vector<std::string> with_size(std::vector<std::string> overrides, const std::string& size);

}  // namespace quadrel::cli

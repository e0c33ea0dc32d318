// The snippets of data/snippets as a browser's GPU runs them, and what compare --decode reads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "browser.hpp"
#include "page/planted.hpp"
#include "page/template.hpp"
#include "quadrel/film/value_bits.hpp"

namespace quadrel::page_tests {
namespace {

using planted::PageError;
using testing_films::TemporaryFolder;

/// Floats of every class by their bits, denormals, NaN and both zeros included.
std::vector<std::uint32_t> all_kinds() {
    std::vector<std::uint32_t> bits = {0x00000000, 0x80000000, 0x00000001, 0x807fffff,
                                       0x00800000, 0x3f800000, 0xbf7fffff, 0x7f7fffff,
                                       0x7f800000, 0xff800000, 0x7fc00000, 0x3eaaaaab};
    std::mt19937 random(5);
    while (bits.size() < 64) bits.push_back(static_cast<std::uint32_t>(random()));
    return bits;
}

/// The codes of each target, by its name.
using Codes = std::map<std::string, std::vector<std::uint32_t>>;

/// What stands in one element of the page.
std::string element(const std::string& dom, const std::string& id) {
    const std::string start = "<pre id=\"" + id + "\">";
    const std::size_t from = dom.find(start);
    if (from == std::string::npos) return "";
    return dom.substr(from + start.size(), dom.find("</pre>", from) - from - start.size());
}

Codes codes_in(const std::string& text) {
    Codes codes;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        for (std::uint32_t code = 0; words >> code;) codes[name].push_back(code);
    }
    return codes;
}

/// A row of pixels as a file would have it.
ComparableImage image_of(const std::vector<std::uint32_t>& codes, std::size_t each,
                         const std::vector<double>& most) {
    const Window window{0, 0, static_cast<int>(codes.size() / each), 1};
    ComparableImage image{"target", {window, window, {}}, {}, {}};
    const char* names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < most.size(); ++c) {
        Plane& plane = image.film.add(names[c], ChannelType::float32);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            plane.bits[i] = testing_films::bits(static_cast<float>(codes[i * each + c] / most[c]));
        image.stored[names[c]] = most[c] == 255 ? Storage::unorm8 : Storage::unorm16;
    }
    return image;
}

std::vector<std::uint32_t> apart(const std::vector<std::uint32_t>& packed) {
    std::vector<std::uint32_t> codes;
    for (const std::uint32_t word : packed)
        for (int shift = 0; shift < 40; shift += 10) codes.push_back(word >> shift & 1023);
    return codes;
}

/// Whether every layout gives the bits back that went in.
testing::AssertionResult come_back(const Codes& codes, const std::vector<std::uint32_t>& bits) {
    const Window window{0, 0, static_cast<int>(bits.size()), 1};
    Film reference{window, window, {}};
    reference.add("v", ChannelType::float32).bits = bits;
    canonicalize(reference);
    const std::vector<double> bytes(4, 255);
    const auto decoded = [&](const std::vector<BitImage>& images) {
        return decode_bits(images, reference).film.planes[0] == reference.planes[0];
    };
    const auto image = [&](BitLayout layout, const std::vector<std::uint32_t>& from,
                           std::vector<double> most) {
        return BitImage{{layout, {"v"}, {}}, image_of(from, 4, most)};
    };
    if (!decoded({image(BitLayout::rgba8, codes.at("rgba8"), bytes)}))
        return testing::AssertionFailure() << "rgba8";
    if (!decoded({image(BitLayout::low, codes.at("low"), bytes),
                  image(BitLayout::high, codes.at("high"), bytes)}))
        return testing::AssertionFailure() << "low and high";
    if (!decoded({image(BitLayout::rg16, codes.at("rg16"), {65535, 65535})}))
        return testing::AssertionFailure() << "rg16";
    if (!decoded({image(BitLayout::rgb10a2, apart(codes.at("rgb10a2")), {1023, 1023, 1023, 3})}))
        return testing::AssertionFailure() << "rgb10a2";
    return testing::AssertionSuccess();
}

TEST(Snippets, BringEveryBitBackFromABrowser) {
    if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    const std::vector<std::uint32_t> bits = all_kinds();
    page::PageTemplate page(std::filesystem::path(QUADREL_SOURCE_DIR) /
                            "tests/data/page/snippets.html");
    page.fill("{{BITS}}", "[" + fmt::format("{}", fmt::join(bits, ",")) + "]");
    page.fill("{{WGSL}}", page::page_part("snippets/pack.wgsl"));
    page.fill("{{GLSL}}", page::page_part("snippets/pack.glsl"));
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "page.html", page.text());
    ASSERT_TRUE(testing_browser::browse(
        folder, "page.html",
        "--use-angle=swiftshader --enable-unsafe-swiftshader --enable-unsafe-webgpu "
        "--use-webgpu-adapter=swiftshader --virtual-time-budget=10000 --dump-dom",
        "dom"));
    const std::string dom = testing_films::file_bytes(folder / "dom");
    int run = 0;
    for (const char* api : {"webgl2", "webgpu"}) {
        const std::string text = element(dom, api);
        EXPECT_EQ(text.find("error"), std::string::npos) << text;
        Codes codes = codes_in(text);
        if (!codes.contains("rgb10a2")) {
            std::cout << "not judged: the browser has no " << api << "\n";
            continue;
        }
        ++run;
        EXPECT_TRUE(come_back(codes, bits)) << api;
        codes["rgba8"][5] ^= 1;
        EXPECT_FALSE(come_back(codes, bits)) << static_cast<int>(PageError::wrong_code);
    }
    if (run == 0) GTEST_SKIP() << "the browser has neither WebGL 2 nor WebGPU";
}

/// By glslang, which knows HLSL, too.
bool compiles(const std::string& options, const std::string& source) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "shader.frag", source);
    const std::string line = "cd '" + folder.path().string() + "' && glslangValidator " + options +
                             " shader.frag >log 2>&1";
    return std::system(line.c_str()) == 0;
}

TEST(Snippets, Compile) {
    if (std::system("command -v glslangValidator >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no glslangValidator on PATH";
    const std::string uses =
        "pack_rgba8(b) + pack_rgb8(b, b & 1u) + pack_rg16(b) + "
        "pack_rgb10a2(b) * float(pack_rg16ui(b).x + pattern_bits(b, b))";
    const std::string main =
        "in float x; out vec4 color; void main() { uint b = value_bits(x); color = " + uses +
        "; }\n";
    const std::string glsl = page::page_part("snippets/pack.glsl") + main;
    EXPECT_TRUE(compiles("", "#version 330 core\n" + glsl));
    EXPECT_TRUE(
        compiles("", "#version 300 es\nprecision highp float; precision highp int;\n" + glsl));
    const std::string hlsl =
        page::page_part("snippets/pack.hlsl") +
        "float4 main(float x : TEXCOORD0) : SV_Target0 { uint b = value_bits(x); return " + uses +
        "; }\n";
    EXPECT_TRUE(compiles("-D -V -S frag -e main", hlsl));
    EXPECT_FALSE(compiles("-D -V -S frag -e main", glsl))
        << static_cast<int>(PageError::wrong_language);
}

}  // namespace
}  // namespace quadrel::page_tests

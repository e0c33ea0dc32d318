#include "stress/log.hpp"

#include "file/read_file.hpp"
#include "quadrel/error.hpp"
#include "stress/wire.hpp"

namespace quadrel::stress {

ResultLog::ResultLog(const std::filesystem::path& file, std::uint64_t seed, double look_ups)
    : file_(file), first_(Json{{"quadrel-stress", 1}, {"seed", seed}, {"look_ups", look_ups}}) {
    std::error_code none;
    const bool is_old = std::filesystem::exists(file, none);
    std::string text = is_old ? read_whole_file(file) : "";
    const std::size_t last = text.rfind('\n');
    if (last == std::string::npos && !text.empty()) refuse(text);
    text.resize(last + 1);  // npos + 1 is 0
    read(text);
    if (is_old) std::filesystem::resize_file(file, text.size(), none);
    out_.open(file, std::ios::binary | std::ios::app);
    if (text.empty()) write_line(first_);
    if (!out_ || none) throw OutputError(file.string(), "could not be written");
}

void ResultLog::add(const std::string& scene, const SceneResult& result) {
    write_line({{"scene", scene}, {"result", Json::parse(to_line(result))}});
}

void ResultLog::refuse(const std::string& first) const {
    constexpr std::size_t most_shown = 100;
    throw InputError(file_.string(), "", "\"" + first.substr(0, most_shown) + "\"",
                     "a log of such a run, which begins with " + first_.dump());
}

void ResultLog::read(const std::string& text) {
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = text.find('\n', begin);
        const Json line =
            Json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                        text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        // What is no JSON is neither equal to anything nor unequal.
        if (begin == 0 && !(line == first_)) refuse(text.substr(0, end));
        if (begin == 0) continue;
        if (!line.is_object() || !line.contains("scene") || !line.contains("result"))
            throw InputError(file_.string(), "", "a line that is none of a log",
                             "a scene and its result");
        known_[line["scene"]] = from_line(line["result"].dump());
    }
}

void ResultLog::write_line(const Json& line) {
    out_ << line.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
    if (!out_) throw OutputError(file_.string(), "could not be written");
}

}  // namespace quadrel::stress

// render --tev: what a viewer is sent, by a stand-in that reads the protocol as tev's own reader
// does.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstring>
#include <map>
#include <optional>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;
using testing_films::write_bytes;
using Words = std::vector<std::string>;

/// Listens on a free port of the loopback interface.
class StandIn {
  public:
    StandIn() : listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(listen(listener_, 4), 0);
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
    }
    ~StandIn() { stop(); }
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;

    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

    /// All bytes of the next connection, or the first `most` of them.
    std::string receive(std::size_t most = std::string::npos) const {
        const int connection = accept(listener_, nullptr, nullptr);
        std::string bytes;
        char buffer[65536];
        while (bytes.size() < most) {
            const ssize_t size = read(connection, buffer, sizeof buffer);
            if (size <= 0) break;
            bytes.append(buffer, static_cast<std::size_t>(size));
        }
        close(connection);
        return bytes;
    }

    void stop() {
        if (listener_ >= 0) close(std::exchange(listener_, -1));
    }

  private:
    int listener_;
    int port_ = 0;
};

/// The image that packets make, as a viewer keeps it.
struct ViewedImage {
    std::string name;
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;
    int updates = 0;
};

class PacketReader {
  public:
    explicit PacketReader(const std::string& bytes) : bytes_(bytes) {}

    template <class Number>
    Number number() {
        Number value{};
        if (at_ + sizeof value > bytes_.size()) throw std::runtime_error("a packet ends early");
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    std::string text() {
        const std::size_t end = bytes_.find('\0', at_);
        if (end == std::string::npos) throw std::runtime_error("a text has no end");
        std::string text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return text;
    }
    bool at_end() const { return at_ == bytes_.size(); }
    std::size_t position() const { return at_; }

  private:
    const std::string& bytes_;
    std::size_t at_ = 0;
};

Words read_names(PacketReader& reader) {
    Words names(static_cast<std::size_t>(reader.number<std::int32_t>()));
    for (std::string& name : names) name = reader.text();
    return names;
}

void create(PacketReader& reader, ViewedImage& image) {
    image.width = reader.number<std::int32_t>();
    image.height = reader.number<std::int32_t>();
    for (const std::string& name : read_names(reader))
        image.channels[name].assign(static_cast<std::size_t>(image.width * image.height), -77);
}

void update(PacketReader& reader, const std::string& packet, ViewedImage& image) {
    const Words names = read_names(reader);
    const auto x0 = reader.number<std::int32_t>(), y0 = reader.number<std::int32_t>();
    const auto width = reader.number<std::int32_t>(), height = reader.number<std::int32_t>();
    std::vector<std::int64_t> offsets(names.size()), strides(names.size());
    for (std::int64_t& offset : offsets) offset = reader.number<std::int64_t>();
    for (std::int64_t& stride : strides) stride = reader.number<std::int64_t>();
    if (x0 < 0 || y0 < 0 || x0 + width > image.width || y0 + height > image.height)
        throw std::runtime_error("a tile lies outside");
    const char* const data = packet.data() + reader.position();
    const std::size_t floats = (packet.size() - reader.position()) / sizeof(float);
    for (std::size_t c = 0; c < names.size(); ++c)
        for (int i = 0; i < width * height; ++i) {
            const auto from = static_cast<std::size_t>(offsets[c] + i * strides[c]);
            if (from >= floats) throw std::runtime_error("a tile's data end early");
            const int x = x0 + i % width, y = y0 + i / width;
            std::memcpy(&image.channels.at(names[c])[static_cast<std::size_t>(y * image.width + x)],
                        data + from * sizeof(float), sizeof(float));
        }
    ++image.updates;
}

ViewedImage view(const std::string& bytes) {
    ViewedImage image;
    for (std::size_t at = 0; at < bytes.size();) {
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + at, sizeof size);
        if (size < 6 || at + size > bytes.size()) throw std::runtime_error("a packet's length");
        const std::string packet = bytes.substr(at, size);
        at += size;
        PacketReader reader(packet);
        reader.number<std::uint32_t>();
        const auto kind = reader.number<char>();
        reader.number<char>();  // whether it takes the focus
        image.name = reader.text();
        if (kind == 4)
            create(reader, image);
        else if (kind == 6)
            update(reader, packet, image);
        else
            throw std::runtime_error("a packet of another kind");
    }
    return image;
}

class Tev : public testing::Test {
  protected:
    void SetUp() override {
        write_bytes(folder / "scene.json", R"({"quadrel": 1, "size": [150, 140],
            "material": {"shade": "shade-lambert"}, "objects": [{"mesh": "torus"}]})");
    }
    pid_t start_render(const Words& more) {
        Words words{"render", "scene.json", "-o", "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return start(words, folder.path(), logs.path());
    }
    TemporaryFolder folder, logs;
    StandIn viewer;
};

TEST_F(Tev, IsSentEveryPixelInTiles) {
    const pid_t child = start_render(
        {"--tev", viewer.address(), "--channels", "R,Z,hit.status", "--window", "7,3,149,140"});
    const ViewedImage image = view(viewer.receive());
    ASSERT_EQ(wait_for(child), 0) << testing_films::file_bytes(logs / "err");
    const Film film = read_exr(folder / "a.exr").film;
    EXPECT_EQ(image.name, "a.exr");
    EXPECT_EQ(image.width, film.window.width());
    EXPECT_EQ(image.height, film.window.height());
    EXPECT_GE(image.updates, 9);
    ASSERT_EQ(image.channels.size(), 3u);
    for (const Plane& plane : film.planes)
        for (std::size_t i = 0; i < plane.bits.size(); ++i) {
            const float shown = image.channels.at(plane.name)[i];
            const float drawn = plane.type == ChannelType::float32
                                    ? plane.as_float(i)
                                    : static_cast<float>(plane.bits[i]);
            ASSERT_EQ(shown, drawn) << plane.name << " " << i;
        }
}

TEST_F(Tev, BrokenStreamsAreNoticedByTheStandIn) {
    const pid_t child = start_render({"--tev=" + viewer.address()});
    const std::string bytes = viewer.receive();
    EXPECT_EQ(wait_for(child), 0);
    EXPECT_NO_THROW(view(bytes));
    std::string bad = bytes;
    bad[4] = 5;
    EXPECT_THROW(view(bad), std::runtime_error);
    EXPECT_THROW(view(bytes.substr(0, bytes.size() - 1)), std::runtime_error);
}

/// The file is what matters.
TEST_F(Tev, AViewerThatGoesIsAWarning) {
    const pid_t child = start_render({"--size", "1024x1024", "--tev", viewer.address()});
    viewer.receive(1000);
    EXPECT_EQ(wait_for(child), 0);
    EXPECT_NE(testing_films::file_bytes(logs / "err").find("warning: tev"), std::string::npos);
    EXPECT_EQ(read_exr(folder / "a.exr").film.window.width(), 1024);
}

TEST_F(Tev, NoViewerIsOneLineAndNoFile) {
    const std::string address = viewer.address();
    viewer.stop();
    for (const auto& [value, code] :
         std::vector<std::pair<std::string, int>>{{address, 5},
                                                  {"nowhere", 2},
                                                  {"", 2},
                                                  {"host:", 2},
                                                  {":1", 2},
                                                  {"127.0.0.1:70000", 2}}) {
        const Outcome outcome =
            run({"render", "scene.json", "-o", "a.exr", "--tev=" + value}, folder.path());
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.err.find(value), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

/// Without an address: where tev listens by itself, and a scene may follow.
TEST_F(Tev, TheAddressMayBeLeftOut) {
    const Outcome outcome = run({"render", "--tev", "scene.json", "-o", "a.exr"}, folder.path());
    EXPECT_TRUE(outcome.code == 0 || outcome.err.find("127.0.0.1:14158") != std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace quadrel::cli_tests

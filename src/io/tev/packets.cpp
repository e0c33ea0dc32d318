#include "io/tev/packets.hpp"

#include <bit>
#include <cstring>

namespace quadrel {
namespace {

static_assert(std::endian::native == std::endian::little, "as the protocol is");

enum class Kind : char { create_image = 4, update_image_v3 = 6 };

class Packet {
  public:
    explicit Packet(Kind kind) : bytes_(sizeof(std::uint32_t), '\0') {
        bytes_ += static_cast<char>(kind);
    }

    template <class Number>
    void add(Number number) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof number);
        std::memcpy(bytes_.data() + at, &number, sizeof number);
    }
    void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
    void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }

    std::string finished() {
        const auto size = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &size, sizeof size);
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

void add_channels(const Film& film, Packet& packet) {
    packet.add(static_cast<std::int32_t>(film.planes.size()));
    for (const Plane& plane : film.planes) packet.add(plane.name);
}

constexpr char keep_focus = 0;

}  // namespace

std::string tev_create_image(const std::string& name, const Film& layout) {
    Packet packet(Kind::create_image);
    packet.add(keep_focus);
    packet.add(name);
    packet.add(std::int32_t{layout.window.width()});
    packet.add(std::int32_t{layout.window.height()});
    add_channels(layout, packet);
    return packet.finished();
}

std::string tev_update_image(const std::string& name, const Film& film, const Window& part,
                             const Window& whole) {
    Packet packet(Kind::update_image_v3);
    packet.add(keep_focus);
    packet.add(name);
    add_channels(film, packet);
    for (const int number : {part.x0 - whole.x0, part.y0 - whole.y0, part.width(), part.height()})
        packet.add(std::int32_t{number});
    const auto pixels = static_cast<std::int64_t>(part.area());
    for (std::size_t c = 0; c < film.planes.size(); ++c)
        packet.add(static_cast<std::int64_t>(c) * pixels);  // where the channel begins
    for (std::size_t c = 0; c < film.planes.size(); ++c) packet.add(std::int64_t{1});  // its stride
    packet.reserve(part.area() * film.planes.size() * sizeof(float));
    for (const Plane& plane : film.planes)
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x) {
                const std::size_t i = film.index(x, y);
                packet.add(plane.type == ChannelType::float32 ? plane.as_float(i)
                                                              : static_cast<float>(plane.bits[i]));
            }
    return packet.finished();
}

}  // namespace quadrel

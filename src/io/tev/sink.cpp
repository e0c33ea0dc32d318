#include "io/tev/sink.hpp"

#include <algorithm>
#include <utility>

#include "io/tev/packets.hpp"

namespace quadrel {
namespace {

constexpr int tile_side = 64;

class TevSink : public BandSink {
  public:
    TevSink(TevConnection& connection, std::string name, const Film& layout)
        : connection_(connection), name_(std::move(name)), whole_(layout.window) {
        connection_.send(tev_create_image(name_, layout));
    }

    BandStep take(std::shared_ptr<const Film> band) override {
        return {{}, [this, band = std::move(band)] {
                    send_to_tev(connection_, name_, *band, band->window, whole_);
                }};
    }

  private:
    TevConnection& connection_;
    std::string name_;
    Window whole_;
};

}  // namespace

std::unique_ptr<BandSink> tev_sink(TevConnection& connection, const std::string& name,
                                   const Film& layout) {
    return std::make_unique<TevSink>(connection, name, layout);
}

void send_to_tev(TevConnection& connection, const std::string& name, const Film& film,
                 const Window& part, const Window& whole) {
    for (int y = part.y0; y < part.y1; y += tile_side)
        for (int x = part.x0; x < part.x1; x += tile_side) {
            if (!connection.lost().empty()) return;
            const Window tile{x, y, std::min(x + tile_side, part.x1),
                              std::min(y + tile_side, part.y1)};
            connection.send(tev_update_image(name, film, tile, whole));
        }
}

}  // namespace quadrel

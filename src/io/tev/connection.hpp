// A connection to the image viewer tev.
#pragma once

#include <string>

namespace quadrel {

/// Where tev listens unless it is told otherwise.
inline constexpr const char* tev_address = "127.0.0.1:14158";

class TevConnection {
  public:
    /// `address` is HOST:PORT, an IPv6 address in brackets. Throws UsageError for what is none,
    /// OutputError where nobody answers within some seconds.
    explicit TevConnection(const std::string& address);
    ~TevConnection();
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Sends all of it. A viewer that has gone, or that takes nothing for some seconds, is no
    /// error: from then on nothing is sent.
    void send(const std::string& packet);

    /// Why nothing is sent any more; empty while something is.
    const std::string& lost() const { return lost_; }

  private:
    int socket_ = -1;
    std::string lost_;
};

}  // namespace quadrel

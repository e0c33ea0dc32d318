#include "io/tev/connection.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

constexpr int patience_ms = 5000;

struct HostAndPort {
    std::string host, port;
};

HostAndPort read_address(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    HostAndPort read;
    if (colon != std::string::npos) read = {address.substr(0, colon), address.substr(colon + 1)};
    int port = 0;
    const char* const end = read.port.data() + read.port.size();
    const auto [stop, error] = std::from_chars(read.port.data(), end, port);
    if (read.host.empty() || error != std::errc() || stop != end || port < 1 || port > 65535)
        throw UsageError("--tev: found \"" + address + "\", expected HOST:PORT, as " + tev_address);
    if (read.host.front() == '[' && read.host.back() == ']')
        read.host = read.host.substr(1, read.host.size() - 2);
    return read;
}

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses resolve(const std::string& address) {
    const HostAndPort where = read_address(address);
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int error = getaddrinfo(where.host.c_str(), where.port.c_str(), &wanted, &found);
    if (error != 0) throw OutputError("tev at " + address, gai_strerror(error));
    return {found, freeaddrinfo};
}

/// Whether the socket can be written within the time that a viewer has.
bool wait_to_write(int socket) {
    pollfd state{socket, POLLOUT, 0};
    int ready = -1;
    do {
        ready = poll(&state, 1, patience_ms);
    } while (ready < 0 && errno == EINTR);
    if (ready == 0) errno = ETIMEDOUT;
    return ready == 1;
}

/// -1 with errno where nobody answers.
int connect_to(const addrinfo& at) {
    const int made =
        socket(at.ai_family, at.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, at.ai_protocol);
    if (made < 0) return -1;
    int error = connect(made, at.ai_addr, at.ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS && wait_to_write(made)) {
        socklen_t size = sizeof error;
        getsockopt(made, SOL_SOCKET, SO_ERROR, &error, &size);
    } else if (error == EINPROGRESS) {
        error = errno;
    }
    if (error == 0) return made;
    close(made);
    errno = error;
    return -1;
}

}  // namespace

TevConnection::TevConnection(const std::string& address) {
    const Addresses addresses = resolve(address);
    for (const addrinfo* at = addresses.get(); at != nullptr && socket_ < 0; at = at->ai_next)
        socket_ = connect_to(*at);
    if (socket_ < 0)
        throw OutputError("tev at " + address,
                          std::string(std::strerror(errno)) + ": expected a viewer that listens");
}

TevConnection::~TevConnection() { close(socket_); }

void TevConnection::send(const std::string& packet) {
    std::size_t sent = 0;
    while (lost_.empty() && sent < packet.size()) {
        const ssize_t now =
            ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
        if (now > 0) {
            sent += static_cast<std::size_t>(now);
            continue;
        }
        const bool full = now < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
        if (now < 0 && errno == EINTR) continue;
        if (!full || !wait_to_write(socket_)) lost_ = std::strerror(errno);
    }
}

}  // namespace quadrel

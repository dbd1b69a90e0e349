// `kinesphere watch tcp://HOST:PORT`: reports that a server sends.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "program/support.hpp"
#include "program/watch/live_watch.hpp"

namespace kinesphere::program::tcp_test {
namespace {

class TcpProgram : public ProgramTest {};

/// Listens at a free port of this machine.
class TcpServer {
 public:
  TcpServer() : listening_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(listening_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(listening_, 1), 0);
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;
  ~TcpServer() {
    end_connection();
    ::close(listening_);
  }

  int port() const { return port_; }
  void accept() { connection_ = ::accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC); }
  void send(std::string_view text) const {
    ASSERT_EQ(::send(connection_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  void end_connection() {
    if (connection_ >= 0) ::close(connection_);
    connection_ = -1;
  }

 private:
  int listening_, connection_ = -1, port_ = 0;
};

TEST_F(TcpProgram, ReadsAServerAndConnectsAgain) {
  TcpServer server;
  LiveWatch watch(
      fmt::format("tcp://localhost:{} --separation sphere:9 --acceleration 1 --position-error 0.1 "
                  "--velocity-error 0.1 --look-ahead 0",
                  server.port()),
      path("err"));
  server.accept();
  server.send("id,time,x,y,vx,vy\na,0,0,0,1,0\nb,0,90,0,-1,0\na,40,40,0,1,0\nb,40,50,0");
  // The row that is cut off is none.
  server.end_connection();
  server.accept();
  server.send("id,time,x,y,vx,vy\na,41,41,0,1,0\nb,41,49,0,-1,0\n");
  const std::string alert = watch.line();
  EXPECT_NE(alert.find(R"("time": 41)"), std::string::npos) << alert;
  EXPECT_NE(alert.find(R"("verdict": "within")"), std::string::npos) << alert;
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0);
  for (const char* said : {"the connection is lost (the server has ended it): trying again each second",
                           "connected again", "malformed"})
    EXPECT_NE(watch.err().find(said), std::string::npos) << watch.err();
}

/// Digits may be missing, so that such a row means another place.
TEST_F(TcpProgram, ARowThatALostConnectionCutsOffIsNone) {
  TcpServer server;
  LiveWatch watch(fmt::format("tcp://localhost:{} --separation sphere:9 --largest-speed 2 --position-error "
                              "0.1 --only all",
                              server.port()),
                  path("err"));
  server.accept();
  server.send("id,time,y,x\na,0,0,0\nb,0,0,99\na,40,0,0\nb,40,0,9");
  server.end_connection();
  server.accept();
  server.send("id,time,y,x\na,41,0,0\nb,41,0,99\na,42,0,0\nb,42,0,5\n");
  // The first alert would be of 40.
  const std::string alert = watch.line();
  EXPECT_EQ(alert.find(R"("time": 40,)"), std::string::npos) << alert;
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0);
  EXPECT_NE(watch.err().find("expected a whole line, but it is too long or cut off"), std::string::npos)
      << watch.err();
}

/// An object shows where it ends.
TEST_F(TcpProgram, ARecordOfEachConnectionNeedsNoLineEnd) {
  TcpServer server;
  LiveWatch watch(
      fmt::format("tcp://localhost:{} --separation sphere:9 --largest-speed 2 --position-error 0.1",
                  server.port()),
      path("err"));
  for (const char* record :
       {R"({"id": "a", "time": 0, "x": 0, "y": 0})"
        "\n",
        R"({"id": "b", "time": 0, "x": 5, "y": 0})", R"({"id": "a", "time": 1, "x": 0, "y": 0})"}) {
    server.accept();
    server.send(record);
    server.end_connection();
  }
  const std::string alert = watch.line();
  EXPECT_NE(alert.find(R"("verdict": "within")"), std::string::npos) << alert;
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0);
  EXPECT_EQ(watch.err().find("malformed"), std::string::npos) << watch.err();
}

TEST_F(TcpProgram, SaysWhichAddressesThereAre) {
  for (const char* address :
       {"tcp://127.0.0.1", "tcp://:30003", "tcp://127.0.0.1:x", "tcp://127.0.0.1:70000"})
    expect_wrong_input(std::string("watch ") + address + " --separation sphere:500m",
                       {address, "tcp://HOST:PORT"});
  int port = 0;
  {
    const TcpServer gone;
    port = gone.port();
  }
  const std::string address = fmt::format("tcp://127.0.0.1:{}", port);
  expect_wrong_input("watch " + address + " --separation sphere:500m", {address, "cannot connect"});
  expect_wrong_input("watch http://receiver/data/aircraft.json --separation sphere:500m",
                     {"curl -s http://receiver/data/aircraft.json", "tcp://"});
}

}  // namespace
}  // namespace kinesphere::program::tcp_test

// The server of `kinesphere watch --serve` and `kinesphere view` against hostile clients.
#include "serving/local_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "program/serving/raw_connection.hpp"
#include "program/support.hpp"

namespace kinesphere::program::local_server_test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A server with a page of fixed content, pages made for each request, one that throws and a folder.
class LocalServerTest : public FolderTest {
 protected:
  LocalServerTest() : server_(std::make_unique<LocalServer>("--port", "default-src 'none'")) {
    std::filesystem::create_directories(path("pages/inner"));
    write("pages/index.html", "<p>index</p>");
    write("pages/inner/page.js", script);
    write("pages/empty.css", "");
    write("pages/.hidden", "hidden");
    write("secret", "secret");
    server_->serve("/fixed", "text/plain", fixed);
    server_->serve("/nothing", "text/plain", empty);
    server_->serve("/made", "text/plain", [this] {
      ++made_;
      return std::string("made for each");
    });
    server_->serve("/large", "application/octet-stream", large);
    server_->serve("/large-made", "application/octet-stream", [this] { return large; });
    server_->serve("/throws", "text/plain", []() -> std::string { throw ProgramError("no such thing"); });
    EXPECT_TRUE(server_->serve_folder("/", path("pages")));
    server_->start(0);
    const std::string address = server_->address();
    port_ = std::stoi(address.substr(address.rfind(':') + 1));
  }

  std::string host() const { return "Host: 127.0.0.1:" + std::to_string(port_) + "\r\n"; }
  std::string request(const std::string& line, const std::string& fields = "") const {
    return line + " HTTP/1.1\r\n" + host() + fields + "\r\n";
  }
  std::string raw(const std::string& bytes) const {
    const RawConnection connection(port_);
    connection.send(bytes);
    return connection.response();
  }
  std::string get(const std::string& target, const std::string& fields = "") const {
    return raw(request("GET " + target, fields));
  }
  /// Expects that another client gets its page at once.
  void expect_open_to_others() const {
    const auto start = Clock::now();
    const RawConnection connection(port_, 2);
    connection.send(request("GET /made"));
    EXPECT_EQ(body_of(connection.response()), "made for each");
    EXPECT_LT(seconds_since(start), 1.5);
  }
  void expect_quick_stop() {
    const auto start = Clock::now();
    server_.reset();
    EXPECT_LT(seconds_since(start), 1.5);
  }

  const std::string script = "let there = 'be light';";
  const std::string fixed = "0123456789abcdefghij";
  const std::string empty;
  const std::string large = std::string(std::size_t{24} << 20, 'L');
  std::atomic<int> made_ = 0;
  std::unique_ptr<LocalServer> server_;
  int port_ = 0;
};

/// No range of any kind returns a byte outside the content.
TEST_F(LocalServerTest, NoRangeLeavesTheContent) {
  const std::string ranges[] = {"60000-120000",
                                "0-0",
                                "5-2",
                                "-5",
                                "-60000",
                                "19-",
                                "20-",
                                "21-40",
                                "0-20",
                                "-",
                                "",
                                "--5",
                                "0-5,10-15",
                                "0-5,60000-60005",
                                "0-,0-,0-,0-,0-,0-,0-,0-",
                                "18446744073709551615-18446744073709551620",
                                "0-18446744073709551615",
                                "9223372036854775807-9223372036854775807",
                                "-9223372036854775808",
                                "99999999999999999999999-",
                                "0-4294967296"};
  const std::pair<const char*, std::string> pages[] = {{"/fixed", fixed},          {"/made", "made for each"},
                                                       {"/nothing", ""},           {"/", "<p>index</p>"},
                                                       {"/inner/page.js", script}, {"/empty.css", ""}};
  for (const auto& [address, content] : pages) {
    for (const std::string& range : ranges) {
      SCOPED_TRACE(std::string(address) + " " + range);
      const std::string response = get(address, "Range: bytes=" + range + "\r\n");
      EXPECT_EQ(status_of(response), 200) << response;
      EXPECT_EQ(body_of(response), content);
      EXPECT_NE(response.find("\r\nContent-Length: " + std::to_string(content.size()) + "\r\n"),
                std::string::npos)
          << response;
      const std::string head = raw(request(std::string("HEAD ") + address, "Range: bytes=" + range + "\r\n"));
      EXPECT_EQ(status_of(head), 200);
      EXPECT_EQ(body_of(head), "");
    }
  }
}

TEST_F(LocalServerTest, RefusesAllMethodsButGetAndHead) {
  for (const char* const method :
       {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "CONNECT", "TRACE", "PROPFIND", "get"}) {
    for (const char* const address : {"/fixed", "/made", "/none", "/inner/page.js"}) {
      const std::string response = raw(request(std::string(method) + " " + address));
      EXPECT_EQ(status_of(response), 405) << method << response;
      EXPECT_NE(response.find("\r\nAllow: GET, HEAD\r\n"), std::string::npos) << response;
      EXPECT_EQ(body_of(response), "");
    }
  }
  EXPECT_EQ(made_, 0);
}

/// The response comes although the body does not, and a long body is not stored.
TEST_F(LocalServerTest, RefusesBodiesUnread) {
  for (const char* const fields :
       {"Content-Length: 3000000000\r\n", "Transfer-Encoding: chunked\r\n",
        "Content-Length: 3000000000\r\nExpect: 100-continue\r\n",
        "Content-Type: multipart/form-data; boundary=x\r\nContent-Length: 3000000000\r\n",
        "Content-Encoding: gzip\r\nTransfer-Encoding: chunked\r\n"}) {
    const RawConnection connection(port_, 2);
    connection.send(request("POST /fixed", fields));
    EXPECT_EQ(status_of(connection.response()), 405) << fields;
  }
  const RawConnection connection(port_, 1);
  connection.send(request("POST /fixed", "Content-Length: 3000000000\r\n"));
  const std::string piece(1 << 20, 'x');
  std::size_t sent = 0;
  for (int k = 0; k < 64; ++k) {
    const std::size_t count = connection.send(piece);
    sent += count;
    if (count < piece.size()) break;
  }
  EXPECT_LT(sent, std::size_t{16} << 20);
}

TEST_F(LocalServerTest, IsNotConfusedByBodiesOfGets) {
  for (const char* const fields :
       {"Content-Length: -1\r\n", "Content-Length: 99999999999999999999\r\n", "Content-Length: x\r\n",
        "Content-Length: 5\r\nContent-Length: 6\r\n", "Transfer-Encoding: chunked\r\n",
        "Transfer-Encoding: gzip, chunked\r\nContent-Encoding: gzip\r\n",
        "Content-Type: multipart/form-data; boundary=\r\n", "Expect: 100-continue\r\n",
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n",
        "Connection: Upgrade, HTTP2-Settings\r\nUpgrade: h2c\r\n", "Connection: keep-alive\r\n",
        "Accept-Encoding: gzip, br\r\n"}) {
    const RawConnection connection(port_, 2);
    connection.send(request("GET /fixed", fields) + "fffffffffffffffff\r\n\x1f\x8b\x08\r\n" +
                    request("GET /made"));
    const std::string response = connection.response();
    EXPECT_EQ(status_of(response), 200) << fields << response;
    EXPECT_EQ(body_of(response), fixed) << "one request, one response: " << fields;
  }
  EXPECT_EQ(made_, 0);
}

TEST_F(LocalServerTest, RefusesWhatIsNoRequest) {
  const std::string lines[] = {"\r\n\r\n",
                               "GET\r\n\r\n",
                               "GET /fixed\r\n" + host() + "\r\n",
                               "GET  /fixed HTTP/1.1\r\n" + host() + "\r\n",
                               "GET /fixed HTTP/1.1 \r\n" + host() + "\r\n",
                               "GET /fixed HTTP/2.0\r\n" + host() + "\r\n",
                               "GET fixed HTTP/1.1\r\n" + host() + "\r\n",
                               "GET http://example.org/fixed HTTP/1.1\r\n" + host() + "\r\n",
                               "GET /fix%6 HTTP/1.1\r\n" + host() + "\r\n",
                               "GET /fix%zzed HTTP/1.1\r\n" + host() + "\r\n",
                               "GET /fixed%00 HTTP/1.1\r\n" + host() + "\r\n",
                               "GET /fixed HTTP/1.1\r\nno field\r\n" + host() + "\r\n",
                               "GET /fixed HTTP/1.1\r\n: empty\r\n" + host() + "\r\n",
                               "GET /fixed HTTP/1.1\r\nX : space\r\n" + host() + "\r\n",
                               "GET /fixed HTTP/1.1\r\n" + host() + " folded\r\n\r\n",
                               "GET /fixed HTTP/1.1\r\n" + host() + "X: a\nb\r\n\r\n",
                               "GET /fixed HTTP/1.1\r\n" + host() + std::string("X: a\0b\r\n\r\n", 10),
                               std::string(100, '\0') + "\r\n\r\n",
                               "\x16\x03\x01\x02\r\n\r\n",
                               "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"};
  for (const std::string& bytes : lines) {
    const std::string response = raw(bytes);
    EXPECT_EQ(status_of(response), 400) << bytes << "\n" << response;
    EXPECT_EQ(body_of(response), "") << bytes;
  }
  expect_open_to_others();
}

TEST_F(LocalServerTest, BoundsTheHeadOfRequests) {
  EXPECT_EQ(status_of(get("/fixed", "Cookie: " + std::string(8'000, 'c') + "\r\n")), 200);
  EXPECT_EQ(status_of(get("/fixed", "Cookie: " + std::string(40'000, 'c') + "\r\n")), 431);
  EXPECT_EQ(status_of(get("/" + std::string(40'000, 'a'))), 431);
  std::string many;
  for (int k = 0; k < 4'000; ++k) many += "X" + std::to_string(k) + ": x\r\n";
  EXPECT_EQ(status_of(get("/fixed", many)), 431);
  EXPECT_EQ(status_of(raw(std::string(100'000, 'G'))), 431);
}

/// A request under another name gets no content, and no hint which addresses exist.
TEST_F(LocalServerTest, AnswersToItsOwnNameAlone) {
  const std::string port = std::to_string(port_);
  for (const std::string& fields :
       {std::string("Host: example.org\r\n"), "Host: example.org:" + port + "\r\n",
        std::string("Host: 127.0.0.1\r\n"), "Host: 127.0.0.1:" + port + "0\r\n",
        "Host: 127.0.0.1:" + port + "\r\nHost: example.org\r\n",
        "Host: example.org\r\nHost: 127.0.0.1:" + port + "\r\n", std::string("Host:\r\n"), std::string()}) {
    for (const char* const line : {"GET /fixed", "GET /none", "HEAD /", "POST /fixed", "GET /throws",
                                   "GET /made", "GET /inner/page.js", "OPTIONS *"}) {
      const std::string response = raw(std::string(line) + " HTTP/1.1\r\n" + fields + "\r\n");
      EXPECT_EQ(status_of(response), 403) << line << fields << response;
      EXPECT_EQ(body_of(response), "");
    }
  }
  EXPECT_EQ(made_, 0);
  EXPECT_EQ(status_of(raw("GET /fixed HTTP/1.1\r\nhost:localhost:" + port + "\r\n\r\n")), 200);
}

/// Pages of other sites can make a browser send requests, but neither read nor embed the response, nor delay
/// the watch.
TEST_F(LocalServerTest, IsNoPartOfOtherSites) {
  EXPECT_EQ(status_of(get("/made", "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: no-cors\r\n")), 403);
  EXPECT_EQ(made_, 0);
  EXPECT_EQ(status_of(get("/made", "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\n")), 200)
      << "a link";
  EXPECT_EQ(status_of(get("/made", "Sec-Fetch-Site: same-origin\r\nSec-Fetch-Mode: cors\r\n")), 200);
  EXPECT_EQ(status_of(get("/made", "Sec-Fetch-Site: none\r\nSec-Fetch-Mode: navigate\r\n")), 200);
  for (const std::string& response :
       {get("/made"), get("/none"), get("/inner/page.js"), raw(request("PUT /made"))}) {
    EXPECT_NE(response.find("\r\nCross-Origin-Resource-Policy: same-origin\r\n"), std::string::npos)
        << response;
    EXPECT_NE(response.find("\r\nX-Content-Type-Options: nosniff\r\n"), std::string::npos) << response;
    EXPECT_EQ(response.find("Access-Control"), std::string::npos) << response;
  }
}

TEST_F(LocalServerTest, ServesNothingOutsideItsFolder) {
  for (const char* const target :
       {"/../secret", "/%2e%2e/secret", "/inner/../../secret", "/..%2fsecret", "/%2e%2e%2fsecret", "//secret",
        "/inner/..%5c..%5csecret", "/./index.html", "/.hidden", "/inner/%2e%2e/index.html", "/index.html/",
        "/inner", "/inner/", "//index.html", "/index.html%20", "/fixed/", "/fixe.", "/FIXED"})
    EXPECT_EQ(status_of(get(target)), 404) << target;
  EXPECT_EQ(status_of(get("/" + std::string(5'000, 'n'))), 404);
  EXPECT_EQ(body_of(get("/inner/page.js?x=../../secret")), script);
  EXPECT_EQ(body_of(get("/inner/p%61ge.js")), script);
}

TEST_F(LocalServerTest, AnswersAProblemWithoutWordsAndGoesOn) {
  const std::string response = get("/throws");
  EXPECT_EQ(status_of(response), 500);
  EXPECT_EQ(response.find("no such thing"), std::string::npos) << response;
  expect_open_to_others();
}

TEST_F(LocalServerTest, ReadsRequestsInPieces) {
  const std::string whole = request("GET /fixed");
  for (std::size_t at = 1; at < whole.size(); ++at) {
    const RawConnection connection(port_);
    connection.send(whole.substr(0, at));
    if (at % 8 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    connection.send(whole.substr(at));
    EXPECT_EQ(body_of(connection.response()), fixed) << at;
  }
  const RawConnection half_closed(port_);
  half_closed.send(whole);
  half_closed.end();
  EXPECT_EQ(body_of(half_closed.response()), fixed);
}

/// Clients that send a byte now and then delay neither other clients nor the end of the server.
TEST_F(LocalServerTest, SlowSendersLockNobodyOut) {
  std::vector<std::unique_ptr<RawConnection>> slow;
  std::atomic<bool> is_over = false;
  for (int k = 0; k < 100; ++k) {
    slow.push_back(std::make_unique<RawConnection>(port_, 1));
    slow.back()->send("GET /fixed");
  }
  std::thread drip([&] {
    while (!is_over) {
      for (const auto& connection : slow) connection->send("x");
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  for (int k = 0; k < 5; ++k) expect_open_to_others();
  expect_quick_stop();
  is_over = true;
  drip.join();
}

/// A connection is closed for a new one only if 64 newer ones are open.
TEST_F(LocalServerTest, ClosesTheOldestFirst) {
  std::vector<std::unique_ptr<RawConnection>> slow;
  const auto open = [&](int count) {
    for (int k = 0; k < count; ++k) {
      slow.push_back(std::make_unique<RawConnection>(port_));
      slow.back()->send("GET /");
    }
  };
  open(64);
  const RawConnection patient(port_);
  patient.send("GET /fixed");
  open(40);
  expect_open_to_others();
  patient.send(" HTTP/1.1\r\n" + host() + "\r\n");
  EXPECT_EQ(body_of(patient.response()), fixed);
}

/// Clients that send a body before they read still get their response.
TEST_F(LocalServerTest, LetsClientsFinishABodyThatItDiscards) {
  const RawConnection connection(port_);
  connection.send(request("POST /fixed", "Content-Length: 300000\r\n"));
  for (int k = 0; k < 3; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(connection.send(std::string(100'000, 'x')), 100'000u);
  }
  EXPECT_EQ(status_of(connection.response()), 405);
}

/// Clients that request much and read nothing delay neither other clients nor the end of the server.
TEST_F(LocalServerTest, SlowReadersLockNobodyOut) {
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int k = 0; k < 100; ++k) {
    slow.push_back(std::make_unique<RawConnection>(port_, 1));
    slow.back()->send(request(k % 10 == 0 ? "GET /large-made" : "GET /large"));
  }
  for (int k = 0; k < 5; ++k) expect_open_to_others();
  expect_quick_stop();
}

/// Content for clients that do not read it is dropped if there is more than 64 MB of it.
TEST_F(LocalServerTest, BoundsWhatItKeepsForSlowReaders) {
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int k = 0; k < 10; ++k) {
    slow.push_back(std::make_unique<RawConnection>(port_));
    slow.back()->send(request("GET /large-made"));
  }
  expect_open_to_others();
  int whole = 0;
  for (const auto& connection : slow) whole += body_of(connection->response()).size() == large.size() ? 1 : 0;
  EXPECT_LE(whole, 3);
  EXPECT_EQ(body_of(get("/large-made")).size(), large.size());
}

TEST_F(LocalServerTest, HandsOverMuchToManyAtOnce) {
  std::vector<std::thread> readers;
  std::atomic<int> right = 0;
  for (int k = 0; k < 6; ++k) readers.emplace_back([&] { right += body_of(get("/large")) == large ? 1 : 0; });
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(right, 6);
}

/// Slow clients are closed after five seconds, even if their place is not needed.
TEST_F(LocalServerTest, ClosesSlowSenders) {
  const auto start = Clock::now();
  const RawConnection slow(port_, 20);
  std::atomic<bool> is_over = false;
  std::thread drip([&] {
    slow.send("GET /");
    while (!is_over && slow.send("x") == 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  });
  EXPECT_EQ(slow.response(), "");
  is_over = true;
  drip.join();
  EXPECT_GT(seconds_since(start), 3);
  EXPECT_LT(seconds_since(start), 12);
}

TEST_F(LocalServerTest, StopsAtOnceWithNobodyThere) { expect_quick_stop(); }

TEST(LocalServerStart, NeverStartedIsNoTrouble) {
  LocalServer server("--port", "");
  EXPECT_FALSE(server.serve_folder("/", "/nowhere/at/all"));
}

}  // namespace
}  // namespace kinesphere::program::local_server_test

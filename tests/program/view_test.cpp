// `kinesphere view`: what it serves, to whom, and how it stops.
#include <csignal>
#include <cstdio>
#include <string>

#include "program/support.hpp"

#ifdef KINESPHERE_WITH_HTTPLIB
#include <httplib.h>
#endif

namespace kinesphere::program {
namespace {

class View : public ProgramTest {};

TEST_F(View, NeedsAPage) {
  expect_wrong_input("view --folder '" + path("nowhere") + "'",
                     {"--folder: expected a folder with index.html"});
  expect_wrong_input("view --port 70000", {"--port"});
}

TEST_F(View, SaysHowItIsBuilt) {
  const ProgramRun run =
      this->run("view --no-browser", "KINESPHERE_VIEWER='" + path("nowhere") + "' timeout 1 ");
  if (run.exit_code == 124) GTEST_SKIP() << "the viewer has been built here";
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find(path("nowhere")), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("cmake --preset browser"), std::string::npos) << run.err;
}

#ifdef KINESPHERE_WITH_HTTPLIB

/// A program that serves a folder until this goes.
class Served {
 public:
  explicit Served(const std::string& folder) {
    const std::string command = std::string("echo $$; exec timeout 60 '") + KINESPHERE_PROGRAM +
                                "' view --no-browser --folder '" + folder + "'";
    pipe_ = popen(command.c_str(), "r");
    char line[128];
    if (std::fgets(line, sizeof line, pipe_) != nullptr) process_ = std::stoi(line);
    if (std::fgets(line, sizeof line, pipe_) != nullptr) address_ = line;
    address_ = address_.substr(0, address_.find('\n'));
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() {
    if (pipe_ != nullptr) stop();
  }

  /// As it is printed.
  const std::string& address() const { return address_; }
  int port() const { return std::stoi(address_.substr(address_.rfind(':') + 1)); }
  httplib::Client client() const { return httplib::Client("127.0.0.1", port()); }
  /// The exit code.
  int stop() {
    kill(process_, SIGTERM);
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  FILE* pipe_ = nullptr;
  pid_t process_ = 0;
  std::string address_;
};

TEST_F(View, ServesTheFilesOfItsFolderAlone) {
  write("secret", "not for others");
  std::filesystem::create_directory(path("viewer"));
  write("viewer/index.html", "<p>the page</p>");
  write("viewer/kinesphere.wasm", "bytes");
  Served served(path("viewer"));
  ASSERT_TRUE(served.address().starts_with("http://127.0.0.1:")) << served.address();
  auto client = served.client();
  const auto page = client.Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->body, "<p>the page</p>");
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html");
  EXPECT_NE(page->get_header_value("Content-Security-Policy").find("'wasm-unsafe-eval'"), std::string::npos);
  EXPECT_EQ(client.Get("/kinesphere.wasm")->get_header_value("Content-Type"), "application/wasm");
  EXPECT_EQ(client.Get("/nothing")->status, 404);
  for (const char* const outside : {"/../secret", "/%2e%2e/secret", "/x/../../secret"})
    EXPECT_EQ(client.Get(outside)->status, 404) << outside;
  EXPECT_EQ(client.Get("/", {{"Host", "example.org"}})->status, 403);
  EXPECT_EQ(client.Get("/", {{"Host", "localhost:" + std::to_string(served.port())}})->status, 200);
  expect_wrong_input(
      "view --no-browser --folder '" + path("viewer") + "' --port " + std::to_string(served.port()),
      {"--port: expected a port of 127.0.0.1 that is free"});
  EXPECT_EQ(served.stop(), 0);
}

#endif

}  // namespace
}  // namespace kinesphere::program

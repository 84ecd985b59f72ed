#include "page/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace sluice {

namespace {
namespace fs = std::filesystem;
using nlohmann::json;

// A software renderer beside a busy build: far more than it takes, and short of CTest's own limit.
constexpr int patience_ms = 240'000;

std::string decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0, bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;  // padding
    held = held << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 0xff);
  }
  return bytes;
}

/// Replaces this process, a child, by Chromium, which reads from descriptor 3 and writes to 4.
[[noreturn]] void become_chromium(int reads, int writes, const std::vector<std::string>& words) {
  // Both are moved out of the way first: either may be 3 or 4 already.
  const int in = fcntl(reads, F_DUPFD, 10), out = fcntl(writes, F_DUPFD, 10);
  const int silence = ::open("/dev/null", O_RDWR);
  for (const int output : {0, 1, 2}) dup2(silence, output);
  dup2(in, 3);
  dup2(out, 4);
  for (const int used : {in, out, reads, writes, silence})
    if (used > 4) ::close(used);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  setpgid(0, 0);
  execv(arguments[0], arguments.data());
  _exit(127);
}
}  // namespace

std::string Browser::program() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    for (const char* folder : {"/usr/bin", "/usr/local/bin", "/snap/bin"})
      if (const fs::path path = fs::path(folder) / name; fs::exists(path)) return path.string();
  return "";
}

Browser::Browser(const fs::path& profile) {
  const std::vector<std::string> words{program(),
                                       "--remote-debugging-pipe",
                                       "--headless=new",
                                       "--no-sandbox",
                                       "--disable-gpu-sandbox",
                                       "--use-angle=swiftshader",
                                       "--enable-unsafe-swiftshader",
                                       "--hide-scrollbars",
                                       "--no-first-run",
                                       "--disable-extensions",
                                       "--disable-background-networking",
                                       "--disable-component-update",
                                       "--disable-sync",
                                       "--disable-dev-shm-usage",
                                       "--host-resolver-rules=MAP * ~NOTFOUND",
                                       "--window-size=1380,1000",
                                       "--user-data-dir=" + profile.string(),
                                       "about:blank"};
  if (words.front().empty()) throw std::runtime_error("Chromium is not installed");
  std::array<int, 2> ask_pipe{}, answer_pipe{};
  if (pipe2(ask_pipe.data(), O_CLOEXEC) != 0 || pipe2(answer_pipe.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe to the browser");
  ::signal(SIGPIPE, SIG_IGN);  // a browser that dies is told by `next_message`
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process for the browser");
  if (process_ == 0) become_chromium(ask_pipe[0], answer_pipe[1], words);
  ::close(ask_pipe[0]);
  ::close(answer_pipe[1]);
  to_ = ask_pipe[1];
  from_ = answer_pipe[0];

  const json tab = ask("Target.createTarget", {{"url", "about:blank"}});
  session_ = ask("Target.attachToTarget", {{"targetId", tab["targetId"]}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) ask(std::string(domain) + ".enable");
}

Browser::~Browser() {
  ::close(to_);
  ::close(from_);
  ::kill(-process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

json Browser::next_message() {
  for (;;) {
    if (const std::size_t end = received_.find('\0'); end != std::string::npos) {
      const json message = json::parse(received_.substr(0, end));
      received_.erase(0, end + 1);
      return message;
    }
    pollfd waiting{from_, POLLIN, 0};
    if (::poll(&waiting, 1, patience_ms) <= 0) throw std::runtime_error("the browser does not answer");
    std::array<char, 1 << 16> bytes{};
    const ssize_t count = ::read(from_, bytes.data(), bytes.size());
    if (count <= 0) throw std::runtime_error("the browser ended");
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

void Browser::note_event(const json& event) {
  const std::string method = event.value("method", "");
  const json& of = event.contains("params") ? event["params"] : event;
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Runtime.exceptionThrown") complaints_.push_back(of.dump());
  if (method == "Runtime.consoleAPICalled" && (of["type"] == "error" || of["type"] == "warning"))
    complaints_.push_back(of["args"].dump());
  if (method == "Log.entryAdded" && of["entry"]["level"] == "error")
    complaints_.push_back(of["entry"].dump());
  if (method == "Network.loadingFailed") complaints_.push_back(of.dump());
}

json Browser::ask(const std::string& method, json parameters) {
  json question{{"id", ++asked_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty()) question["sessionId"] = session_;
  const std::string text = question.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(to_, text.data() + sent, text.size() - sent);
    if (count <= 0) throw std::runtime_error("the browser ended before " + method);
    sent += static_cast<std::size_t>(count);
  }
  for (;;) {
    const json message = next_message();
    if (message.value("id", 0) != asked_) {
      note_event(message);
      continue;
    }
    if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
    return message["result"];
  }
}

void Browser::open(const std::string& address) {
  complaints_.clear();
  loaded_ = false;
  ask("Page.navigate", {{"url", address}});
  while (!loaded_) note_event(next_message());
}

json Browser::value(const std::string& expression) {
  const json answer =
      ask("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) throw std::runtime_error(answer["exceptionDetails"].dump());
  return answer["result"].value("value", json());
}

Image Browser::picture(const std::string& selector) {
  // Two frames: one that lays the page out, one in which what it draws by itself is there.
  value("document.querySelector('" + selector +
        "').scrollIntoView(), new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
        ".then(() => true)");
  return read_png(decode_base64(ask("Page.captureScreenshot", {{"format", "png"}})["data"]));
}

}  // namespace sluice

#pragma once
/// A headless Chromium that is asked over a pipe (DevTools protocol), so that a test waits for what the
/// page has done, however slow the machine: no virtual time, no guess at how long a frame takes.

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/png.h"

namespace sluice {

class Browser {
 public:
  /// Starts it. No host name resolves in it: whatever a page asks of a network fails and is a complaint.
  /// @param profile  folder of its own, made anew
  /// @throws std::runtime_error where there is no Chromium, or none that answers
  explicit Browser(const std::filesystem::path& profile);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Path of the Chromium that would be started, or "".
  static std::string program();

  /// Loads a page and waits until it and its scripts are there.
  void open(const std::string& address);
  /// Value of a JavaScript expression, promises awaited. @throws std::runtime_error if it throws
  nlohmann::json value(const std::string& expression);
  /// The window as a person would see it, scrolled to the element that `selector` names.
  Image picture(const std::string& selector);
  /// What the page complained of since it was opened: console, exceptions, refused requests.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  nlohmann::json ask(const std::string& method, nlohmann::json parameters = nlohmann::json::object());
  nlohmann::json next_message();
  void note_event(const nlohmann::json& event);

  pid_t process_ = -1;
  int to_ = -1, from_ = -1;  ///< ends of the pipes
  std::string received_;     ///< bytes after the last whole message
  std::string session_;      ///< of the attached tab
  int asked_ = 0;
  bool loaded_ = false;
  std::vector<std::string> complaints_;
};

}  // namespace sluice

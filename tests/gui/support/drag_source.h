// A file dragged onto a window, as a file manager does it: the source's side of XDND 5.
#pragma once

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>

#include "gui/support/screen.h"

namespace unshot::testing_support {

/// file:///a%20path
inline std::string fileUri(const std::filesystem::path& path) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char c : path.string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && (std::isalnum(byte) || std::string("/-._~").find(c) != std::string::npos)) {
      uri += c;
    } else {
      uri.append("%").append(1, kDigits[byte >> 4]).append(1, kDigits[byte & 15]);
    }
  }
  return uri;
}

class DragSource {
 public:
  DragSource() : display_(::XOpenDisplay(nullptr), ::XCloseDisplay) {
    if (!display_) throw std::runtime_error("no display");
    window_ = ::XCreateSimpleWindow(x(), DefaultRootWindow(x()), 0, 0, 1, 1, 0, 0, 0);
  }

  /// Drags `uris` over the middle of the window and lets go; false where the window does not take them.
  bool drop(const std::string& window, const std::string& uris) {
    target_ = std::stoul(window);
    content_ = uris;
    ::XSetSelectionOwner(x(), atom("XdndSelection"), window_, CurrentTime);
    send("XdndEnter", {own(), 5l << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
    XWindowAttributes size;
    int left = 0, top = 0;
    Window child = 0;
    ::XGetWindowAttributes(x(), target_, &size);
    ::XTranslateCoordinates(x(), target_, DefaultRootWindow(x()), 0, 0, &left, &top, &child);
    const long place = (left + size.width / 2) << 16 | (top + size.height / 2);
    send("XdndPosition", {own(), 0, place, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    if ((answer("XdndStatus").data.l[1] & 1) == 0) return false;
    send("XdndDrop", {own(), 0, CurrentTime, 0, 0});
    return answer("XdndFinished").data.l[1] != 0;  // GLFW 3.3 puts the count of bytes there, not the flag
  }

 private:
  Display* x() const { return display_.get(); }
  Atom atom(const char* name) const { return ::XInternAtom(x(), name, False); }
  long own() const { return static_cast<long>(window_); }

  void send(const char* type, const std::array<long, 5>& data) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target_;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    std::copy(data.begin(), data.end(), event.xclient.data.l);
    ::XSendEvent(x(), target_, False, NoEventMask, &event);
    ::XFlush(x());
  }

  /// Serves the selection until the window answers with this message; all zero where it does not.
  XClientMessageEvent answer(const char* type) {
    XClientMessageEvent found{};
    const bool came = eventually([&] {
      while (::XPending(x()) > 0) {
        XEvent event;
        ::XNextEvent(x(), &event);
        if (event.type == SelectionRequest) serve(event.xselectionrequest);
        if (event.type != ClientMessage || event.xclient.message_type != atom(type)) continue;
        found = event.xclient;
        return true;
      }
      return false;
    });
    if (!came) ADD_FAILURE() << "no " << type;
    return found;
  }

  void serve(const XSelectionRequestEvent& request) const {
    ::XChangeProperty(x(), request.requestor, request.property, request.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(content_.data()),
                      static_cast<int>(content_.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    ::XSendEvent(x(), request.requestor, False, NoEventMask, &event);
    ::XFlush(x());
  }

  std::unique_ptr<Display, int (*)(Display*)> display_;
  Window window_ = 0, target_ = 0;
  std::string content_;
};

}  // namespace unshot::testing_support

#include "viewer/panels/messages_panel.h"

#include "base/text.h"
#include "viewer/panels/widgets.h"

namespace unshot {

void messagesSection(Viewer& viewer) {
  const auto& log = viewer.messages().log();
  if (log.empty()) return;
  const std::size_t unread = viewer.messages().unread();
  const std::string title = "Messages (" + countText(log.size()) +
                            (unread > 0 ? ", " + countText(unread) + " unread" : "") + ")###messages";
  const bool open = ImGui::CollapsingHeader(title.c_str());
  tooltip("What was said over the scene, the newest first");
  if (!open) return;
  const ImVec4 error(0.95f, 0.55f, 0.5f, 1), other(0.5f, 0.85f, 0.5f, 1);
  for (auto one = log.rbegin(); one != log.rend(); ++one) {
    dot(one->error ? error : other);
    wrapped((one->error ? "Error: " : "") + one->text);
    if (one == log.rbegin() && ImGui::IsItemVisible()) viewer.noteMessagesRead();
  }
}

}  // namespace unshot

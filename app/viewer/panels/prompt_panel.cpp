#include "viewer/panels/prompt_panel.h"

#include <algorithm>
#include <utility>

#include "viewer/actions/action_search.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr float kRows = 14;
constexpr float kPromptWidth = 44;  // in letters' heights
constexpr float kHelpBeside = 34;   // from this width on help stands beside the names
constexpr float kHelpColumn = 15;

enum class Entered { kNothing, kEnter, kTab, kUp, kDown, kEscape };

struct Typing {
  Prompt& prompt;
  Entered entered = Entered::kNothing;
};

/// A folder that cannot be read is said in the prompt.
template <class Attempt>
void attempt(Prompt& prompt, const Attempt& what) {
  try {
    what();
  } catch (const Error& error) {
    prompt.wrong = error.fullText();
  }
}

void replaceText(ImGuiInputTextCallbackData& data, const std::string& text) {
  data.DeleteChars(0, data.BufTextLen);
  data.InsertChars(0, text.c_str());
  data.CursorPos = data.BufTextLen;
  data.ClearSelection();
}

/// At once, so that nothing that is typed meanwhile is lost.
void followPath(ImGuiInputTextCallbackData& data, Prompt& prompt) {
  attempt(prompt, [&] {
    const std::string text(data.Buf, static_cast<std::size_t>(data.BufTextLen));
    const std::string left = prompt.files.follow(text);
    if (left == text) return;
    replaceText(data, left);
    prompt.chosen = 0;
  });
}

int takeEvent(ImGuiInputTextCallbackData* data) {
  Typing& typing = *static_cast<Typing*>(data->UserData);
  if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) {
    typing.entered = Entered::kTab;
  } else if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) {
    typing.entered = data->EventKey == ImGuiKey_UpArrow ? Entered::kUp : Entered::kDown;
  } else {
    if (typing.prompt.replacement)
      replaceText(*data, *std::exchange(typing.prompt.replacement, std::nullopt));
    if (typing.prompt.kind == PromptKind::kFiles) followPath(*data, typing.prompt);
  }
  return 0;
}

/// The line, which has the keyboard for as long as it is there.
Entered typeLine(Prompt& prompt, const char* hint) {
  Typing typing{prompt};
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) return Entered::kEscape;
  if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const std::string before = prompt.text.data();
  constexpr ImGuiInputTextFlags kFlags =
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways |
      ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackHistory;
  if (ImGui::InputTextWithHint("##text", hint, prompt.text.data(), prompt.text.size(), kFlags, takeEvent,
                               &typing))
    typing.entered = Entered::kEnter;
  if (before != prompt.text.data()) {
    prompt.chosen = 0;
    prompt.wrong.clear();
  }
  return typing.entered;
}

void moveChosen(Prompt& prompt, Entered entered, std::size_t count) {
  if (count == 0) return;
  prompt.chosen = std::min(prompt.chosen, count - 1);
  if (entered == Entered::kUp) prompt.chosen = (prompt.chosen + count - 1) % count;
  if (entered == Entered::kDown) prompt.chosen = (prompt.chosen + 1) % count;
  prompt.follow_chosen = entered == Entered::kUp || entered == Entered::kDown;
}

/// A row of the list; true where it is clicked.
bool row(Prompt& prompt, std::size_t k, const std::string& text) {
  ImGui::PushID(static_cast<int>(k));
  const bool clicked = ImGui::Selectable(text.c_str(), k == prompt.chosen);
  if (k == prompt.chosen && prompt.follow_chosen) ImGui::SetScrollHereY();
  ImGui::PopID();
  if (clicked) prompt.chosen = k;
  return clicked;
}

void below(const Prompt& prompt, const std::string& help) {
  if (prompt.wrong.empty()) return dimmed(help);
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.6f, 0.5f, 1));
  wrapped(prompt.wrong);
  ImGui::PopStyleColor();
}

// Actions.

/// Performs the action, or says what is wrong with its argument, or asks for it in the line.
void enterAction(Viewer& viewer, const Action& action, const std::string& argument) {
  Prompt& prompt = viewer.ui().prompt;
  if (argument.empty() && action.needsArgument()) {
    prompt.replacement = std::string(action.key) + " ";
    return;
  }
  prompt.wrong = checkArgument(action, argument);
  if (!prompt.wrong.empty()) {
    prompt.replacement = prompt.text.data();
    return;
  }
  prompt.close();
  viewer.perform(action.key, argument);
}

std::string nameOf(const FoundAction& found) {
  const std::string argument = found.title.empty() ? std::string(found.action->argument) : found.argument;
  return std::string(found.action->key) + (argument.empty() ? "" : " " + argument);
}

/// Of the choice, or of the action.
std::string_view helpOf(const FoundAction& found) {
  return found.title.empty() ? found.action->help : std::string_view(found.title);
}

/// Name, help where there is room for it, key; true where it is clicked.
bool actionRow(Prompt& prompt, std::size_t k, const FoundAction& found) {
  const float size = ImGui::GetFontSize(), width = ImGui::GetContentRegionMax().x;
  const std::string shortcut(found.title.empty() ? found.action->shortcut.text : std::string_view());
  const float keys = shortcut.empty() ? 0 : ImGui::CalcTextSize(shortcut.c_str()).x;
  const float room = width - keys - (shortcut.empty() ? 0 : size);
  const std::string name = shortened(nameOf(found), room);
  const bool clicked = row(prompt, k, name);
  const float help = std::max(kHelpColumn * size, ImGui::CalcTextSize(name.c_str()).x + size);
  if (width > kHelpBeside * size && room > help + 4 * size) {
    ImGui::SameLine(help);
    ImGui::TextDisabled("%s", shortened(std::string(helpOf(found)), room - help).c_str());
  }
  if (!shortcut.empty()) {
    ImGui::SameLine(width - keys);
    ImGui::TextUnformatted(shortcut.c_str());
  }
  return clicked;
}

void actionsPrompt(Viewer& viewer, float height) {
  Prompt& prompt = viewer.ui().prompt;
  const Entered entered = typeLine(prompt, "What to do");
  if (entered == Entered::kEscape) return prompt.close();
  const std::string text = prompt.text.data();
  const TypedAction typed = typedAction(text);
  const std::vector<FoundAction> found = matchingActions(text);
  moveChosen(prompt, entered, found.size());
  std::optional<std::size_t> wanted;
  if (entered == Entered::kEnter && !found.empty()) wanted = prompt.chosen;
  if (entered == Entered::kTab && !found.empty())
    prompt.replacement = std::string(found[prompt.chosen].action->key) + " " + found[prompt.chosen].argument;
  ImGui::BeginChild("rows", {0, height});
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (actionRow(prompt, k, found[k])) wanted = k;
  }
  if (found.empty()) ImGui::TextDisabled("nothing; H lists keys and mouse");
  ImGui::EndChild();
  const FoundAction* chosen = found.empty() ? nullptr : &found[prompt.chosen];
  if (prompt.wrong.empty() && typed.action && !typed.argument.empty() && chosen->title.empty())
    prompt.wrong = checkArgument(*typed.action, typed.argument);
  below(prompt,
        chosen ? std::string(chosen->action->help) : "No action has this in its name or its description");
  if (wanted) enterAction(viewer, *found[*wanted].action, found[*wanted].argument);
}

// Files.

/// As many of the last folders as there is room for.
std::string endOf(const std::filesystem::path& path, float width) {
  std::string text = path.string();
  while (ImGui::CalcTextSize(text.c_str()).x > width) {
    const std::size_t slash = text.find('/', text.find('/') + 1);
    if (slash == std::string::npos) return shortened(text, width);
    text = "\u2026" + text.substr(slash);
  }
  return text;
}

void enterFile(Viewer& viewer, const FileList::Entry& entry) {
  Prompt& prompt = viewer.ui().prompt;
  const std::filesystem::path path = prompt.files.pathOf(entry);
  if (entry.folder) {
    prompt.files.open(path);
    prompt.wrong.clear();
    prompt.replacement = "";
    prompt.chosen = 0;
    return;
  }
  prompt.close();
  viewer.memory().keepSetting("folder", prompt.files.folder().string());
  viewer.perform(actionOfFile(path), path.string());
}

void filesPrompt(Viewer& viewer, float height) {
  Prompt& prompt = viewer.ui().prompt;
  ImGui::TextDisabled("%s", endOf(prompt.files.folder(), ImGui::GetContentRegionMax().x).c_str());
  const Entered entered = typeLine(prompt, "Name of a file or folder, or a path");
  if (entered == Entered::kEscape) return prompt.close();
  const std::string text = prompt.text.data();
  if (entered == Entered::kTab) prompt.replacement = prompt.files.completed(text);
  const std::vector<FileList::Entry> found = prompt.files.matching(text);
  moveChosen(prompt, entered, found.size());
  std::optional<std::size_t> wanted;
  if (entered == Entered::kEnter) {
    prompt.replacement = text;
    if (found.empty()) {
      prompt.wrong = "No folder here, and no file to open, has '" + text + "' in its name";
    } else {
      wanted = prompt.chosen;
    }
  }
  ImGui::BeginChild("rows", {0, height});
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string name = found[k].name + (found[k].folder ? "/" : "");
    if (row(prompt, k, shortened(name, ImGui::GetContentRegionMax().x))) wanted = k;
  }
  if (found.empty()) ImGui::TextDisabled("nothing");
  ImGui::EndChild();
  below(prompt, "Enter opens, Tab completes, Esc closes");
  if (wanted) attempt(prompt, [&] { enterFile(viewer, found[*wanted]); });
}

/// The line, the path or nothing above it, two lines of help below.
float promptHeightBesideRows() {
  return 5 * ImGui::GetFrameHeightWithSpacing() + 2 * ImGui::GetStyle().WindowPadding.y;
}

}  // namespace

float leastPromptHeight() { return promptHeightBesideRows() + 3 * ImGui::GetTextLineHeightWithSpacing(); }

void buildPrompt(Viewer& viewer, float middle, float top) {
  Prompt& prompt = viewer.ui().prompt;
  if (!prompt.open()) return;
  const float size = ImGui::GetFontSize();
  const float width = std::min(2 * middle - size, kPromptWidth * size);
  const float height =
      std::clamp(ImGui::GetIO().DisplaySize.y - top - promptHeightBesideRows(),
                 3 * ImGui::GetTextLineHeightWithSpacing(), kRows * ImGui::GetTextLineHeightWithSpacing());
  ImGui::SetNextWindowPos({middle, top}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::SetNextWindowBgAlpha(0.97f);
  ImGui::Begin("prompt", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  prompt.kind == PromptKind::kActions ? actionsPrompt(viewer, height) : filesPrompt(viewer, height);
  ImGui::End();
}

}  // namespace unshot

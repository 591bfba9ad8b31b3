#include "scene/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "base/error.h"
#include "scene/mtl_scan.h"
#include "scene/texture_mean.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;

/// More words than this in a mtllib are taken one by one.
constexpr std::size_t kMostJoinedWords = 32;

/// Doubts of one kind: told once, with the first of them and how many more there are.
struct Doubts {
  std::size_t count = 0;
  std::string message;
  std::string where;

  void add(const std::string& new_message, const std::string& new_where) {
    if (count++ > 0) return;
    message = new_message;
    where = new_where;
  }

  void report(Diagnostics& diagnostics, Severity severity, const std::string& code,
              const std::string& advice) const {
    if (count == 0) return;
    const std::string more = count > 1 ? " (and " + std::to_string(count - 1) + " more)" : "";
    diagnostics.push_back({severity, code, message + more, where, advice});
  }
};

/// A material as a file defines it.
struct Definition {
  MtlEntry entry;
  MtlValues values;
  fs::path file;
};

class Library {
 public:
  Library(const fs::path& obj_path, const MtlNumberReader& read_numbers)
      : obj_path_(obj_path), read_numbers_(read_numbers) {}

  void load(const ObjName& statement) {
    for (const fs::path& file : filesOf(statement)) {
      if (loaded_.insert(file).second) loadFile(file);
    }
  }

  /// The first definition of that name; a comment behind the name on either side does not matter.
  const Definition* find(const std::string& name) const {
    if (const auto it = by_name_.find(name); it != by_name_.end()) return &definitions_[it->second];
    const std::string plain(withoutComment(name));
    if (const auto it = by_name_.find(plain); it != by_name_.end()) return &definitions_[it->second];
    if (const auto it = by_plain_name_.find(plain); it != by_plain_name_.end())
      return &definitions_[it->second];
    return nullptr;
  }

  void report(Diagnostics& diagnostics) const {
    missing_.report(diagnostics, Severity::kWarning, "missing-mtl",
                    "put the MTL file beside the OBJ or correct its mtllib line; its materials are grey 0.5");
    unreadable_.report(diagnostics, Severity::kWarning, "unreadable-mtl", "export the MTL file again");
    repeated_.report(diagnostics, Severity::kNote, "repeated-material", "the first definition is used");
  }

 private:
  /// What a mtllib line names: one file whose name may hold blanks, or several files.
  std::vector<fs::path> filesOf(const ObjName& statement) {
    const fs::path folder = obj_path_.parent_path();
    const std::string place = placeOf(obj_path_, statement.line);
    if (const fs::path whole = findBeside(folder, statement.text); !whole.empty()) return {whole};
    const std::string_view text = withoutComment(statement.text);
    std::vector<std::string_view> words;
    std::string_view rest = text;
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) words.push_back(word);
    if (words.empty()) missing_.add("mtllib names no file", place);

    std::vector<fs::path> files;
    std::vector<std::string_view> not_found;
    for (std::size_t i = 0; i < words.size();) {
      const std::size_t taken = longestName(folder, words, i, files);
      if (taken == 0) not_found.push_back(words[i]);
      i += std::max<std::size_t>(taken, 1);
    }
    // Where none is found the line most likely names one file.
    if (files.empty() && !words.empty()) not_found = {text};
    for (const std::string_view name : not_found) {
      missing_.add("there is no material file '" + std::string(name) + "'", place);
    }
    return files;
  }

  /// Adds the file whose name is made of the most words from `first` on; returns how many words, 0 for no
  /// file.
  static std::size_t longestName(const fs::path& folder, const std::vector<std::string_view>& words,
                                 std::size_t first, std::vector<fs::path>& files) {
    const std::size_t last = words.size() <= kMostJoinedWords ? words.size() : first + 1;
    for (std::size_t end = last; end > first; --end) {
      const char* const begin = words[first].data();
      const std::string_view final_word = words[end - 1];
      const auto length = static_cast<std::size_t>(final_word.data() + final_word.size() - begin);
      if (fs::path file = findBeside(folder, {begin, length}); !file.empty()) {
        files.push_back(std::move(file));
        return end - first;
      }
    }
    return 0;
  }

  void loadFile(const fs::path& file) {
    std::string text;
    try {
      text = readTextFile(file);
    } catch (const Error& error) {
      unreadable_.add(std::string("material file: ") + error.what(), file.string());
      return;
    }
    const MtlScan scan = scanMtl(text);
    if (scan.entries.empty()) {
      unreadable_.add("material file: there is no newmtl in it", file.string());
      return;
    }
    const std::vector<MtlValues> values = read_numbers_(scan.plain);
    for (std::size_t i = 0; i < scan.entries.size() && i < values.size(); ++i) {
      const MtlEntry& entry = scan.entries[i];
      if (!by_name_.try_emplace(entry.name, definitions_.size()).second) {
        repeated_.add("material '" + entry.name + "' is defined more than once", placeOf(file, entry.line));
        continue;
      }
      by_plain_name_.try_emplace(std::string(withoutComment(entry.name)), definitions_.size());
      definitions_.push_back({entry, values[i], file});
    }
  }

  const fs::path& obj_path_;
  const MtlNumberReader& read_numbers_;
  std::set<fs::path> loaded_;
  std::vector<Definition> definitions_;
  std::unordered_map<std::string, std::size_t> by_name_, by_plain_name_;
  Doubts missing_, unreadable_, repeated_;
};

/// Makes a Material of a Definition.
class Converter {
 public:
  Material convert(const Definition& definition) {
    const MtlEntry& entry = definition.entry;
    Material material;
    material.name = entry.name;
    material.reflectance = reflectance(definition);
    material.emission = emission(definition);
    for (const std::string& keyword : entry.read_past) {
      read_past_keywords_.insert(keyword);
      read_past_.add("", placeOf(definition.file, entry.line));
    }
    return material;
  }

  void report(Diagnostics& diagnostics) {
    clamped_.report(diagnostics, Severity::kWarning, "reflectance-clamped",
                    "Kd is a reflectance: keep it within 0..1");
    emission_clamped_.report(diagnostics, Severity::kWarning, "emission-clamped",
                             "Ke is an emission in W/m^2: keep it finite and at least 0");
    unreadable_.report(diagnostics, Severity::kWarning, "unreadable-colour",
                       "write three numbers; spectra and CIE colours are not read");
    no_diffuse_.report(diagnostics, Severity::kNote, "no-kd", "it reflects nothing; give it a Kd");
    texture_.report(diagnostics, Severity::kWarning, "unreadable-texture",
                    "put the image beside the MTL file (PNG, JPEG, TGA, BMP, HDR); Kd alone is used");
    if (read_past_keywords_.empty()) return;
    std::string list;
    for (const std::string& keyword : read_past_keywords_) list += (list.empty() ? "" : ", ") + keyword;
    diagnostics.push_back({Severity::kNote, "read-past",
                           "not used, since every surface is diffuse and opaque: " + list, read_past_.where,
                           "only Kd, map_Kd and Ke count"});
  }

 private:
  glm::dvec3 reflectance(const Definition& definition) {
    const MtlEntry& entry = definition.entry;
    const bool textured = entry.texture_line > 0;
    const std::string quoted = "material '" + entry.name + "'";
    glm::dvec3 rho = definition.values.diffuse;
    if (entry.diffuse_text.empty() && entry.diffuse_readable) {
      // A texture without Kd is meant as it is.
      rho = glm::dvec3(textured ? 1.0 : 0.0);
      if (!textured) no_diffuse_.add(quoted + " has no Kd", placeOf(definition.file, entry.line));
    } else if (!entry.diffuse_readable) {
      rho = Material().reflectance;
      unreadable_.add(quoted + ": Kd '" + entry.diffuse_text + "' is no colour; grey 0.5 is used",
                      placeOf(definition.file, entry.diffuse_line));
    } else {
      rho = clampReflectance(rho, quoted, definition);
    }
    return textured ? rho * textureFactor(quoted, definition) : rho;
  }

  glm::dvec3 clampReflectance(const glm::dvec3& kd, const std::string& quoted, const Definition& definition) {
    glm::dvec3 rho{0.0};
    bool changed = false;
    for (int c = 0; c < 3; ++c) {
      rho[c] = kd[c] > 0 ? std::min(kd[c], 1.0) : 0.0;
      changed = changed || rho[c] != kd[c];
    }
    if (changed) {
      clamped_.add(quoted + ": Kd " + definition.entry.diffuse_text + " is outside 0..1 and was clamped",
                   placeOf(definition.file, definition.entry.diffuse_line));
    }
    return rho;
  }

  glm::dvec3 textureFactor(const std::string& quoted, const Definition& definition) {
    const std::string& name = definition.values.diffuse_texture;
    const fs::path file = findBeside(definition.file.parent_path(), name);
    auto mean = means_.find(file);
    if (mean == means_.end()) {
      mean = means_.emplace(file, file.empty() ? std::nullopt : textureMean(file)).first;
    }
    if (mean->second) return glm::min(glm::max(*mean->second, glm::dvec3(0.0)), glm::dvec3(1.0));
    texture_.add(quoted + ": the texture '" + name + "' cannot be read",
                 placeOf(definition.file, definition.entry.texture_line));
    return glm::dvec3(1.0);
  }

  glm::dvec3 emission(const Definition& definition) {
    const MtlEntry& entry = definition.entry;
    const std::string quoted = "material '" + entry.name + "'";
    if (!entry.emission_readable) {
      unreadable_.add(quoted + ": Ke '" + entry.emission_text + "' is no colour; 0 is used",
                      placeOf(definition.file, entry.emission_line));
      return glm::dvec3(0.0);
    }
    glm::dvec3 e = definition.values.emission;
    bool changed = false;
    for (int c = 0; c < 3; ++c) {
      if (e[c] >= 0 && std::isfinite(e[c])) continue;
      e[c] = 0;
      changed = true;
    }
    if (changed) {
      emission_clamped_.add(
          quoted + ": Ke " + entry.emission_text + " is negative or not finite; 0 is used there",
          placeOf(definition.file, entry.emission_line));
    }
    return e;
  }

  std::map<fs::path, std::optional<glm::dvec3>> means_;
  std::set<std::string> read_past_keywords_;
  Doubts clamped_, emission_clamped_, unreadable_, no_diffuse_, texture_, read_past_;
};

}  // namespace

ObjMaterials readMaterials(const ObjScan& scan, const fs::path& obj_path, const MtlNumberReader& read_numbers,
                           Diagnostics& diagnostics, const CancelToken& cancel) {
  Library library(obj_path, read_numbers);
  for (const ObjName& statement : scan.libraries) library.load(statement);
  library.report(diagnostics);

  ObjMaterials result;
  Converter converter;
  Doubts unknown;
  std::map<const Definition*, std::uint32_t> converted;
  for (const ObjName& name : scan.material_names) {
    cancel.check();
    const auto fresh = static_cast<std::uint32_t>(result.materials.size());
    if (const Definition* definition = library.find(name.text)) {
      const auto [place, is_new] = converted.try_emplace(definition, fresh);
      if (is_new) result.materials.push_back(converter.convert(*definition));
      result.of_name.push_back(place->second);
      continue;
    }
    unknown.add("material '" + name.text + "' is not defined", placeOf(obj_path, name.line));
    Material grey;
    grey.name = name.text;
    result.materials.push_back(grey);
    result.of_name.push_back(fresh);
  }
  converter.report(diagnostics);
  unknown.report(diagnostics, Severity::kWarning, "unknown-material",
                 "grey 0.5 without emission is used; define it in an MTL file that a mtllib line names");

  const auto nameless = std::find_if(scan.faces.begin(), scan.faces.end(),
                                     [](const ObjFace& face) { return face.material_name == kNone; });
  if (nameless != scan.faces.end()) {
    result.without_name = static_cast<std::uint32_t>(result.materials.size());
    Material grey;
    grey.name = "(none)";
    result.materials.push_back(grey);
    const auto count = std::count_if(scan.faces.begin(), scan.faces.end(),
                                     [](const ObjFace& face) { return face.material_name == kNone; });
    diagnostics.push_back(
        {Severity::kWarning, "no-material",
         counted(static_cast<std::size_t>(count), "face has", "faces have") + " no material",
         placeOf(obj_path, nameless->line),
         "grey 0.5 without emission is used; put a usemtl line before them"});
  }
  return result;
}

}  // namespace unshot

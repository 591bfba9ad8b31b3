// What a form-factor method offers: columns and rows of K, where K_vq is Lambert factor times visibility of
// receiver v and source patch q: the share of v's view that q fills. H = K S.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formfactor/receivers.h"

namespace unshot {

/// How exactly a column is known, from the least.
enum class ColumnQuality : std::uint8_t {
  kGroup,     ///< as if the patch lay anywhere in the group of patches around it
  kOnePoint,  ///< as if all of it lay in one point
  kFull       ///< as exactly as the method has it
};

/// What patch q sends where. With A the areas, sum_v A_v K_vq / A_q + escape + defect = 1.
struct Column {
  std::vector<std::uint32_t> receiver;  ///< ascending; empty where `k` has one value per receiver ...
  std::uint32_t first = 0;              ///< ... from this one on
  std::vector<float> k;                 ///< K_vq
  double escape = 0;                    ///< share of q's light that meets no surface
  double defect = 0;                    ///< share lost (or, negative, gained) by approximation
  ColumnQuality quality = ColumnQuality::kFull;
  bool at_hand = false;  ///< made of what an earlier draft was computed for; nothing was computed anew

  template <class F>
  void forEach(F&& f) const {
    for (std::size_t i = 0; i < k.size(); ++i) {
      if (k[i] != 0)
        f(receiver.empty() ? first + static_cast<std::uint32_t>(i) : receiver[i], static_cast<double>(k[i]));
    }
  }
  std::size_t bytes() const {
    return receiver.capacity() * sizeof(receiver[0]) + k.capacity() * sizeof(k[0]);
  }
};

/// Where receiver v's light comes from: sum_q K_vq + escape = 1.
struct Row {
  std::vector<std::uint32_t> source;
  std::vector<float> k;
  double escape = 0;
};

/// One way to compute K. Used from one thread; with GL, the one where its context is current.
class FormFactorMethod {
 public:
  virtual ~FormFactorMethod() = default;
  virtual ReceiverKind receiverKind() const = 0;
  /// By shooting from patch q.
  virtual Column column(std::uint32_t q) = 0;
  /// Column q sooner, `wanted` exactly or better, of the same energy; the column itself where the method has
  /// nothing cheaper, or where it would show (emitters). The same at each call.
  virtual Column draft(std::uint32_t q, ColumnQuality wanted) {
    static_cast<void>(wanted);
    return column(q);
  }
  /// By gathering at receiver v.
  virtual Row row(std::uint32_t v) = 0;
  /// Pictures drawn so far (hemicubes), for reports; 0 where the method draws none.
  virtual std::uint64_t drawn() const { return 0; }
  /// What the method chose by looking at the scene and the machine, with its reason; empty: nothing out of
  /// the ordinary.
  virtual std::string note() const { return {}; }
};

}  // namespace unshot

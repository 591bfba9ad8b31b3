// Direct solution: I - M as a dense matrix, one for each channel of its own reflectance, factorised and
// solved; then d = (I - M)^-1 U is shot, and once more for what rounding left.
//
// The factorisation is a blocked LU without pivoting, panel by panel, so that it can be paused: I - M is
// diagonally dominant (its rows, or with A its columns, reflect no more than they receive), and elimination
// keeps it so (Golub and Van Loan, Matrix Computations, 4.1.1).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "solver/brightness.h"
#include "solver/first_pass.h"
#include "solver/modes.h"

namespace unshot {
namespace {

using Matrix = Eigen::MatrixXd;  // by columns

constexpr std::uint32_t kColumnsAtOnce = 64;
// Of the free memory, so that kept form factors and the picture have their place.
constexpr double kMemoryShare = 0.5;
constexpr int kMostRounds = 4;

double bytesNeeded(std::size_t patches, int channels) {
  return static_cast<double>(channels) * static_cast<double>(patches) * static_cast<double>(patches) *
         sizeof(double);
}

class Direct final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    switch (phase_) {
      case Phase::kFirstPass:
        if (first_pass_.step(state, transport)) return 1;
        startAssembly(state);
        if (unknowns_.empty()) return std::nullopt;
        return 0;
      case Phase::kAssembly:
        assemble(state, transport);
        return 0;
      case Phase::kFactorisation:
        factorise();
        return 0;
      case Phase::kSolution:
        break;
    }
    if (!product_.running()) {
      if (rounds_ >= kMostRounds || state.onlyRoundingUnshot()) return std::nullopt;
      product_.begin(transport, solution(state));
    }
    const std::size_t used = product_.advance(transport);
    if (product_.running()) return used;
    state.add(glm::dvec3(1.0), product_.flow());
    ++rounds_;
    return used;
  }

  std::string activity() const override {
    if (phase_ == Phase::kAssembly) return "assembling the matrix";
    if (phase_ == Phase::kFactorisation) return "factorising";
    return {};
  }

  std::size_t bytes() const override {
    std::size_t values = 0;
    for (const Matrix& matrix : matrix_) values += static_cast<std::size_t>(matrix.size());
    return values * sizeof(double);
  }

 private:
  enum class Phase { kFirstPass, kAssembly, kFactorisation, kSolution };

  // Equal channels share a matrix; patches that light does not reach, or that reflect none, are no unknowns.
  void startAssembly(const RadiosityState& state) {
    const std::vector<glm::dvec3>& rho = state.reflectance();
    for (int c = 0; c < 3; ++c) {
      matrix_of_[c] = c;
      for (int b = c - 1; b >= 0; --b) {
        if (std::all_of(rho.begin(), rho.end(), [&](const glm::dvec3& r) { return r[b] == r[c]; }))
          matrix_of_[c] = matrix_of_[b];
      }
    }
    row_of_.assign(state.patchCount(), kNone);
    for (std::uint32_t q = 0; q < state.patchCount(); ++q) {
      const bool reached = state.unshot()[q] != glm::dvec3(0.0) || state.shot()[q] != glm::dvec3(0.0);
      if (!reached || rho[q] == glm::dvec3(0.0)) continue;
      row_of_[q] = static_cast<std::uint32_t>(unknowns_.size());
      unknowns_.push_back(q);
    }
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    try {
      for (int c = 0; c < 3; ++c) {
        if (matrix_of_[c] == c) matrix_[c] = Matrix::Identity(n, n);
      }
    } catch (const std::bad_alloc&) {
      throw IterationFailure(ErrorKind::kEnvironment,
                             "there is no memory for a matrix of " + std::to_string(n) + " unknowns", {},
                             "--mode gmres");
    }
    phase_ = n > 0 ? Phase::kAssembly : Phase::kSolution;
  }

  void assemble(const RadiosityState& state, Transport& transport) {
    const Receivers& receivers = transport.receivers();
    const std::size_t end = std::min<std::size_t>(done_ + kColumnsAtOnce, unknowns_.size());
    while (done_ < end) {
      const std::uint32_t q = unknowns_[done_];
      const bool at_hand = transport.isKept(q);
      transport.column(q).forEach([&](std::uint32_t v, double k) {
        for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
          const PatchShare& share = receivers.shares[s];
          if (row_of_[share.patch] == kNone) continue;
          const glm::dvec3 m = share.area / state.area()[share.patch] * k * state.reflectance()[share.patch];
          for (int c = 0; c < 3; ++c) {
            if (matrix_of_[c] == c)
              matrix_[c](row_of_[share.patch], static_cast<Eigen::Index>(done_)) -= m[c];
          }
        }
      });
      ++done_;
      if (!at_hand) break;
    }
    if (done_ < unknowns_.size()) return;
    phase_ = Phase::kFactorisation;
    done_ = 0;
  }

  // One panel of one matrix: columns [k, k + width) by rows, then the rest of the rows above, then the
  // trailing block (Golub and Van Loan, 3.2.11). The width keeps a panel at some tens of milliseconds.
  void factorise() {
    while (factorising_ < 3 && matrix_of_[factorising_] != factorising_) ++factorising_;
    if (factorising_ == 3) {
      phase_ = Phase::kSolution;
      return;
    }
    Matrix& a = matrix_[factorising_];
    const Eigen::Index n = a.rows(), k = static_cast<Eigen::Index>(done_);
    const Eigen::Index width =
        std::min<Eigen::Index>(n - k, std::clamp<Eigen::Index>(100'000'000 / (n * n), 8, 64));
    for (Eigen::Index j = k; j < k + width; ++j) {
      if (!(a(j, j) > 0)) {
        throw IterationFailure(ErrorKind::kInput,
                               "the system is singular: walls that reflect all light enclose a place", {},
                               "a reflectance (Kd) below 1 for some wall");
      }
      const Eigen::Index below = n - j - 1, right = k + width - j - 1;
      a.col(j).tail(below) /= a(j, j);
      if (right > 0) {
        a.block(j + 1, j + 1, below, right).noalias() -=
            a.col(j).tail(below) * a.row(j).segment(j + 1, right);
      }
    }
    const Eigen::Index rest = n - k - width;
    if (rest > 0) {
      auto upper = a.block(k, k + width, width, rest);
      a.block(k, k, width, width).triangularView<Eigen::UnitLower>().solveInPlace(upper);
      a.bottomRightCorner(rest, rest).noalias() -= a.block(k + width, k, rest, width) * upper;
    }
    done_ += static_cast<std::size_t>(width);
    if (done_ < unknowns_.size()) return;
    done_ = 0;
    ++factorising_;
  }

  std::vector<glm::dvec3> solution(const RadiosityState& state) const {
    std::vector<glm::dvec3> out(state.patchCount(), glm::dvec3(0.0));
    Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns_.size()));
    for (int c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < unknowns_.size(); ++i)
        x[static_cast<Eigen::Index>(i)] = state.unshot()[unknowns_[i]][c];
      const Matrix& lu = matrix_[matrix_of_[c]];
      lu.triangularView<Eigen::UnitLower>().solveInPlace(x);
      lu.triangularView<Eigen::Upper>().solveInPlace(x);
      for (std::size_t i = 0; i < unknowns_.size(); ++i)
        out[unknowns_[i]][c] = x[static_cast<Eigen::Index>(i)];
    }
    return out;
  }

  Phase phase_ = Phase::kFirstPass;
  FirstPass first_pass_;
  TransportProduct product_;
  int matrix_of_[3] = {0, 0, 0};
  Matrix matrix_[3];
  std::vector<std::uint32_t> unknowns_, row_of_;
  std::size_t done_ = 0;
  int factorising_ = 0, rounds_ = 0;
};

}  // namespace

std::string directUnavailable(const ModeSetup& setup) {
  const double room = kMemoryShare * static_cast<double>(setup.memory_bytes);
  const double needed = bytesNeeded(setup.patches, setup.channels);
  if (needed <= room) return {};
  const double patches = std::sqrt(room / bytesNeeded(1, setup.channels));
  const double elements = patches / static_cast<double>(setup.patches) * static_cast<double>(setup.elements);
  return "its matrix of " + countText(setup.patches) + " patches takes " + memoryText(needed) + ", and " +
         memoryText(room) + " are there for it (--elements " +
         countText(static_cast<std::size_t>(0.9 * elements)) + " would do, or --mode gmres)";
}

std::unique_ptr<IterationMode> makeDirect() { return std::make_unique<Direct>(); }

}  // namespace unshot

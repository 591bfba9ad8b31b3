#include "viewer/scene_display.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/clock.h"

namespace unshot {
namespace {

constexpr double kGlideSeconds = 0.25;  // time constant of the exposure
constexpr double kArrivedStops = 0.01;
// A jump of the light by more than this (a new display mode, a door opened) is not worth a glide.
constexpr double kJumpStops = 6;
constexpr double kMostLost = 64;  // times darker than all light, a part of it is exposed for itself
constexpr std::size_t kFewestPieces = 10'000;
constexpr std::size_t kFewestFinePieces = 2'000;  // of pictures with many samples a pixel
constexpr double kBandSamples = 1e6;              // of such a picture at a time; 20 bytes each
constexpr std::size_t kFewestRows = 64;
constexpr std::size_t kMarkedAtOnce = 20'000;  // triangles, whose marks take some milliseconds to find
constexpr std::size_t kMostMerged = 25'000;    // triangles of a coarse picture, aimed at: some 10 ms
constexpr std::size_t kFewestBytes = 1 << 20;

/// Whether samples that were drawn are also those of the other one.
bool serves(const SceneDisplay::Wanted& a, const SceneDisplay::Wanted& b) {
  const ViewOptions &va = a.settings.view, &vb = b.settings.view;
  return a.camera == b.camera && va.display == vb.display && va.ambient == vb.ambient &&
         va.light == vb.light && va.reference == vb.reference && va.form_factors == vb.form_factors &&
         va.last_shot == vb.last_shot && a.width == b.width && a.height == b.height &&
         a.samples == b.samples && a.divisor <= b.divisor;
}

/// Of the picture itself [px].
int widthOf(const SceneDisplay::Wanted& wanted) {
  return (wanted.width + wanted.divisor - 1) / wanted.divisor;
}
int heightOf(const SceneDisplay::Wanted& wanted) {
  return (wanted.height + wanted.divisor - 1) / wanted.divisor;
}

ViewOptions viewOf(const SceneDisplay::Wanted& wanted) {
  ViewOptions view = wanted.settings.view;
  view.supersampling = wanted.samples;
  view.merged = wanted.divisor > 1;
  return view;
}

}  // namespace

SceneDisplay::SceneDisplay(gl::Context& context, std::function<void()> wake)
    : context_(context),
      wake_(std::move(wake)),
      view_(context),
      shown_{gl::Texture(context), gl::Framebuffer(context)},
      next_{gl::Texture(context), gl::Framebuffer(context)} {}

void SceneDisplay::setSnapshot(std::shared_ptr<const Snapshot> snapshot) {
  if (snapshot == snapshot_) return;
  snapshot_ = std::move(snapshot);
  drawn_.reset();
  sampled_.reset();
  making_.reset();
  if (snapshot_) view_.beginSnapshot(snapshot_);
}

void SceneDisplay::startFraming(double aspect) {
  framing_.reset();
  framing_hurries_ = false;
  AutomaticCameraOptions options;
  options.aspect = aspect;
  if (snapshot_) framing_.emplace(context_, snapshot_, options);
}

std::optional<Camera> SceneDisplay::continueFraming(std::optional<double> seconds) {
  if (!framing_) return std::nullopt;
  const double end = wallSeconds() + seconds.value_or(0);
  while (!framing_hurries_ && framing_->step()) {
    if (seconds && wallSeconds() >= end) return std::nullopt;
  }
  const Camera found = framing_->best();
  framing_.reset();
  return found;
}

bool SceneDisplay::differs(const Wanted& wanted) const {
  return !drawn_ || !serves(*drawn_, wanted) ||
         drawn_->settings.view.exposure_ev != wanted.settings.view.exposure_ev ||
         drawn_->settings.view.tone != wanted.settings.view.tone ||
         drawn_->settings.view.false_colour != wanted.settings.view.false_colour ||
         drawn_->settings.exposure_locked != wanted.settings.exposure_locked ||
         drawn_->settings.histogram != wanted.settings.histogram ||
         drawn_->settings.view.automatic_exposure != wanted.settings.view.automatic_exposure;
}

bool SceneDisplay::waits(const Wanted& wanted) const {
  return marks_ && snapshot_ && marks_->display == wanted.settings.view.display &&
         marks_->cut == snapshot_->mesh->cut && !marks_->job->ready();
}

std::optional<double> SceneDisplay::waitingSince() const {
  return marks_ ? std::optional(marks_->began) : std::nullopt;
}

/// Whether a picture can be drawn without finding marks of a large mesh first; else that is begun or goes on.
bool SceneDisplay::marksStand(const Wanted& wanted) {
  if (!snapshot_) return true;
  const std::string& display = wanted.settings.view.display;
  const std::shared_ptr<const Mesh>& mesh = snapshot_->mesh;
  if (marks_ && (marks_->display != display || marks_->cut != mesh->cut)) marks_.reset();
  if (!view_.lacksMarks(displayMode(display)) || mesh->triangle_element.size() <= kMarkedAtOnce) return true;
  if (!marks_) {
    const auto find = [mesh, &mode = displayMode(display)](const CancelToken& cancel) {
      return findMeshMarks(*mesh, mode, cancel);
    };
    marks_ = {mesh->cut, display, wallSeconds(), std::make_unique<Background<MeshMarks>>(find, wake_)};
  }
  if (!marks_->job->ready()) return false;
  view_.beginMarks(std::exchange(marks_, std::nullopt)->job->take());
  return true;
}

/// Of a large mesh, fewer triangles for coarse pictures, once per mesh, where a CPU draws. Before they are
/// there, coarse pictures have all.
void SceneDisplay::seekMerged() {
  if (!snapshot_) return;
  const std::shared_ptr<const Mesh>& mesh = snapshot_->mesh;
  if (merged_cut_ != mesh->cut) {
    merged_cut_ = mesh->cut;
    merging_.reset();
    if (mesh->triangle_element.size() <= kMostMerged) return;
    const auto merge = [mesh](const CancelToken& cancel) {
      return mergeTriangles(*mesh, kMostMerged, cancel);
    };
    merging_ = std::make_unique<Background<MergedTriangles>>(merge, nullptr);
  }
  if (!merging_ || !merging_->ready()) return;
  try {
    view_.beginMerged(std::exchange(merging_, nullptr)->take());
  } catch (const std::bad_alloc&) {  // there is no room for what is only sooner
  }
}

/// What is drawn while marks are being found: the display before, where the camera has moved. None: the
/// picture before stays.
std::optional<SceneDisplay::Wanted> SceneDisplay::meanwhile(const Wanted& wanted) const {
  const bool moved = wanted.camera != shown_camera_ || wanted.width != shown_.place_width ||
                     wanted.height != shown_.place_height;
  if (shown_display_.empty() || !moved) return std::nullopt;
  Wanted out = wanted;
  out.settings.view.display = view_.lacksMarks(displayMode(shown_display_)) ? "radiosity" : shown_display_;
  return out;
}

bool SceneDisplay::outdated(const Wanted& wanted) const {
  if (drawing()) return true;
  if (!waits(wanted)) return differs(wanted);
  const std::optional<Wanted> other = meanwhile(wanted);
  return other && differs(*other);
}

bool SceneDisplay::sampled(const Wanted& wanted) const { return sampled_ && serves(*sampled_, wanted); }

void SceneDisplay::allocate(Picture& picture, const Wanted& wanted) const {
  picture.place_width = wanted.width;
  picture.place_height = wanted.height;
  const int width = widthOf(wanted), height = heightOf(wanted);
  if (width == picture.width && height == picture.height) return;
  const gl::Functions& fn = context_.functions();
  fn.BindTexture(GL_TEXTURE_2D, picture.texture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.texture.id(), 0);
  picture.framebuffer.checkComplete("the picture in the window");
  picture.width = width;
  picture.height = height;
}

double SceneDisplay::nextExposure(double metered, double seconds) {
  const double stops = std::log2(metered / exposure_);
  const bool arrive = snap_ || seconds < 0 || !std::isfinite(stops) || std::abs(stops) < kArrivedStops ||
                      std::abs(stops) > kJumpStops;
  snap_ = false;
  gliding_ = !arrive;
  return arrive ? metered : exposure_ * std::exp2(stops * (1 - std::exp(-seconds / kGlideSeconds)));
}

bool SceneDisplay::draw(const Wanted& wanted, double seconds, double deadline) {
  if (wanted.width <= 0 || wanted.height <= 0) return false;
  // A picture for a window of another size is of no use, and one for a camera at rest comes too late for one
  // that moves.
  if (making_ && (deadline == kAtOnce || making_->wanted.width != wanted.width ||
                  making_->wanted.height != wanted.height || making_->wanted.divisor < wanted.divisor)) {
    making_.reset();
  }
  const std::optional<Wanted> now = making_              ? making_->wanted
                                    : marksStand(wanted) ? wanted
                                                         : meanwhile(wanted);
  if (!now) {
    if (view_.uploadBytes() == 0) return false;
    const StateGuard guard(context_.functions());
    upload(deadline);
    return true;
  }
  if (!drawing() && !differs(*now) && !gliding_) {
    glide_seconds_ = 0;
    return false;
  }
  glide_seconds_ = seconds < 0 || glide_seconds_ < 0 ? -1 : glide_seconds_ + seconds;
  const StateGuard guard(context_.functions());
  if (!making_ && !context_.info().hardware) seekMerged();
  if (!making_) view_.beginLight(viewOf(*now));
  if (!upload(deadline)) return true;
  if (!making_) begin(*now);
  deadline = extended(deadline);
  if (!drawSamples(deadline)) return true;
  if (making_->row == 0) expose();
  if (!showRows(deadline)) return true;
  std::swap(shown_, next_);
  ++version_;
  drawn_ = making_->wanted;
  shown_camera_ = drawn_->camera;
  shown_display_ = drawn_->settings.view.display;
  making_.reset();
  bands_.next = 0;
  bands_.piece = 0;
  return true;
}

void SceneDisplay::begin(const Wanted& wanted) {
  drawn_anew_ = !sampled(wanted);
  const int width = widthOf(wanted) * wanted.samples, height = heightOf(wanted) * wanted.samples;
  if (drawn_anew_) sampled_.reset();
  if (drawn_anew_ && (samples_.width() != width || samples_.height() != height)) {
    samples_ = LinearTarget();  // the old one goes first: both at once may not fit
    samples_ = LinearTarget(context_, width, height);
  }
  making_ = Making{wanted};  // not where there was no memory for it
  if (!drawn_anew_) making_->wanted.divisor = sampled_->divisor;
}

/// Sends what the snapshot still has to send until it is done or time is up. Returns whether it is done.
bool SceneDisplay::upload(double deadline) {
  double now = wallSeconds();
  for (std::size_t rest; (rest = view_.uploadBytes()) > 0;) {
    const std::size_t bytes = deadline == kAtOnce ? rest : bytes_.next(deadline - now, rest, kFewestBytes);
    view_.upload(bytes);
    const double start = std::exchange(now, wallSeconds());
    bytes_.note(bytes, now - start);
    if (now >= deadline) break;
  }
  return view_.uploadBytes() == 0;
}

/// Later by as much as it takes to end the picture, if that is little.
double SceneDisplay::extended(double deadline) {
  if (deadline == kAtOnce) return deadline;
  const bool drawn = sampled(making_->wanted);
  const std::size_t pieces = drawn ? 0 : view_.pieceCount(viewOf(making_->wanted)) - making_->piece;
  const double rest = pieces_.seconds(pieces) +
                      rows_.seconds(static_cast<std::size_t>(heightOf(making_->wanted) - making_->row));
  const double now = wallSeconds(), most = Pace::kOverrun * (deadline - now);
  return rest <= most ? now + most : deadline;
}

/// The two passes of a picture, each until it is done or time is up. Returns whether it is done.
bool SceneDisplay::drawSamples(double deadline) {
  if (sampled(making_->wanted)) return true;
  if (!drawPieces(samples_, making_->wanted, {}, making_->piece, pieces_, deadline)) return false;
  sampled_ = making_->wanted;
  small_.reset();
  metered_.reset();
  return true;
}

bool SceneDisplay::showRows(double deadline) {
  const Wanted& wanted = making_->wanted;
  const gl::Functions& fn = context_.functions();
  allocate(next_, wanted);
  fn.BindFramebuffer(GL_FRAMEBUFFER, next_.framebuffer.id());
  for (double now = wallSeconds(); making_->row < next_.height;) {
    const auto rest = static_cast<std::size_t>(next_.height - making_->row);
    const std::size_t rows = deadline == kAtOnce ? rest : rows_.next(deadline - now, rest, kFewestRows);
    view_.resolve(samples_, exposure_, viewOf(wanted), {0, making_->row, next_.width, static_cast<int>(rows)},
                  making_->row);
    making_->row += static_cast<int>(rows);
    if (deadline == kAtOnce) continue;
    fn.Finish();
    const double start = std::exchange(now, wallSeconds());
    rows_.note(rows, now - start);
    if (now >= deadline) break;
  }
  return making_->row == next_.height;
}

bool SceneDisplay::drawPieces(const LinearTarget& target, const Wanted& wanted, const FrameWindow& window,
                              std::size_t& piece, Pace& pace, double deadline) {
  const gl::Functions& fn = context_.functions();
  const ViewOptions view = viewOf(wanted);
  const std::size_t least = wanted.samples > 1 ? kFewestFinePieces : kFewestPieces;
  const double aspect = static_cast<double>(wanted.width) / wanted.height;
  const std::size_t all = view_.pieceCount(view);
  target.bind();
  double now = wallSeconds();
  do {
    const std::size_t most =
        deadline == kAtOnce ? all - piece : pace.next(deadline - now, all - piece, least);
    const DrawnPieces drawn = view_.drawPieces(wanted.camera, aspect, window, view, {piece, all, most});
    piece = drawn.end;
    if (deadline == kAtOnce) continue;
    fn.Finish();  // else a software renderer only takes notes
    const double start = std::exchange(now, wallSeconds());
    if (drawn.count > 0) pace.note(drawn.count, now - start);
  } while (piece < all && now < deadline);
  return piece >= all;
}

void SceneDisplay::expose() {
  const Wanted& wanted = making_->wanted;
  // A part of the light keeps the exposure of the whole, so that the eye sees what is missing; if it has one.
  // A bounce alone may be far too dark for that.
  const bool alone = wanted.settings.view.light.oneBounce();
  const bool whole = wanted.settings.view.light.all() || alone;
  const DisplayMode& mode = displayMode(wanted.settings.view.display);
  const bool metering = mode.tone_mapped;
  const auto metered = [&] {
    if (!metered_) metered_ = metering ? SceneView::meter(smallCopy(), viewOf(wanted)) : 1;
    return *metered_;
  };
  // Where light never fades, a few bounces would be nothing beside all of it.
  const bool lost = wanted.settings.view.light.bounces && metered() > kMostLost * exposure_;
  const bool follow = !wanted.settings.exposure_locked && (whole || exposed_for_part_ || lost);
  const ExposedKind kind{mode.quantity, mode.false_colour, alone};
  if (!wanted.settings.exposure_locked) {
    locked_.reset();
  } else if (!locked_ && exposed_kind_) {
    locked_ = {*exposed_kind_, exposure_};
  }
  if (exposed_display_ != wanted.settings.view.display || exposed_kind_ != kind) snap_ = true;
  exposed_display_ = wanted.settings.view.display;
  exposed_kind_ = kind;
  gliding_ = false;
  if (const auto& given = wanted.settings.view.automatic_exposure) {
    exposure_ = *given;
  } else if (locked_ && locked_->kind == kind) {
    exposure_ = locked_->exposure;
    snap_ = false;
  } else if (follow || snap_) {
    exposure_ = nextExposure(metered(), glide_seconds_);
    exposed_for_part_ = !whole;
  }
  histogram_.reset();
  if (wanted.settings.histogram) histogram_ = luminanceHistogram(smallCopy());
  glide_seconds_ = 0;
}

const std::vector<glm::vec4>& SceneDisplay::smallCopy() {
  if (!small_) small_ = view_.smallCopy(samples_);
  return *small_;
}

void SceneDisplay::sharpen(int samples, double deadline) {
  if (sharp()) return;
  if (samples > drawn_->samples) {
    const StateGuard guard(context_.functions());
    Wanted finer = *drawn_;
    finer.samples = samples;
    if (!drawBand(bands_, finer, exposure_, shown_, deadline)) return;
  } else {
    ++bands_.next;
  }
  ++version_;
}

/// The next one, until it is done or time is up. Returns whether it is done.
bool SceneDisplay::drawBand(Bands& bands, const Wanted& finer, double exposure, const Picture& into,
                            double deadline) {
  const int width = finer.width, height = finer.height, samples = finer.samples;
  const int bottom = height * bands.next / bands.count, top = height * (bands.next + 1) / bands.count;
  if (top > bottom) {
    LinearTarget& target = bands.target;
    if (target.width() != width * samples || target.height() != (top - bottom) * samples) {
      target = LinearTarget();
      target = LinearTarget(context_, width * samples, (top - bottom) * samples);
      bands.piece = 0;
    }
    const FrameWindow window{{0, static_cast<double>(bottom) / height},
                             {1, static_cast<double>(top) / height}};
    if (!drawPieces(target, finer, window, bands.piece, bands.pace, deadline)) return false;
    context_.functions().BindFramebuffer(GL_FRAMEBUFFER, into.framebuffer.id());
    view_.resolve(target, exposure, viewOf(finer), {0, bottom, width, top - bottom});
  }
  ++bands.next;
  bands.piece = 0;
  return true;
}

void SceneDisplay::beginFiner(int samples) {
  finer_.reset();
  if (!drawn_) return;
  Finer finer{*drawn_, exposure_, {gl::Texture(context_), gl::Framebuffer(context_)}, {}};
  finer.wanted.samples = samples;
  finer.wanted.divisor = 1;
  const double all = 1.0 * samples * samples * drawn_->width * drawn_->height;
  finer.bands.count = std::clamp(static_cast<int>(std::ceil(all / kBandSamples)), 1, drawn_->height);
  const StateGuard guard(context_.functions());
  allocate(finer.picture, finer.wanted);
  finer_ = std::move(finer);
}

bool SceneDisplay::continueFiner(double deadline) {
  if (!finer_) return true;
  Bands& bands = finer_->bands;
  const StateGuard guard(context_.functions());
  while (bands.next < bands.count) {
    if (!drawBand(bands, finer_->wanted, finer_->exposure, finer_->picture, deadline)) return false;
    if (wallSeconds() >= deadline) break;
  }
  return bands.next == bands.count;
}

double SceneDisplay::finerDone() const {
  return finer_ ? static_cast<double>(finer_->bands.next) / finer_->bands.count : 1;
}

void SceneDisplay::endFiner() {
  if (!finer_) return;
  Wanted shown = finer_->wanted;
  if (drawn_) shown.samples = drawn_->samples;
  const bool whole = finer_->bands.next == finer_->bands.count;
  if (whole && drawn_ && !drawing() && !differs(shown) && exposure_ == finer_->exposure) {
    std::swap(shown_, finer_->picture);
    bands_.next = kBands;
    ++version_;
  }
  finer_.reset();
}

void SceneDisplay::copyTo(int x, int width) const { copyPicture(context_.functions(), shown_, x, width); }

void SceneDisplay::rehearseCopies() const {
  const gl::Functions& fn = context_.functions();
  GLint target = 0;
  fn.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  Picture picture{gl::Texture(context_), gl::Framebuffer(context_)};
  Wanted small;
  small.width = small.height = 6;  // no power of two, for which the code would be another
  for (const int divisor : {1, 2}) {
    small.divisor = divisor;
    allocate(picture, small);
    fn.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(target));
    copyPicture(fn, picture, 0, small.width);
  }
}

void SceneDisplay::copyFinerTo(int x, int width) const {
  copyPicture(context_.functions(), finer_ ? finer_->picture : shown_, x, width);
}

void SceneDisplay::copyPicture(const gl::Functions& fn, const Picture& picture, int x, int most) {
  const int width = std::min(picture.place_width, most), height = picture.place_height;
  if (width <= 0) return;
  const bool coarse = picture.width != picture.place_width;
  const int columns =
      coarse ? (width * picture.width + picture.place_width - 1) / picture.place_width : width;
  GLint read = 0;
  fn.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
  fn.BindFramebuffer(GL_READ_FRAMEBUFFER, picture.framebuffer.id());
  fn.BlitFramebuffer(0, 0, columns, picture.height, x, 0, x + width, height, GL_COLOR_BUFFER_BIT,
                     coarse ? GL_LINEAR : GL_NEAREST);
  fn.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read));
}

}  // namespace unshot

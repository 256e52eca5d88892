#include "experiments/session/sdl_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/base/error.h"
#include "core/io/image_file.h"

namespace plenolab {

namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr int kWarmUpFlips = 10, kMeasuredFlips = 60;
constexpr SDL_Color kInk{230, 230, 230, 255}, kFaint{150, 150, 150, 255}, kMark{255, 200, 60, 255};
constexpr int kToneRate_hz = 44100;
constexpr double kTone_hz = 440, kTone_s = 0.15;

[[noreturn]] void fail(const std::string& what) {
  throw InputError(fmt::format("{}: {}", what, SDL_GetError()));
}

/// glFinish of the renderer's OpenGL context; null if it has none.
auto find_gl_finish(SDL_Renderer* renderer) -> void (*)() {
  SDL_RendererInfo info;
  if (SDL_GetRendererInfo(renderer, &info) != 0 || !std::string(info.name).starts_with("opengl"))
    return nullptr;
  return reinterpret_cast<void (*)()>(SDL_GL_GetProcAddress("glFinish"));
}

}  // namespace

bool waits_for_display(const std::string& renderer, int swap_interval) {
  return renderer.starts_with("opengl") && swap_interval == 1;
}

SdlStage::SdlStage(Options options)
    : options_(std::move(options)), start_ticks_(SDL_GetPerformanceCounter()) {
  if (TTF_Init() != 0) fail("cannot draw text");
  open_audio();
}

SdlStage::~SdlStage() {
  if (audio_ != 0) SDL_CloseAudioDevice(audio_);
  if (font_) TTF_CloseFont(font_);
  if (small_font_) TTF_CloseFont(small_font_);
  textures_.clear();
  TTF_Quit();
}

std::int64_t SdlStage::now_us() const {
  const std::uint64_t ticks = SDL_GetPerformanceCounter() - start_ticks_;
  const std::uint64_t rate = SDL_GetPerformanceFrequency();
  return static_cast<std::int64_t>(ticks / rate * 1'000'000 + ticks % rate * 1'000'000 / rate);
}

/// Sessions work without sound: participants may decline it, and pads vibrate. The tone comes from a
/// callback: for queued sound SDL makes a thread of 64 KiB, in which a program with much thread-local
/// storage, as ours is, does not fit.
void SdlStage::open_audio() {
  if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0) return;
  tone_.resize(static_cast<std::size_t>(kTone_s * kToneRate_hz));
  for (std::size_t i = 0; i < tone_.size(); ++i) {
    const double t_s = static_cast<double>(i) / kToneRate_hz;
    const double fade = std::min({1.0, t_s / 0.01, (kTone_s - t_s) / 0.01});  // without clicks
    tone_[i] = static_cast<std::int16_t>(8000 * fade * std::sin(2 * std::numbers::pi * kTone_hz * t_s));
  }
  tone_at_ = tone_.size();
  SDL_AudioSpec wanted;
  SDL_zero(wanted);
  wanted.freq = kToneRate_hz;
  wanted.format = AUDIO_S16SYS;
  wanted.channels = 1;
  wanted.samples = 512;
  wanted.callback = &SdlStage::fill_audio;
  wanted.userdata = this;
  audio_ = SDL_OpenAudioDevice(nullptr, 0, &wanted, nullptr, 0);
  if (audio_ != 0) SDL_PauseAudioDevice(audio_, 0);
}

void SDLCALL SdlStage::fill_audio(void* self, Uint8* stream, int bytes) {
  SdlStage& stage = *static_cast<SdlStage*>(self);
  const std::size_t wanted = static_cast<std::size_t>(bytes) / sizeof(std::int16_t);
  const std::size_t count = std::min(wanted, stage.tone_.size() - stage.tone_at_);
  std::memset(stream, 0, static_cast<std::size_t>(bytes));
  std::memcpy(stream, stage.tone_.data() + stage.tone_at_, count * sizeof(std::int16_t));
  stage.tone_at_ += count;
}

bool SdlStage::tone() {
  if (audio_ == 0) return false;
  SDL_LockAudioDevice(audio_);
  tone_at_ = 0;
  SDL_UnlockAudioDevice(audio_);
  return true;
}

void SdlStage::require_on_screen(int screen) const {
  const int really = SDL_GetWindowDisplayIndex(window_.get());
  if (really != screen)
    throw InputError(
        fmt::format("the window for display {} came up on display {}: check how the displays are arranged",
                    screen, really));
}

DisplayReport SdlStage::open_display(int screen) {
  const int screens = SDL_GetNumVideoDisplays();
  if (screen >= screens)
    throw InputError(
        fmt::format("the study wants display {}, but there are only {}, counted from 0", screen, screens));
  textures_.clear();
  renderer_.reset();
  const int place = static_cast<int>(SDL_WINDOWPOS_CENTERED_DISPLAY(static_cast<unsigned>(screen)));
  const Uint32 flags = options_.windowed ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP;
  SDL_Rect bounds{0, 0, 1280, 720};
  if (!options_.windowed) SDL_GetDisplayBounds(screen, &bounds);
  window_.reset(SDL_CreateWindow("plenolab session", place, place, bounds.w, bounds.h, flags));
  if (!window_) fail("cannot open a window");
  renderer_.reset(SDL_CreateRenderer(window_.get(), -1, SDL_RENDERER_PRESENTVSYNC));
  if (!renderer_) fail("cannot draw into the window");
  SDL_ShowCursor(SDL_DISABLE);
  SDL_RaiseWindow(window_.get());
  SDL_StartTextInput();
  DisplayReport report{.screen = screen};
  const char* name = SDL_GetDisplayName(screen);
  report.name = fmt::format("{}: {}", SDL_GetCurrentVideoDriver(), name ? name : "display");
  SDL_DisplayMode mode;
  if (SDL_GetCurrentDisplayMode(screen, &mode) == 0) report.refresh_hz = mode.refresh_rate;
  report.vsync = flips_wait();
  finish_gl_ = find_gl_finish(renderer_.get());
  picture_ = {};
  measure_interval(report);
  require_on_screen(screen);
  SDL_GetRendererOutputSize(renderer_.get(), &width_px_, &height_px_);
  report.width_px = width_px_;
  report.height_px = height_px_;
  open_fonts();
  return report;
}

/// SDL says PRESENTVSYNC of renderers too for which it only sleeps: what counts is the driver's swap
/// interval.
bool SdlStage::flips_wait() const {
  SDL_RendererInfo info;
  if (SDL_GetRendererInfo(renderer_.get(), &info) != 0) return false;
  return waits_for_display(info.name, SDL_GL_GetSwapInterval());
}

/// Shows what was drawn; the time when it was done. Without waiting for OpenGL that would be when the frame
/// was queued, up to some frames before it is shown.
std::int64_t SdlStage::present() {
  SDL_RenderPresent(renderer_.get());
  if (finish_gl_) finish_gl_();
  return now_us();
}

void SdlStage::measure_interval(DisplayReport& report) {
  std::vector<double> intervals;
  std::int64_t last_us = 0;
  for (int i = 0; i < kWarmUpFlips + kMeasuredFlips; ++i) {
    SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, 255);
    SDL_RenderClear(renderer_.get());
    const std::int64_t t_us = present();
    SDL_PumpEvents();
    if (i >= kWarmUpFlips) intervals.push_back(static_cast<double>(t_us - last_us) * 1e-3);
    last_us = t_us;
  }
  std::nth_element(intervals.begin(), intervals.begin() + kMeasuredFlips / 2, intervals.end());
  report.interval_ms = intervals[kMeasuredFlips / 2];
  interval_ms_ = report.interval_ms;
  last_flip_us_ = last_us;
}

void SdlStage::open_fonts() {
  if (font_) TTF_CloseFont(font_);
  if (small_font_) TTF_CloseFont(small_font_);
  font_ = TTF_OpenFont(kFontFile, std::max(16, height_px_ / 24));
  small_font_ = TTF_OpenFont(kFontFile, std::max(12, height_px_ / 40));
  if (!font_ || !small_font_) fail("cannot draw text (package fonts-dejavu-core)");
}

SdlStage::Texture SdlStage::upload(const std::filesystem::path& file) {
  const DisplayImage image = read_display_image(file);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.size() * 3);
  const auto code = [](float value) { return static_cast<std::uint8_t>(std::lround(value * 255)); };
  for (const Rgb& pixel : image.pixels())
    bytes.insert(bytes.end(), {code(pixel.r), code(pixel.g), code(pixel.b)});
  SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "nearest");
  Texture texture(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STATIC,
                                    image.width(), image.height()));
  if (!texture || SDL_UpdateTexture(texture.get(), nullptr, bytes.data(), image.width() * 3) != 0)
    fail(fmt::format("cannot show {}", file.string()));
  return texture;
}

void SdlStage::load(const std::vector<Picture>& pictures) {
  for (const Picture& picture : pictures) {
    Texture& texture = textures_[picture.file.string()];
    if (!texture) texture = upload(picture.file);
    int width = 0, height = 0;
    SDL_QueryTexture(texture.get(), nullptr, nullptr, &width, &height);
    if (width * picture.zoom > width_px_ || height * picture.zoom > height_px_)
      throw InputError(fmt::format("{} is {}×{} px at zoom {}, larger than the display's {}×{} px",
                                   picture.file.string(), width * picture.zoom, height * picture.zoom,
                                   picture.zoom, width_px_, height_px_));
  }
}

void SdlStage::draw(const Picture& picture) {
  picture_ = picture;
  ++pictures_drawn_;
  compose();
  save_screenshot();
}

void SdlStage::compose() {
  SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, 255);
  SDL_RenderClear(renderer_.get());
  if (picture_.kind == Picture::Kind::kImage) draw_image(picture_);
  if (picture_.kind == Picture::Kind::kPage) draw_page(picture_);
}

void SdlStage::draw_image(const Picture& picture) {
  const auto found = textures_.find(picture.file.string());
  PLENOLAB_CHECK(found != textures_.end(), picture.file.string());
  SDL_Rect place{0, 0, 0, 0};
  SDL_QueryTexture(found->second.get(), nullptr, nullptr, &place.w, &place.h);
  place.w *= picture.zoom;
  place.h *= picture.zoom;
  place.x = (width_px_ - place.w) / 2;
  place.y = (height_px_ - place.h) / 2;
  SDL_RenderCopy(renderer_.get(), found->second.get(), nullptr, &place);
}

/// Draws text, wrapped and centred; the y below it.
int SdlStage::draw_text(const std::string& text, TTF_Font* font, int y, SDL_Color colour, bool boxed) {
  if (text.empty()) return y + TTF_FontLineSkip(font);
  TTF_SetFontWrappedAlign(font, TTF_WRAPPED_ALIGN_CENTER);
  const auto wrap = static_cast<Uint32>(width_px_ * 8 / 10);
  SDL_Surface* surface = TTF_RenderUTF8_Blended_Wrapped(font, text.c_str(), colour, wrap);
  if (!surface) fail("cannot draw text");
  const Texture texture(SDL_CreateTextureFromSurface(renderer_.get(), surface));
  const SDL_Rect place{(width_px_ - surface->w) / 2, y, surface->w, surface->h};
  SDL_FreeSurface(surface);
  SDL_RenderCopy(renderer_.get(), texture.get(), nullptr, &place);
  if (boxed) {
    const SDL_Rect box{place.x - 16, place.y - 4, place.w + 32, place.h + 8};
    SDL_SetRenderDrawColor(renderer_.get(), colour.r, colour.g, colour.b, 255);
    SDL_RenderDrawRect(renderer_.get(), &box);
  }
  return y + place.h;
}

void SdlStage::draw_page(const Picture& picture) {
  const FormPage& page = picture.page;
  draw_text(picture.banner, small_font_, height_px_ / 30, kMark);
  int y = draw_text(page.text, font_, height_px_ / 6, kInk) + TTF_FontLineSkip(font_);
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const bool selected = static_cast<int>(i) == page.selected;
    y = draw_text(page.lines[i], font_, y, selected ? kMark : kInk, selected) + TTF_FontLineSkip(font_) / 3;
  }
  draw_text(page.footer, small_font_, height_px_ * 9 / 10, kFaint);
}

std::int64_t SdlStage::flip() {
  // Until shortly before the flip inputs are polled every millisecond, then the frame is drawn and waits for
  // the display.
  const auto spare_us = static_cast<std::int64_t>(interval_ms_ * 1000) - 4000;
  while (now_us() - last_flip_us_ < spare_us) {
    SDL_Delay(1);
    for (RawInput& input : poll()) waiting_.push_back(std::move(input));
  }
  compose();
  return last_flip_us_ = present();
}

std::vector<RawInput> SdlStage::poll() {
  std::vector<RawInput> inputs = std::move(waiting_);
  waiting_.clear();
  const std::int64_t asked_us = now_us();
  std::vector<RawInput> fresh = input_.poll(last_poll_us_, asked_us);
  // SDL collects inputs until it has none left: they may have come after it was asked.
  const std::int64_t answered_us = now_us();
  for (RawInput& input : fresh) {
    input.t_us = answered_us;
    inputs.push_back(std::move(input));
  }
  if (options_.stop_requested && options_.stop_requested())
    inputs.push_back({.kind = RawInput::Kind::kClose, .t_low_us = last_poll_us_, .t_us = answered_us});
  last_poll_us_ = asked_us;
  return inputs;
}

StageEquipment SdlStage::equipment() {
  waiting_ = poll();
  return {input_.pad_name(), audio_ != 0};
}

/// What has been drawn, before it is shown: for manuals, with time that nobody measures.
void SdlStage::save_screenshot() {
  if (options_.screenshots.empty()) return;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_) *
                                  3);
  if (SDL_RenderReadPixels(renderer_.get(), nullptr, SDL_PIXELFORMAT_RGB24, bytes.data(), width_px_ * 3) != 0)
    fail("cannot take a screenshot");
  DisplayImage image(width_px_, height_px_);
  const auto value = [&](std::size_t i) { return static_cast<float>(bytes[i]) / 255; };
  for (std::size_t i = 0; i < image.size(); ++i)
    image.pixels()[i] = {value(3 * i), value(3 * i + 1), value(3 * i + 2)};
  write_display_image(std::filesystem::path(options_.screenshots) / fmt::format("{:03}.png", pictures_drawn_),
                      image);
}

}  // namespace plenolab

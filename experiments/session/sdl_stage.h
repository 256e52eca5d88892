#pragma once

#include <SDL.h>
#include <SDL_ttf.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/session/sdl_input.h"
#include "experiments/session/stage.h"

namespace plenolab {

/// The real stage: full-screen windows of SDL, pads, keyboard, tones. Needs an SdlLibrary.
///   - One window on one display at a time; after it is up, the display it is really on is compared with the
///     one asked for, and a mismatch refused.
///   - Whether flips wait for the display is asked of the OpenGL driver (other renderers only pretend), and
///     measured. A flip is timed when the driver has nothing left to do, not when it has been queued; what
///     the display itself adds to that is unknown here.
///   - Inputs are polled every millisecond until shortly before the next flip.
/// Text is DejaVu Sans, in the central region of the display.
/// Whether flips of a renderer wait for the display, by its name and the driver's swap interval. 0 does not
/// wait, and −1 does not when a frame is late: it then tears.
bool waits_for_display(const std::string& renderer, int swap_interval);

class SdlStage final : public Stage {
 public:
  struct Options {
    bool windowed = false;                 ///< a window instead of the full screen, for trying out
    std::string screenshots;               ///< folder for a picture of everything that is drawn; empty: none
    std::function<bool()> stop_requested;  ///< asked at every poll; true counts as closing the window
  };
  explicit SdlStage(Options options);
  ~SdlStage() override;

  DisplayReport open_display(int screen) override;
  void load(const std::vector<Picture>& pictures) override;
  void draw(const Picture& picture) override;
  std::int64_t flip() override;
  std::int64_t now_us() const override;
  std::vector<RawInput> poll() override;
  StageEquipment equipment() override;
  bool tone() override;
  bool vibrate() override { return input_.rumble(250); }

 private:
  struct DestroyWindow {
    void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
  };
  struct DestroyRenderer {
    void operator()(SDL_Renderer* renderer) const { SDL_DestroyRenderer(renderer); }
  };
  struct DestroyTexture {
    void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }
  };
  using Texture = std::unique_ptr<SDL_Texture, DestroyTexture>;

  void require_on_screen(int screen) const;
  bool flips_wait() const;
  std::int64_t present();
  void measure_interval(DisplayReport& report);
  void compose();
  void draw_image(const Picture& picture);
  void draw_page(const Picture& picture);
  int draw_text(const std::string& text, TTF_Font* font, int y, SDL_Color colour, bool boxed = false);
  Texture upload(const std::filesystem::path& file);
  void open_fonts();
  void open_audio();
  static void SDLCALL fill_audio(void* self, Uint8* stream, int bytes);
  void save_screenshot();

  Options options_;
  std::unique_ptr<SDL_Window, DestroyWindow> window_;
  std::unique_ptr<SDL_Renderer, DestroyRenderer> renderer_;
  std::map<std::string, Texture> textures_;  // after the renderer: gone before it
  TTF_Font* font_ = nullptr;
  TTF_Font* small_font_ = nullptr;
  SDL_AudioDeviceID audio_ = 0;
  std::vector<std::int16_t> tone_;  // samples
  std::size_t tone_at_ = 0;         // the next one to be heard; locked with the audio device
  SdlInput input_;
  std::vector<RawInput> waiting_;
  Picture picture_;
  void (*finish_gl_)() = nullptr;  // glFinish; null where the renderer is not OpenGL
  int width_px_ = 0, height_px_ = 0, pictures_drawn_ = 0;
  double interval_ms_ = 1000.0 / 60;
  std::int64_t last_flip_us_ = 0, last_poll_us_ = 0;
  std::uint64_t start_ticks_ = 0;
};

}  // namespace plenolab

#include "tools/report/gl/canvas.h"

#include <backends/imgui_impl_opengl3.h>
#include <backends/imgui_impl_opengl3_loader.h>
#include <fmt/core.h>
#include <imgui.h>
#include <implot.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "tools/report/gl/fonts.h"
#include "tools/report/gl/frame_buffer.h"

// the configuration of one of the source trees sends failed assertions here
void slimgui_assert(const char* file, int line, const char* expression) {
  fmt::print(stderr, "{}:{}: assertion failed: {}\n", file, line, expression);
  std::abort();
}

namespace warmjoint::report {
namespace {

constexpr int kOversampling = 2;  // drawn pixels for each pixel of the picture, each way

// ImGui's loader takes a plain function
const GlContext* loading_context = nullptr;

GL3WglProc FindForImGui(const char* name) { return loading_context->Find(name); }

/// ImGui, ImPlot and ImGui's renderer: made for each picture, so that none depends on the last.
class Session {
 public:
  Session(int width, int height) {
    ImGui::CreateContext();
    ImPlot::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    const auto scale = static_cast<float>(Canvas::kPixelsPerPoint * kOversampling);
    io.DisplayFramebufferScale = {scale, scale};
    io.DeltaTime = 1.0f / 60;
    if (!ImGui_ImplOpenGL3_Init("#version 130")) Refuse({}, "OpenGL is too old for pictures");
    brush_ = {AddFont(RegularFont()), AddFont(BoldFont())};

    // multisampling smooths all edges; ImGui's own fringes would smooth them twice
    ImGuiStyle& style = ImGui::GetStyle();
    style.AntiAliasedLines = style.AntiAliasedFill = style.AntiAliasedLinesUseTex = false;
    style.WindowPadding = {0, 0};
    style.WindowBorderSize = 0;
    style.CurveTessellationTol = 0.1f;
    style.CircleTessellationMaxError = 0.05f;
  }
  ~Session() {
    ImGui_ImplOpenGL3_Shutdown();
    ImPlot::DestroyContext();
    ImGui::DestroyContext();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void Frame(const std::function<void(const Brush&)>& draw) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings);
    // fonts learn how many pixels a point has when they are pushed
    for (ImFont* font : {brush_.regular, brush_.bold}) {
      ImGui::PushFont(font, 0);
      ImGui::PopFont();
    }
    draw(brush_);
    ImGui::End();
    ImGui::Render();
  }

  /// Makes the glyphs that the last frame asked for.
  void Prepare() {
    for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) {
      if (texture->Status != ImTextureStatus_OK) ImGui_ImplOpenGL3_UpdateTexture(texture);
    }
  }

  void Render() { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

 private:
  static ImFont* AddFont(std::span<const unsigned char> file) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    return ImGui::GetIO().Fonts->AddFontFromMemoryTTF(
        const_cast<unsigned char*>(file.data()), static_cast<int>(file.size()), 13.0f, &config);
  }

  Brush brush_{};
};

}  // namespace

Canvas::Canvas(std::unique_ptr<GlContext> context) : context_(std::move(context)) {}
Canvas::~Canvas() = default;

Image Canvas::Draw(int width, int height, Rgb background,
                   const std::function<void(const Brush&)>& draw) {
  context_->MakeCurrent();
  loading_context = context_.get();
  if (imgl3wInit2(&FindForImGui) != 0) Refuse({}, "OpenGL is too old for pictures");

  const int scale = kPixelsPerPoint * kOversampling;
  FrameBuffer buffer(*context_, width * scale, height * scale);
  Session session(width, height);
  // the first frame measures text and asks for glyphs; the second finds all in place
  session.Frame(draw);
  session.Prepare();
  session.Frame(draw);
  buffer.Clear(background);
  session.Render();
  return Shrink(buffer.Read(), kOversampling);
}

}  // namespace warmjoint::report

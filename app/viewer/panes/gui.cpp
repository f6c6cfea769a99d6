#include "viewer/panes/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "common/error.h"

namespace gnomon::app {
namespace {

constexpr float letterHeight = 15;

/// The letters of the system; Dear ImGui's own where there are none.
void loadLetters(ImGuiIO& io) {
  static constexpr std::array<ImWchar, 9> ranges = {0x20,   0xff,   0x370,  0x3ff, 0x2010,
                                                    0x2044, 0x2190, 0x22ff, 0};
  const char* path = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (std::filesystem::exists(path)) {
    io.Fonts->AddFontFromFileTTF(path, letterHeight, nullptr, ranges.data());
  } else {
    io.Fonts->AddFontDefault();
  }
}

void setColours() {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 1;
  style.ItemSpacing = ImVec2(8, 5);
  style.FramePadding = ImVec2(6, 3);
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.965F, 0.967F, 0.972F, 1);
  style.Colors[ImGuiCol_Border] = ImVec4(0.72F, 0.74F, 0.78F, 1);
  style.Colors[ImGuiCol_FrameBg] = ImVec4(1, 1, 1, 1);
  style.Colors[ImGuiCol_SliderGrab] = ImVec4(0.62F, 0.71F, 0.85F, 1);
  style.Colors[ImGuiCol_PlotHistogram] = ImVec4(0.62F, 0.71F, 0.85F, 1);
  style.Colors[ImGuiCol_Header] = ImVec4(0.86F, 0.88F, 0.92F, 1);
}

}  // namespace

Gui::Gui() : context_(ImGui::CreateContext()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing of a session stays behind unless it is saved
  io.LogFilename = nullptr;
  loadLetters(io);
  setColours();
  if (!ImGui_ImplOpenGL3_Init("#version 450")) {
    throw InternalError("Dear ImGui cannot draw by this OpenGL");
  }
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void Gui::beginInWindow() const {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

bool Gui::hasInput() const {
  const ImGuiIO& io = ImGui::GetIO();
  const bool moves = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0;
  const bool holds =
      std::any_of(std::begin(io.MouseDown), std::end(io.MouseDown),
                  [](bool down) { return down; }) ||
      std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), [](bool down) { return down; });
  return moves || holds || !io.InputQueueCharacters.empty();
}

void Gui::beginWithoutWindow(int width, int height, ImVec2 cursor) const {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = 1.0F / 60;
  io.MousePos = cursor;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Gui::draw(int width, int height) const {
  ImGui::Render();
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace gnomon::app

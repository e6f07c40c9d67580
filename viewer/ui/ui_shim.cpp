/* SPDX-License-Identifier: MIT
 * Dear ImGui behind the C functions of ui_shim.h, and how the viewer looks. */
#include "viewer/ui/ui_shim.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <cfloat>
#include <cstdio>
#include <cstring>

/* ---- looks ---- */

namespace {

/* Colours of water at night, with one accent, that of moonlight on it. */
const ImVec4 color_text(0.87f, 0.89f, 0.92f, 1.0f);
const ImVec4 color_faint(0.52f, 0.57f, 0.64f, 1.0f);
const ImVec4 color_accent(0.93f, 0.78f, 0.47f, 1.0f);
const ImVec4 color_warning(0.96f, 0.52f, 0.42f, 1.0f);

ImVec4 grey(float level, float alpha = 1.0f) { return ImVec4(level * 0.86f, level * 0.97f, level * 1.16f, alpha); }

ImVec4 accent(float alpha) { return ImVec4(color_accent.x, color_accent.y, color_accent.z, alpha); }

void set_colors(ImGuiStyle &style)
{
    ImVec4 *c = style.Colors;
    c[ImGuiCol_Text] = color_text;
    c[ImGuiCol_TextDisabled] = color_faint;
    c[ImGuiCol_WindowBg] = grey(0.075f);
    c[ImGuiCol_ChildBg] = grey(0.06f);
    c[ImGuiCol_PopupBg] = grey(0.10f, 0.98f);
    c[ImGuiCol_Border] = grey(0.19f);
    c[ImGuiCol_FrameBg] = grey(0.14f);
    c[ImGuiCol_FrameBgHovered] = grey(0.19f);
    c[ImGuiCol_FrameBgActive] = grey(0.22f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = grey(0.06f);
    c[ImGuiCol_ScrollbarBg] = grey(0.06f, 0.0f);
    c[ImGuiCol_ScrollbarGrab] = grey(0.20f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.27f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.32f);
    c[ImGuiCol_CheckMark] = color_accent;
    c[ImGuiCol_SliderGrab] = accent(0.55f);
    c[ImGuiCol_SliderGrabActive] = color_accent;
    c[ImGuiCol_Button] = grey(0.17f);
    c[ImGuiCol_ButtonHovered] = grey(0.23f);
    c[ImGuiCol_ButtonActive] = grey(0.28f);
    c[ImGuiCol_Header] = grey(0.125f);
    c[ImGuiCol_HeaderHovered] = grey(0.17f);
    c[ImGuiCol_HeaderActive] = grey(0.20f);
    c[ImGuiCol_Separator] = grey(0.17f);
    c[ImGuiCol_Tab] = grey(0.10f);
    c[ImGuiCol_TabHovered] = grey(0.22f);
    c[ImGuiCol_TabActive] = grey(0.20f);
    c[ImGuiCol_TextSelectedBg] = accent(0.30f);
    c[ImGuiCol_NavHighlight] = accent(0.60f);
}

void set_style(float scale)
{
    ImGuiStyle style;
    style.WindowRounding = 0;
    style.ChildRounding = 4;
    style.FrameRounding = 4;
    style.PopupRounding = 5;
    style.GrabRounding = 3;
    style.TabRounding = 4;
    style.ScrollbarRounding = 6;
    style.ScrollbarSize = 10;
    style.GrabMinSize = 6;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.WindowPadding = ImVec2(12, 10);
    style.FramePadding = ImVec2(7, 3);
    style.ItemSpacing = ImVec2(7, 5);
    style.ItemInnerSpacing = ImVec2(7, 4);
    set_colors(style);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

/* Loads a common font of the system, or else the one of ImGui. */
void load_font(float scale)
{
    static const char *const candidates[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                             "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                             "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
    static const ImWchar ranges[] = {0x20, 0xff, 0x391, 0x3c9, 0x2010, 0x2026, 0x2190, 0x2193, 0x2212, 0x2212, 0x2248, 0x2265, 0};
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    atlas->Clear();
    for (const char *path : candidates) {
        FILE *file = fopen(path, "rb");
        if (!file)
            continue;
        fclose(file);
        ImFontConfig config;
        config.OversampleH = 2;
        config.RasterizerMultiply = 1.1f;
        if (atlas->AddFontFromFileTTF(path, 13.5f * scale, &config, ranges))
            return;
    }
    ImFontConfig config;
    config.SizePixels = 13.0f * scale;
    atlas->AddFontDefault(&config);
}

ImU32 packed(uint32_t rgba) { return IM_COL32(rgba >> 24, rgba >> 16 & 255, rgba >> 8 & 255, rgba & 255); }

ImDrawList *list_of(ui_layer layer)
{
    switch (layer) {
    case UI_LAYER_BEHIND:
        return ImGui::GetBackgroundDrawList();
    case UI_LAYER_ABOVE:
        return ImGui::GetForegroundDrawList();
    case UI_LAYER_WINDOW:
        break;
    }
    return ImGui::GetWindowDrawList();
}

const ImVec4 &tone_color(ui_tone tone)
{
    switch (tone) {
    case UI_TONE_FAINT:
        return color_faint;
    case UI_TONE_ACCENT:
        return color_accent;
    case UI_TONE_WARNING:
        return color_warning;
    case UI_TONE_NORMAL:
        break;
    }
    return color_text;
}

} // namespace

/* ---- life and frames ---- */

bool ui_create(GLFWwindow *window)
{
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr; /* ImGui writes no file */
    io.LogFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    set_style(1);
    load_font(1);
    return ImGui_ImplGlfw_InitForOpenGL(window, false) && ImGui_ImplOpenGL3_Init("#version 330");
}

void ui_destroy(void)
{
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ui_set_scale(float scale)
{
    set_style(scale);
    load_font(scale);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

void ui_frame_begin(const ui_stand_in *stand_in)
{
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (stand_in->active) {
        ImGuiIO &io = ImGui::GetIO();
        io.MousePos = ImVec2(stand_in->x, stand_in->y);
        for (int i = 0; i < 3; i++)
            io.MouseDown[i] = stand_in->down[i];
        io.DeltaTime = stand_in->seconds;
    }
    ImGui::NewFrame();
}

void ui_frame_end(void)
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void ui_on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers) { ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, modifiers); }

void ui_on_character(GLFWwindow *window, unsigned character) { ImGui_ImplGlfw_CharCallback(window, character); }

void ui_on_button(GLFWwindow *window, int button, int action, int modifiers) { ImGui_ImplGlfw_MouseButtonCallback(window, button, action, modifiers); }

void ui_on_scroll(GLFWwindow *window, double x, double y) { ImGui_ImplGlfw_ScrollCallback(window, x, y); }

void ui_on_focus(GLFWwindow *window, int focused) { ImGui_ImplGlfw_WindowFocusCallback(window, focused); }

void ui_on_enter(GLFWwindow *window, int entered) { ImGui_ImplGlfw_CursorEnterCallback(window, entered); }

bool ui_takes_pointer(void) { return ImGui::GetIO().WantCaptureMouse; }

bool ui_holds_item(void) { return ImGui::IsAnyItemActive(); }

bool ui_takes_keys(void) { return ImGui::GetIO().WantTextInput; }

/* ---- windows ---- */

bool ui_panel_begin(const char *name, ui_rect place, unsigned flags)
{
    ImGuiWindowFlags window = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                              ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    if (!(flags & UI_PANEL_SCROLLS))
        window |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (flags & UI_PANEL_UNTOUCHED)
        window |= ImGuiWindowFlags_NoInputs;
    if (flags & UI_PANEL_FITS)
        window |= ImGuiWindowFlags_AlwaysAutoResize;
    ImGui::SetNextWindowPos(ImVec2(place.x, place.y));
    if (flags & UI_PANEL_FITS)
        ImGui::SetNextWindowSizeConstraints(ImVec2(place.width, 0), ImVec2(place.width > 0 ? place.width : FLT_MAX, FLT_MAX));
    else
        ImGui::SetNextWindowSize(ImVec2(place.width, place.height));
    ImGui::SetNextWindowBgAlpha(flags & UI_PANEL_GLASS ? 0.78f : 0.97f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, flags & UI_PANEL_GLASS ? 6.0f : 0.0f);
    const bool open = ImGui::Begin(name, nullptr, window);
    ImGui::PopStyleVar();
    return open;
}

void ui_panel_end(void) { ImGui::End(); }

bool ui_child_begin(const char *name, float height) { return ImGui::BeginChild(name, ImVec2(0, height)); }

void ui_child_end(void) { ImGui::EndChild(); }

bool ui_header(const char *label, bool open_at_first) { return ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0); }

bool ui_tabs_begin(const char *name) { return ImGui::BeginTabBar(name); }

bool ui_tab_begin(const char *label, bool select) { return ImGui::BeginTabItem(label, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0); }

void ui_tab_end(void) { ImGui::EndTabItem(); }

void ui_tabs_end(void) { ImGui::EndTabBar(); }

/* ---- layout ---- */

float ui_font_size(void) { return ImGui::GetFontSize(); }

ui_rect ui_room(void)
{
    const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    return {at.x, at.y, room.x, room.y};
}

void ui_same_line(float from_left) { ImGui::SameLine(from_left); }

void ui_space(float height) { ImGui::Dummy(ImVec2(0, height)); }

void ui_item_width(float width) { ImGui::SetNextItemWidth(width); }

void ui_disabled_begin(bool disabled) { ImGui::BeginDisabled(disabled); }

void ui_disabled_end(void) { ImGui::EndDisabled(); }

void ui_tooltip(const char *text)
{
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::GetCurrentContext() == nullptr || ImGui::IsItemActive())
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/* ---- items ---- */

void ui_text(ui_tone tone, const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, tone_color(tone));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void ui_text_wrapped(ui_tone tone, const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, tone_color(tone));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

bool ui_button(const char *label, float width) { return ImGui::Button(label, ImVec2(width, 0)); }

bool ui_toggle_button(const char *label, bool on, float width)
{
    if (on) {
        ImGui::PushStyleColor(ImGuiCol_Button, accent(0.85f));
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, accent(1.0f));
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, accent(0.7f));
        ImGui::PushStyleColor(ImGuiCol_Text, grey(0.06f));
    }
    const bool pressed = ImGui::Button(label, ImVec2(width, 0));
    if (on)
        ImGui::PopStyleColor(4);
    return pressed;
}

bool ui_checkbox(const char *label, bool *on) { return ImGui::Checkbox(label, on); }

bool ui_slider(const char *label, double *value, double min, double max, const char *format, bool logarithmic)
{
    const ImGuiSliderFlags flags = ImGuiSliderFlags_NoRoundToFormat | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    return ImGui::SliderScalar(label, ImGuiDataType_Double, value, &min, &max, format, flags);
}

bool ui_slider_count(const char *label, uint32_t *value, uint32_t min, uint32_t max, bool logarithmic, const char *zero)
{
    return ImGui::SliderScalar(label, ImGuiDataType_U32, value, &min, &max, zero && *value == 0 ? zero : "%u", logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

bool ui_drag(const char *label, double *values, int count, double step, double min, double max, const char *format)
{
    return ImGui::DragScalarN(label, ImGuiDataType_Double, values, count, static_cast<float>(step), &min, &max, format,
                              ImGuiSliderFlags_NoRoundToFormat | ImGuiSliderFlags_AlwaysClamp);
}

/* A colour of any brightness: a number for its largest channel, and a swatch for the rest. */
bool ui_color(const char *label, float rgb[3], float *intensity)
{
    const float most = rgb[0] > rgb[1] ? (rgb[0] > rgb[2] ? rgb[0] : rgb[2]) : (rgb[1] > rgb[2] ? rgb[1] : rgb[2]);
    float hue[3] = {1, 1, 1}, level = most;
    for (int i = 0; i < 3 && most > 0; i++)
        hue[i] = rgb[i] / most;
    ImGui::PushID(label);
    const float width = ImGui::CalcItemWidth();
    ImGui::BeginGroup();
    bool changed = ImGui::ColorEdit3("##hue", hue, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_Float);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::SetNextItemWidth(width - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x);
    const float step = level > 0 ? level * 0.01f : *intensity * 0.001f;
    changed |= ImGui::DragFloat("##level", &level, step, 0, *intensity, "%.4g", ImGuiSliderFlags_NoRoundToFormat | ImGuiSliderFlags_AlwaysClamp);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextUnformatted(label, strstr(label, "##"));
    ImGui::EndGroup();
    ImGui::PopID();
    for (int i = 0; i < 3 && changed; i++)
        rgb[i] = hue[i] * level;
    return changed;
}

bool ui_choice(const char *label, int *chosen, const char *const *names, int count) { return ImGui::Combo(label, chosen, names, count); }

bool ui_selectable(const char *label, bool selected, float width) { return ImGui::Selectable(label, selected, 0, ImVec2(width, 0)); }

void ui_progress(float fraction, const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, accent(0.55f));
    ImGui::ProgressBar(fraction, ImVec2(-1, 0), text);
    ImGui::PopStyleColor();
}

bool ui_text_field(const char *label, char *text, size_t size) { return ImGui::InputText(label, text, size, ImGuiInputTextFlags_AutoSelectAll); }

void ui_clipboard(const char *text) { ImGui::SetClipboardText(text); }

/* ---- drawing ---- */

ui_rect ui_canvas(const char *name, float height)
{
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::InvisibleButton(name, ImVec2(width > 1 ? width : 1, height));
    return {at.x, at.y, width, height};
}

ui_pointer ui_canvas_pointer(void)
{
    const ImVec2 at = ImGui::GetIO().MousePos;
    return {ImGui::IsItemActivated(), ImGui::IsItemActive(), at.x, at.y};
}

void ui_draw_line(ui_layer layer, float x0, float y0, float x1, float y1, uint32_t color, float thickness)
{
    list_of(layer)->AddLine(ImVec2(x0, y0), ImVec2(x1, y1), packed(color), thickness);
}

void ui_draw_polyline(ui_layer layer, const float *points, int count, uint32_t color, float thickness, bool closed)
{
    ImDrawList *list = list_of(layer);
    for (int i = 0; i < count; i++)
        list->PathLineTo(ImVec2(points[2 * i], points[2 * i + 1]));
    list->PathStroke(packed(color), closed ? ImDrawFlags_Closed : 0, thickness);
}

void ui_draw_box(ui_layer layer, ui_rect p, uint32_t color, float rounding)
{
    list_of(layer)->AddRectFilled(ImVec2(p.x, p.y), ImVec2(p.x + p.width, p.y + p.height), packed(color), rounding);
}

void ui_draw_disk(ui_layer layer, float x, float y, float radius, uint32_t color) { list_of(layer)->AddCircleFilled(ImVec2(x, y), radius, packed(color)); }

void ui_draw_circle(ui_layer layer, float x, float y, float radius, uint32_t color, float thickness)
{
    list_of(layer)->AddCircle(ImVec2(x, y), radius, packed(color), 0, thickness);
}

void ui_draw_text(ui_layer layer, float x, float y, uint32_t color, const char *text) { list_of(layer)->AddText(ImVec2(x, y), packed(color), text); }

float ui_text_width(const char *text) { return ImGui::CalcTextSize(text).x; }

void ui_clip_begin(ui_layer layer, ui_rect p) { list_of(layer)->PushClipRect(ImVec2(p.x, p.y), ImVec2(p.x + p.width, p.y + p.height)); }

void ui_clip_end(ui_layer layer) { list_of(layer)->PopClipRect(); }

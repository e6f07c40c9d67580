/* SPDX-License-Identifier: MIT
 *
 * Dear ImGui for C, as far as the viewer needs it. ui_shim.cpp is the only C++ of this repository's programs.
 *
 * Places and sizes are in window coordinates with y down. Colours are 0xRRGGBBAA. The part of a label after "##" is not shown. All functions must be called on
 * the thread of the window's OpenGL context. Those of the sections windows, layout, items and drawing must be called between ui_frame_begin() and
 * ui_frame_end().
 */
#ifndef MANGATA_VIEWER_UI_UI_SHIM_H
#define MANGATA_VIEWER_UI_UI_SHIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct GLFWwindow;

typedef struct ui_rect {
    float x, y, width, height;
} ui_rect;

/* ---- life and frames ---- */

/* Starts on a window whose OpenGL context is current. False: it cannot draw there. */
bool ui_create(struct GLFWwindow *window);
void ui_destroy(void);

/* Sets the scale of text and of everything around it. 1 suits a screen of 96 dots per inch. Must be called outside of a frame. */
void ui_set_scale(float scale);

/* A pointer and a clock that replace the real ones, so that a script can be repeated exactly. */
typedef struct ui_stand_in {
    bool active; /* false: the real ones are used */
    float x, y;
    bool down[3];  /* buttons: left, right, middle */
    float seconds; /* since the last frame */
} ui_stand_in;

/* Begin and end a frame. ui_frame_end() draws it into the current framebuffer. */
void ui_frame_begin(const ui_stand_in *stand_in);
void ui_frame_end(void);

/* GLFW's callbacks must pass their arguments to these. */
void ui_on_key(struct GLFWwindow *window, int key, int scancode, int action, int modifiers);
void ui_on_character(struct GLFWwindow *window, unsigned character);
void ui_on_button(struct GLFWwindow *window, int button, int action, int modifiers);
void ui_on_scroll(struct GLFWwindow *window, double x, double y);
void ui_on_focus(struct GLFWwindow *window, int focused);
void ui_on_enter(struct GLFWwindow *window, int entered);

bool ui_takes_pointer(void); /* the pointer is over or holds a control */
bool ui_takes_keys(void);    /* text is being typed */
bool ui_holds_item(void);    /* a control is held down or written in */

/* ---- windows ---- */

typedef enum ui_panel_flags {
    UI_PANEL_PLAIN = 0,
    UI_PANEL_SCROLLS = 1,
    UI_PANEL_GLASS = 2,    /* see-through */
    UI_PANEL_FITS = 4,     /* its height follows its content; ui_rect.height is not read */
    UI_PANEL_UNTOUCHED = 8 /* takes no input */
} ui_panel_flags;

/* Begin and end a window at a place. `flags` are those of ui_panel_flags. False: nothing of it is visible, so its content may be left out. Each begin needs its
 * end, also if it returned false. */
bool ui_panel_begin(const char *name, ui_rect place, unsigned flags);
void ui_panel_end(void);

/* The same for a part of a window that scrolls by itself. */
bool ui_child_begin(const char *name, float height);
void ui_child_end(void);

/* A line that opens and closes what follows. Returns whether it is open. */
bool ui_header(const char *label, bool open_at_first);

/* Begin and end a row of tabs, and the content of one of them. An end is needed only if its begin returned true. */
bool ui_tabs_begin(const char *name);
bool ui_tab_begin(const char *label, bool select); /* select: opens this tab */
void ui_tab_end(void);
void ui_tabs_end(void);

/* ---- layout ---- */

float ui_font_size(void);
ui_rect ui_room(void);              /* the rest of the window's content area; its x and y are those of the next item */
void ui_same_line(float from_left); /* x of the next item, on the line of the last one; 0: right behind that one */
void ui_space(float height);
void ui_item_width(float width); /* width of the next item; negative: it ends so far from the right border */
void ui_disabled_begin(bool disabled);
void ui_disabled_end(void);
void ui_tooltip(const char *text); /* text about the last item, shown while the pointer rests on it */

/* ---- items: each that returns a bool returns whether the user has changed or pressed it ---- */

typedef enum ui_tone { UI_TONE_NORMAL, UI_TONE_FAINT, UI_TONE_ACCENT, UI_TONE_WARNING } ui_tone;

void ui_text(ui_tone tone, const char *text);
void ui_text_wrapped(ui_tone tone, const char *text);
bool ui_button(const char *label, float width); /* width 0: that of the label */
bool ui_toggle_button(const char *label, bool on, float width);
bool ui_checkbox(const char *label, bool *on);
bool ui_slider(const char *label, double *value, double min, double max, const char *format, bool logarithmic);
/* `zero` is shown in place of 0; NULL: 0 itself. */
bool ui_slider_count(const char *label, uint32_t *value, uint32_t min, uint32_t max, bool logarithmic, const char *zero);
bool ui_drag(const char *label, double *values, int count, double step, double min, double max, const char *format);
bool ui_color(const char *label, float rgb[3], float *intensity);
bool ui_choice(const char *label, int *chosen, const char *const *names, int count);
bool ui_selectable(const char *label, bool selected, float width);
void ui_progress(float fraction, const char *text);
bool ui_text_field(const char *label, char *text, size_t size);
void ui_clipboard(const char *text);

/* ---- drawing ---- */

typedef enum ui_layer { UI_LAYER_WINDOW, UI_LAYER_BEHIND, UI_LAYER_ABOVE } ui_layer; /* in the current window, behind all windows, above all windows */

/* An empty item to draw on, as wide as the window. Returns its place. */
ui_rect ui_canvas(const char *name, float height);

/* What the pointer does with the last canvas. */
typedef struct ui_pointer {
    bool pressed; /* the button goes down on the canvas in this frame */
    bool held;    /* the button has been down since it went down on the canvas */
    float x, y;
} ui_pointer;
ui_pointer ui_canvas_pointer(void);

void ui_draw_line(ui_layer layer, float x0, float y0, float x1, float y1, uint32_t color, float thickness);
void ui_draw_polyline(ui_layer layer, const float *points, int count, uint32_t color, float thickness, bool closed);
void ui_draw_box(ui_layer layer, ui_rect place, uint32_t color, float rounding);
void ui_draw_disk(ui_layer layer, float x, float y, float radius, uint32_t color);
void ui_draw_circle(ui_layer layer, float x, float y, float radius, uint32_t color, float thickness);
void ui_draw_text(ui_layer layer, float x, float y, uint32_t color, const char *text);
float ui_text_width(const char *text);
void ui_clip_begin(ui_layer layer, ui_rect place);
void ui_clip_end(ui_layer layer);

#ifdef __cplusplus
}
#endif
#endif

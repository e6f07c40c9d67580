/* SPDX-License-Identifier: MIT
 * Keys, and the callbacks of GLFW. The pointer is in pointer.c. */
#include <GLFW/glfw3.h>

#include <math.h>
#include <string.h>
#include <strings.h>

#include "viewer/scene/camera_moves.h"
#include "cli/common/progress.h"
#include "viewer/app/viewer.h"

const key_help key_helps[] = {
    {"drag", "orbit, or look around when flying"},
    {"right drag", "look around"},
    {"middle drag, Shift drag", "pull the water along; shift the magnified picture"},
    {"wheel", "nearer, farther (orbit); speed (fly)"},
    {"Ctrl wheel", "magnify the pixels"},
    {"Ctrl click", "inspect a pixel"},
    {"W A S D, Q E", "move; down, up"},
    {"Shift", "five times as fast"},
    {"F", "orbit or fly"},
    {"R", "reset the camera"},
    {"P", "follow the camera path, or leave it"},
    {"K", "record a keyframe"},
    {"Space", "run, pause"},
    {", .", "one frame back, on"},
    {"[ ]", "slower, faster"},
    {"Home", "back to the first frame"},
    {"1 ... 6", "method of A (Shift: of B)"},
    {"X", "compare: off, wipe, difference"},
    {"L", "next layer"},
    {"- =", "darker, brighter"},
    {"I", "inspector"},
    {"T", "timings"},
    {"C", "copy as command"},
    {"F12", "save the picture"},
    {"Ctrl Z, Ctrl Y", "undo, redo"},
    {"Ctrl O", "open a scene"},
    {"Tab", "hide or show the controls"},
    {"F11", "full screen"},
    {"? or F1", "these keys"},
    {"Ctrl Q", "quit"},
};
const size_t key_help_count = sizeof key_helps / sizeof key_helps[0];

/* ---- names of keys ---- */

typedef struct key_name {
    const char *name;
    int key, modifiers;
} key_name;

static const key_name key_names[] = {
    {"space", GLFW_KEY_SPACE, 0}, {"tab", GLFW_KEY_TAB, 0},  {"escape", GLFW_KEY_ESCAPE, 0},    {"home", GLFW_KEY_HOME, 0},
    {"f1", GLFW_KEY_F1, 0},       {"f11", GLFW_KEY_F11, 0},  {"f12", GLFW_KEY_F12, 0},          {"?", GLFW_KEY_SLASH, GLFW_MOD_SHIFT},
    {",", GLFW_KEY_COMMA, 0},     {".", GLFW_KEY_PERIOD, 0}, {"[", GLFW_KEY_LEFT_BRACKET, 0},   {"]", GLFW_KEY_RIGHT_BRACKET, 0},
    {"-", GLFW_KEY_MINUS, 0},     {"=", GLFW_KEY_EQUAL, 0},  {"shift", GLFW_KEY_LEFT_SHIFT, 0},
};

int key_from_name(const char *name, int *modifiers)
{
    *modifiers = 0;
    if (strncmp(name, "ctrl+", 5) == 0) {
        const int key = key_from_name(name + 5, modifiers);
        *modifiers |= GLFW_MOD_CONTROL;
        return key;
    }
    if (strncmp(name, "shift+", 6) == 0) {
        const int key = key_from_name(name + 6, modifiers);
        *modifiers |= GLFW_MOD_SHIFT;
        return key;
    }
    for (size_t i = 0; i < sizeof key_names / sizeof key_names[0]; i++)
        if (strcasecmp(name, key_names[i].name) == 0) {
            *modifiers = key_names[i].modifiers;
            return key_names[i].key;
        }
    if (name[0] && !name[1] && name[0] >= 'a' && name[0] <= 'z')
        return GLFW_KEY_A + name[0] - 'a';
    if (name[0] && !name[1] && name[0] >= '0' && name[0] <= '9')
        return GLFW_KEY_0 + name[0] - '0';
    return -1;
}

/* ---- keys ---- */

static void flip(int *on) { *on = !*on; }

static void full_screen(viewer *v)
{
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (glfwGetWindowMonitor(v->window))
        glfwSetWindowMonitor(v->window, NULL, v->windowed[0], v->windowed[1], v->windowed[2], v->windowed[3], 0);
    else if (mode) {
        glfwGetWindowPos(v->window, &v->windowed[0], &v->windowed[1]);
        glfwGetWindowSize(v->window, &v->windowed[2], &v->windowed[3]);
        glfwSetWindowMonitor(v->window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
}

/* Changes the exposure, or the offset of automatic exposure, by `stops`. */
static void expose(viewer *v, double stops)
{
    scene_post *post = &v->document.values.post;
    double *value = post->exposure.automatic ? &post->exposure_offset : &post->exposure.stops;
    *value = fmin(fmax(*value + stops, -60), 60);
}

/* Records a keyframe at the clock's time. */
static void record(viewer *v)
{
    scene_values *values = &v->document.values;
    if (viewer_follows_path(v))
        viewer_free_camera(v);
    if (!keyframe_record(&values->camera.path, v->settings.clock.time, &values->camera.still))
        viewer_report(v, true, "no further keyframe fits");
    else {
        v->settings.move.path = 0; /* the camera stays in hand */
        viewer_report(v, false, "keyframe at %.3f s; %zu in all", v->settings.clock.time, values->camera.path.count);
    }
}

static void save_named_picture(viewer *v)
{
    char error[VIEWER_TEXT];
    if (!viewer_save_picture(v, v->picture_name, v->picture_size[0], v->picture_size[1], error, sizeof error))
        viewer_report(v, true, "%s", error);
}

static void press(viewer *v, int key, int modifiers)
{
    settings *s = &v->settings;
    const bool shift = modifiers & GLFW_MOD_SHIFT;
    if (modifiers & GLFW_MOD_CONTROL) {
        v->quit |= key == GLFW_KEY_Q;
        if (key == GLFW_KEY_O)
            dialog_toggle(v);
        if (key == GLFW_KEY_Z || key == GLFW_KEY_Y)
            viewer_undo(v, key == GLFW_KEY_Y || shift ? 1 : -1);
        return;
    }
    switch (key) {
    case GLFW_KEY_F:
        flip(&s->move.mode);
        break;
    case GLFW_KEY_R:
        viewer_reset_camera(v);
        break;
    case GLFW_KEY_P:
        if (viewer_follows_path(v))
            viewer_free_camera(v);
        else
            s->move.path = 1;
        break;
    case GLFW_KEY_K:
        record(v);
        break;
    case GLFW_KEY_SPACE:
        flip(&s->clock.play);
        break;
    case GLFW_KEY_COMMA:
        viewer_step_frames(v, -1);
        break;
    case GLFW_KEY_PERIOD:
        viewer_step_frames(v, 1);
        break;
    case GLFW_KEY_LEFT_BRACKET:
        s->clock.speed = fmax(s->clock.speed / 2, 1 / 64.0);
        break;
    case GLFW_KEY_RIGHT_BRACKET:
        s->clock.speed = fmin(s->clock.speed * 2, 64);
        break;
    case GLFW_KEY_HOME:
        s->clock.time = v->document.values.time.start;
        break;
    case GLFW_KEY_X:
        s->view.compare = (s->view.compare + 1) % 3;
        break;
    case GLFW_KEY_L:
        s->view.layer = (s->view.layer + 1) % (MGT_LAYER_NORMAL + 1);
        break;
    case GLFW_KEY_MINUS:
        expose(v, -0.5);
        break;
    case GLFW_KEY_EQUAL:
        expose(v, 0.5);
        break;
    case GLFW_KEY_I:
        flip(&s->panel.inspector);
        if (s->inspect.x == 0 && s->inspect.y == 0) /* no pixel has been chosen yet */
            s->inspect = (inspect_settings){v->place.width / 2, v->place.height * 2 / 3};
        break;
    case GLFW_KEY_T:
        flip(&s->panel.timings);
        break;
    case GLFW_KEY_C:
        viewer_copy_command(v);
        break;
    case GLFW_KEY_F12:
        save_named_picture(v);
        break;
    case GLFW_KEY_TAB:
        flip(&s->panel.shown);
        break;
    case GLFW_KEY_F11:
        full_screen(v);
        break;
    case GLFW_KEY_F1:
        flip(&s->panel.keys);
        break;
    case GLFW_KEY_SLASH:
        if (shift)
            flip(&s->panel.keys);
        break;
    case GLFW_KEY_ESCAPE:
        s->panel.keys = 0;
        if (v->dialog.shown)
            dialog_toggle(v);
        break;
    default:
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_6)
            s->sides[shift ? SIDE_B : SIDE_A].method = key - GLFW_KEY_1;
        break;
    }
}

void input_key(viewer *v, int key, int label, int action, int modifiers)
{
    static const int held[] = {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E};
    for (int i = 0; i < 6; i++)
        if (key == held[i])
            v->pointer.keys[i] = action != GLFW_RELEASE && !ui_takes_keys() && !(modifiers & GLFW_MOD_CONTROL);
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT)
        v->pointer.fast = action != GLFW_RELEASE;
    const bool steps = modifiers & GLFW_MOD_CONTROL && (label == GLFW_KEY_Z || label == GLFW_KEY_Y);
    const bool repeats = label == GLFW_KEY_COMMA || label == GLFW_KEY_PERIOD || steps;
    if (!ui_takes_keys() && (action == GLFW_PRESS || (action == GLFW_REPEAT && repeats)))
        press(v, label, modifiers);
}

void input_press_key(viewer *v, const char *name)
{
    int modifiers;
    const int key = key_from_name(name, &modifiers);
    if (key < 0)
        return;
    input_key(v, key, key, GLFW_PRESS, modifiers);
    input_key(v, key, key, GLFW_RELEASE, modifiers);
}

/* ---- GLFW ---- */

static viewer *viewer_of(GLFWwindow *window) { return glfwGetWindowUserPointer(window); }

/* The key of a letter by its label. GLFW names keys by their places on a US keyboard, and on others Z and Y, or Q and A, have changed places. */
static int label_of(int key, int scancode)
{
    const char *name = glfwGetKeyName(key, scancode);
    return name && name[0] >= 'a' && name[0] <= 'z' && !name[1] ? GLFW_KEY_A + name[0] - 'a' : key;
}

static void on_key(GLFWwindow *window, int key, int scancode, int action, int modifiers)
{
    ui_on_key(window, key, scancode, action, modifiers);
    input_key(viewer_of(window), key, label_of(key, scancode), action, modifiers);
}

static void on_button(GLFWwindow *window, int button, int action, int modifiers)
{
    ui_on_button(window, button, action, modifiers);
    input_button(viewer_of(window), button, action, modifiers);
}

static void on_pointer(GLFWwindow *window, double x, double y) { input_pointer(viewer_of(window), x, y); }

static void on_scroll(GLFWwindow *window, double x, double y)
{
    const bool held = glfwGetKey(window, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS || glfwGetKey(window, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
    ui_on_scroll(window, x, y);
    input_scroll(viewer_of(window), y, held ? GLFW_MOD_CONTROL : 0);
}

static void on_focus(GLFWwindow *window, int focused)
{
    viewer *v = viewer_of(window);
    ui_on_focus(window, focused);
    memset(v->pointer.keys, 0, sizeof v->pointer.keys); /* the release of a key in another window is not reported */
    v->pointer.fast = false;
}

static void on_drop(GLFWwindow *window, int count, const char **paths)
{
    for (int i = 0; i < count; i++)
        viewer_drop(viewer_of(window), paths[i]);
}

void input_install(viewer *v)
{
    glfwSetWindowUserPointer(v->window, v);
    glfwSetKeyCallback(v->window, on_key);
    glfwSetCharCallback(v->window, ui_on_character);
    glfwSetMouseButtonCallback(v->window, on_button);
    glfwSetCursorPosCallback(v->window, on_pointer);
    glfwSetScrollCallback(v->window, on_scroll);
    glfwSetWindowFocusCallback(v->window, on_focus);
    glfwSetCursorEnterCallback(v->window, ui_on_enter);
    glfwSetDropCallback(v->window, on_drop);
}

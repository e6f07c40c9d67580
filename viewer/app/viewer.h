/* SPDX-License-Identifier: MIT
 * The state of the viewer, and the functions that work on it, by file. Everything here belongs to the main thread, which owns the window and its OpenGL
 * context. */
#ifndef MANGATA_VIEWER_APP_VIEWER_H
#define MANGATA_VIEWER_APP_VIEWER_H

#include "viewer/ui/controls.h"
#include "viewer/scene/history.h"
#include "mangata/gl.h"
#include "viewer/picture/film_export.h"
#include "viewer/picture/judge.h"
#include "viewer/picture/picture_saver.h"
#include "viewer/picture/render_worker.h"
#include "viewer/picture/timings.h"
#include "viewer/scene/scene_places.h"
#include "viewer/ui/ui_shim.h"
#include "cli/view_request.h"

enum { VIEWER_TEXT = 640, LOG_LINES = 200, OPEN_PATH = 4096 };

/* ---- parts of the state ---- */

/* The scene that the picture shows now: document, settings, clock and camera put together. It holds its own waves. */
typedef struct shot {
    mgt_scene scene; /* image.width and image.height are not set */
    mgt_wave waves[MGT_MAX_WAVES];
    struct scene_models *models; /* borrowed from the document, unless noted otherwise */
} shot;

/* Place of the picture in the window, window coordinates. */
typedef struct picture_place {
    ui_rect room;           /* the part of the window beside the panel */
    ui_rect place;          /* the picture within `room` */
    uint32_t width, height; /* full size of the picture, pixels */
} picture_place;

/* The renderers and their orders. A side without samples is rendered by OpenGL in the window's own context, or by the worker `live`. A side with samples is
 * rendered by the worker `refining`, on the CPU. */
typedef struct renderers {
    render_worker *live, *refining; /* live is NULL while OpenGL renders */
    mgt_context *gl;                /* renders with OpenGL; NULL: the CPU renders */
    mgt_context *tools;             /* a CPU context of one thread, for the inspector; NULL: it has not been needed yet */
    mgt_context_info info;          /* of the context that renders sides without samples */
    picture pictures[SIDE_COUNT];   /* the last picture of each side from a worker */
    uint64_t serial;                /* number of the last order; 0: none */
    uint64_t shown[SIDE_COUNT];     /* number of the order that each side's texture shows */
    shot ordered;                   /* what the last order shows; owns a share of its models */
    render_order last;              /* the last order; serial 0: the next frame gives a new one */
    double seconds_per_pixel;       /* smoothed render time of sides without samples; 0: not measured */
    double changed_at;              /* seconds_now() of the last change of what is shown */
    bool reduced;                   /* the last order is smaller than the full size, because something moves */
    bool behind;                    /* a change waits until the worker has rendered the last order */
    int64_t shader_stamp;           /* stamp of the shader files of --shaders that are in use; 0: the built-in ones are */
} renderers;

/* The last lines of the log, a ring. */
typedef struct journal {
    char lines[LOG_LINES][256];
    int count, next; /* number of lines; index of the next one */
} journal;

/* A line over the picture. */
typedef struct notice {
    char text[VIEWER_TEXT];
    bool is_error;
    double until; /* seconds_now() when a message disappears; errors do not read it */
} notice;

/* DRAG_WIPE moves the divider. DRAG_GRAB moves the camera with the water under the pointer, DRAG_SLIDE in its own plane. DRAG_SHIFT moves the magnified
 * part. */
typedef enum drag_kind { DRAG_NONE, DRAG_WIPE, DRAG_ORBIT, DRAG_LOOK, DRAG_GRAB, DRAG_SLIDE, DRAG_SHIFT } drag_kind;

/* What the pointer drags while a button is pressed. */
typedef struct drag {
    drag_kind kind;
    double x, y;       /* place of the press, window coordinates */
    mgt_camera camera; /* the camera at the press */
    double point[3];   /* DRAG_GRAB: the grabbed point of the water, metres */
    double offset[2];  /* from the pointer to the place at which that point is seen, fractions of the picture */
} drag;

typedef struct pointer_state {
    double x, y;        /* window coordinates */
    double scrolled_at; /* seconds_now() of the wheel's last step */
    drag drag;
    bool keys[6]; /* held: W A S D Q E */
    bool fast;    /* held: Shift */
} pointer_state;

/* What is known of the inspected pixel. */
typedef struct inspection {
    bool valid; /* false: nothing is known */
    mgt_pixel_info info;
    uint32_t x, y;
    uint64_t serial; /* number of the order that was inspected */
} inspection;

/* The comparison of A and B with brute force. */
typedef struct judging {
    judge *judge;    /* NULL: not needed yet */
    uint64_t serial; /* number of the order that is judged; 0: none */
    judgement found;
    bool has_found;
} judging;

/* The choices for the next film. */
typedef struct film_choice {
    char name[VIEWER_TEXT]; /* file name; film_path() adds the ending of the kind */
    int kind;               /* index in the list `kinds` of film.c */
    uint32_t size[2];       /* pixels; 0: as in the window */
    uint32_t first, last;   /* first and last frame; a number beyond the scene's last frame stands for that frame */
    uint32_t crf;           /* constant rate factor of H.264 and HEVC, 0 (best) to 51 */
    bool replaces;          /* existing files are replaced */
} film_choice;

/* The dialog that opens a scene. */
typedef struct open_dialog {
    bool shown;
    char path[OPEN_PATH];   /* the text field */
    char folder[OPEN_PATH]; /* folder whose files are listed; empty: it has not been shown yet */
    char *shipped_folder;   /* folder of the shipped scenes, owned; NULL: it is missing, or the dialog is not shown */
    name_list shipped, recent, files;
} open_dialog;

typedef struct script script;

struct GLFWwindow;

typedef struct viewer {
    const view_request *request;
    struct GLFWwindow *window;
    gl_functions gl_functions;
    display *display;
    document document;
    settings settings;
    history history;
    control_board board;
    renderers render;
    picture_place place;
    timings timings;
    picture_saver *saver;           /* NULL: no picture has been saved yet */
    char progress[VIEWER_TEXT];     /* text about the picture that is being saved; empty: none is */
    char save_problem[VIEWER_TEXT]; /* why the last picture or film was not saved; empty: it was */
    journal journal;
    notice scene_error, shader_error, render_error, message;
    pointer_state pointer;
    ui_stand_in stand_in;
    inspection inspection;
    open_dialog dialog;
    judging judging;
    film_choice film;
    film_export *film_export; /* NULL: no film is being rendered */
    double film_fraction;     /* fraction of the film that is done */
    size_t selected_wave, selected_keyframe, selected_object;
    int held_handle;                                        /* index of the dragged handle in the plot of waves; -1: none */
    int open_tab;                                           /* page of the panel that the next frame opens, counted from 1; 0: no other one */
    char save_name[VIEWER_TEXT], picture_name[VIEWER_TEXT]; /* file names of the next scene and of the next picture */
    uint32_t picture_size[2];                               /* size of the next picture, pixels; 0: as in the window */
    script *script;                                         /* NULL: no script runs */
    double polled_at;                                       /* seconds_now() when the files were last looked at */
    double advanced_at;                                     /* seconds_now() of the last frame */
    float ui_scale;                                         /* scale of text and controls that is in use */
    int windowed[4];                                        /* place and size of the window before full screen */
    bool quit;                                              /* the main loop ends after this frame */
    int exit_code;
} viewer;

/* ---- messages (notices.c) ---- */

/* Adds a line to the log, which is also printed as a note of the console. */
void viewer_log(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Shows a line over the picture for a few seconds. */
void viewer_tell(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Shows the line and logs it. `is_error` selects its colour and a longer time. */
void viewer_report(viewer *v, bool is_error, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* ---- the scene of the moment (shot.c) ---- */

/* Fills the shot from document, settings and clock. False: the camera has no valid direction; v->scene_error then says so. `out` borrows the document's
 * models. */
bool viewer_take_shot(viewer *v, shot *out);

/* The values of a scene file whose frame 0 is the frame in the window, at width × height pixels. The caller frees them with scene_values_free(). False: out of
 * memory. */
bool viewer_frame_values(const viewer *v, uint32_t width, uint32_t height, scene_values *out);

/* Whether the camera follows the keyframes. */
bool viewer_follows_path(const viewer *v);

/* Takes the camera off the path at its present place. Returns the camera, which the caller may change. */
mgt_camera *viewer_free_camera(viewer *v);

/* Sets the camera back to that of the scene file, on the path if there is one, and ends magnifying. */
void viewer_reset_camera(viewer *v);

/* Reverts every change since the scene was read. */
void viewer_revert(viewer *v);

/* Replaces wind, spectrum and swells by the waves that they have made. */
void viewer_write_out_sea(viewer *v);

/* What makes the waves. */
typedef enum sea_kind { SEA_OF_WAVES, SEA_OF_WIND, SEA_OF_SPECTRUM } sea_kind;
static inline sea_kind sea_of(const scene_water *w)
{
    return w->wind.speed > 0 ? SEA_OF_WIND : w->spectrum.settings.kind != SPECTRUM_NONE ? SEA_OF_SPECTRUM : SEA_OF_WAVES;
}
/* Chooses what makes the waves. Wind and spectrum take over each other's wind. */
void sea_choose(viewer *v, sea_kind kind);

/* Add and remove swells and single waves. An index beyond the list is ignored. A full list and lack of memory are reported. */
void swell_add(viewer *v);
void swell_remove(viewer *v, size_t index);
void wave_add(viewer *v);
void wave_remove(viewer *v, size_t index);

/* Stops the clock at the whole frame that is `frames` frames after the present one, or before it if that is negative. */
void viewer_step_frames(viewer *v, int frames);

/* Moves the clock and the camera on by so many seconds of the window. */
void viewer_advance(viewer *v, double seconds);

/* Reads the scene file again if it has changed. */
void viewer_poll_files(viewer *v);

/* ---- rendering (rendering.c) ---- */

/* Starts the renderers that the request asks for. False: it has printed a line and set v->exit_code. */
bool viewer_start_rendering(viewer *v);
/* Ends all renderers and frees what they own. */
void viewer_stop_rendering(viewer *v);

/* Takes the pictures that are ready, and orders new ones if what is shown has changed. Once a frame. */
void viewer_render(viewer *v);

/* Uses the shader files of --shaders if they have changed. A file with an error leaves the old ones in use, and v->shader_error says why. */
void viewer_poll_shaders(viewer *v);

/* Whether all that is shown is rendered at its full size, and sides with samples have at least `samples` of them (0: all). */
bool viewer_is_settled(const viewer *v, uint64_t samples);

/* The description of a CPU context, with the request's options. */
mgt_context_desc viewer_cpu_desc(const viewer *v);

/* Ends rendering with OpenGL and reports `why`. The CPU renders from then on. Does nothing if it does already. */
void viewer_lose_gl(viewer *v, const char *why);

/* The CPU context of one thread for the inspector. NULL: it cannot be created, which has been reported. */
mgt_context *viewer_tools(viewer *v);

/* ---- the judge (judging.c) ---- */

/* Begins to judge when nothing moves, stops when something does, and takes the figures. Once a frame. */
void viewer_judge(viewer *v);

/* ---- another scene (open.c) ---- */

/* Sets the window's title to the name of the scene. */
void viewer_set_title(viewer *v);

/* Opens another scene in place of this one, as a step that can be undone. False: nothing has changed, and `error` says why. */
bool viewer_open(viewer *v, const char *path, char *error, size_t error_size);

/* Replaces the document. Takes ownership of what `other` owns, and empties it. */
void viewer_take_document(viewer *v, document *other);

/* Takes a file that was dropped on the window: opens a scene, or adds a model as an object. */
void viewer_drop(viewer *v, const char *path);

/* Shows or hides the dialog. */
void dialog_toggle(viewer *v);
void dialog_free(viewer *v); /* frees the lists of the dialog */

/* ---- films (film.c) ---- */

/* Begins to render the film that v->film describes by side A's method, in a process of its own. False: `error` says why. */
bool film_begin(viewer *v, char *error, size_t error_size);
/* Ends the film's process, which removes unfinished files. */
void film_stop(viewer *v);

/* Reports a film that has been saved or has failed. Returns whether one is still being rendered. Once a frame. */
bool film_watch(viewer *v);

/* Chooses the kind of film by the ending of its name. False: no kind has that ending. */
bool film_take_kind(viewer *v);

/* Writes the path of the film with its ending to `path`. */
void film_path(const viewer *v, char *path, size_t size);

/* ---- results (results.c) ---- */

/* The command line "mangata render …" that renders this frame. The caller frees it. NULL: out of memory. */
char *viewer_command(const viewer *v);
/* Puts that command into the clipboard, and reports it. */
void viewer_copy_command(viewer *v);

/* Begins to render side A into a .png or .exr file in the background, at width × height pixels (0: as in the window). An existing file is replaced. False:
 * `error` says why. */
bool viewer_save_picture(viewer *v, const char *path, uint32_t width, uint32_t height, char *error, size_t error_size);

/* Reports a picture that has been saved or has failed. Returns whether one is still being saved. Once a frame. */
bool viewer_watch_saver(viewer *v);

/* Writes the window's pixels to a .png file. An existing file is replaced. False: `error` says why. */
bool viewer_save_window(const viewer *v, const char *path, char *error, size_t error_size);

/* The window's pixels as RGBA, 4 bytes each, top row first. The caller frees them. NULL: out of memory. */
uint8_t *viewer_read_window(const viewer *v, uint32_t *width, uint32_t *height);

/* Writes the scene with its changes to a new file, and reports that. A scene with a path has no other camera, which the report says where the camera is off the
 * path. False: `error` says why. */
bool viewer_save_scene(viewer *v, const char *path, char *error, size_t error_size);

/* Updates v->inspection to the pixel that the settings name, if it is out of date. */
void viewer_inspect(viewer *v);

/* Finds the point of the water in the pixel at `at`. `at` and `middle`, the pixel's centre, are fractions of the picture's width and height. `point` is in
 * metres. False: the pixel shows no water. */
bool viewer_point_at(viewer *v, const double at[2], double point[3], double middle[2]);

/* ---- undo (undo.c) ---- */

/* Keeps what has changed as one step of undo, as soon as nothing is held any more. `all`: at once. Once a frame. */
void viewer_keep_step(viewer *v, bool all);

/* Undoes a step (`by` is -1) or redoes one (1), and shows what has changed. False: there is no such step, or memory has run out. */
bool viewer_undo(viewer *v, int by);

/* ---- input (input.c, pointer.c) ---- */

/* Events of GLFW and of scripts. Places are in window coordinates. Keys, buttons, actions and modifiers have GLFW's numbers. `key` is a place on the
 * keyboard, by which the camera moves, `label` the key of that label, for all else. input_scroll() takes steps of the wheel. */
void input_key(viewer *v, int key, int label, int action, int modifiers);
void input_button(viewer *v, int button, int action, int modifiers);
void input_pointer(viewer *v, double x, double y);
void input_scroll(viewer *v, double amount, int modifiers);
/* Installs GLFW's callbacks on the window. */
void input_install(viewer *v);

/* Converts a place in the window to fractions of the picture's width and height, which lie outside of [0, 1] beside the picture. */
void input_fraction(const viewer *v, double x, double y, double fraction[2]);

/* A line of the list of keys. */
typedef struct key_help {
    const char *keys, *what;
} key_help;
extern const key_help key_helps[];
extern const size_t key_help_count;

/* Presses and releases the key of this name. An unknown name does nothing. */
void input_press_key(viewer *v, const char *name);

/* GLFW's number of the key of a name such as "space", "F1", "w", "?" or "ctrl+z"; -1: there is none. `modifiers` gets GLFW's bits. */
int key_from_name(const char *name, int *modifiers);

/* ---- scripts (script.c) ---- */

/* Opens a script; "-" is the standard input. `path` must outlive it. NULL: it cannot be opened, or memory has run out. */
script *script_open(const char *path);
void script_close(script *s);
/* Runs commands until one waits. Once a frame, after the window's events. */
void script_step(viewer *v);
/* Takes the window's pixels if a command asks for them. Once a frame, after drawing and before the window shows it. */
void script_after_frame(viewer *v);

#endif

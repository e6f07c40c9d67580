/* SPDX-License-Identifier: MIT
 * The viewer's state and its parts: one file a part, all over one struct. */
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

/* ---- parts ---- */

/* What the picture is made of right now: the scene of this moment, as changed, in memory of its own. */
typedef struct shot {
    mgt_scene scene; /* without the image's size */
    mgt_wave waves[MGT_MAX_WAVES];
    struct scene_models *models; /* borrowed of the document */
} shot;

/* Where the picture lies in the window, window coordinates. */
typedef struct picture_place {
    ui_rect room;           /* what the panels leave */
    ui_rect place;          /* the picture within */
    uint32_t width, height; /* its full size, pixels */
} picture_place;

/* One renderer: either the CPU worker or OpenGL on the window's own context. */
typedef struct renderers {
    render_worker *live, *refining;
    mgt_context *gl;       /* NULL: the CPU renders */
    mgt_context *tools;    /* of one thread, for the inspector; made when first needed */
    mgt_context_info info; /* of what renders the sides without samples */
    picture pictures[SIDE_COUNT];
    uint64_t serial;            /* of the last order */
    uint64_t shown[SIDE_COUNT]; /* order that each side's texture is of */
    shot ordered;               /* what the last order showed, with a share of its models */
    render_order last;          /* the last order */
    double seconds_per_pixel;   /* of live frames, smoothed */
    double changed_at;          /* seconds_now() of the last change */
    bool reduced;               /* the last order was below the full size */
    bool behind;                /* what is to be seen has not been ordered yet */
    int64_t shader_stamp;       /* of the kernel files in use; 0: the built-in ones */
} renderers;

typedef struct journal {
    char lines[LOG_LINES][256];
    int count, next;
} journal;

/* The banner over the picture. */
typedef struct notice {
    char text[VIEWER_TEXT];
    bool is_error;
    double until; /* seconds_now(); 0: until it is taken away */
} notice;

typedef enum drag_kind { DRAG_NONE, DRAG_WIPE, DRAG_ORBIT, DRAG_LOOK, DRAG_GRAB, DRAG_SLIDE, DRAG_SHIFT } drag_kind;

/* What the pressed button does. */
typedef struct drag {
    drag_kind kind;
    double x, y;       /* of the press */
    mgt_camera camera; /* then */
    double point[3];   /* grabbed, of the water */
    double offset[2];  /* from the pointer to where that point is seen, fractions of the picture */
} drag;

typedef struct pointer_state {
    double x, y;
    double scrolled_at; /* seconds_now() of the wheel's last step */
    drag drag;
    bool keys[6]; /* W A S D Q E */
    bool fast;
} pointer_state;

typedef struct inspection {
    bool valid;
    mgt_pixel_info info;
    uint32_t x, y;
    uint64_t serial; /* of the order it belongs to */
} inspection;

/* A and B against brute force. */
typedef struct judging {
    judge *judge;    /* NULL: not needed yet */
    uint64_t serial; /* of the order that is judged; 0: none */
    judgement found;
    bool has_found;
} judging;

/* What the next film is to be. */
typedef struct film_choice {
    char name[VIEWER_TEXT]; /* its ending follows the kind */
    int kind;               /* place in the list of film.c */
    uint32_t size[2];       /* 0: as in the window */
    uint32_t first, last;   /* frames; beyond the last one: that */
    uint32_t crf;
    bool replaces; /* files that are there */
} film_choice;

typedef struct open_dialog {
    bool shown;
    char path[OPEN_PATH];   /* typed */
    char folder[OPEN_PATH]; /* whose files are listed; empty: the current one */
    char *shipped_folder;   /* owned; NULL: missing, or not shown */
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
    picture_saver *saver;           /* NULL: nothing has been saved yet */
    char progress[VIEWER_TEXT];     /* what goes on in the background; empty: nothing */
    char save_problem[VIEWER_TEXT]; /* of the last picture saved; empty: it is there */
    journal journal;
    notice scene_error, shader_error, render_error, message;
    pointer_state pointer;
    ui_stand_in stand_in;
    inspection inspection;
    open_dialog dialog;
    judging judging;
    film_choice film;
    film_export *film_export; /* NULL: none is under way */
    double film_fraction;     /* of it that is done */
    size_t selected_wave, selected_keyframe, selected_object;
    int held_handle; /* of the plot of waves; -1: none */
    int open_tab;    /* page of the panel to open, from 1; 0: as it is */
    char save_name[VIEWER_TEXT], picture_name[VIEWER_TEXT];
    uint32_t picture_size[2]; /* of the next picture; 0: as in the window */
    script *script;           /* NULL: none */
    double polled_at;         /* seconds_now() when the files were last looked at */
    double advanced_at;       /* seconds_now() when the clock last went on */
    float ui_scale;           /* in use */
    int windowed[4];          /* place and size to go back to from full screen */
    bool quit;
    int exit_code;
} viewer;

/* ---- messages (notices.c) ---- */

void viewer_log(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Shows a line over the picture for a few seconds. */
void viewer_tell(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same, and logs it. */
void viewer_report(viewer *v, bool is_error, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* ---- the scene of the moment (shot.c) ---- */

/* Fills the shot from document and settings. False, with the reason as a notice, where there is no legal scene. */
bool viewer_take_shot(viewer *v, shot *out);

/* The values that a scene file must have to show the frame in the window as its frame 0; to be freed. False when memory runs out. */
bool viewer_frame_values(const viewer *v, uint32_t width, uint32_t height, scene_values *out);

/* Whether the camera comes from the keyframes now. */
bool viewer_follows_path(const viewer *v);

/* Takes the camera off the path, where it stands, so that it can be moved. */
mgt_camera *viewer_free_camera(viewer *v);

void viewer_reset_camera(viewer *v);

/* Takes back every change since the scene was read. */
void viewer_revert(viewer *v);

/* Turns the sea into single waves. */
void viewer_write_out_sea(viewer *v);

/* What makes the waves; chosen anew, one takes the wind of the other. */
typedef enum sea_kind { SEA_OF_WAVES, SEA_OF_WIND, SEA_OF_SPECTRUM } sea_kind;
static inline sea_kind sea_of(const scene_water *w)
{
    return w->wind.speed > 0 ? SEA_OF_WIND : w->spectrum.settings.kind != SPECTRUM_NONE ? SEA_OF_SPECTRUM : SEA_OF_WAVES;
}
void sea_choose(viewer *v, sea_kind kind);

void swell_add(viewer *v);
void swell_remove(viewer *v, size_t index);
void wave_add(viewer *v);
void wave_remove(viewer *v, size_t index);

void viewer_step_frames(viewer *v, int frames);

/* Runs clock and camera on by so many seconds. */
void viewer_advance(viewer *v, double seconds);

/* Reads scene and shader files again where they have changed. */
void viewer_poll_files(viewer *v);

/* ---- rendering (rendering.c) ---- */

/* Starts the renderers that the request asks for. False with the exit code in v->exit_code and a line printed. */
bool viewer_start_rendering(viewer *v);
void viewer_stop_rendering(viewer *v);

/* Orders what is to be seen, takes what is done. */
void viewer_render(viewer *v);

/* Takes kernel files of --shaders that have changed. */
void viewer_poll_shaders(viewer *v);

/* All that is to be seen is rendered at its full size; refining sides have at least `samples` samples (0: all of them). */
bool viewer_is_settled(const viewer *v, uint64_t samples);

/* The machine's part of every CPU context. */
mgt_context_desc viewer_cpu_desc(const viewer *v);

/* Goes on with the CPU where OpenGL cannot. */
void viewer_lose_gl(viewer *v, const char *why);

/* A context for single pixels and pictures on the side; NULL with a notice. */
mgt_context *viewer_tools(viewer *v);

/* ---- the judge (judging.c) ---- */

/* Begins to judge once all rests, ends when something moves, takes the figures. Once a frame. */
void viewer_judge(viewer *v);

/* ---- another scene (open.c) ---- */

void viewer_set_title(viewer *v);

/* Opens another scene in place of this one, as a step that can be undone. False with the reason in `error`, and nothing has changed. */
bool viewer_open(viewer *v, const char *path, char *error, size_t error_size);

/* Shows a document of another file; takes over what it owns. */
void viewer_take_document(viewer *v, document *other);

/* A file dropped on the window: a scene is opened, a model becomes an object. */
void viewer_drop(viewer *v, const char *path);

/* Shows or hides the dialog. */
void dialog_toggle(viewer *v);
void dialog_free(viewer *v); /* what it lists */

/* ---- films (film.c) ---- */

/* Begins to render the film that v->film says, by side A's method, in a process of its own. */
bool film_begin(viewer *v, char *error, size_t error_size);
void film_stop(viewer *v);

/* Tells of a film that has been saved, or of why it has not. True while one is under way. */
bool film_watch(viewer *v);

/* Chooses the kind by the ending of the film's name. False where no kind has it. */
bool film_take_kind(viewer *v);

/* The path of the film, its ending included. */
void film_path(const viewer *v, char *path, size_t size);

/* ---- results (results.c) ---- */

/* `mangata render …` that gives this frame; to be freed. NULL when memory runs out. */
char *viewer_command(const viewer *v);
void viewer_copy_command(viewer *v);

/* Begins to render side A at a size (0: as in the window) into a .png or .exr, in the background; an existing file is replaced. */
bool viewer_save_picture(viewer *v, const char *path, uint32_t width, uint32_t height, char *error, size_t error_size);

/* Tells of a picture that has been saved, or of why it has not. True while one is under way. */
bool viewer_watch_saver(viewer *v);

/* What stands in the window, as a PNG. */
bool viewer_save_window(const viewer *v, const char *path, char *error, size_t error_size);

/* The window's pixels, top row first, 4 bytes each; to be freed. */
uint8_t *viewer_read_window(const viewer *v, uint32_t *width, uint32_t *height);

bool viewer_save_scene(viewer *v, const char *path, char *error, size_t error_size);

/* Looks into the pixel that the settings name. */
void viewer_inspect(viewer *v);

/* The place of the water in the pixel at fractions of the picture's width and height, and the pixel's own middle; false where there is none. */
bool viewer_point_at(viewer *v, const double at[2], double point[3], double middle[2]);

/* ---- undo (undo.c) ---- */

/* Keeps what has changed as one step, once nothing is held any more; `all`: at once. Every frame. */
void viewer_keep_step(viewer *v, bool all);

/* Steps back by -1, on by 1, and tells over the picture what has changed. False where there is no such step. */
bool viewer_undo(viewer *v, int by);

/* ---- input (input.c, pointer.c) ---- */

/* What GLFW reports, and scripts too. Places in window coordinates; keys, buttons and actions as GLFW numbers them. */
void input_key(viewer *v, int key, int action, int modifiers);
void input_button(viewer *v, int button, int action, int modifiers);
void input_pointer(viewer *v, double x, double y);
void input_scroll(viewer *v, double amount, int modifiers);
void input_install(viewer *v);

/* Place in the finished picture, fractions of its width and height, of a place in the window. */
void input_fraction(const viewer *v, double x, double y, double fraction[2]);

typedef struct key_help {
    const char *keys, *what;
} key_help;
extern const key_help key_helps[];
extern const size_t key_help_count;

/* As if the key of this name were pressed and let go. */
void input_press_key(viewer *v, const char *name);

/* GLFW's number of a key by name ("space", "F1", "w", "?"); -1 where there is none. */
int key_from_name(const char *name, int *modifiers);

/* ---- scripts (script.c) ---- */

script *script_open(const char *path);
void script_close(script *s);
/* Goes on with the script; called once a frame before events are handled. */
void script_step(viewer *v);
/* After a frame is drawn and before it is shown. */
void script_after_frame(viewer *v);

#endif

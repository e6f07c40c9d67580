/* SPDX-License-Identifier: MIT
 * Presets of seas, folders of scenes, and the list of recent scenes. */
#define _GNU_SOURCE
#include "viewer/scene/scene_places.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/output_file.h"

enum { RECENT_MOST = 12, PATH_SIZE = 4096 };

const sea_preset sea_presets[] = {
    {"light air, 3 m/s", "--sea wind=3"},
    {"gentle breeze, 5 m/s", "--sea wind=5"},
    {"fresh breeze, 9 m/s", "--sea wind=9"},
    {"strong wind, 13 m/s", "--sea wind=13"},
    {"gale, 19 m/s", "--sea wind=19"},
    {"lake, 3 km of fetch", "--sea wind=8,fetch=3000"},
    {"bay, 4 m deep", "--sea wind=9,fetch=20000,depth=4"},
    {"ocean swell", "--sea wind=3,swell=2,swell_period=14"},
    {"breeze over swell from the side", "--sea wind=7,swell=1.5,swell_period=12,swell_direction=60"},
};
const size_t sea_preset_count = sizeof sea_presets / sizeof sea_presets[0];

static bool ends_with(const char *name, const char *const *endings)
{
    const char *dot = strrchr(name, '.');
    for (; dot && *endings; endings++)
        if (strcasecmp(dot, *endings) == 0)
            return true;
    return false;
}

bool is_scene_name(const char *name) { return ends_with(name, (const char *const[]){".yaml", ".yml", ".json", NULL}); }

bool is_model_name(const char *name) { return ends_with(name, (const char *const[]){".gltf", ".glb", ".obj", ".ply", NULL}); }

/* ---- lists ---- */

void name_list_free(name_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->names[i]);
    free(list->names);
    *list = (name_list){0};
}

/* Appends a name, of which it takes ownership. NULL is ignored. If memory runs out, the name is dropped. */
static void add(name_list *list, char *name)
{
    char **names = name ? realloc(list->names, (list->count + 1) * sizeof *names) : NULL;
    if (!names) {
        free(name);
        return;
    }
    list->names = names;
    names[list->count++] = name;
}

/* ---- folders ---- */

char *shipped_folder(void)
{
    static const char *const places[] = {"../share/mangata/scenes", "../scenes"}; /* beside an installed program, and beside one in the build folder */
    char program[PATH_SIZE];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0)
        return NULL;
    program[length] = 0;
    char *slash = strrchr(program, '/');
    if (slash)
        *slash = 0;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        char *path = NULL, *whole = NULL;
        if (asprintf(&path, "%s/%s", program, places[i]) > 0)
            whole = realpath(path, NULL);
        free(path);
        if (whole)
            return whole;
    }
    return NULL;
}

name_list scenes_of_folder(const char *folder)
{
    name_list list = {0};
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, NULL, alphasort);
    /* Folders come first. */
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < count; i++) {
            const char *name = entries[i]->d_name;
            char path[PATH_SIZE], *text = NULL;
            struct stat status;
            if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path || stat(path, &status) != 0 ||
                (name[0] == '.' && strcmp(name, "..") != 0))
                continue;
            const bool is_folder = S_ISDIR(status.st_mode);
            if (is_folder == (pass == 0) && (is_folder || (S_ISREG(status.st_mode) && is_scene_name(name))) &&
                asprintf(&text, "%s%s", name, is_folder ? "/" : "") > 0)
                add(&list, text);
        }
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
    return list;
}

/* ---- recent scenes ---- */

/* The folder of the viewer's state, which the caller frees. NULL: there is none, or memory has run out. */
static char *state_folder(void)
{
    const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    char *path = NULL;
    if (state && state[0] == '/')
        return asprintf(&path, "%s/mangata", state) > 0 ? path : NULL;
    return home && home[0] == '/' && asprintf(&path, "%s/.local/state/mangata", home) > 0 ? path : NULL;
}

name_list recent_scenes(void)
{
    name_list list = {0};
    char *folder = state_folder(), *path = NULL, line[PATH_SIZE];
    FILE *stream = folder && asprintf(&path, "%s/recent", folder) > 0 ? fopen(path, "r") : NULL;
    while (stream && list.count < RECENT_MOST && fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\n")] = 0;
        if (line[0])
            add(&list, strdup(line));
    }
    if (stream)
        fclose(stream);
    free(path);
    free(folder);
    return list;
}

/* Creates a folder and those above it. Failures show when a file is written. */
static void make_folders(char *path)
{
    for (char *p = path + 1; (p = strchr(p, '/')); p++) {
        *p = 0;
        mkdir(path, 0777);
        *p = '/';
    }
    mkdir(path, 0700);
}

void recent_add(const char *path)
{
    const bool is_file = strncmp(path, "--", 2) != 0;
    char *folder = state_folder(), *file = NULL, *text = NULL, *whole = is_file ? realpath(path, NULL) : strdup(path);
    size_t size = 0;
    name_list old = recent_scenes();
    FILE *stream = folder && whole && !strchr(whole, '\n') && asprintf(&file, "%s/recent", folder) > 0 ? open_memstream(&text, &size) : NULL;
    if (stream) {
        const output_options options = {.overwrite = true};
        file_error unused;
        fprintf(stream, "%s\n", whole);
        for (size_t i = 0, kept = 1; i < old.count && kept < RECENT_MOST; i++)
            if (strcmp(old.names[i], whole) != 0) {
                fprintf(stream, "%s\n", old.names[i]);
                kept++;
            }
        if (fclose(stream) == 0) {
            make_folders(folder);
            (void)output_file_write_whole(file, text, size, &options, &unused);
        }
    }
    name_list_free(&old);
    free(text);
    free(whole);
    free(file);
    free(folder);
}

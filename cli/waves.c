/* SPDX-License-Identifier: MIT */
/* `mangata waves`: a scene from the wave spectrum of a wind or of a buoy. */
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "image/output_file.h"
#include "cli/common/interrupt.h"
#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "params/waves.h"
#include "scene/scene_edit.h"
#include "scene/scene_sea.h"
#include "cli/common/verbs.h"
#include "cli/waves_report.h"

/* The first options of the table. They are keys of the scene's `water.spectrum`. */
enum {
    OPT_MODEL,
    OPT_WIND,
    OPT_WIND_HEIGHT,
    OPT_FETCH,
    OPT_DEPTH,
    OPT_GAMMA,
    OPT_DIRECTION,
    OPT_DIRECTIONS,
    OPT_SPREAD,
    OPT_SLOPE,
    OPT_SHORTEST,
    OPT_COUNT,
    OPT_SEED,
    OPT_FILE,
    SPECTRUM_OPTIONS
};

static const char *const keys[SPECTRUM_OPTIONS] =
    {[OPT_MODEL] = "model",   [OPT_WIND] = "wind",   [OPT_WIND_HEIGHT] = "wind_height", [OPT_FETCH] = "fetch",
     [OPT_DEPTH] = "depth",   [OPT_GAMMA] = "gamma", [OPT_DIRECTION] = "direction_deg", [OPT_DIRECTIONS] = "directions",
     [OPT_SPREAD] = "spread", [OPT_SLOPE] = "slope", [OPT_SHORTEST] = "shortest",       [OPT_COUNT] = "count",
     [OPT_SEED] = "seed",     [OPT_FILE] = "file"};

static const option waves_options[];

typedef struct waves_request {
    console out;
    scene_values values;     /* defaults, then the values of --base */
    scene_spectrum spectrum; /* the spectrum; it borrows the name of its file */
    bool given[SPECTRUM_OPTIONS];
    const char *output, *base;
    scene_changes changes;
    bool as_spectrum, overwrite;
} waves_request;

/* ---- the command line --------------------------------------------------------------------------------------- */

static const field_row *spectrum_field(const scene_values *values, const char *key, const void **place)
{
    char path[64];
    snprintf(path, sizeof path, "water.spectrum.%s", key);
    return scene_values_find(values, path, place);
}

/* Reads the name of a choice into *place. */
static bool set_choice(const field_row *field, const char *text, int *place) { return field_parse(field, text, place); }

/* Reads a key of the spectrum with the checks of the scene format. */
static int set_key(const option *o, void *request, const char *text)
{
    waves_request *r = request;
    const int id = (int)(o - waves_options);
    const void *unused;
    const field_row *field = spectrum_field(&r->values, keys[id], &unused);
    void *place = (char *)&r->spectrum + field->offset;
    char allowed[160];
    double number;
    uint64_t whole;
    bool good = true;
    field_allowed(field, allowed, sizeof allowed);
    r->given[id] = true;
    switch (field->type) {
    case FIELD_CHOICE:
        good = set_choice(field, text, place) && (id != OPT_MODEL || r->spectrum.settings.kind != SPECTRUM_NONE);
        break;
    case FIELD_COUNT:
        good = number_parse_u64(text, (uint64_t)field->max, &whole) && (double)whole >= field->min;
        if (good)
            *(uint32_t *)place = (uint32_t)whole;
        break;
    case FIELD_NUMBER:
        number = 0;
        good = (id == OPT_DEPTH && strcmp(text, "inf") == 0) || (number_parse_double(text, &number) && field_in_range(field, number));
        if (good)
            *(double *)place = number;
        break;
    default:
        memcpy(place, &text, sizeof text);
        break; /* the path of the buoy's table */
    }
    return good ? EXIT_CODE_OK : option_wrong(o, text, id == OPT_MODEL ? "pierson-moskowitz, jonswap, tma, elfouhaily or buoy" : allowed);
}

static int refuse_operand(const option *o, void *place, const char *value)
{
    (void)o, (void)place;
    return console_error(EXIT_CODE_USAGE, "%s: mangata waves takes options alone; a scene to start from is --base SCENE", value);
}

/* Refuses an option that the spectrum does not take. */
static int refuse_unused(int id, const char *takers) { return console_error(EXIT_CODE_USAGE, "--%s: it is for %s alone", waves_options[id].name, takers); }

static int check_unused(const waves_request *r)
{
    static const int windy[] = {OPT_WIND, OPT_WIND_HEIGHT}, spread[] = {OPT_DIRECTIONS, OPT_SPREAD};
    const spectrum_settings *s = &r->spectrum.settings;
    const bool buoy = s->kind == SPECTRUM_BUOY;
    if (r->given[OPT_FETCH] && !spectrum_takes_fetch(s->kind))
        return refuse_unused(OPT_FETCH, "jonswap, tma and elfouhaily");
    if (r->given[OPT_GAMMA] && !spectrum_takes_gamma(s->kind))
        return refuse_unused(OPT_GAMMA, "jonswap and tma");
    for (size_t i = 0; i < 2; i++)
        if (r->given[windy[i]] && buoy && s->slope != SLOPE_COX_MUNK)
            return refuse_unused(windy[i], "the spectra of a wind, or for --slope cox-munk,");
    if (r->given[OPT_DIRECTION] && buoy)
        return refuse_unused(OPT_DIRECTION, "the spectra of a wind");
    for (size_t i = 0; i < 2; i++)
        if (r->given[spread[i]] && spectrum_has_directions(s->kind))
            return refuse_unused(spread[i], "pierson-moskowitz, jonswap and tma");
    if (r->given[OPT_SPREAD] && s->directions != DIRECTIONS_FIXED)
        return refuse_unused(OPT_SPREAD, "--directions fixed");
    return EXIT_CODE_OK;
}

/* Whether `change`, KEY=VALUE, is of `key` or of something in it. */
static bool changes_key(const char *change, const char *key)
{
    const size_t length = strlen(key);
    return strncmp(change, key, length) == 0 && !isalnum((unsigned char)change[length]) && change[length] != '_';
}

static bool changes_any(const scene_changes *changes, const char *key)
{
    for (size_t i = 0; i < changes->count; i++)
        if (changes_key(changes->items[i], key))
            return true;
    return false;
}

/* Refuses changes of what says which waves there are: that is up to the options here. */
static int check_changes(const scene_changes *changes)
{
    static const char *const keys_of_waves[] = {"water.wind", "water.waves", "water.sea", "water.swell", "water.spectrum"};
    for (size_t i = 0; i < sizeof keys_of_waves / sizeof keys_of_waves[0]; i++)
        if (changes_any(changes, keys_of_waves[i]))
            return console_error(EXIT_CODE_USAGE,
                                 "--set %s: the waves are those of --wind, --spectrum and the other options; --set is for the rest of the scene",
                                 keys_of_waves[i]);
    for (size_t i = 0; i < changes->count; i++)
        if (strncmp(changes->items[i], "water=", 6) == 0)
            return console_error(EXIT_CODE_USAGE, "--set water: one key of it at a time, such as water.choppiness=0.7");
    return EXIT_CODE_OK;
}

/* Refuses options that contradict each other. */
static int check_request(waves_request *r)
{
    spectrum_settings *s = &r->spectrum.settings;
    if (r->given[OPT_FILE] && !r->given[OPT_MODEL])
        s->kind = SPECTRUM_BUOY;
    if (r->given[OPT_FILE] && s->kind != SPECTRUM_BUOY)
        return console_error(EXIT_CODE_USAGE, "--buoy is for --spectrum buoy alone");
    if (s->kind == SPECTRUM_BUOY && !r->given[OPT_FILE])
        return console_error(EXIT_CODE_USAGE, "--spectrum buoy needs --buoy FILE");
    if (s->kind == SPECTRUM_TMA && !(s->depth > 0))
        return console_error(EXIT_CODE_USAGE, "--spectrum tma needs --depth M, above 0 and at most 12000");
    if (r->output && strcmp(r->output, "-") == 0)
        r->output = NULL;
    file_error error;
    if (r->output && output_file_check_kind(r->output, &error) != FILE_OK)
        return console_file_error(&error);
    const char *name = r->output ? strrchr(r->output, '.') : NULL;
    if (r->output && (!name || (strcasecmp(name, ".yaml") != 0 && strcasecmp(name, ".yml") != 0)))
        return console_error(EXIT_CODE_USAGE, "%s: allowed is a name that ends in .yaml or .yml, or - for standard output", r->output);
    const int code = check_unused(r);
    return code == EXIT_CODE_OK ? check_changes(&r->changes) : code;
}

/* ---- the scene ---------------------------------------------------------------------------------------------- */

/* The length of the folder in a path. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Whether the scene may go into another folder than that of --base, from which its relative paths start. */
static bool is_elsewhere(const waves_request *r)
{
    const size_t length = folder_length(r->base);
    return !r->output || length != folder_length(r->output) || memcmp(r->base, r->output, length) != 0;
}

/* Loads --base with the overrides, without its waves. */
static int load_base(const waves_request *r, scene_values *values)
{
    scene_error error = {0};
    const scene_values empty = scene_sea_values();
    scene_file *file = r->base ? scene_file_load(r->base, r->changes.items, r->changes.count, &error)
                               : scene_values_parse(&empty, "the scene", r->changes.items, r->changes.count, &error);
    if (!file) {
        console_scene_error(&error);
        return exit_code_of_scene_error(error.kind);
    }
    bool copied = scene_values_copy(values, scene_file_values(file));
    scene_file_free(file);
    if (copied && r->base && is_elsewhere(r))
        copied = scene_values_fix_files(values, r->base);
    if (!copied)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    scene_values_write_out_auto(values);
    /* That of the base tells of its waves. */
    if (r->base && !changes_any(&r->changes, "description")) {
        free(values->description);
        values->description = NULL;
    }
    free(values->water.waves.items);
    free(values->water.sea.items);
    free(values->water.swell.items);
    free(values->water.spectrum.file);
    values->water.waves = values->water.sea = values->water.swell = (scene_list){0};
    values->water.spectrum = (scene_spectrum){0};
    values->water.wind = scene_values_defaults().water.wind;
    return EXIT_CODE_OK;
}

/* The path of the table as the scene must hold it, which is relative to the scene's folder or absolute. The caller frees it. NULL: out of memory. */
static char *table_name(const waves_request *r)
{
    const bool elsewhere = r->as_spectrum && r->output && strchr(r->output, '/') && r->spectrum.file[0] != '/';
    char *name = elsewhere ? realpath(r->spectrum.file, NULL) : NULL;
    return name ? name : strdup(r->spectrum.file);
}

static int write_scene(const waves_request *r, const scene_values *values)
{
    const output_options options = {.overwrite = r->overwrite};
    file_error error;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    bool good = stream && scene_values_write(stream, values);
    if (stream)
        good = fclose(stream) == 0 && good;
    int code = good ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
    if (good && !r->output) {
        fwrite(text, 1, size, stdout);
    } else if (good) {
        interrupt_install(); /* so that no file is left incomplete */
        if (output_file_write_whole(r->output, text, size, &options, &error) != FILE_OK)
            code = console_file_error(&error);
    }
    free(text);
    return code;
}

/* The command-line option of a key of the scene format. */
static const char *option_of_key(const char *key)
{
    for (int i = 0; i < SPECTRUM_OPTIONS; i++)
        if (strcmp(keys[i], key) == 0)
            return waves_options[i].name;
    return key;
}

static int refuse_sea(const scene_sea_fault *fault)
{
    if (fault->setting.key)
        return console_error(EXIT_CODE_BAD_INPUT, "--%s %s", option_of_key(fault->setting.key), fault->setting.text);
    console_scene_error(&fault->error);
    return exit_code_of_scene_error(fault->error.kind);
}

/* Notes that a fetch is longer than a fully developed sea needs, because waves do not grow beyond that. */
static void warn_of_fetch(const waves_request *r, const wave_spectrum *spectrum, const console *out)
{
    const bool fetch = spectrum_takes_fetch(spectrum->kind);
    const double developed = 0.877 * SPECTRUM_GRAVITY / wind_at_height(spectrum->wind_10, 10, 19.5);
    if (fetch && spectrum->peak < developed)
        console_note(out, "a fetch of %g km is more than this wind needs for a fully developed sea: pierson-moskowitz fits better",
                     r->spectrum.settings.fetch / 1000);
}

/* Refuses waves that a scene cannot hold. */
static int check_heights(const scene_water *water)
{
    const scene_list all = scene_water_all(water);
    const mgt_wave *waves = all.items;
    for (size_t i = 0; i < all.count; i++)
        if (!(wave_crest(&waves[i]) <= 1000))
            return console_error(EXIT_CODE_BAD_INPUT, "water.amplitude is %g, which makes a wave of %g m; allowed: waves of at most 1000 m", water->height,
                                 wave_crest(&waves[i]));
    return EXIT_CODE_OK;
}

static int make_scene(const waves_request *r, scene_values *values, const console *out)
{
    static const char here[] = "";
    scene_sea_fault fault;
    scene_sea sea;
    waves_report report;
    values->water.spectrum = r->spectrum;
    values->water.spectrum.file = r->given[OPT_FILE] ? strdup(r->spectrum.file) : NULL;
    if (r->given[OPT_FILE] && !values->water.spectrum.file)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    if (!scene_sea_open(&sea, &values->water.spectrum, here, &fault))
        return refuse_sea(&fault);
    warn_of_fetch(r, &sea.spectrum, out);
    int code = scene_sea_fill(&values->water, here, &fault) ? check_heights(&values->water) : refuse_sea(&fault);
    const scene_list waves = scene_water_all(&values->water);
    if (code == EXIT_CODE_OK && !waves_report_make(&report, &r->spectrum, &sea, waves.items, waves.count))
        code = console_error(EXIT_CODE_FAILED, "out of memory");
    scene_sea_close(&sea);
    if (code != EXIT_CODE_OK)
        return code;
    if (!r->base && !changes_any(&r->changes, "camera"))
        scene_sea_place_camera(&values->camera.still, report.waves.height);
    if (!values->description)
        values->description = strdup(waves_report_title(&report).text);
    if (!r->as_spectrum)
        scene_values_write_out_sea(values);
    if (values->water.spectrum.file) {
        free(values->water.spectrum.file);
        values->water.spectrum.file = r->as_spectrum ? table_name(r) : NULL;
    }
    if (!out->json || r->output)
        code = write_scene(r, values);
    if (code != EXIT_CODE_OK)
        return code;
    if (out->json)
        return console_print_json(waves_report_json(&report, r->output));
    waves_report_print(&report, out);
    return EXIT_CODE_OK;
}

/* ---- the verb ----------------------------------------------------------------------------------------------- */

static int run(void *request)
{
    waves_request *r = request;
    int code = check_request(r);
    if (code == EXIT_CODE_OK)
        code = load_base(r, &r->values);
    return code == EXIT_CODE_OK ? make_scene(r, &r->values, &r->out) : code;
}

static const option waves_options[] = {
    [OPT_MODEL] = {"spectrum", 0, "NAME", "pierson-moskowitz, jonswap (default), tma, elfouhaily or buoy", .set = set_key},
    [OPT_WIND] = {"wind", 0, "SPEED", "of the wind in m/s (default 8)", .set = set_key},
    [OPT_WIND_HEIGHT] = {"wind-height", 0, "M",
                         "height above the sea at which that holds (default: as in the paper,\n"
                         "19.5 m for pierson-moskowitz, else 10 m)",
                         .set = set_key},
    [OPT_FETCH] = {"fetch", 0, "M", "open water that the wind has crossed: jonswap, tma, elfouhaily\n(default 50000)", .set = set_key},
    [OPT_DEPTH] = {"depth", 0, "M", "of the water (default inf; tma needs one)", .set = set_key},
    [OPT_GAMMA] = {"gamma", 0, "G", "peak enhancement factor: jonswap, tma (default 3.3)", .set = set_key},
    [OPT_DIRECTION] = {"direction", 0, "DEG",
                       "where the wind comes from: 0 (default) is -z, \"north\", whose waves\n"
                       "run towards +z; 90 is +x, \"east\"",
                       .set = set_key},
    [OPT_DIRECTIONS] = {"directions", 0, "NAME",
                        "how waves spread around it: mitsuyasu, hasselmann (default),\n"
                        "donelan-banner, or fixed with --spread; elfouhaily has its own",
                        .set = set_key},
    [OPT_SPREAD] = {"spread", 0, "S", "s of cos^2s of half the angle, for --directions fixed (default 10)", .set = set_key},
    [OPT_SLOPE] = {"slope", 0, "NAME", "slope variance of the short waves: spectrum (default), or cox-munk, a clean sea's", .set = set_key},
    [OPT_SHORTEST] = {"shortest", 0, "M", "length of the shortest wave (default 0.05; buoy: the table's end)", .set = set_key},
    [OPT_COUNT] = {"count", 'n', "N", "number of waves, 1 to 2048 (default 64)", .set = set_key},
    [OPT_SEED] = {"seed", 0, "N", "another seed: another sea of the same kind (default 1)", .set = set_key},
    [OPT_FILE] = {"buoy", 0, "FILE",
                  "a measured spectrum: lines of frequency (Hz), direction (degrees,\n"
                  "where waves come from), density (m^2/Hz/degree), or a file of\n"
                  "NDBC's (.data_spec, ...w2025.txt) or Datawell's (.spt); see docs/waves.md",
                  .set = set_key},
    {"output", 'o', "SCENE", "scene file to write, .yaml or .yml (default: standard output)", .set = option_text, .offset = offsetof(waves_request, output)},
    {"base", 0, "SCENE", "take all but the waves from this scene", .set = option_text, .offset = offsetof(waves_request, base)},
    {"set", 0, "KEY=VALUE", "change a value of that scene, e.g. light.body=moon; may be repeated", .set = option_change,
     .offset = offsetof(waves_request, changes)},
    {"as-spectrum", 0, NULL, "write the key water.spectrum instead of single waves", .set = option_given, .offset = offsetof(waves_request, as_spectrum)},
    {"overwrite", 0, NULL, "replace an existing file", .set = option_given, .offset = offsetof(waves_request, overwrite)},
};

static const option_table waves_table = {"waves",
                                         "[-o SCENE] [options]",
                                         "Writes a scene whose waves are drawn from a published wave spectrum, or from a buoy's.\n"
                                         "--json prints the sea's statistics instead, beside their closed forms.",
                                         waves_options,
                                         sizeof waves_options / sizeof waves_options[0],
                                         .notes = "exit codes: 0 done, 64 usage, 65 bad scene, table or sea, 66 no such input, 73 cannot write",
                                         .operand = {.set = refuse_operand},
                                         .changes = offsetof(waves_request, changes),
                                         .run = run};

int verb_waves(int count, char **arguments)
{
    waves_request request = {.values = scene_values_defaults()};
    request.spectrum = request.values.water.spectrum;
    request.spectrum.settings.kind = SPECTRUM_JONSWAP;
    const int code = options_run(&waves_table, &request, count, arguments);
    scene_values_free(&request.values);
    return code;
}

/* SPDX-License-Identifier: MIT */
/* `mangata info`: what this build contains, and what this machine can run. */
#include <libfyaml.h>
#include <openexr_base.h>
#include <spng.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/options.h"
#include "cli/common/verbs.h"

#if defined(__clang__)
#define COMPILER "clang " __clang_version__
#else
#define COMPILER "gcc " __VERSION__
#endif

/* Finds the version of ffmpeg; "": there is no ffmpeg. */
static void find_ffmpeg(char *line, size_t size)
{
    line[0] = 0;
    FILE *pipe = popen("ffmpeg -version 2>/dev/null </dev/null", "r");
    if (!pipe)
        return;
    if (!fgets(line, (int)size, pipe))
        line[0] = 0;
    char rest[4096];
    while (fread(rest, 1, sizeof rest, pipe) > 0)
        ;
    pclose(pipe);
    static const char start[] = "ffmpeg version ";
    if (strncmp(line, start, sizeof start - 1) != 0)
        line[0] = 0;
    else
        memmove(line, line + sizeof start - 1, strlen(line) - sizeof start + 2);
    line[strcspn(line, " \n")] = 0;
}

static json_t *list_isas(void)
{
    json_t *list = json_array();
    for (int i = MGT_ISA_SCALAR; list && i <= MGT_ISA_NEON; i++)
        if (mgt_isa_available((mgt_isa)i))
            json_array_append_new(list, json_string(mgt_isa_name((mgt_isa)i)));
    return list;
}

static json_t *list_methods(void)
{
    json_t *list = json_array();
    mgt_method_properties p;
    for (int m = 0; list && mgt_method_info((mgt_method)m, &p, sizeof p) == MGT_OK; m++)
        json_array_append_new(list, json_pack("{s:s, s:s, s:b}", "name", p.name, "description", p.description, "gl", (p.backends >> MGT_BACKEND_GL) & 1));
    return list;
}

/* The message id of a context that cannot be created. */
typedef struct refusal {
    char id[64];
} refusal;

static void keep_refusal(void *user, mgt_log_level level, const char *id, const char *text)
{
    (void)text;
    refusal *r = user;
    if (level == MGT_LOG_ERROR)
        snprintf(r->id, sizeof r->id, "%s", id);
}

/* The renderers of the OpenGL devices, in their order. For a device that cannot be used ("context.gl") it is the reason. */
static json_t *list_gl_devices(void)
{
    json_t *list = json_array();
    for (uint32_t device = 0; list && device < 64; device++) {
        refusal refused = {""};
        mgt_context_desc desc;
        mgt_context_desc_init(&desc, sizeof desc);
        desc.backend = MGT_BACKEND_GL;
        desc.gl_device = device;
        desc.log = keep_refusal;
        desc.log_user = &refused;
        mgt_context *context = NULL;
        if (mgt_context_create(&context, &desc) == MGT_OK) {
            mgt_context_info info = {.struct_size = sizeof info};
            mgt_context_get_info(context, &info);
            json_array_append_new(list, json_string(info.renderer));
            mgt_context_destroy(context);
        } else if (strcmp(refused.id, "context.gl") != 0) {
            break;
        } else {
            char text[600];
            snprintf(text, sizeof text, "not usable: %s", mgt_last_error(NULL));
            json_array_append_new(list, json_string(text));
        }
    }
    return list;
}

/* Those of this build: without OpenGL it has no shaders either. */
static json_t *list_backends(void)
{
    json_t *list = json_pack("[s]", mgt_backend_name(MGT_BACKEND_CPU));
    if (mgt_gl_source_name(0))
        json_array_append_new(list, json_string(mgt_backend_name(MGT_BACKEND_GL)));
    json_array_append_new(list, json_string(mgt_backend_name(MGT_BACKEND_NULL)));
    return list;
}

static json_t *collect(const mgt_context_info *info)
{
    int major = 0, minor = 0, patch = 0;
    const char *extra = "";
    char exr[64], ffmpeg[256];
    exr_get_library_version(&major, &minor, &patch, &extra);
    snprintf(exr, sizeof exr, "%d.%d.%d", major, minor, patch);
    find_ffmpeg(ffmpeg, sizeof ffmpeg);
    return json_pack("{s:s, s:s, s:{s:s, s:s, s:i, s:i}, s:o, s:{s:s, s:s, s:s, s:s, s:s*}, s:[s,s,s,s,s,s,s], s:o, s:o, s:o}", "version", mgt_version(),
                     "compiler", COMPILER, "default", "backend", mgt_backend_name(info->backend), "isa", mgt_isa_name(info->isa), "lanes", (int)info->lanes,
                     "threads", (int)info->threads, "instruction_sets", list_isas(), "libraries", "libfyaml", fy_library_version(), "libspng",
                     spng_version_string(), "openexr", exr, "jansson", jansson_version_str(), "ffmpeg", ffmpeg[0] ? ffmpeg : NULL, "formats", "png", "exr",
                     "pfm", "sums", "y4m", ffmpeg[0] ? "mp4" : "mp4 (needs ffmpeg)", ffmpeg[0] ? "mov" : "mov (needs ffmpeg)", "backends", list_backends(),
                     "gl_devices", list_gl_devices(), "methods", list_methods());
}

static void print_words(const char *label, const json_t *list)
{
    size_t i;
    json_t *word;
    printf("%-18s", label);
    json_array_foreach(list, i, word) printf("%s%s", i ? ", " : "", json_string_value(word));
    putchar('\n');
}

static void print_text(const json_t *all)
{
    const json_t *used = json_object_get(all, "default");
    json_t *libraries = json_object_get(all, "libraries"), *version;
    const char *name;
    printf("%-18s%s\n", "mangata", json_string_value(json_object_get(all, "version")));
    printf("%-18s%s\n", "compiler", json_string_value(json_object_get(all, "compiler")));
    print_words("backends", json_object_get(all, "backends"));
    size_t i;
    json_t *device;
    json_array_foreach(json_object_get(all, "gl_devices"), i, device) printf("OpenGL device %-4zu%s\n", i, json_string_value(device));
    print_words("instruction sets", json_object_get(all, "instruction_sets"));
    printf("%-18s%s, %d lanes, %d threads\n", "used", json_string_value(json_object_get(used, "isa")), (int)json_integer_value(json_object_get(used, "lanes")),
           (int)json_integer_value(json_object_get(used, "threads")));
    json_object_foreach(libraries, name, version) printf("%-18s%s\n", name, json_string_value(version));
    if (!json_object_get(libraries, "ffmpeg"))
        printf("%-18s%s\n", "ffmpeg", "not found");
    print_words("formats", json_object_get(all, "formats"));
}

static int refuse_operand(const option *o, void *place, const char *value)
{
    (void)o, (void)place;
    return console_error(EXIT_CODE_USAGE, "mangata info takes no %s", value);
}

static int run(void *request)
{
    const console *out = request;
    mgt_context *context = NULL;
    const mgt_status status = mgt_context_create(&context, NULL);
    if (status != MGT_OK)
        return console_library_error(NULL, status);
    mgt_context_info info = {.struct_size = sizeof info};
    mgt_context_get_info(context, &info);
    mgt_context_destroy(context);
    json_t *all = collect(&info);
    if (out->json || !all)
        return console_print_json(all);
    print_text(all);
    json_decref(all);
    return EXIT_CODE_OK;
}

static const option_table info_table = {"info",
                                        "[options]",
                                        "Lists version, instruction sets, threads, libraries and file formats.",
                                        .notes = "exit codes: 0 done, 1 failed, 64 usage",
                                        .operand = {.set = refuse_operand},
                                        .run = run};

int verb_info(int count, char **arguments)
{
    console out = {0};
    return options_run(&info_table, &out, count, arguments);
}

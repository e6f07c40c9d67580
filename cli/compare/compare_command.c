/* SPDX-License-Identifier: MIT */
/* Commands as text. */
#include "cli/compare/compare_command.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/markup.h"
#include "cli/common/memory_text.h"

char *compare_command(const compare_job *job)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    fputs("mangata compare", stream);
    for (int i = 0; i < job->request->argument_count; i++)
        shell_word(stream, job->request->arguments[i]);
    return memory_text_finish(stream, &text);
}

char *compare_picture_command(const compare_job *job, const compare_scene *scene, size_t picture)
{
    const compare_request *r = job->request;
    const mgt_quality *q = compare_picture_quality(scene, picture);
    const bool reference = picture == COMPARE_REFERENCE || picture >= COMPARE_HALF;
    char *text = NULL, frames[FRAME_LIST_TEXT];
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    frame_list_print(&r->frames, frames, sizeof frames);
    fputs("mangata render", stream);
    shell_scene(stream, scene->path);
    fprintf(stream, " -o %s_%%04d.exr --layer color --layer coverage --frames %s",
            reference ? compare_picture_name(job, picture) : r->methods[picture - 1].file, frames);
    if (reference && q->method == MGT_METHOD_SSAA)
        fprintf(stream, " --method ssaa%u --time-samples %u", q->spatial_samples, q->time_samples);
    else if (reference)
        fprintf(stream, " --method reference --spatial %u --time-samples %u", q->spatial_samples, q->time_samples);
    if (reference && q->refraction == MGT_REFRACTION_PATH_TRACED)
        fprintf(stream, " --refraction truth --refraction-samples %u", q->refraction_samples);
    if (!reference)
        fprintf(stream, " %s", r->methods[picture - 1].options);
    if (q->seed || scene_file_quality(scene->file).seed) /* the scene's would be taken without it */
        fprintf(stream, " --seed %llu", (unsigned long long)q->seed);
    for (size_t i = 0; i < r->changes.count; i++) {
        fputs(" --set", stream);
        shell_word(stream, r->changes.items[i]);
    }
    if (r->context.backend != MGT_BACKEND_CPU)
        fprintf(stream, " --backend %s", mgt_backend_name(r->context.backend));
    return memory_text_finish(stream, &text);
}

/* SPDX-License-Identifier: MIT
 *
 * The canonical text of a scene: every value that can change a pixel, one a line, for the render hash.
 */
#include <stdio.h>
#include <stdlib.h>

#include "scene/scene_models.h"
#include "scene/scene_sea.h"

enum { DOUBLE_DIGITS = 17, FLOAT_DIGITS = 9 }; /* read back as the same number */

/* Adding zero turns -0 into 0, which renders the same. */
static void write_number(FILE *stream, double value, int digits) { fprintf(stream, " %.*g", digits, value + 0.0); }

static void write_value(FILE *stream, const field_row *field, const void *value)
{
    const scene_exposure *exposure = value;
    switch (field->type) {
    case FIELD_COUNT:
        fprintf(stream, " %u", *(const uint32_t *)value);
        break;
    case FIELD_NUMBER:
        write_number(stream, *(const double *)value, DOUBLE_DIGITS);
        break;
    case FIELD_FLOAT:
        write_number(stream, (double)*(const float *)value, FLOAT_DIGITS);
        break;
    case FIELD_VECTOR:
    case FIELD_SCALE:
        for (int i = 0; i < 3; i++)
            write_number(stream, ((const double *)value)[i], DOUBLE_DIGITS);
        break;
    case FIELD_COLOR:
        for (int i = 0; i < 3; i++)
            write_number(stream, (double)((const float *)value)[i], FLOAT_DIGITS);
        break;
    case FIELD_LARGE:
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        fprintf(stream, " %s", field_print(field, value).text);
        break;
    case FIELD_EXPOSURE:
        if (exposure->automatic)
            fputs(" auto", stream);
        else
            write_number(stream, exposure->stops, DOUBLE_DIGITS);
        break;
    case FIELD_LIST:
        fprintf(stream, " %zu", ((const scene_list *)value)->count);
        break;
    case FIELD_TEXT:
    case FIELD_MAPPING:
        break;
    }
    fputc('\n', stream);
}

static void write_fields(FILE *stream, const char *path, const field_row *mapping, const void *values)
{
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        const void *value = field_at(field, values);
        char name[64];
        snprintf(name, sizeof name, "%s%s%s", path, path[0] != '\0' ? "." : "", field->key);
        if (field->flags & FIELD_NO_PIXELS)
            continue;
        if (field->type == FIELD_MAPPING) {
            if (field->flags & FIELD_GIVEN)
                fprintf(stream, "%s %d\n", name, *(const bool *)value);
            write_fields(stream, name, field, value);
            continue;
        }
        fputs(name, stream);
        write_value(stream, field, value);
        if (field->type != FIELD_LIST)
            continue;
        const scene_list *list = value;
        for (size_t i = 0; i < list->count; i++) {
            char item[64];
            snprintf(item, sizeof item, "%.40s[%zu]", name, i);
            write_fields(stream, item, field, (const char *)list->items + i * field->item_size);
        }
    }
}

char *scene_values_canonical(const scene_values *values, size_t *length)
{
    char *text = NULL;
    size_t size = 0;
    scene_values effective = *values;
    if (effective.camera.path.count > 0) /* the still camera is then never looked through */
        effective.camera.still = ((const scene_keyframe *)effective.camera.path.items)[0].camera;
    effective.water.waves = scene_water_all(&values->water);
    effective.sky.aerial = scene_values_aerial(values) ? WHEN_ON : WHEN_OFF;
    effective.sky.stars = scene_values_by_night(values, values->sky.stars) ? WHEN_ON : WHEN_OFF;
    effective.post.night_tint = scene_values_by_night(values, values->post.night_tint) ? WHEN_ON : WHEN_OFF;
    effective.water.foam.share = scene_water_foam(&values->water);
    if (!effective.post.exposure.automatic)
        effective.post.exposure_offset = 0;
    FILE *stream = open_memstream(&text, &size);
    if (stream == NULL)
        return NULL;
    write_fields(stream, "", scene_root_field(), &effective);
    scene_models_write(stream, values->models);
    bool bad = ferror(stream) != 0;
    if (fclose(stream) != 0 || bad) {
        free(text);
        return NULL;
    }
    if (length != NULL)
        *length = size;
    return text;
}

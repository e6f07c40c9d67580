/* SPDX-License-Identifier: MIT
 *
 * Targets: formats, strides, bounds, several layers at once, and that neither crop nor threads nor company change a byte.
 */
#include "api_sea.h"

typedef struct layer_format {
    mgt_layer layer;
    mgt_format format;
    size_t size; /* bytes a pixel */
} layer_format;

static const layer_format all_formats[] = {
    {MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, 12},       {MGT_LAYER_COLOR, MGT_FORMAT_RGBA32F, 16},
    {MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, 4},    {MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, 4},
    {MGT_LAYER_MASK, MGT_FORMAT_R32F, 4},           {MGT_LAYER_DEPTH, MGT_FORMAT_R32F, 4},
    {MGT_LAYER_NORMAL, MGT_FORMAT_RGB32F, 12},      {MGT_LAYER_NORMAL, MGT_FORMAT_RGBA32F, 16},
    {MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, 4},        {MGT_LAYER_IMPORTANCE, MGT_FORMAT_R32F, 4},
    {MGT_LAYER_DETAIL, MGT_FORMAT_R32F, 4},         {MGT_LAYER_REFRACTION, MGT_FORMAT_RGB32F, 12},
    {MGT_LAYER_REFRACTION, MGT_FORMAT_RGBA32F, 16}, {MGT_LAYER_REFRACTION_ERROR, MGT_FORMAT_R32F, 4},
    {MGT_LAYER_FOAM, MGT_FORMAT_R32F, 4},
};
enum { FORMATS = sizeof all_formats / sizeof *all_formats, PIXELS = SEA_WIDTH * SEA_HEIGHT };

typedef struct planes {
    unsigned char *bytes[FORMATS]; /* tightly packed, SEA_WIDTH × SEA_HEIGHT at most */
} planes;

static planes planes_create(void)
{
    planes p;
    for (int k = 0; k < FORMATS; k++)
        assert_non_null(p.bytes[k] = calloc(PIXELS, all_formats[k].size));
    return p;
}

static void planes_destroy(planes *p)
{
    for (int k = 0; k < FORMATS; k++)
        free(p->bytes[k]);
}

/* All layers in all formats by one call. */
static void render_all(mgt_context *context, const mgt_scene *scene, planes *p)
{
    mgt_target targets[FORMATS];
    for (int k = 0; k < FORMATS; k++)
        targets[k] = sea_target(all_formats[k].layer, all_formats[k].format, p->bytes[k], 0);
    sea_render(context, scene, targets, FORMATS);
}

static void layers_together_equal_each_alone(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    planes together = planes_create();
    unsigned char *alone = calloc(PIXELS, 16);
    assert_non_null(alone);
    for (int m = 0; m < SEA_METHODS; m++) {
        sea_take_method(&scene, m);
        render_all(context, &scene, &together);
        for (int k = 0; k < FORMATS; k++) {
            const mgt_target target = sea_target(all_formats[k].layer, all_formats[k].format, alone, 0);
            sea_render(context, &scene, &target, 1);
            if (memcmp(alone, together.bytes[k], PIXELS * all_formats[k].size) != 0)
                fail_msg("method %d, layer %d, format %d alone differs", m, (int)all_formats[k].layer, (int)all_formats[k].format);
        }
    }
    free(alone);
    planes_destroy(&together);
    mgt_context_destroy(context);
}

/* One target inside canary bytes, rows `gap` bytes further apart than needed, top-down or bottom-up. */
static void check_strided(mgt_context *context, const mgt_scene *scene, const layer_format *f, const unsigned char *expected, size_t gap, bool upward)
{
    enum { MARGIN = 64, CANARY = 0xa5 };
    const size_t row = f->size * SEA_WIDTH, stride = row + gap, total = stride * SEA_HEIGHT + 2 * MARGIN;
    unsigned char *memory = malloc(total);
    assert_non_null(memory);
    memset(memory, CANARY, total);
    unsigned char *first = memory + MARGIN + (upward ? stride * (SEA_HEIGHT - 1) : 0);
    const mgt_target target = sea_target(f->layer, f->format, first, upward ? -(ptrdiff_t)stride : (ptrdiff_t)stride);
    sea_render(context, scene, &target, 1);
    for (size_t y = 0; y < SEA_HEIGHT; y++) {
        const unsigned char *at = memory + MARGIN + stride * (upward ? SEA_HEIGHT - 1 - y : y);
        assert_memory_equal(at, expected + row * y, row);
        for (size_t i = row; i < stride; i++)
            assert_int_equal(at[i], CANARY);
    }
    for (size_t i = 0; i < MARGIN; i++) {
        assert_int_equal(memory[i], CANARY);
        assert_int_equal(memory[total - 1 - i], CANARY);
    }
    free(memory);
}

static void strides_and_bounds_are_kept(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    planes tight = planes_create();
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_REFERENCE};
    for (int m = 0; m < 2; m++) {
        scene.quality.method = methods[m];
        render_all(context, &scene, &tight);
        for (int k = 0; k < FORMATS; k++) {
            check_strided(context, &scene, &all_formats[k], tight.bytes[k], 0, true);
            check_strided(context, &scene, &all_formats[k], tight.bytes[k], 52, false);
            check_strided(context, &scene, &all_formats[k], tight.bytes[k], 52, true);
        }
        scene.post.glare = 0; /* written by tiles then, not by rows */
        render_all(context, &scene, &tight);
        check_strided(context, &scene, &all_formats[2], tight.bytes[2], 3, true);
        scene.post.glare = 0.03f;
    }
    planes_destroy(&tight);
    mgt_context_destroy(context);
}

static void null_backend_fills_rows_alone(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_NULL;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    unsigned char *zero = calloc(PIXELS, 16);
    assert_non_null(zero);
    for (int k = 0; k < FORMATS; k++) {
        check_strided(context, &scene, &all_formats[k], zero, 52, false);
        check_strided(context, &scene, &all_formats[k], zero, 52, true);
    }
    free(zero);
    mgt_context_destroy(context);
}

/* A crop's targets hold that place of the whole picture, glare and all. */
static void crops_equal_the_whole(void **state)
{
    (void)state;
    static const uint32_t crops[][4] = {{0, 0, 1, 1}, {31, 15, 34, 18}, {5, 20, 78, 27}, {40, 0, 3, 47}, {82, 46, 1, 1}};
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    planes whole = planes_create(), part = planes_create();
    for (int m = 0; m < SEA_METHODS; m++) {
        sea_take_method(&scene, m);
        scene.image = (mgt_image){.width = SEA_WIDTH, .height = SEA_HEIGHT};
        render_all(context, &scene, &whole);
        for (size_t c = 0; c < sizeof crops / sizeof *crops; c++) {
            const uint32_t *r = crops[c];
            scene.image = (mgt_image){SEA_WIDTH, SEA_HEIGHT, r[0], r[1], r[2], r[3]};
            render_all(context, &scene, &part);
            for (int k = 0; k < FORMATS; k++)
                for (uint32_t y = 0; y < r[3]; y++) {
                    const size_t size = all_formats[k].size;
                    assert_memory_equal(part.bytes[k] + size * r[2] * y, whole.bytes[k] + size * ((size_t)(r[1] + y) * SEA_WIDTH + r[0]), size * r[2]);
                }
        }
    }
    planes_destroy(&whole);
    planes_destroy(&part);
    mgt_context_destroy(context);
}

static void threads_and_instruction_sets_do_not_count(void **state)
{
    (void)state;
    static const struct {
        uint32_t threads;
        mgt_isa isa;
    } machines[] = {{1, MGT_ISA_AVX2}, {2, MGT_ISA_AVX2}, {7, MGT_ISA_AVX2}, {2, MGT_ISA_AVX512}, {7, MGT_ISA_AVX512}, {7, MGT_ISA_SCALAR}};
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    planes first[SEA_METHODS], again = planes_create();
    mgt_context *scalar = sea_context(1, MGT_ISA_SCALAR);
    for (int m = 0; m < SEA_METHODS; m++) {
        first[m] = planes_create();
        sea_take_method(&scene, m);
        render_all(scalar, &scene, &first[m]);
    }
    mgt_context_destroy(scalar);
    for (size_t i = 0; i < sizeof machines / sizeof *machines; i++) {
        if (!mgt_isa_available(machines[i].isa))
            continue;
        mgt_context *context = sea_context(machines[i].threads, machines[i].isa);
        for (int m = 0; m < SEA_METHODS; m++) {
            sea_take_method(&scene, m);
            render_all(context, &scene, &again);
            for (int k = 0; k < FORMATS; k++)
                if (memcmp(again.bytes[k], first[m].bytes[k], PIXELS * all_formats[k].size) != 0)
                    fail_msg("method %d, layer %d, format %d by %u threads of instruction set %d differs from the plain build", m, (int)all_formats[k].layer,
                             (int)all_formats[k].format, machines[i].threads, (int)machines[i].isa);
        }
        mgt_context_destroy(context);
    }
    for (int m = 0; m < SEA_METHODS; m++)
        planes_destroy(&first[m]);
    planes_destroy(&again);
}

/* What was rendered before leaves no trace: another sky, another size, a cancelled frame. */
static void history_does_not_count(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    planes first = planes_create(), again = planes_create();
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    render_all(context, &scene, &first);
    mgt_scene other = scene;
    other.sky.model = MGT_SKY_ATMOSPHERE;
    other.light.elevation_deg = 3;
    other.image = (mgt_image){.width = 20, .height = 20};
    other.water.wave_count = 3;
    other.quality.method = MGT_METHOD_SSAA;
    render_all(context, &other, &again);
    other.sky.model = MGT_SKY_BLACK;
    render_all(context, &other, &again);
    render_all(context, &scene, &again);
    for (int k = 0; k < FORMATS; k++)
        assert_memory_equal(again.bytes[k], first.bytes[k], PIXELS * all_formats[k].size);
    planes_destroy(&first);
    planes_destroy(&again);
    mgt_context_destroy(context);
}

static void layers_hold_what_they_promise(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    planes p = planes_create();
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int m = 0; m < SEA_METHODS; m++) {
        sea_take_method(&scene, m);
        render_all(context, &scene, &p);
        const float *rgb = (const void *)p.bytes[0], *rgba = (const void *)p.bytes[1], *coverage = (const void *)p.bytes[3];
        const float *water = (const void *)p.bytes[4], *depth = (const void *)p.bytes[5], *normal = (const void *)p.bytes[6],
                    *normal4 = (const void *)p.bytes[7];
        int lit = 0, dry = 0, wet = 0;
        for (int i = 0; i < PIXELS; i++) {
            assert_true(coverage[i] >= 0 && coverage[i] <= water[i] && water[i] >= 0 && water[i] <= 1);
            lit += coverage[i] > 0, wet += water[i] == 1, dry += water[i] == 0;
            const float *n = normal + 3 * i;
            const double length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
            assert_true(isinf(depth[i]) ? length == 0 || water[i] > 0 : depth[i] > 0 && fabs(length - 1) < 1e-5 && n[1] > 0);
            assert_true(rgba[4 * i + 3] == 1 && normal4[4 * i + 3] == 1 && p.bytes[2][4 * i + 3] == 255);
            for (int c = 0; c < 3; c++)
                assert_true(rgb[3 * i + c] >= 0 && isfinite(rgb[3 * i + c]) && rgb[3 * i + c] == rgba[4 * i + c] && n[c] == normal4[4 * i + c]);
        }
        if (!(lit > 10 && wet > PIXELS / 3 && dry > PIXELS / 10))
            fail_msg("method %d: %d pixels lit, %d of water, %d without", m, lit, wet, dry);
    }
    planes_destroy(&p);
    mgt_context_destroy(context);
}

static void refused(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count, const char *text)
{
    const mgt_status status = mgt_render(context, scene, targets, count);
    if (status != MGT_ERROR_ARGUMENT || !strstr(mgt_last_error(context), text))
        fail_msg("expected a refusal with \"%s\", got %d: %s", text, (int)status, mgt_last_error(context));
}

static void bad_targets_are_refused(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    static float pixels[PIXELS * 4 + 4];
    const mgt_target good = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, pixels, 0);
    mgt_target many[17];
    for (int i = 0; i < 17; i++)
        many[i] = good;
    refused(context, &scene, NULL, 1, "NULL");
    refused(context, &scene, many, 0, "1 to 16");
    refused(context, &scene, many, 17, "1 to 16");
    sea_render(context, &scene, many, 16);
    for (int layer = -1; layer <= MGT_LAYER_FOAM + 1; layer++)
        for (int format = -1; format <= MGT_FORMAT_RGBA8_SRGB + 1; format++) {
            const mgt_target t = sea_target((mgt_layer)layer, (mgt_format)format, pixels, 0);
            bool legal = false;
            for (int k = 0; k < FORMATS; k++)
                legal |= (int)all_formats[k].layer == layer && (int)all_formats[k].format == format;
            if (!legal)
                refused(context, &scene, &t, 1, layer < 0 || layer > MGT_LAYER_FOAM ? "layer" : "format");
        }
    mgt_target t = sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_RGBA8_SRGB, pixels, 0);
    refused(context, &scene, &t, 1, "depth cannot be written in format rgba8_srgb; allowed is r32f");
    t = good;
    t.pixels = NULL;
    refused(context, &scene, &t, 1, "NULL");
    t = good;
    t.struct_size = 0;
    refused(context, &scene, &t, 1, "struct_size");
    t.struct_size = sizeof t + 1;
    refused(context, &scene, &t, 1, "struct_size");
    static const ptrdiff_t strides[] = {12 * SEA_WIDTH - 4, -(12 * SEA_WIDTH - 4), 4, -4, 12 * SEA_WIDTH + 2, PTRDIFF_MIN, PTRDIFF_MIN + 4, PTRDIFF_MAX - 3};
    for (size_t i = 0; i < sizeof strides / sizeof *strides; i++) {
        t = good;
        t.row_stride = strides[i];
        refused(context, &scene, &t, 1, "row_stride");
    }
    t = good;
    t.pixels = (char *)pixels + 1;
    refused(context, &scene, &t, 1, "multiples of 4");
    many[3].layer = MGT_LAYER_DEPTH; /* the text says which */
    refused(context, &scene, many, 5, "target 3");
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_together_equal_each_alone),
        cmocka_unit_test(strides_and_bounds_are_kept),
        cmocka_unit_test(null_backend_fills_rows_alone),
        cmocka_unit_test(crops_equal_the_whole),
        cmocka_unit_test(threads_and_instruction_sets_do_not_count),
        cmocka_unit_test(history_does_not_count),
        cmocka_unit_test(layers_hold_what_they_promise),
        cmocka_unit_test(bad_targets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
